#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tools/configuration/field_range.h"

namespace sparsight {

// Writes the fields of one struct after its [table] line, then the tables in it: in TOML, a key
// after a nested table's line would be the nested one's.
class TomlWriter {
 public:
  explicit TomlWriter(std::string& toml, std::string path = {})
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
    TomlWriter writer(fields, path);
    visit_fields(writer, value);
    tables_ += fmt::format("\n[{}]\n{}{}", path, fields, writer.tables_);
  }
  const std::string& tables() const { return tables_; }

 private:
  std::string& toml_;
  std::string path_;
  std::string tables_;
};

}  // namespace sparsight
