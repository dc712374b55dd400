// The vector code of photometric_kernel.cc, compiled once per instruction set (hence no plain
// include guard; see Highway's g3doc/quick_reference.md).

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

#include "slam/tracking/photometric_kernel.h"

#ifndef SPARSIGHT_SLAM_TRACKING_PHOTOMETRIC_KERNEL_PLAIN_
#define SPARSIGHT_SLAM_TRACKING_PHOTOMETRIC_KERNEL_PLAIN_
namespace sparsight {

// Sums are kept in this many lanes on every machine, so that they do not depend on its vector
// width.
inline constexpr std::size_t kSumLanes = PatchSet::kBlock;
using LaneSums = std::array<float, kSumLanes>;
using PatchLaneSums = std::array<double, Linearization::kPatchLanes>;

// Upper triangle of H row by row, then b.
inline constexpr std::size_t kNormalSums =
    NormalEquations::kSize * (NormalEquations::kSize + 1) / 2 + NormalEquations::kSize;
using NormalSums = std::array<LaneSums, kNormalSums>;

struct ProjectionParameters {
  std::array<float, 12> T{};  // T_camera_keyframe, 3x4, row by row
  float fx = 0.0F, fy = 0.0F, cx = 0.0F, cy = 0.0F;
  std::array<float, 5> distortion{};  // k1 k2 p1 p2 k3
  bool distorted = false;
  float max_radius2 = 0.0F;
  float gain = 1.0F, offset = 0.0F;
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;
};

}  // namespace sparsight
#endif

#if defined(SPARSIGHT_SLAM_TRACKING_PHOTOMETRIC_KERNEL_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef SPARSIGHT_SLAM_TRACKING_PHOTOMETRIC_KERNEL_INL_
#undef SPARSIGHT_SLAM_TRACKING_PHOTOMETRIC_KERNEL_INL_
#else
#define SPARSIGHT_SLAM_TRACKING_PHOTOMETRIC_KERNEL_INL_
#endif

