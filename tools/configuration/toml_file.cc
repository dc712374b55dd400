#include "tools/configuration/toml_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace sparsight {

Result<toml::table> parse_toml_table(std::string_view toml, std::string_view file) {
  try {
    return toml::parse(toml, file);
  } catch (const toml::parse_error& error) {
    return fail(ErrorCode::kMalformed, fmt::format("{}:{}: not TOML: {}", file,
                                                   error.source().begin.line, error.description()));
  }
}

Error error_of(std::vector<FileError> errors, std::string_view file) {
  std::stable_sort(errors.begin(), errors.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
  std::string text;
  for (const FileError& error : errors) {
    text += fmt::format("{}{}:{}: {}", text.empty() ? "" : "\n", file, error.line, error.text);
  }
  return {ErrorCode::kOutOfRange, std::move(text)};
}

}  // namespace sparsight
