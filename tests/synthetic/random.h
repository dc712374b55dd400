#pragma once

#include <cstdint>

namespace sparsight::synthetic {

// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): every bit of the input reaches every bit
// of the output. The standard distributions differ between libraries; these numbers do not.
constexpr std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

constexpr std::uint64_t hash(std::uint64_t seed, std::int64_t a, std::int64_t b) {
  return hash(seed ^ (static_cast<std::uint64_t>(a) * 0x9e3779b1U) ^
              (static_cast<std::uint64_t>(b) * 0x85ebca77c2b2ae63ULL));
}

// [0, 1)
constexpr double unit_interval(std::uint64_t bits) {
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

// Standard normal to within the sum of four uniforms (Irwin–Hall); its tails end at 3.5 sigma.
constexpr double normal(std::uint64_t bits) {
  const auto quarter = [bits](unsigned shift) {
    return static_cast<double>((bits >> shift) & 0xffffU) / 65536.0;
  };
  const double sum = quarter(0) + quarter(16) + quarter(32) + quarter(48);
  return (sum - 2.0) * 1.7320508075688772;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(hash(seed)) {}

  std::uint64_t bits() { return state_ = hash(state_); }
  double uniform(double low, double high) { return low + (high - low) * unit_interval(bits()); }
  double gaussian(double sigma) { return sigma * normal(bits()); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

 private:
  std::uint64_t state_;
};

}  // namespace sparsight::synthetic
