#pragma once

#include <filesystem>
#include <string>

#include "tools/session/session.h"

namespace sparsight {

// What a person is told when a session ends: what was done, how fast, how far off, and where the
// results are. A few lines.
std::string session_text(const Session& session, const std::filesystem::path& folder);

}  // namespace sparsight
