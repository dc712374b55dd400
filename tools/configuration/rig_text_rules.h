#pragma once

#include "tools/configuration/field_range.h"

namespace sparsight {

TextRule any_text();
TextRule some_text();
TextRule ipv4_address();
TextRule ipv4_address_or_nothing();
TextRule pixel_format_or_auto();

}  // namespace sparsight
