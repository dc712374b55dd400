#pragma once

#include <string>
#include <vector>

namespace sparsight {

// A Markdown table whose columns are padded, so that it reads in a terminal too. The first row is
// the head; every row has as many cells. Cells are right-aligned.
std::string aligned_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace sparsight
