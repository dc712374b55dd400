#include "tests/layering/source_tree.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace sparsight::layering {
namespace fs = std::filesystem;

std::vector<Include> find_includes(std::string_view text) {
  // Anchored at the line's start, so that line comments and strings do not count.
  static const std::regex kPattern{R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re"};
  std::vector<Include> includes;
  std::istringstream lines{std::string{text}};
  int number = 0;
  bool in_comment = false;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::smatch match;
    if (!in_comment && std::regex_search(line, match, kPattern)) {
      includes.push_back({.path = match[2], .quoted = match[1] == "\"", .line = number});
    }
    const std::size_t opened = line.rfind("/*");
    const std::size_t closed = line.rfind("*/");
    if (opened != std::string::npos) in_comment = true;
    if (closed != std::string::npos && (opened == std::string::npos || closed > opened)) {
      in_comment = false;
    }
  }
  return includes;
}

namespace {

SourceFile read_source(const fs::path& top, const fs::path& file) {
  std::ifstream stream{file, std::ios::binary};
  SourceFile source{.path = fs::relative(file, top).generic_string(),
                    .text = std::string{std::istreambuf_iterator<char>{stream}, {}},
                    .includes = {}};
  source.includes = find_includes(source.text);
  return source;
}

}  // namespace

std::vector<SourceFile> read_sources(const fs::path& top) {
  std::vector<SourceFile> sources;
  for (const char* folder : {"hal", "drivers", "slam", "realtime", "tools", "tests"}) {
    if (!fs::is_directory(top / folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator{top / folder}) {
      const fs::path extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cc")) {
        sources.push_back(read_source(top, entry.path()));
      }
    }
  }
  std::ranges::sort(sources, {}, &SourceFile::path);
  return sources;
}

}  // namespace sparsight::layering
