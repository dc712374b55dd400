#include "slam/image/halving.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slam/image/halving.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sparsight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void halve_rows(const std::uint8_t* upper, const std::uint8_t* lower, std::size_t width,
                std::uint8_t* out) {
  std::size_t u = 0;
#if HWY_TARGET != HWY_SCALAR
  // A lane is two neighbouring pixels.
  const hn::ScalableTag<std::uint16_t> pairs;
  const hn::Repartition<std::uint8_t, decltype(pairs)> pixels;
  const hn::Rebind<std::uint8_t, decltype(pairs)> means;
  const auto sum_of_pairs = [&](const std::uint8_t* row) {
    const auto both = hn::BitCast(pairs, hn::LoadU(pixels, row));
    return hn::Add(hn::And(both, hn::Set(pairs, 0xFF)), hn::ShiftRight<8>(both));
  };
  const std::size_t step = hn::Lanes(pairs);
  for (; u + step <= width; u += step) {
    const auto sum = hn::Add(sum_of_pairs(upper + 2 * u), sum_of_pairs(lower + 2 * u));
    const auto mean = hn::ShiftRight<2>(hn::Add(sum, hn::Set(pairs, 2)));
    hn::StoreU(hn::DemoteTo(means, hn::BitCast(hn::RebindToSigned<decltype(pairs)>(), mean)), means,
               out + u);
  }
#endif
  for (; u < width; ++u) {
    const int sum = upper[2 * u] + upper[2 * u + 1] + lower[2 * u] + lower[2 * u + 1];
    out[u] = static_cast<std::uint8_t>((sum + 2) / 4);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sparsight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sparsight {

HWY_EXPORT(halve_rows);

void halve_rows(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(halve_rows)(upper, lower, static_cast<std::size_t>(width), out);
}

}  // namespace sparsight
#endif
