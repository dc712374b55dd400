#include "tools/benchmark/benchmark_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/benchmark/aligned_table.h"
#include "tools/benchmark/benchmark_means.h"

namespace sparsight {
namespace {

using Row = std::vector<std::string>;
using Cell = std::string (*)(const BenchmarkEntry&);

constexpr const char* kNone = "–";
constexpr const char* kShortMark = "‡";    // segments of 10-50 m
constexpr const char* kPartialMark = "†";  // not the whole sequence

const RunAccuracy* accuracy_of(const BenchmarkEntry& entry) {
  const bool has = entry.status == BenchmarkEntry::Status::kDone && entry.figures.accuracy;
  return has ? &*entry.figures.accuracy : nullptr;
}

bool is_short(const BenchmarkEntry& entry) {
  return accuracy_of(entry) != nullptr && accuracy_of(entry)->short_segments;
}

bool is_partial(const BenchmarkEntry& entry) {
  const RunAccuracy* accuracy = accuracy_of(entry);
  return accuracy != nullptr && accuracy->evaluation.frames != accuracy->evaluation.truth_frames;
}

// A failed run says so in the first table; elsewhere its cell is empty.
std::string t_rel_cell(const BenchmarkEntry& entry) {
  if (entry.status == BenchmarkEntry::Status::kFailed) return "failed";
  const RunAccuracy* accuracy = accuracy_of(entry);
  if (accuracy == nullptr || !accuracy->evaluation.kitti.t_rel_percent) return kNone;
  return fmt::format("{:.2f}{}", *accuracy->evaluation.kitti.t_rel_percent,
                     accuracy->short_segments ? kShortMark : "");
}

std::string r_rel_cell(const BenchmarkEntry& entry) {
  const RunAccuracy* accuracy = accuracy_of(entry);
  if (accuracy == nullptr || !accuracy->evaluation.kitti.r_rel_deg_per_m) return kNone;
  return fmt::format("{:.4f}{}", *accuracy->evaluation.kitti.r_rel_deg_per_m,
                     accuracy->short_segments ? kShortMark : "");
}

std::string ate_cell(const BenchmarkEntry& entry) {
  const RunAccuracy* accuracy = accuracy_of(entry);
  return accuracy == nullptr ? kNone : fmt::format("{:.3f}", accuracy->evaluation.ate.rmse_m);
}

std::string time_cell(const BenchmarkEntry& entry) {
  const RunFigures& figures = entry.figures;
  if (!figures.tracking_median_ms || !figures.tracking_p99_ms) return kNone;
  return fmt::format("{:.1f} / {:.1f}", *figures.tracking_median_ms, *figures.tracking_p99_ms);
}

std::string name_cell(const Benchmark& benchmark, const std::string& sequence) {
  const bool partial = std::ranges::any_of(benchmark.entries, [&](const auto& entry) {
    return entry.run.sequence.name == sequence && is_partial(entry);
  });
  return sequence + (partial ? kPartialMark : "");
}

void append_head(Row& row, const Benchmark& benchmark, const char* figure) {
  for (const int rays : benchmark.options.rays) row.push_back(fmt::format("{} {}", figure, rays));
}

void append_cells(Row& row, const Benchmark& benchmark, const std::string& sequence, Cell cell) {
  for (const int rays : benchmark.options.rays) {
    row.push_back(cell(*find_entry(benchmark, sequence, rays)));
  }
}

void append_published(Row& row, const std::optional<PublishedErrors>& errors) {
  if (!errors) {
    row.insert(row.end(), 4, kNone);
    return;
  }
  for (const double error : {errors->dvl_64, errors->dvl_16, errors->dvl_8, errors->demo}) {
    row.push_back(fmt::format("{:.2f}", error));
  }
}

// A mean over fewer sequences than its neighbours says over how many.
Row mean_row(const Benchmark& benchmark) {
  const std::vector<RaysMean> means = means_by_rays(benchmark);
  const std::size_t most = std::ranges::max(means, {}, &RaysMean::sequences).sequences;
  Row row = {"mean", ""};
  for (const RaysMean& mean : means) {
    const std::string count = mean.sequences == most ? "" : fmt::format(" ({})", mean.sequences);
    row.push_back(mean.sequences == 0 ? kNone : fmt::format("{:.2f}{}", mean.t_rel_percent, count));
  }
  const PublishedMean published = published_mean(benchmark);
  append_published(row, published.sequences == 0 ? std::nullopt : std::optional(published.errors));
  return row;
}

std::string translation_table(const Benchmark& benchmark) {
  Row head = {"seq", "frames"};
  append_head(head, benchmark, "ours");
  head.insert(head.end(), {"DVL 64", "DVL 16", "DVL 8", "DEMO"});
  std::vector<Row> rows = {head};
  for (const std::string& name : sequence_names(benchmark)) {
    const BenchmarkEntry* first = find_entry(benchmark, name, benchmark.options.rays.front());
    Row row = {name_cell(benchmark, name), std::to_string(first->run.frames())};
    append_cells(row, benchmark, name, t_rel_cell);
    append_published(row, published_errors(name));
    rows.push_back(row);
  }
  rows.push_back(mean_row(benchmark));
  return aligned_table(rows);
}

std::string detail_table(const Benchmark& benchmark) {
  Row head = {"seq"};
  append_head(head, benchmark, "r_rel");
  append_head(head, benchmark, "ATE");
  append_head(head, benchmark, "ms");
  std::vector<Row> rows = {head};
  for (const std::string& name : sequence_names(benchmark)) {
    Row row = {name_cell(benchmark, name)};
    for (const Cell cell : {r_rel_cell, ate_cell, time_cell}) {
      append_cells(row, benchmark, name, cell);
    }
    rows.push_back(row);
  }
  return aligned_table(rows);
}

void append_footnotes(std::string& text, const Benchmark& benchmark) {
  const auto out = std::back_inserter(text);
  if (std::ranges::any_of(benchmark.entries, is_short)) {
    fmt::format_to(out,
                   "\n{} The path is too short for a segment of 100 m: error over segments of "
                   "10, 20, 30, 40 and 50 m, not comparable with the paper's and not in the "
                   "mean.\n",
                   kShortMark);
  }
  for (const std::string& name : sequence_names(benchmark)) {
    const auto entry = std::ranges::find_if(benchmark.entries, [&](const auto& candidate) {
      return candidate.run.sequence.name == name && is_partial(candidate);
    });
    if (entry == benchmark.entries.end()) continue;
    const Evaluation& evaluation = entry->figures.accuracy->evaluation;
    fmt::format_to(out, "\n{} {}: only the first {} of {} frames, {:.0f} m; not in the mean.\n",
                   kPartialMark, name, evaluation.frames, evaluation.truth_frames,
                   evaluation.path_length_m);
  }
}

void append_incidents(std::string& text, const Benchmark& benchmark) {
  const auto out = std::back_inserter(text);
  for (const BenchmarkEntry& entry : benchmark.entries) {
    if (entry.status == BenchmarkEntry::Status::kFailed) {
      fmt::format_to(out, "\nFAILED: {} with {} rays: {}\n", entry.run.sequence.name,
                     entry.run.rays, entry.message);
    }
  }
  for (const std::string& note : benchmark.notes) fmt::format_to(out, "\nNote: {}\n", note);
  if (benchmark.interrupted()) {
    fmt::format_to(out, "\nNot complete: the same command goes on from here.\n");
  }
}

}  // namespace

std::string benchmark_markdown(const Benchmark& benchmark, const std::string& command) {
  std::string text = "# KITTI odometry benchmark\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "\nsparsight {}, profile {}, no loop closure: `{}`\n", SPARSIGHT_VERSION,
                 benchmark.options.profile, command);
  fmt::format_to(out,
                 "\nTranslational error t_rel in percent over segments of 100 to 800 m (KITTI "
                 "development kit), by number of rays, beside Table II of the paper (DVL-SLAM) "
                 "and DEMO. The mean is that of the rows.\n\n");
  text += translation_table(benchmark);
  fmt::format_to(out,
                 "\nRotational error r_rel in deg/m, absolute trajectory error ATE in m (rmse "
                 "after rigid alignment), tracking time per frame in ms (median / p99), by "
                 "number of rays.\n\n");
  text += detail_table(benchmark);
  append_footnotes(text, benchmark);
  append_incidents(text, benchmark);
  return text;
}

}  // namespace sparsight
