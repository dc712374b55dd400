#include "tools/configuration/toml_writer.h"

#include <fmt/format.h>

#include "tools/configuration/transform_fields.h"

namespace sparsight {

std::string toml_text(std::int64_t value) { return fmt::format("{}", value); }

std::string toml_text(double value) {
  // A float in TOML needs its point: 5 would be an integer.
  std::string number = fmt::format("{}", value);
  if (number.find_first_of(".en") == std::string::npos) number += ".0";
  return number;
}

std::string toml_text(bool value) { return value ? "true" : "false"; }

std::string toml_text(std::string_view value) {
  std::string text = "\"";
  for (const char c : value) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += fmt::format("\\{}", c);
    } else if (code < 0x20 || code == 0x7F) {
      text += fmt::format("\\u{:04X}", code);
    } else {
      text += c;
    }
  }
  return text + "\"";
}

void TomlWriter::transform(std::string_view key, const Eigen::Isometry3d& T,
                           std::string_view meaning) {
  TransformFields fields = fields_of(T);
  std::string matrix;
  TomlWriter writer(matrix, nested(key));
  visit_fields(writer, fields);
  tables_ += fmt::format("\n[{}]\n# {}, metres\n{}", nested(key), meaning, matrix);
}

void TomlWriter::write(std::string_view key, std::string_view value) {
  toml_ += fmt::format("{} = {}\n", key, value);
}

std::string TomlWriter::nested(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

}  // namespace sparsight
