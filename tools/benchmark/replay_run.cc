#include "tools/benchmark/replay_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "tools/evaluation/text_file.h"
#include "tools/session/atomic_file.h"

namespace sparsight {

std::size_t ReplayRun::frames() const {
  return std::min(sequence.images, max_frames.value_or(sequence.images));
}

std::string run_settings(const ReplayRun& run, const std::string& program,
                         const std::string& profile) {
  using Json = nlohmann::ordered_json;
  const Json json = {{"source", run.sequence.folder.string()},
                     {"rays", run.rays},
                     {"frames", run.frames()},
                     {"program", program},
                     {"profile", profile}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

bool session_is_complete(const ReplayRun& run) {
  const auto session = read_text_file(run.session / "session.json");
  if (!session) return false;
  const auto json = nlohmann::json::parse(*session, nullptr, false);
  return json.is_object() && json.contains("complete") && json["complete"] == true;
}

bool is_finished(const ReplayRun& run, const std::string& settings) {
  const auto stamp = read_text_file(run.stamp());
  return stamp && *stamp == settings && session_is_complete(run);
}

Result<void> begin_run(const ReplayRun& run) {
  std::error_code error;
  std::filesystem::create_directories(run.session.parent_path(), error);
  if (!error) std::filesystem::remove(run.stamp(), error);
  if (!error) return {};
  return fail(ErrorCode::kUnreadable,
              fmt::format("{}: cannot be written: {}; give --output a folder you may write",
                          run.session.parent_path().string(), error.message()));
}

Result<void> finish_run(const ReplayRun& run, const std::string& settings) {
  return write_file(run.stamp(), settings);
}

}  // namespace sparsight
