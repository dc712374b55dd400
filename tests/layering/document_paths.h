#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sparsight::layering {

// What a Markdown text says is in the tree: words in `code` that start with a top-level folder, and
// the targets of links and pictures that are no web addresses. Both forms of `a/b.{h,cc}` are
// written out. Words with <placeholders> or wildcards are no paths.
struct DocumentPath {
  std::string path;
  int line = 0;
  bool relative_to_document = false;  // links are; code is from the top of the tree
};
std::vector<DocumentPath> find_paths(std::string_view markdown);

// The paths of one document that do not exist, each as "file:line: no such file: path".
std::vector<std::string> check_document(const std::filesystem::path& top,
                                        const std::filesystem::path& document);

}  // namespace sparsight::layering
