#pragma once

#include <string>

#include "tools/session/session_summary.h"

namespace sparsight {

// report.html: one page that needs no other file and no network, in light or dark as the reader
// has it.
std::string report_html(const Session& session, const SessionSummary& summary);

}  // namespace sparsight
