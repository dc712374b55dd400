#pragma once

#include <cmath>
#include <cstdint>

namespace sparsight::simulated {

// Mixes all bits (SplitMix64's finaliser, Steele et al. 2014).
inline std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

// The same sequence on every machine, unlike the distributions of the standard library. What is
// made in any order, as frames are, seeds one of its own with its number. Draws of one expression
// stand in braces: the order of a function's arguments is the compiler's own.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(hash(seed)) {}
  Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t number = 0)
      : state_(hash(hash(hash(seed) + stream) + number)) {}

  std::uint64_t bits() { return hash(state_++); }
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }  // [0, 1)
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  float uniform_f(double low, double high) { return static_cast<float>(uniform(low, high)); }
  int index(int count) { return static_cast<int>(unit() * count); }
  bool chance(double probability) { return unit() < probability; }
  double exponential(double mean) { return -mean * std::log(1.0 - unit()); }
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
    return radius * std::cos(2.0 * M_PI * unit());
  }

 private:
  std::uint64_t state_;
};

}  // namespace sparsight::simulated