HWY_BEFORE_NAMESPACE();
namespace sparsight {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kSumLanes>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;

// Grey value and gradient, as in slam/image/interpolation.h.
struct VectorSample {
  VF value, du, dv;
};

// Four neighbouring pixels of a row in the bytes of one 32-bit lane, leftmost lowest.
template <int kByte>
HWY_INLINE VF pixel(VI row) {
  return hn::ConvertTo(F(), hn::And(hn::ShiftRight<8 * kByte>(row), hn::Set(I(), 0xFF)));
}

HWY_INLINE VF blend(VF from, VF to, VF share) { return hn::MulAdd(share, hn::Sub(to, from), from); }

// From the rows v0 - 1 .. v0 + 2, at u0 + a, v0 + b.
HWY_INLINE VectorSample sample_rows(VI row0, VI row1, VI row2, VI row3, VF a, VF b) {
  const F f;
  const VF half = hn::Set(f, 0.5F);
  const VF line0 = blend(pixel<1>(row0), pixel<2>(row0), a);
  const VF line1 = blend(pixel<1>(row1), pixel<2>(row1), a);
  const VF line2 = blend(pixel<1>(row2), pixel<2>(row2), a);
  const VF line3 = blend(pixel<1>(row3), pixel<2>(row3), a);
  const VF slope1 =
      hn::Sub(blend(pixel<2>(row1), pixel<3>(row1), a), blend(pixel<0>(row1), pixel<1>(row1), a));
  const VF slope2 =
      hn::Sub(blend(pixel<2>(row2), pixel<3>(row2), a), blend(pixel<0>(row2), pixel<1>(row2), a));
  return {blend(line1, line2, b), hn::Mul(half, blend(slope1, slope2, b)),
          hn::Mul(half, blend(hn::Sub(line2, line0), hn::Sub(line3, line1), b))};
}

// Normalised coordinates in, distorted ones out, and the 2x2 derivative (Brown–Conrady).
struct VectorDistortion {
  VF x, y, xx, xy, yy;
};

HWY_INLINE VectorDistortion distort(const ProjectionParameters& p, VF x, VF y) {
  const F f;
  const VF one = hn::Set(f, 1.0F);
  if (!p.distorted) return {x, y, one, hn::Zero(f), one};
  const VF k1 = hn::Set(f, p.distortion[0]);
  const VF k2 = hn::Set(f, p.distortion[1]);
  const VF p1 = hn::Set(f, 2.0F * p.distortion[2]);
  const VF p2 = hn::Set(f, 2.0F * p.distortion[3]);
  const VF k3 = hn::Set(f, p.distortion[4]);
  const VF half = hn::Set(f, 0.5F);
  const VF three = hn::Set(f, 3.0F);
  const VF x2 = hn::Mul(x, x);
  const VF y2 = hn::Mul(y, y);
  const VF xy = hn::Mul(x, y);
  const VF r2 = hn::Add(x2, y2);
  const VF radial = hn::MulAdd(r2, hn::MulAdd(r2, hn::MulAdd(r2, k3, k2), k1), one);
  const VF d_radial = hn::Mul(
      hn::Set(f, 2.0F), hn::MulAdd(r2, hn::MulAdd(r2, hn::Mul(three, k3), hn::Add(k2, k2)), k1));
  const VF cross = hn::MulAdd(xy, d_radial, hn::MulAdd(p1, x, hn::Mul(p2, y)));
  return {
      hn::MulAdd(x, radial, hn::MulAdd(p1, xy, hn::Mul(p2, hn::MulAdd(half, r2, x2)))),
      hn::MulAdd(y, radial, hn::MulAdd(p2, xy, hn::Mul(p1, hn::MulAdd(half, r2, y2)))),
      hn::Add(hn::MulAdd(x2, d_radial, radial), hn::MulAdd(p1, y, hn::Mul(three, hn::Mul(p2, x)))),
      cross,
      hn::Add(hn::MulAdd(y2, d_radial, radial), hn::MulAdd(p2, x, hn::Mul(three, hn::Mul(p1, y))))};
}

HWY_INLINE VF transformed(const ProjectionParameters& p, int row, VF x, VF y, VF z) {
  const F f;
  const float* r = p.T.data() + 4 * row;
  return hn::MulAdd(
      hn::Set(f, r[0]), x,
      hn::MulAdd(hn::Set(f, r[1]), y, hn::MulAdd(hn::Set(f, r[2]), z, hn::Set(f, r[3]))));
}

// So many entries at a time: their pixels are read one by one, which on most machines takes less
// than gathering them, and what was just stored in parts cannot be loaded as a whole at once.
constexpr std::size_t kChunk = 8 * PatchSet::kBlock;

// Entries in the current frame, and the pixels around them.
struct Chunk {
  using Column = float[kChunk];
  HWY_ALIGN Column x, y, z, inverse_z, xn, yn;  // the point, and its normalised coordinates
  HWY_ALIGN Column xx, xy, yy;                  // how the lens changes them
  HWY_ALIGN Column inside;                      // a mask
  HWY_ALIGN Column a, b;                        // what is left of u and v, below 1
  HWY_ALIGN std::int32_t first[kChunk];         // the first pixel's place in the image
  HWY_ALIGN std::int32_t rows[4][kChunk];       // four pixels of each of the four rows
};

HWY_INLINE void project(const PatchSet& patches, const ProjectionParameters& p, std::size_t at,
                        std::size_t k, Chunk& out) {
  const F f;
  const I i;
  const VF X = hn::LoadU(f, patches.x.data() + at);
  const VF Y = hn::LoadU(f, patches.y.data() + at);
  const VF Z = hn::LoadU(f, patches.z.data() + at);
  const VF x = transformed(p, 0, X, Y, Z);
  const VF y = transformed(p, 1, X, Y, Z);
  const VF z = transformed(p, 2, X, Y, Z);

  const VF one = hn::Set(f, 1.0F);
  const auto in_front = hn::Gt(z, hn::Set(f, 1e-3F));
  const VF inverse_z = hn::Div(one, hn::IfThenElse(in_front, z, one));
  const VF xn = hn::Mul(x, inverse_z);
  const VF yn = hn::Mul(y, inverse_z);
  const VF radius2 = hn::MulAdd(xn, xn, hn::Mul(yn, yn));
  const VectorDistortion d = distort(p, xn, yn);
  const VF u = hn::MulAdd(hn::Set(f, p.fx), d.x, hn::Set(f, p.cx));
  const VF v = hn::MulAdd(hn::Set(f, p.fy), d.y, hn::Set(f, p.cy));
  // Written so that NaN is outside.
  const auto inside =
      hn::And(hn::And(in_front, hn::Le(radius2, hn::Set(f, p.max_radius2))),
              hn::And(hn::And(hn::Ge(u, one), hn::Ge(v, one)),
                      hn::And(hn::Lt(u, hn::Set(f, static_cast<float>(p.width - 2))),
                              hn::Lt(v, hn::Set(f, static_cast<float>(p.height - 2))))));
  const VF safe_u = hn::IfThenElse(inside, u, one);
  const VF safe_v = hn::IfThenElse(inside, v, one);
  const VI u0 = hn::ConvertTo(i, safe_u);
  const VI v0 = hn::ConvertTo(i, safe_v);
  const VI before = hn::Set(i, 1);
  hn::Store(hn::Sub(hn::Add(hn::Mul(hn::Sub(v0, before), hn::Set(i, p.width)), u0), before), i,
            out.first + k);
  hn::Store(hn::Sub(safe_u, hn::ConvertTo(f, u0)), f, out.a + k);
  hn::Store(hn::Sub(safe_v, hn::ConvertTo(f, v0)), f, out.b + k);
  hn::Store(hn::VecFromMask(f, inside), f, out.inside + k);
  hn::Store(x, f, out.x + k);
  hn::Store(y, f, out.y + k);
  hn::Store(z, f, out.z + k);
  hn::Store(inverse_z, f, out.inverse_z + k);
  hn::Store(xn, f, out.xn + k);
  hn::Store(yn, f, out.yn + k);
  hn::Store(d.xx, f, out.xx + k);
  hn::Store(d.xy, f, out.xy + k);
  hn::Store(d.yy, f, out.yy + k);
}

HWY_INLINE void read_pixels(const ProjectionParameters& p, std::size_t entries, Chunk& chunk) {
  for (std::size_t k = 0; k < entries; ++k) {
    const std::uint8_t* pixel = p.pixels + chunk.first[k];
    for (std::size_t row = 0; row < 4; ++row, pixel += p.width) {
      std::memcpy(&chunk.rows[row][k], pixel, sizeof(std::int32_t));
    }
  }
}

HWY_INLINE void differentiate(const PatchSet& patches, const ProjectionParameters& p,
                              const Chunk& chunk, std::size_t at, std::size_t k,
                              Linearization& out) {
  const F f;
  const I i;
  const VectorSample s = sample_rows(hn::Load(i, chunk.rows[0] + k), hn::Load(i, chunk.rows[1] + k),
                                     hn::Load(i, chunk.rows[2] + k), hn::Load(i, chunk.rows[3] + k),
                                     hn::Load(f, chunk.a + k), hn::Load(f, chunk.b + k));
  const VF x = hn::Load(f, chunk.x + k);
  const VF y = hn::Load(f, chunk.y + k);
  const VF z = hn::Load(f, chunk.z + k);
  const VF inverse_z = hn::Load(f, chunk.inverse_z + k);
  const VF xy = hn::Load(f, chunk.xy + k);

  // Chain rule: image gradient, distortion, perspective division.
  const VF fu = hn::Mul(hn::Set(f, p.fx), s.du);
  const VF fv = hn::Mul(hn::Set(f, p.fy), s.dv);
  const VF gx = hn::Mul(inverse_z, hn::MulAdd(hn::Load(f, chunk.xx + k), fu, hn::Mul(xy, fv)));
  const VF gy = hn::Mul(inverse_z, hn::MulAdd(xy, fu, hn::Mul(hn::Load(f, chunk.yy + k), fv)));
  const VF gz =
      hn::Neg(hn::MulAdd(gx, hn::Load(f, chunk.xn + k), hn::Mul(gy, hn::Load(f, chunk.yn + k))));

  const VF expected = hn::MulAdd(hn::Set(f, p.gain), hn::LoadU(f, patches.intensity.data() + at),
                                 hn::Set(f, p.offset));
  const auto inside = hn::MaskFromVec(hn::Load(f, chunk.inside + k));
  const auto keep = [&](VF value) { return hn::IfThenElseZero(inside, value); };
  hn::StoreU(keep(hn::Sub(s.value, expected)), f, out.residual.data() + at);
  hn::StoreU(keep(hn::LoadU(f, patches.weight.data() + at)), f, out.weight.data() + at);
  // d_residual_d_xi = [q x g, g] for a left increment on q = T p.
  hn::StoreU(keep(hn::NegMulAdd(z, gy, hn::Mul(y, gz))), f, out.J[0].data() + at);
  hn::StoreU(keep(hn::NegMulAdd(x, gz, hn::Mul(z, gx))), f, out.J[1].data() + at);
  hn::StoreU(keep(hn::NegMulAdd(y, gx, hn::Mul(x, gy))), f, out.J[2].data() + at);
  hn::StoreU(keep(gx), f, out.J[3].data() + at);
  hn::StoreU(keep(gy), f, out.J[4].data() + at);
  hn::StoreU(keep(gz), f, out.J[5].data() + at);
}

void linearize_entries(const PatchSet& patches, const ProjectionParameters& p, Linearization& out) {
  const std::size_t step = hn::Lanes(F());
  Chunk chunk;
  for (std::size_t first = 0; first < patches.entries(); first += kChunk) {
    const std::size_t entries = std::min(kChunk, patches.entries() - first);
    for (std::size_t k = 0; k < entries; k += step) project(patches, p, first + k, k, chunk);
    read_pixels(p, entries, chunk);
    for (std::size_t k = 0; k < entries; k += step) {
      differentiate(patches, p, chunk, first + k, k, out);
    }
  }
}

// w(r) of eq. (5) times the entry's own weight.
HWY_INLINE VF total_weight(const float* weights, std::size_t at, VF residual, float dof,
                           float inverse_sigma2) {
  const F f;
  const VF r2 = hn::Mul(residual, residual);
  const VF robust =
      hn::Div(hn::Set(f, dof + 1.0F), hn::MulAdd(r2, hn::Set(f, inverse_sigma2), hn::Set(f, dof)));
  return hn::Mul(robust, hn::LoadU(f, weights + at));
}

void weighted_square_sums(const Linearization& l, float dof, float inverse_sigma2,
                          LaneSums& squares, LaneSums& weights) {
  const F f;
  const std::size_t step = hn::Lanes(f);
  for (std::size_t lane = 0; lane < kSumLanes; lane += step) {
    VF square_sum = hn::Zero(f);
    VF weight_sum = hn::Zero(f);
    for (std::size_t at = lane; at < l.residual.size(); at += kSumLanes) {
      const VF r = hn::LoadU(f, l.residual.data() + at);
      const VF w = total_weight(l.weight.data(), at, r, dof, inverse_sigma2);
      square_sum = hn::MulAdd(w, hn::Mul(r, r), square_sum);
      weight_sum = hn::Add(weight_sum, hn::LoadU(f, l.weight.data() + at));
    }
    hn::StoreU(square_sum, f, squares.data() + lane);
    hn::StoreU(weight_sum, f, weights.data() + lane);
  }
}

// log(1 + t) for t >= 0, to 1e-6: exponent by bits, then the series of 2 artanh.
HWY_INLINE VF log1p_positive(VF t) {
  const F f;
  const I i;
  const VF x = hn::Add(t, hn::Set(f, 1.0F));
  const VI bits = hn::BitCast(i, x);
  const VI exponent = hn::Sub(hn::ShiftRight<23>(bits), hn::Set(i, 127));
  const VF mantissa =
      hn::BitCast(f, hn::Or(hn::And(bits, hn::Set(i, 0x007FFFFF)), hn::Set(i, 0x3F800000)));
  const VF one = hn::Set(f, 1.0F);
  const VF s = hn::Div(hn::Sub(mantissa, one), hn::Add(mantissa, one));  // 0 .. 1/3
  const VF s2 = hn::Mul(s, s);
  VF series = hn::Set(f, 2.0F / 11.0F);
  series = hn::MulAdd(series, s2, hn::Set(f, 2.0F / 9.0F));
  series = hn::MulAdd(series, s2, hn::Set(f, 2.0F / 7.0F));
  series = hn::MulAdd(series, s2, hn::Set(f, 2.0F / 5.0F));
  series = hn::MulAdd(series, s2, hn::Set(f, 2.0F / 3.0F));
  series = hn::MulAdd(series, s2, hn::Set(f, 2.0F));
  return hn::MulAdd(hn::ConvertTo(f, exponent), hn::Set(f, 0.6931472F), hn::Mul(series, s));
}

// sum of w/2 * log(1 + r^2 / (nu sigma^2)); scale = 1 / (nu sigma^2).
void log_likelihood_sums(const Linearization& l, float scale, LaneSums& costs, LaneSums& weights) {
  const F f;
  const std::size_t step = hn::Lanes(f);
  for (std::size_t lane = 0; lane < kSumLanes; lane += step) {
    VF cost_sum = hn::Zero(f);
    VF weight_sum = hn::Zero(f);
    for (std::size_t at = lane; at < l.residual.size(); at += kSumLanes) {
      const VF r = hn::LoadU(f, l.residual.data() + at);
      const VF w = hn::LoadU(f, l.weight.data() + at);
      const VF cost = log1p_positive(hn::Mul(hn::Mul(r, r), hn::Set(f, scale)));
      cost_sum = hn::MulAdd(hn::Mul(hn::Set(f, 0.5F), w), cost, cost_sum);
      weight_sum = hn::Add(weight_sum, w);
    }
    hn::StoreU(cost_sum, f, costs.data() + lane);
    hn::StoreU(weight_sum, f, weights.data() + lane);
  }
}

void patch_log_sums(const Linearization& l, double dof, double scale, PatchLaneSums& out) {
  const hn::CappedTag<double, Linearization::kPatchLanes> d;
  const std::size_t step = hn::Lanes(d);
  for (std::size_t lane = 0; lane < out.size(); lane += step) {
    auto sum = hn::Zero(d);
    for (std::size_t at = lane; at < l.patch_squares.size(); at += out.size()) {
      const auto squares = hn::LoadU(d, l.patch_squares.data() + at);
      const auto pixels = hn::LoadU(d, l.patch_pixels.data() + at);
      const auto log = hn::Log(d, hn::MulAdd(squares, hn::Set(d, scale), hn::Set(d, 1.0)));
      sum = hn::MulAdd(hn::Add(hn::Set(d, dof), pixels), log, sum);
    }
    hn::StoreU(sum, d, out.data() + lane);
  }
}

// Of eq. (5), times the entries' own.
void robust_weights(const Linearization& l, float dof, float inverse_sigma2,
                    std::vector<float>& out) {
  const F f;
  const std::size_t step = hn::Lanes(f);
  for (std::size_t at = 0; at < l.residual.size(); at += step) {
    const VF r = hn::LoadU(f, l.residual.data() + at);
    hn::StoreU(total_weight(l.weight.data(), at, r, dof, inverse_sigma2), f, out.data() + at);
  }
}

// One row of the normal equations: columns kRow to 7 of the upper triangle, then b. Columns 6 and 7
// are d_r / d_gain = -I_m and d_r / d_offset = -1.
template <int kRow>
struct NormalRow {
  static constexpr int kSize = NormalEquations::kSize;
  static constexpr int kSums = kSize - kRow + 1;
  // Where they stand in NormalSums.
  static constexpr int kFirst = kRow * kSize - kRow * (kRow - 1) / 2;
  static constexpr int kRight = static_cast<int>(kNormalSums) - kSize + kRow;
  VF sums[kSums];

