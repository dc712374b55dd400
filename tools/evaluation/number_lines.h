#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"

namespace sparsight {

// A line of a text table: its number in the file, from 1, and its blank-separated fields.
struct NumberLine {
  std::size_t number = 0;
  std::vector<std::string_view> fields;  // views into the text
};

// The lines that carry something: empty lines and those that start with # are passed over.
std::vector<NumberLine> split_number_lines(std::string_view text);

// A finite number, or an error that names file, line and field (`field` counts from 0).
Result<double> parse_number(const NumberLine& line, std::size_t field, const std::string& source);

// Seconds, rounded to whole nanoseconds; exact unless written with an exponent.
Result<std::chrono::nanoseconds> parse_seconds(const NumberLine& line, std::size_t field,
                                               const std::string& source);

}  // namespace sparsight
