#include "tools/configuration/profile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "tools/configuration/embedded_profiles.h"
#include "tools/configuration/profile_reader.h"

namespace sparsight {
namespace {

// Writes the fields of one struct after its [table] line, then the tables in it: in TOML, a key
// after a nested table's line would be the nested one's.
class ProfileWriter {
 public:
  explicit ProfileWriter(std::string& toml, std::string path = {})
      : toml_(toml), path_(std::move(path)) {}

  template <typename Number>
  void field(std::string_view key, Number value, FieldRange) {
    if constexpr (std::is_integral_v<Number>) {
      toml_ += fmt::format("{} = {}\n", key, value);
    } else {
      // A float in TOML needs its point: 5 would be an integer.
      std::string number = fmt::format("{}", value);
      if (number.find_first_of(".en") == std::string::npos) number += ".0";
      toml_ += fmt::format("{} = {}\n", key, number);
    }
  }
  void field(std::string_view key, bool value) { toml_ += fmt::format("{} = {}\n", key, value); }

  template <typename Enum>
  void choice(std::string_view key, Enum value,
              const std::vector<std::pair<std::string_view, Enum>>& names) {
    for (const auto& [name, enumerator] : names) {
      if (enumerator == value) toml_ += fmt::format("{} = \"{}\"\n", key, name);
    }
  }

  template <typename Struct>
  void table(std::string_view key, Struct& value) {
    const std::string path = path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
    std::string fields;
    ProfileWriter writer(fields, path);
    visit_fields(writer, value);
    tables_ += fmt::format("\n[{}]\n{}{}", path, fields, writer.tables_);
  }
  const std::string& tables() const { return tables_; }

 private:
  std::string& toml_;
  std::string path_;
  std::string tables_;
};

Error error_of(std::vector<ProfileError> errors, std::string_view file) {
  std::stable_sort(errors.begin(), errors.end(),
                   [](const auto& a, const auto& b) { return a.line < b.line; });
  std::string text;
  for (const ProfileError& error : errors) {
    text += fmt::format("{}{}:{}: {}", text.empty() ? "" : "\n", file, error.line, error.text);
  }
  return {ErrorCode::kOutOfRange, std::move(text)};
}

}  // namespace

std::vector<std::string> built_in_profiles() {
  std::vector<std::string> names;
  for (const EmbeddedProfile& profile : embedded_profiles()) names.emplace_back(profile.name);
  return names;
}

Result<OdometryConfig> parse_profile(std::string_view toml, std::string_view file) {
  toml::table table;
  try {
    table = toml::parse(toml, file);
  } catch (const toml::parse_error& error) {
    return fail(ErrorCode::kMalformed, fmt::format("{}:{}: not TOML: {}", file,
                                                   error.source().begin.line, error.description()));
  }
  OdometryConfig config;
  std::vector<ProfileError> errors;
  ProfileReader reader(table, "", errors);
  visit_fields(reader, config);
  reader.refuse_unknown_keys();
  if (!errors.empty()) return tl::unexpected(error_of(std::move(errors), file));
  return config;
}

Result<OdometryConfig> load_profile(const std::string& name_or_path) {
  for (const EmbeddedProfile& profile : embedded_profiles()) {
    if (profile.name == name_or_path) {
      return parse_profile(profile.toml, fmt::format("config/{}.toml", profile.name));
    }
  }
  std::ifstream file(name_or_path);
  std::ostringstream toml;
  if (!file || !(toml << file.rdbuf())) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot read this profile; give one of {} or the path of a "
                            "TOML file that is not empty",
                            name_or_path, fmt::join(built_in_profiles(), ", ")));
  }
  return parse_profile(toml.str(), name_or_path);
}

std::string describe_profile(const OdometryConfig& config) {
  std::string toml;
  ProfileWriter writer(toml);
  OdometryConfig copy = config;  // visited fields are never const
  visit_fields(writer, copy);
  return toml + writer.tables();
}

}  // namespace sparsight
