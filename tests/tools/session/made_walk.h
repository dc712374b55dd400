#pragma once

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "drivers/recording/recording_writer.h"
#include "drivers/simulated/simulated_rig.h"
#include "tests/drivers/simulated/bare_room.h"
#include "tools/configuration/rig_file.h"

namespace sparsight::testing {

// Two seconds in the bare room, large enough to be tracked, with all that the rig gave.
struct MadeWalk {
  std::vector<RigEvent> events;
  RigConfig rig;
  std::unique_ptr<SimulatedRig> simulation;  // for its truth

  static const MadeWalk& shared() {
    static const MadeWalk kWalk = [] {
      SimulationOptions options = small_options(2.0);
      options.width = 240;
      options.height = 180;
      MadeWalk walk;
      walk.simulation = std::make_unique<SimulatedRig>(options, bare_room());
      walk.events = gather_events(*walk.simulation).all;
      walk.rig = walk.simulation->rig_config();
      return walk;
    }();
    return kWalk;
  }
};

inline void write_recording(const std::filesystem::path& file, const std::vector<RigEvent>& events,
                            const RigConfig& rig) {
  std::filesystem::remove(file);
  RecordingContent content;
  content.calibration = rig.calibration;
  content.attachments.push_back({kRigConfigurationAttachment, "application/toml", describe(rig)});
  McapWriterOptions options;
  options.sync_chunks = false;
  auto writer = RecordingWriter::create(file, content, options).value();
  for (const RigEvent& event : events) ASSERT_TRUE(writer->write(event));
  ASSERT_TRUE(writer->close());
}

}  // namespace sparsight::testing
