#pragma once

#include <memory>
#include <string>

#include "slam/loop/vocabulary.h"

namespace sparsight {

// The vocabulary the program carries: config/vocabulary.bin as it was when it was built.
std::shared_ptr<const Vocabulary> built_in_vocabulary();

// Text as ORB-SLAM's (ORBvoc.txt), or our binary form; told by its first bytes.
Result<Vocabulary> parse_vocabulary(std::string_view bytes, const std::string& source);
Result<Vocabulary> load_vocabulary(const std::string& file);

}  // namespace sparsight
