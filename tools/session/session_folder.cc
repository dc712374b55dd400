#include "tools/session/session_folder.h"

#include <fmt/format.h>

#include <system_error>

namespace sparsight {
namespace {

namespace fs = std::filesystem;

fs::path unused_folder(const fs::path& source, std::optional<int> rays) {
  const std::string name =
      fmt::format("session-{}{}", source_name(source), rays ? fmt::format("-{}rays", *rays) : "");
  fs::path folder = name;
  for (int number = 2; fs::exists(folder); ++number) folder = fmt::format("{}-{}", name, number);
  return folder;
}

}  // namespace

// "sequences/04/" and "." both have a name.
std::string source_name(const fs::path& source) {
  std::error_code error;
  fs::path path = fs::canonical(source, error);
  if (error) path = source;
  if (!path.has_filename()) path = path.parent_path();
  return path.stem().string();
}

Result<fs::path> claim_session_folder(const std::optional<fs::path>& output, const fs::path& source,
                                      std::optional<int> rays) {
  const fs::path folder = output ? *output : unused_folder(source, rays);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: is a file; give --output a folder", folder.string()));
  }
  fs::create_directories(folder, error);
  if (error) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot make this folder: {}; give --output a folder you may write",
                            folder.string(), error.message()));
  }
  const bool empty = fs::is_empty(folder, error);
  if (!error && !empty && !fs::exists(folder / "session.json")) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: is not empty and holds no earlier session (session.json), so "
                            "nothing is written there; give --output another folder",
                            folder.string()));
  }
  return folder;
}

}  // namespace sparsight
