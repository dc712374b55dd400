#include "tools/doctor/disk_checks.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>

namespace sparsight {
namespace {

constexpr double kMega = 1e6;
// 1507 packets of 1206 bytes a second in dual mode, half of it else (VLP-16 manual, p. 49).
constexpr double kLidarSingle = 0.91e6;
constexpr std::string_view kTrialFile = ".sparsight_disk_trial";

Result<void> write_and_sync(const std::filesystem::path& file, int megabytes) {
  const std::vector<char> block(1'000'000, 'x');
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's signature
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  bool good = fd >= 0;
  for (int i = 0; good && i < megabytes; ++i) {
    good = ::write(fd, block.data(), block.size()) == static_cast<ssize_t>(block.size());
  }
  good = good && ::fdatasync(fd) == 0;
  const int reason = errno;
  if (fd >= 0) ::close(fd);
  if (good) return {};
  return fail(ErrorCode::kUnreadable, fmt::format("{}: cannot write: {}", file.string(),
                                                  std::generic_category().message(reason)));
}

Check speed(const DiskObservation& seen, double needed) {
  Check check{"disk speed", Verdict::kOk,
              fmt::format("{:.0f} MB/s, a recording needs {:.1f}", seen.bytes_per_s / kMega,
                          needed / kMega),
              ""};
  if (seen.bytes_per_s < 2.0 * needed) {
    check.verdict = seen.bytes_per_s < needed ? Verdict::kFail : Verdict::kWarn;
    check.fix = "record to an NVMe disk or a card of class A2; lower the frame rate or size";
  }
  return check;
}

Check space(const DiskObservation& seen, double needed) {
  const double minutes = seen.free_bytes / needed / 60.0;
  Check check{"disk space", Verdict::kOk,
              fmt::format("{:.1f} GB free, {:.0f} minutes", seen.free_bytes / 1e9, minutes), ""};
  if (minutes < 15.0) {
    check.verdict = minutes < 3.0 ? Verdict::kFail : Verdict::kWarn;
    check.fix = "move old recordings away";
  }
  return check;
}

}  // namespace

Result<DiskObservation> observe_disk(const std::filesystem::path& folder, int megabytes) {
  std::error_code error;
  const auto space = std::filesystem::space(folder, error);
  if (error) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: {}", folder.string(), error.message()));
  }
  const auto file = folder / kTrialFile;
  const auto begin = std::chrono::steady_clock::now();
  const auto written = write_and_sync(file, megabytes);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::filesystem::remove(file, error);
  if (!written) return tl::unexpected(written.error());
  return DiskObservation{static_cast<double>(space.available),
                         megabytes * kMega / std::max(took.count(), 1e-6)};
}

double recording_bytes_per_s(const RigConfig& rig) {
  const bool dual = rig.lidar.return_mode == ReturnMode::kDual;
  return rig.camera.width * rig.camera.height * rig.camera.rate_hz +
         (dual ? 2.0 : 1.0) * kLidarSingle;
}

std::vector<Check> disk_checks(const Result<DiskObservation>& seen, const RigConfig& rig) {
  if (!seen) {
    return {{"disk speed", Verdict::kFail, "not measured",
             seen.error().message + "; name a folder to record to with --folder"}};
  }
  const double needed = recording_bytes_per_s(rig);
  return {speed(*seen, needed), space(*seen, needed)};
}

}  // namespace sparsight
