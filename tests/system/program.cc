#include "tests/system/program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/build_paths.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

ProgramRun run_sparsight(const std::vector<std::string>& arguments) {
  const fs::path stem = fs::path(::testing::TempDir()) / ("sparsight_" + std::to_string(getpid()));
  const std::string output = stem.string() + ".out";
  const std::string errors = stem.string() + ".err";
  std::string command = quoted(testing::program());
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  const int status = std::system((command + " >" + output + " 2>" + errors).c_str());
  ProgramRun run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(output), text_of(errors)};
  fs::remove(output);
  fs::remove(errors);
  return run;
}

fs::path scratch_folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  const fs::path folder = fs::path(::testing::TempDir()) / "sparsight_system" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t pose_count(const fs::path& file) {
  std::ifstream in(file);
  std::size_t count = 0;
  for (std::string line; std::getline(in, line);) count += line.starts_with("#") ? 0U : 1U;
  return count;
}

}  // namespace sparsight
