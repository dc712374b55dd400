#include <nlohmann/json.hpp>
#include <optional>

#include "tools/benchmark/benchmark_means.h"
#include "tools/benchmark/benchmark_report.h"

namespace sparsight {
namespace {

using Json = nlohmann::ordered_json;

template <typename Figure>
Json value_or_null(const std::optional<Figure>& figure) {
  return figure ? Json(*figure) : Json(nullptr);
}

const char* name_of(BenchmarkEntry::Status status) {
  switch (status) {
    case BenchmarkEntry::Status::kDone:
      return "done";
    case BenchmarkEntry::Status::kFailed:
      return "failed";
    case BenchmarkEntry::Status::kNotRun:
      break;
  }
  return "not run";
}

void add_accuracy(Json& run, const std::optional<RunAccuracy>& accuracy) {
  if (!accuracy) {
    for (const char* key : {"truth_frames", "path_length_m", "lengths_m", "t_rel_percent",
                            "r_rel_deg_per_m", "ate_rmse_m"}) {
      run[key] = nullptr;
    }
    return;
  }
  const Evaluation& evaluation = accuracy->evaluation;
  run["truth_frames"] = evaluation.truth_frames;
  run["path_length_m"] = evaluation.path_length_m;
  run["lengths_m"] = accuracy->lengths_m;
  run["t_rel_percent"] = value_or_null(evaluation.kitti.t_rel_percent);
  run["r_rel_deg_per_m"] = value_or_null(evaluation.kitti.r_rel_deg_per_m);
  run["ate_rmse_m"] = evaluation.ate.rmse_m;
}

Json run_json(const BenchmarkEntry& entry) {
  Json run = {{"sequence", entry.run.sequence.name},   {"rays", entry.run.rays},
              {"status", name_of(entry.status)},       {"message", entry.message},
              {"session", entry.run.session.string()}, {"frames", entry.figures.frames},
              {"comparable", is_comparable(entry)}};
  add_accuracy(run, entry.figures.accuracy);
  run["tracking_median_ms"] = value_or_null(entry.figures.tracking_median_ms);
  run["tracking_p99_ms"] = value_or_null(entry.figures.tracking_p99_ms);
  run["times_real_time"] = value_or_null(entry.figures.times_real_time);
  return run;
}

Json mean_json(const RaysMean& mean) {
  const bool any = mean.sequences > 0;
  return {{"rays", mean.rays},
          {"sequences", mean.sequences},
          {"t_rel_percent", any ? Json(mean.t_rel_percent) : Json(nullptr)},
          {"r_rel_deg_per_m", any ? Json(mean.r_rel_deg_per_m) : Json(nullptr)}};
}

Json published_json(const PublishedErrors& errors) {
  return {{"sequence", errors.sequence},
          {"demo", errors.demo},
          {"dvl_64", errors.dvl_64},
          {"dvl_16", errors.dvl_16},
          {"dvl_8", errors.dvl_8}};
}

}  // namespace

std::string benchmark_json(const Benchmark& benchmark, const std::string& command) {
  Json json = {{"sparsight", SPARSIGHT_VERSION},
               {"command", command},
               {"profile", benchmark.options.profile},
               {"max_frames", value_or_null(benchmark.options.max_frames)},
               {"complete", benchmark.all_done()},
               {"notes", benchmark.notes},
               {"runs", Json::array()},
               {"means", Json::array()},
               {"published", Json::array()}};
  for (const BenchmarkEntry& entry : benchmark.entries) json["runs"].push_back(run_json(entry));
  for (const RaysMean& mean : means_by_rays(benchmark)) json["means"].push_back(mean_json(mean));
  for (const std::string& name : sequence_names(benchmark)) {
    if (const auto errors = published_errors(name)) {
      json["published"].push_back(published_json(*errors));
    }
  }
  // A path need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sparsight
