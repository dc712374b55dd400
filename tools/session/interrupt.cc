#include "tools/session/interrupt.h"

#include <csignal>

namespace sparsight {
namespace {

// The only thing a signal handler may touch.
volatile std::sig_atomic_t interrupt_pending = 0;

void request_end(int signal) {
  interrupt_pending = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptRequest::InterruptRequest() {
  interrupt_pending = 0;
  std::signal(SIGINT, request_end);
  std::signal(SIGTERM, request_end);
}

InterruptRequest::~InterruptRequest() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool InterruptRequest::pending() const { return interrupt_pending != 0; }

}  // namespace sparsight
