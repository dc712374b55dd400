#include "tools/configuration/rig_text_rules.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

bool is_ipv4(std::string_view text) {
  in_addr address{};
  // inet_pton() stops at a zero byte.
  return text.find('\0') == std::string_view::npos &&
         inet_pton(AF_INET, std::string(text).c_str(), &address) == 1;
}

}  // namespace

TextRule any_text() {
  return {[](std::string_view) { return true; }, ""};
}

TextRule some_text() {
  return {[](std::string_view text) { return !text.empty(); }, "must not be empty"};
}

TextRule ipv4_address() { return {is_ipv4, "must be an IPv4 address such as 192.168.1.201"}; }

TextRule ipv4_address_or_nothing() {
  return {[](std::string_view text) { return text.empty() || is_ipv4(text); },
          "must be an IPv4 address such as 192.168.1.201, or \"\" for any"};
}

TextRule pixel_format_or_auto() {
  std::string names;
  for (const PixelFormatCode& code : pixel_format_codes()) {
    names += fmt::format(", \"{}\"", code.name);
  }
  return {[](std::string_view text) { return text == "auto" || format_named(text).has_value(); },
          "must be one of \"auto\"" + names};
}

}  // namespace sparsight
