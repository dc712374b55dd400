#pragma once

namespace sparsight {

// While one lives, the first SIGINT or SIGTERM only asks for an end; the second ends the program as
// ever. One at a time.
class InterruptRequest {
 public:
  InterruptRequest();
  ~InterruptRequest();
  InterruptRequest(const InterruptRequest&) = delete;
  InterruptRequest& operator=(const InterruptRequest&) = delete;

  bool pending() const;
};

}  // namespace sparsight
