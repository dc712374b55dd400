#include "tools/sparsight/map_options.h"

#include <string>

namespace sparsight {
namespace {

// To what CLI11 makes an enumerator of; returns what is wrong.
std::string format_as_number(std::string& text) {
  for (const CloudFormat format : kCloudFormats) {
    if (CLI::detail::to_lower(text) != name_of(format)) continue;
    text = std::to_string(static_cast<int>(format));
    return {};
  }
  return "ply, pcd and las are known, not " + text;
}

}  // namespace

void add_map_options(CLI::App& command, std::vector<CloudFormat>& formats,
                     SessionMapOptions& maps) {
  CLI::Option* format =
      command
          .add_option("--map-format", formats,
                      "files of the map, of ply, pcd and las (LAS 1.4), separated by commas")
          ->type_name("FORMATS")
          ->delimiter(',')
          ->transform(CLI::Validator(format_as_number, ""))
          ->default_str("ply");
  command
      .add_flag_callback(
          "--no-map", [&formats] { formats.clear(); }, "write no map file")
      ->excludes(format);
  command
      .add_option("--map", maps.earlier,
                  "go on in the map of an earlier session: once a place of it is seen again, poses "
                  "are in its frame")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  command
      .add_option(
          "--save-map", maps.save_to,
          "leave a map for later sessions, with all that --map gave; may be the same folder")
      ->type_name("DIR");
}

}  // namespace sparsight
