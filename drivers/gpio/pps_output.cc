#include "drivers/gpio/pps_output.h"

#include <algorithm>

namespace sparsight {

PpsOutput::PpsOutput(TriggerConfig config, std::unique_ptr<PpsPort> port)
    : config_(std::move(config)), port_(std::move(port)) {}

PpsOutput::~PpsOutput() { stop(); }

Result<void> PpsOutput::start() {
  if (plan_) return {};
  if (!config_.pps_output_line) {
    return fail(ErrorCode::kMissingField,
                "[trigger] pps_output_line: missing; name the GPIO line that is wired to the "
                "LiDAR's PPS input");
  }
  if (auto opened = port_->open(config_); !opened) return opened;
  plan_ = plan_from(port_->now(), port_->utc_now());
  return {};
}

void PpsOutput::stop() {
  if (!plan_) return;
  port_->close();
  plan_.reset();
}

void PpsOutput::step() {
  if (!plan_) return;
  const PpsStep next = plan_->next();
  port_->sleep_until(next.at);
  const std::chrono::nanoseconds delay = port_->now() - next.at;
  if (next.kind == PpsStep::Kind::kRise && delay > kLatestEdge) {
    ++counters_.late;
    return plan_->skip_to(port_->now());
  }
  perform(next, delay);
  plan_->done();
}

void PpsOutput::perform(const PpsStep& step, std::chrono::nanoseconds delay) {
  switch (step.kind) {
    case PpsStep::Kind::kRise:
      counters_.worst_delay = std::max(counters_.worst_delay, delay);
      ++(port_->set_pin(true) ? counters_.pulses : counters_.failed);
      break;
    case PpsStep::Kind::kFall:
      if (!port_->set_pin(false)) ++counters_.failed;
      break;
    case PpsStep::Kind::kSentence:
      if (config_.nmea_device.empty()) break;
      if (delay > kLatestSentence - kSentenceAfterEdge) {
        ++counters_.late;
      } else {
        ++(port_->send(gprmc(step.second)) ? counters_.sentences : counters_.failed);
      }
      break;
  }
}

}  // namespace sparsight
