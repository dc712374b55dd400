#include "slam/image/pyramid.h"
#include "tests/benchmarks/made_drive.h"

namespace sparsight {
namespace {

// With the copy of the image that the pyramid keeps.
void make_pyramid(benchmark::State& state) {
  const GreyImage& image = made_drive(static_cast<int>(state.range(0))).frames.front().grey;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ImagePyramid(image, MadeDrive::kLevels));
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(image.pixels.size()));
}
BENCHMARK(make_pyramid)->Apply(each_drive);

}  // namespace
}  // namespace sparsight
