#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sparsight::layering {

struct Include {
  std::string path;  // as written between the quotes or brackets
  bool quoted = false;
  int line = 0;
};

struct SourceFile {
  std::string path;  // from the top of the tree, with forward slashes
  std::string text;
  std::vector<Include> includes;

  bool is_header() const { return path.ends_with(".h"); }
  // The top-level folder.
  std::string_view layer() const { return std::string_view{path}.substr(0, path.find('/')); }
};

// Includes outside of comments, in the order they stand.
std::vector<Include> find_includes(std::string_view text);

// Every .h and .cc below the layers and the tests, in the order of their paths.
std::vector<SourceFile> read_sources(const std::filesystem::path& top);

}  // namespace sparsight::layering
