#pragma once

#include <Eigen/Geometry>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tools/configuration/field_range.h"

namespace sparsight {

// Values as TOML writes them, to the last digit.
std::string toml_text(std::int64_t value);
std::string toml_text(double value);
std::string toml_text(bool value);
std::string toml_text(std::string_view value);

// Writes the fields of one struct after its [table] line, then the tables in it: in TOML, a key
// after a nested table's line would be the nested one's. An absent field is not written.
class TomlWriter {
 public:
  explicit TomlWriter(std::string& toml, std::string path = {})
      : toml_(toml), path_(std::move(path)) {}

  template <typename Number>
  void field(std::string_view key, const Number& value, FieldRange) {
    write(key, text_of(value));
  }
  template <typename Number>
  void field(std::string_view key, const std::optional<Number>& value, FieldRange) {
    if (value) write(key, text_of(*value));
  }
  template <typename Number>
  void required_field(std::string_view key, const Number& value, FieldRange range) {
    field(key, value, range);
  }
  void field(std::string_view key, bool value) { write(key, toml_text(value)); }
  void text(std::string_view key, const std::string& value, const TextRule&) {
    write(key, toml_text(std::string_view(value)));
  }

  template <typename Enum>
  void choice(std::string_view key, Enum value,
              const std::vector<std::pair<std::string_view, Enum>>& names) {
    for (const auto& [name, enumerator] : names) {
      if (enumerator == value) write(key, toml_text(name));
    }
  }
  template <typename Enum>
  void choice(std::string_view key, const std::optional<Enum>& value,
              const std::vector<std::pair<std::string_view, Enum>>& names) {
    if (value) choice(key, *value, names);
  }

  template <typename Struct>
  void table(std::string_view key, Struct& value) {
    write_table("[" + nested(key) + "]", key, value);
  }
  template <typename Struct>
  void optional_table(std::string_view key, Struct& value, bool present) {
    if (present) table(key, value);
  }
  template <typename Struct>
  void list(std::string_view key, std::vector<Struct>& values) {
    for (Struct& value : values) write_table("[[" + nested(key) + "]]", key, value);
  }
  void transform(std::string_view key, const Eigen::Isometry3d& T, std::string_view meaning);

  void require(std::string_view) {}
  void check(std::string_view, bool, const std::string&) {}

  const std::string& tables() const { return tables_; }

 private:
  template <typename Number>
  static std::string text_of(const Number& value) {
    if constexpr (std::is_integral_v<Number>) {
      return toml_text(static_cast<std::int64_t>(value));
    } else {
      return toml_text(static_cast<double>(value));
    }
  }
  template <typename Count, typename Period>
  static std::string text_of(const std::chrono::duration<Count, Period>& value) {
    return text_of(value.count());
  }
  template <typename Element, std::size_t kSize>
  static std::string text_of(const std::array<Element, kSize>& values) {
    std::string text = "[";
    for (const Element& value : values) text += (text.size() > 1 ? ", " : "") + text_of(value);
    return text + "]";
  }

  template <typename Struct>
  void write_table(const std::string& heading, std::string_view key, Struct& value) {
    std::string fields;
    TomlWriter writer(fields, nested(key));
    visit_fields(writer, value);
    tables_ += "\n" + heading + "\n" + fields + writer.tables_;
  }
  void write(std::string_view key, std::string_view value);
  std::string nested(std::string_view key) const;

  std::string& toml_;
  std::string path_;
  std::string tables_;
};

}  // namespace sparsight
