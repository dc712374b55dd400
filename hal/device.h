#pragma once

#include <cstdint>

namespace sparsight {

enum class DeviceState : std::uint8_t {
  kStopped,    // not started, or stopped
  kStreaming,  // data come
  kSilent,     // there, but nothing has come for longer than its rate allows
  kGone,       // unplugged or unreachable; read() goes on looking for it
  kEnded,      // a recording has no more; never of a live device
};

enum class DeviceKind : std::uint8_t { kCamera, kLidar, kTrigger };

}  // namespace sparsight
