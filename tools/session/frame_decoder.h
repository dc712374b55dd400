#pragma once

#include "realtime/sync/grey_image.h"

namespace sparsight {

// For compressed frames, live and recorded: the drivers know how, the synchronisation whom to ask.
JpegDecoder frame_decoder();

}  // namespace sparsight
