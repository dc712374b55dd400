#include "tools/benchmark/benchmark_means.h"

#include <algorithm>

namespace sparsight {

bool is_comparable(const BenchmarkEntry& entry) {
  const auto& accuracy = entry.figures.accuracy;
  return entry.status == BenchmarkEntry::Status::kDone && accuracy && !accuracy->short_segments &&
         accuracy->evaluation.frames == accuracy->evaluation.truth_frames;
}

std::vector<RaysMean> means_by_rays(const Benchmark& benchmark) {
  std::vector<RaysMean> means;
  for (const int rays : benchmark.options.rays) {
    RaysMean mean{.rays = rays};
    for (const BenchmarkEntry& entry : benchmark.entries) {
      if (entry.run.rays != rays || !is_comparable(entry)) continue;
      ++mean.sequences;
      mean.t_rel_percent += *entry.figures.accuracy->evaluation.kitti.t_rel_percent;
      mean.r_rel_deg_per_m += *entry.figures.accuracy->evaluation.kitti.r_rel_deg_per_m;
    }
    if (mean.sequences > 0) {
      mean.t_rel_percent /= static_cast<double>(mean.sequences);
      mean.r_rel_deg_per_m /= static_cast<double>(mean.sequences);
    }
    means.push_back(mean);
  }
  return means;
}

PublishedMean published_mean(const Benchmark& benchmark) {
  PublishedMean mean;
  for (const std::string& name : sequence_names(benchmark)) {
    const auto published = published_errors(name);
    const bool comparable = std::ranges::any_of(benchmark.entries, [&](const auto& entry) {
      return entry.run.sequence.name == name && is_comparable(entry);
    });
    if (!published || !comparable) continue;
    ++mean.sequences;
    mean.errors.demo += published->demo;
    mean.errors.dvl_64 += published->dvl_64;
    mean.errors.dvl_16 += published->dvl_16;
    mean.errors.dvl_8 += published->dvl_8;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(mean.sequences, 1));
  for (double* sum :
       {&mean.errors.demo, &mean.errors.dvl_64, &mean.errors.dvl_16, &mean.errors.dvl_8}) {
    *sum /= count;
  }
  return mean;
}

std::vector<std::string> sequence_names(const Benchmark& benchmark) {
  std::vector<std::string> names;
  for (const BenchmarkEntry& entry : benchmark.entries) {
    const std::string& name = entry.run.sequence.name;
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

const BenchmarkEntry* find_entry(const Benchmark& benchmark, const std::string& sequence,
                                 int rays) {
  const auto entry = std::ranges::find_if(benchmark.entries, [&](const auto& candidate) {
    return candidate.run.sequence.name == sequence && candidate.run.rays == rays;
  });
  return entry == benchmark.entries.end() ? nullptr : &*entry;
}

}  // namespace sparsight
