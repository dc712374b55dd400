#include "tests/layering/document_paths.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace sparsight::layering {
namespace fs = std::filesystem;
namespace {

using Match = std::sregex_iterator;

// "a.{h,cc}" is a.h and a.cc.
std::vector<std::string> expand_braces(const std::string& path) {
  static const std::regex kBraces{R"(^(.*)\{([^}]*)\}(.*)$)"};
  std::smatch match;
  if (!std::regex_match(path, match, kBraces)) return {path};
  std::vector<std::string> paths;
  std::istringstream options{match[2]};
  for (std::string option; std::getline(options, option, ',');) {
    paths.push_back(match[1].str() + option + match[3].str());
  }
  return paths;
}

void find_code_paths(const std::string& line, int number, std::vector<DocumentPath>& paths) {
  static const std::regex kCode{"`([^`]+)`"};
  static const std::regex kPath{
      R"(^(\./)?((hal|drivers|slam|realtime|tools|toolchain|tests|docs|config|\.ci)/[\w./{},-]*|)"
      R"([A-Z]\w*\.(md|txt|json)|LICENSE)$)"};
  for (Match code{line.begin(), line.end(), kCode}; code != Match{}; ++code) {
    std::istringstream words{(*code)[1]};
    for (std::string word; words >> word;) {
      if (!std::regex_match(word, kPath)) continue;
      for (std::string& path : expand_braces(word)) {
        paths.push_back({.path = std::move(path), .line = number});
      }
    }
  }
}

void find_links(const std::string& line, int number, std::vector<DocumentPath>& paths) {
  static const std::regex kLink{R"(\]\(([^)#\s]+)(#[^)]*)?\))"};
  for (Match link{line.begin(), line.end(), kLink}; link != Match{}; ++link) {
    const std::string target = (*link)[1];
    if (target.find("://") != std::string::npos) continue;
    paths.push_back({.path = target, .line = number, .relative_to_document = true});
  }
}

}  // namespace

std::vector<DocumentPath> find_paths(std::string_view markdown) {
  std::vector<DocumentPath> paths;
  std::istringstream lines{std::string{markdown}};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    find_code_paths(line, number, paths);
    find_links(line, number, paths);
  }
  return paths;
}

std::vector<std::string> check_document(const fs::path& top, const fs::path& document) {
  std::ifstream stream{top / document, std::ios::binary};
  const std::string text{std::istreambuf_iterator<char>{stream}, {}};
  std::vector<std::string> missing;
  for (const DocumentPath& path : find_paths(text)) {
    const fs::path base = path.relative_to_document ? (top / document).parent_path() : top;
    if (!fs::exists(base / path.path)) {
      missing.push_back(
          fmt::format("{}:{}: no such file: {}", document.generic_string(), path.line, path.path));
    }
  }
  return missing;
}

}  // namespace sparsight::layering
