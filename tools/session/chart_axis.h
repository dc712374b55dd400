#pragma once

#include <limits>
#include <string>
#include <vector>

namespace sparsight {

struct Interval {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(min <= max); }
  double length() const { return max - min; }
  double middle() const { return 0.5 * (min + max); }
  void include(double value);
};

// Positions along an axis that read well: multiples of 1, 2 or 5 times a power of ten.
struct Ticks {
  double step = 1.0;
  std::vector<double> positions;

  std::string label(double position) const;
};

// The finest ticks that divide the range into at most `most` parts; whole numbers only if asked
// for.
Ticks nice_ticks(const Interval& range, int most, bool whole_numbers = false);

// The range widened to the next ticks, and to some length if it has none.
Interval widened_to_ticks(const Interval& range, int most);

}  // namespace sparsight
