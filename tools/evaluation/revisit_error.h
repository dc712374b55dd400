#pragma once

#include <cstddef>
#include <vector>

#include "tools/evaluation/kitti_error.h"

namespace sparsight {

struct RevisitOptions {
  std::size_t places = 0;  // none: not measured
  double radius_m = 2.0;   // of a place
};

// A place that the path passed before.
struct Revisit {
  std::size_t place = 0;
  std::size_t first = 0;  // frames, as in the pairs: where each of the two passes was nearest
  std::size_t again = 0;
  double way_m = 0.0;  // along the true path from the one to the other
  // Of the one pose relative to the other: what a map of both shows double by.
  double error_m = 0.0;
  double error_deg = 0.0;
};

// What a map's user sees of drift: how far two passes of the same place come apart. The places
// stand at equal distances along the first lap of the true path, from its start on; a lap ends
// where the path comes back to within the radius of its start, having been five times as far away.
// Each later pass is compared with the first one.
struct RevisitError {
  std::size_t places = 0;  // 0: the path never comes back
  std::vector<Revisit> revisits;
  double rmse_m = 0.0;
  double max_m = 0.0;
};
RevisitError revisit_error(const PosePairs& pairs, const RevisitOptions& options);

}  // namespace sparsight
