#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "tools/configuration/toml_reader.h"
#include "tools/configuration/toml_writer.h"

namespace sparsight {

// `file` only names the text in errors.
Result<toml::table> parse_toml_table(std::string_view toml, std::string_view file);

// All of them, each on a line "FILE:LINE: text", in the order of the lines.
Error error_of(std::vector<FileError> errors, std::string_view file);

// What visit_fields(visitor, Config&) says the file may hold; what it does not hold keeps the
// default of its header.
template <typename Config>
Result<Config> parse_toml(std::string_view toml, std::string_view file) {
  const auto table = parse_toml_table(toml, file);
  if (!table) return tl::unexpected(table.error());
  Config config;
  std::vector<FileError> errors;
  TomlReader reader(*table, "", errors);
  visit_fields(reader, config);
  reader.refuse_unknown_keys();
  if (!errors.empty()) return tl::unexpected(error_of(std::move(errors), file));
  return config;
}

// All fields with their values; parse_toml() gives the same configuration back.
template <typename Config>
std::string describe_as_toml(Config config) {  // a copy: visited fields are never const
  std::string toml;
  TomlWriter writer(toml);
  visit_fields(writer, config);
  return toml + writer.tables();
}

}  // namespace sparsight