  HWY_INLINE void clear() {
#pragma GCC unroll 16
    for (int k = 0; k < kSums; ++k) sums[k] = hn::Zero(F());
  }

  HWY_INLINE void add(const PatchSet& patches, const Linearization& l, std::size_t at, VF w, VF r) {
    const F f;
    const VF minus_intensity = hn::Neg(hn::LoadU(f, patches.intensity.data() + at));
    VF own = hn::Neg(w);
    if constexpr (kRow < 6) own = hn::Mul(w, hn::LoadU(f, l.J[kRow].data() + at));
    if constexpr (kRow == 6) own = hn::Mul(w, minus_intensity);
#pragma GCC unroll 16
    for (int column = kRow; column < 6; ++column) {
      VF& sum = sums[column - kRow];
      sum = hn::MulAdd(own, hn::LoadU(f, l.J[static_cast<std::size_t>(column)].data() + at), sum);
    }
    if constexpr (kRow <= 6) sums[6 - kRow] = hn::MulAdd(own, minus_intensity, sums[6 - kRow]);
    sums[7 - kRow] = hn::Sub(sums[7 - kRow], own);
    sums[8 - kRow] = hn::MulAdd(own, r, sums[8 - kRow]);
  }

  HWY_INLINE void store(std::size_t lane, NormalSums& out) const {
    const F f;
#pragma GCC unroll 16
    for (int k = 0; k < kSums - 1; ++k) {
      hn::StoreU(sums[k], f, out[static_cast<std::size_t>(kFirst + k)].data() + lane);
    }
    hn::StoreU(sums[kSums - 1], f, out[static_cast<std::size_t>(kRight)].data() + lane);
  }
};

// Two rows at a time, eleven sums: more would not stay in registers.
template <int kRow>
void normal_row_pair(const PatchSet& patches, const Linearization& l,
                     const std::vector<float>& weights, NormalSums& out) {
  const F f;
  const std::size_t step = hn::Lanes(f);
  for (std::size_t lane = 0; lane < kSumLanes; lane += step) {
    NormalRow<kRow> longer;
    NormalRow<NormalEquations::kSize - 1 - kRow> shorter;
    longer.clear();
    shorter.clear();
    for (std::size_t at = lane; at < l.residual.size(); at += kSumLanes) {
      const VF w = hn::LoadU(f, weights.data() + at);
      const VF r = hn::LoadU(f, l.residual.data() + at);
      longer.add(patches, l, at, w, r);
      shorter.add(patches, l, at, w, r);
    }
    longer.store(lane, out);
    shorter.store(lane, out);
  }
}

void normal_equation_sums(const PatchSet& patches, const Linearization& l,
                          const std::vector<float>& weights, NormalSums& out) {
  normal_row_pair<0>(patches, l, weights, out);
  normal_row_pair<1>(patches, l, weights, out);
  normal_row_pair<2>(patches, l, weights, out);
  normal_row_pair<3>(patches, l, weights, out);
}

void column_sums(const std::vector<float>& values, LaneSums& out) {
  const F f;
  const std::size_t step = hn::Lanes(f);
  for (std::size_t lane = 0; lane < kSumLanes; lane += step) {
    VF sum = hn::Zero(f);
    for (std::size_t at = lane; at < values.size(); at += kSumLanes) {
      sum = hn::Add(sum, hn::LoadU(f, values.data() + at));
    }
    hn::StoreU(sum, f, out.data() + lane);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace sparsight
HWY_AFTER_NAMESPACE();

#endif  // per target
