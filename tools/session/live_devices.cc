#include "tools/session/live_devices.h"

#include <chrono>
#include <memory>
#include <utility>

#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"
#include "drivers/replay/played_events.h"
#include "drivers/replay/repeated_events.h"
#include "drivers/simulated/simulated_devices.h"
#include "drivers/v4l2/v4l2_camera.h"
#include "drivers/vlp16/udp_lidar.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "hal/time.h"
#include "tools/configuration/rig_file.h"

namespace sparsight {
namespace {

// From opening a recording until its first event comes: the devices have started by then.
constexpr std::chrono::milliseconds kLead{300};

Result<RigConfig> rig_of(RecordingSource& recording, const std::string& file,
                         const std::string& rig_file) {
  if (!rig_file.empty()) return load_rig(rig_file);
  const auto description = recording.attachment(kRigConfigurationAttachment);
  if (!description) return tl::unexpected(description.error());
  return parse_rig(*description, file + "#rig.toml");
}

}  // namespace

Result<LiveRig> open_rig(const std::string& rig_file) {
  auto config = load_rig(rig_file);
  if (!config) return tl::unexpected(config.error());
  LiveRig rig{.config = *config, .source = rig_file};
  rig.devices.camera = std::make_shared<V4l2Camera>(config->camera);
  rig.devices.lidar = std::make_shared<UdpLidar>(config->lidar);
  rig.devices.trigger = std::make_shared<GpioTriggerLine>(config->trigger);
  rig.devices.decoder = std::make_unique<Vlp16Decoder>(config->lidar);
  return rig;
}

Result<LiveRig> play_recording(const std::filesystem::path& file, const std::string& rig_file,
                               int times) {
  auto recording = RecordingSource::open(file);
  if (!recording) return tl::unexpected(recording.error());
  auto config = rig_of(**recording, file.string(), rig_file);
  if (!config) return tl::unexpected(config.error());
  LiveRig rig{.config = *config, .source = file};
  const HostTime start = HostClock::now() + kLead;
  const HostTime first = (*recording)->info().first;
  auto repeated = std::make_unique<RepeatedEvents>(
      [file]() -> Result<std::unique_ptr<RigEventSource>> { return RecordingSource::open(file); },
      times);
  SimulatedDevices devices(std::make_unique<PlayedEvents>(std::move(repeated), start - first),
                           start, SimulatedPace::kRealTime);
  rig.devices.camera = devices.camera();
  rig.devices.lidar = devices.lidar();
  rig.devices.trigger = devices.trigger_line();
  rig.devices.decoder = std::make_unique<Vlp16Decoder>(config->lidar);
  return rig;
}

}  // namespace sparsight
