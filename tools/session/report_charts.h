#pragma once

#include <vector>

#include "tools/session/chart.h"
#include "tools/session/session_summary.h"

namespace sparsight {

// Path from above, to scale.
Chart path_chart(const Session& session);
// Height over the distance travelled.
Chart height_chart(const Session& session);
// Error per segment length: translation, rotation. Needs ground truth.
std::vector<Chart> segment_charts(const Evaluation& evaluation);
// Distance from the truth, after alignment, along the path.
Chart position_error_chart(const GroundTruth& truth);

// Over the frames.
Chart tracking_time_chart(const Session& session, const SessionSummary& summary);
Chart window_time_chart(const Session& session, const SessionSummary& summary);
Chart points_chart(const Session& session);
Chart sigma_chart(const Session& session);
Chart visibility_chart(const Session& session);
Chart attempts_chart(const Session& session);

}  // namespace sparsight
