#include "tools/session/simulate_session.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "drivers/recording/recording_writer.h"
#include "realtime/sync/grey_image.h"
#include "tools/configuration/rig_file.h"
#include "tools/session/interrupt.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

// Whatever of the outputs is asked for. The first error ends the simulation.
class SimulationOutput {
 public:
  explicit SimulationOutput(const SimulateSession& session) : session_(session) {}

  Result<void> open(const RigConfig& config) {
    if (!session_.frames.empty()) {
      std::error_code error;
      fs::create_directories(session_.frames, error);
      if (error) {
        return fail(ErrorCode::kUnreadable,
                    session_.frames + ": cannot be made: " + error.message());
      }
    }
    if (session_.output.empty()) return {};
    RecordingContent content;
    content.calibration = config.calibration;
    content.attachments.push_back(
        {kRigConfigurationAttachment, "application/toml", describe(config)});
    content.session["source"] = "simulated";
    content.session["seed"] = fmt::format("{}", session_.options.seed);
    // An hour of work is not at stake: no wait for the disk at each chunk.
    McapWriterOptions options;
    options.sync_chunks = false;
    auto writer = RecordingWriter::create(session_.output, content, options);
    if (!writer) return tl::unexpected(writer.error());
    writer_ = std::move(*writer);
    return {};
  }

  Result<void> write(const RigEvent& event) {
    const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event);
    if (frame != nullptr && !session_.frames.empty()) {
      if (Result<void> drawn = draw(**frame); !drawn) return drawn;
    }
    return writer_ ? writer_->write(event) : Result<void>{};
  }

  Result<void> close(const SimulatedTruth& truth) {
    if (!session_.frames.empty()) {
      Result<void> done = truth.write_tum(session_.frames + "/ground_truth.tum");
      if (!done) return done;
    }
    if (!writer_) return {};
    if (Result<void> closed = writer_->close(); !closed) return closed;
    return truth.write_tum(ground_truth_path(session_.output));
  }

 private:
  Result<void> draw(const CameraFrame& frame) const {
    auto image = convert_image(frame, session_.options.color, {});
    if (!image) return tl::unexpected(image.error());
    const std::string path =
        fmt::format("{}/{}_{:06}.png", session_.frames, frame.epoch, frame.sequence);
    cv::Mat pixels(frame.height, frame.width, CV_8U, image->grey.pixels.data());
    if (image->color) {
      std::vector<std::uint8_t>& rgb = image->color->rgb;
      for (std::size_t i = 0; i < rgb.size(); i += 3) std::swap(rgb[i], rgb[i + 2]);
      pixels = cv::Mat(frame.height, frame.width, CV_8UC3, rgb.data());
    }
    if (cv::imwrite(path, pixels)) return {};
    return fail(ErrorCode::kUnreadable, path + ": cannot be written; is there space?");
  }

  const SimulateSession& session_;
  std::unique_ptr<RecordingWriter> writer_;
};

struct Counts {
  std::size_t frames = 0;
  std::size_t packets = 0;
  std::size_t edges = 0;
};

std::string summary(const SimulateSession& session, const Counts& counts, double wall_s) {
  std::string text = fmt::format("{} frames, {} LiDAR packets, {} edges in {:.0f} s\n",
                                 counts.frames, counts.packets, counts.edges, wall_s);
  if (!session.output.empty()) {
    text += fmt::format("{}\n{}\n", session.output, ground_truth_path(session.output));
  }
  if (!session.frames.empty()) text += session.frames + "/\n";
  return text;
}

}  // namespace

std::string ground_truth_path(const std::string& recording) {
  return fs::path(recording).replace_extension("ground_truth.tum").string();
}

Result<std::string> run_simulation(const SimulateSession& session, Progress::Style style) {
  const auto begin = std::chrono::steady_clock::now();
  SimulationOutput output(session);
  if (const auto opened = output.open(simulated_rig_config(session.options)); !opened) {
    return tl::unexpected(opened.error());
  }
  SimulatedRig rig(session.options);
  const InterruptRequest interrupt;
  Progress progress(stderr, style, rig.ground_truth().exposures().size());
  Counts counts;
  while (const std::optional<RigEvent> event = rig.next()) {
    if (const auto written = output.write(*event); !written) {
      progress.end();
      return tl::unexpected(written.error());
    }
    if (std::holds_alternative<std::shared_ptr<const CameraFrame>>(*event)) {
      ++counts.frames;
      progress.frame(arrival_of(*event), "");
    }
    if (std::holds_alternative<LidarPacket>(*event)) ++counts.packets;
    if (std::holds_alternative<Edge>(*event)) ++counts.edges;
    if (interrupt.pending()) break;
  }
  progress.end();
  if (const auto closed = output.close(rig.ground_truth()); !closed) {
    return tl::unexpected(closed.error());
  }
  const auto wall = std::chrono::steady_clock::now() - begin;
  return summary(session, counts, to_seconds(wall));
}

}  // namespace sparsight
