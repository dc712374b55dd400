#include "tests/layering/layer_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>

namespace sparsight::layering {
namespace {

using Names = std::set<std::string_view>;

// What each layer may include besides itself. Tests and tools may include everything.
const std::map<std::string_view, Names> kMayInclude = {
    {"hal", {}},
    {"drivers", {"hal"}},
    {"slam", {"hal"}},
    {"realtime", {"hal", "slam"}},
};
const Names kLayers = {"hal", "drivers", "slam", "realtime", "tools", "tests"};

bool is_product(const SourceFile& file) { return file.layer() != "tests"; }

Violation at(const SourceFile& file, const Include& include, std::string_view remedy) {
  return fmt::format("{}:{}: includes {}: {}", file.path, include.line, include.path, remedy);
}

// A name that ends with a slash stands for all below it.
bool is_one_of(std::string_view header, const std::vector<std::string_view>& names) {
  return std::ranges::any_of(names, [&](std::string_view name) {
    return name.ends_with('/') ? header.starts_with(name) : header == name;
  });
}

struct LibraryRule {
  std::vector<std::string_view> headers;
  Names layers;             // where a .cc may include them
  bool in_headers = false;  // and a .h, too
  std::string_view remedy;
};

const std::vector<LibraryRule> kLibraryRules = {
    {{"Eigen/Dense", "Eigen/Eigen"},
     {},
     false,
     "it draws in all of Eigen; include the modules in use, such as Eigen/Geometry"},
    {{"opencv2/"},
     {"drivers", "slam", "tools"},
     false,
     "OpenCV reads images and finds features, in .cc files of drivers, slam and tools only"},
    {{"opencv2/imgcodecs", "opencv2/imgcodecs.hpp"},
     {"drivers", "tools"},
     false,
     "image files are read and written in drivers and tools"},
    {{"ceres/"}, {"slam"}, false, "Ceres optimises the pose graph, in .cc files of slam only"},
    {{"CLI/"}, {"tools"}, true, "the command line belongs to tools"},
    {{"toml++/", "toml.hpp"},
     {"tools"},
     true,
     "one place parses files, and it is in tools; objects take values"},
    {{"nlohmann/"},
     {"drivers", "tools"},
     true,
     "JSON is what tools write and what devices answer; the rest takes values"},
    {{"pcap", "httplib.h"},
     {"drivers"},
     false,
     "devices and their captures are the drivers' business, behind hal's interfaces"},
};

}  // namespace

std::vector<Violation> check_layers(const std::vector<SourceFile>& sources) {
  std::vector<Violation> violations;
  for (const SourceFile& file : sources) {
    const auto rule = kMayInclude.find(file.layer());
    for (const Include& include : file.includes) {
      const std::string_view target =
          std::string_view{include.path}.substr(0, include.path.find('/'));
      const bool ours = kLayers.contains(target) && include.path.find('/') != std::string::npos;
      if (include.quoted && !ours) {
        violations.push_back(
            at(file, include, "quotes are for our own headers, named from the top of the tree"));
      } else if (!include.quoted && ours) {
        violations.push_back(at(file, include, "our own headers stand in quotes"));
      } else if (ours && target == "tests" && is_product(file)) {
        violations.push_back(at(file, include, "the product does not know its tests"));
      } else if (ours && rule != kMayInclude.end() && target != file.layer() &&
                 !rule->second.contains(target)) {
        violations.push_back(
            at(file, include, fmt::format("{} may not know {}", file.layer(), target)));
      }
    }
  }
  return violations;
}

std::vector<Violation> check_third_party(const std::vector<SourceFile>& sources) {
  std::vector<Violation> violations;
  for (const SourceFile& file : sources) {
    if (!is_product(file)) continue;
    for (const Include& include : file.includes) {
      for (const LibraryRule& rule : kLibraryRules) {
        if (!is_one_of(include.path, rule.headers)) continue;
        if (rule.layers.contains(file.layer()) && (rule.in_headers || !file.is_header())) continue;
        violations.push_back(at(file, include, rule.remedy));
      }
    }
  }
  return violations;
}

std::vector<Violation> check_estimation_is_pure(const std::vector<SourceFile>& sources) {
  static const Names kImpure = {"thread",  "mutex",   "shared_mutex", "condition_variable",
                                "future",  "fstream", "filesystem",   "iostream",
                                "cstdio",  "cstdlib", "ctime",        "random",
                                "unistd.h"};
  std::vector<Violation> violations;
  for (const SourceFile& file : sources) {
    if (file.layer() != "slam") continue;
    for (const Include& include : file.includes) {
      if (kImpure.contains(include.path)) {
        violations.push_back(at(file, include, "slam has no thread, no clock, no file, no chance"));
      }
    }
    for (const char* clock : {"steady_clock", "system_clock", "clock_gettime", "::now("}) {
      if (file.text.find(clock) != std::string::npos) {
        violations.push_back(fmt::format("{}: says {}: slam has no clock; times come with the data",
                                         file.path, clock));
      }
    }
  }
  return violations;
}

std::vector<Violation> check_file_pairs(const std::vector<SourceFile>& sources) {
  std::set<std::string> paths;
  for (const SourceFile& file : sources) paths.insert(file.path);

  std::vector<Violation> violations;
  for (const SourceFile& file : sources) {
    const bool library = kMayInclude.contains(file.layer());
    if (!library || file.is_header()) continue;
    const std::string header = file.path.substr(0, file.path.size() - 2) + "h";
    if (!paths.contains(header)) {
      violations.push_back(fmt::format("{}: has no header {}", file.path, header));
    }
  }
  return violations;
}

std::vector<Violation> check_folder_names(const std::vector<SourceFile>& sources) {
  static const Names kNameless = {"util", "utils", "common", "helper", "helpers", "misc", "core"};
  std::vector<Violation> violations;
  for (const SourceFile& file : sources) {
    for (const std::filesystem::path& part : std::filesystem::path{file.path}) {
      const std::string name = part.stem().string();
      if (kNameless.contains(name)) {
        violations.push_back(
            fmt::format("{}: '{}' is no concept; name it after what it holds", file.path, name));
      }
    }
  }
  return violations;
}

}  // namespace sparsight::layering
