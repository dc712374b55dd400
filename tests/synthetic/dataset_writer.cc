#include "tests/synthetic/dataset_writer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

namespace sparsight::synthetic {
namespace {

namespace fs = std::filesystem;

Result<void> write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush())
    return fail(ErrorCode::kUnreadable, fmt::format("cannot write {}", file.c_str()));
  return {};
}

Result<void> write_image(const fs::path& file, GreyImage image) {
  const cv::Mat view(image.height, image.width, CV_8UC1, image.pixels.data());
  if (!cv::imwrite(file.string(), view)) {
    return fail(ErrorCode::kUnreadable, fmt::format("cannot write {}", file.c_str()));
  }
  return {};
}

Result<void> write_scan(const fs::path& file, const Sweep& sweep) {
  std::string bytes;
  for (const LidarReturn& r : sweep.returns) {
    const std::array<float, 4> point{r.p_lidar.x(), r.p_lidar.y(), r.p_lidar.z(), r.intensity};
    bytes.append(reinterpret_cast<const char*>(point.data()), sizeof(point));
  }
  return write_text(file, bytes);
}

std::string numbers(const Eigen::Matrix<double, 3, 4>& matrix) {
  std::string line;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      line += fmt::format("{}{:.12e}", line.empty() ? "" : " ", matrix(row, column));
    }
  }
  return line;
}

Eigen::Matrix<double, 3, 4> projection(const CameraIntrinsics& camera) {
  Eigen::Matrix<double, 3, 4> P;
  P << camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0;
  return P;
}

std::string pose_lines(const Scene& scene, std::size_t frames) {
  const Eigen::Isometry3d T_first_world = scene.T_world_camera(scene.exposure_s(0)).inverse();
  std::string text;
  for (std::size_t i = 0; i < frames; ++i) {
    const Eigen::Isometry3d T = T_first_world * scene.T_world_camera(scene.exposure_s(i));
    text += numbers(T.matrix().topRows<3>()) + "\n";
  }
  return text;
}

Result<void> write_frames(const Scene& scene, std::size_t frames, const fs::path& images,
                          const fs::path& scans, int digits, const Progress& progress) {
  for (std::size_t i = 0; i < frames; ++i) {
    const std::string name = fmt::format("{:0{}}", i, digits);
    auto written = write_image(images / (name + ".png"), scene.image(i));
    if (written) written = write_scan(scans / (name + ".bin"), scene.sweep(i));
    if (!written) return written;
    if (progress) progress(i);
  }
  return {};
}

Result<void> make_folders(std::initializer_list<fs::path> folders) {
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      return fail(ErrorCode::kUnreadable,
                  fmt::format("cannot make {}: {}", folder.c_str(), error.message()));
    }
  }
  return {};
}

// The day begins at noon; a drive lasts less than an hour.
std::string timestamp(double seconds) {
  const auto ns = static_cast<long long>(std::llround(seconds * 1e9));
  const long long s = ns / 1'000'000'000LL;
  return fmt::format("2011-09-26 12:{:02}:{:02}.{:09}\n", s / 60, s % 60, ns % 1'000'000'000LL);
}

Result<void> write_raw_times(const Scene& scene, std::size_t frames, const fs::path& drive) {
  const auto* lidar = std::get_if<SpinningLidar>(&scene.sensor);
  const double half_turn = lidar != nullptr ? lidar->period_s / 2.0 : 0.0;
  std::array<std::string, 3> text;
  for (std::size_t i = 0; i < frames; ++i) {
    text[0] += timestamp(scene.exposure_s(i) - half_turn);
    text[1] += timestamp(scene.exposure_s(i));
    text[2] += timestamp(scene.exposure_s(i) + half_turn);
  }
  auto written = write_text(drive / "image_00" / "timestamps.txt", text[1]);
  const fs::path velodyne = drive / "velodyne_points";
  if (written) written = write_text(velodyne / "timestamps_start.txt", text[0]);
  if (written) written = write_text(velodyne / "timestamps.txt", text[1]);
  if (written) written = write_text(velodyne / "timestamps_end.txt", text[2]);
  return written;
}

std::string rotation_and_translation(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d R = T.linear();
  const Eigen::Vector3d t = T.translation();
  return fmt::format(
      "R: {:.12e} {:.12e} {:.12e} {:.12e} {:.12e} {:.12e} {:.12e} {:.12e} {:.12e}\n"
      "T: {:.12e} {:.12e} {:.12e}\n",
      R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2), t.x(), t.y(),
      t.z());
}

Result<void> write_raw_calibration(const Scene& scene, const fs::path& day) {
  const CameraIntrinsics& c = scene.rig.camera;
  std::string cameras = "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\n";
  for (int i = 0; i < 4; ++i) {
    cameras += fmt::format(
        "S_{0:02}: {1} {2}\nK_{0:02}: {3} 0 {4} 0 {5} {6} 0 0 1\nD_{0:02}: 0 0 0 0 0\n"
        "R_{0:02}: 1 0 0 0 1 0 0 0 1\nT_{0:02}: 0 0 0\nS_rect_{0:02}: {1} {2}\n"
        "R_rect_{0:02}: 1 0 0 0 1 0 0 0 1\nP_rect_{0:02}: {7}\n",
        i, c.width, c.height, c.fx, c.cx, c.fy, c.cy, numbers(projection(c)));
  }
  const std::string time = "calib_time: 15-Mar-2012 11:37:16\n";
  auto written = write_text(day / "calib_cam_to_cam.txt", cameras);
  if (written) {
    written = write_text(
        day / "calib_velo_to_cam.txt",
        time + rotation_and_translation(scene.rig.T_camera_lidar) + "delta_f: 0 0\ndelta_c: 0 0\n");
  }
  if (written) {
    written = write_text(day / "calib_imu_to_velo.txt",
                         time + rotation_and_translation(Eigen::Isometry3d::Identity()));
  }
  return written;
}

}  // namespace

Result<fs::path> write_odometry_folder(const Scene& scene, std::size_t frames, const fs::path& root,
                                       const Progress& progress) {
  const fs::path sequence = root / "sequences" / "00";
  auto written = make_folders({sequence / "image_0", sequence / "velodyne", root / "poses"});
  std::string calibration;
  for (int i = 0; i < 4; ++i) {
    calibration += fmt::format("P{}: {}\n", i, numbers(projection(scene.rig.camera)));
  }
  calibration += fmt::format("Tr: {}\n", numbers(scene.rig.T_camera_lidar.matrix().topRows<3>()));
  std::string times;
  for (std::size_t i = 0; i < frames; ++i) {
    times += fmt::format("{:.6e}\n", scene.exposure_s(i) - scene.exposure_s(0));
  }
  if (written) written = write_text(sequence / "calib.txt", calibration);
  if (written) written = write_text(sequence / "times.txt", times);
  if (written) written = write_text(root / "poses" / "00.txt", pose_lines(scene, frames));
  if (written) {
    written = write_frames(scene, frames, sequence / "image_0", sequence / "velodyne", 6, progress);
  }
  if (!written) return tl::unexpected(written.error());
  return sequence;
}

Result<fs::path> write_raw_folder(const Scene& scene, std::size_t frames, const fs::path& root,
                                  const Progress& progress) {
  const fs::path day = root / "2011_09_26";
  const fs::path drive = day / "2011_09_26_drive_0001_sync";
  const fs::path images = drive / "image_00" / "data";
  const fs::path scans = drive / "velodyne_points" / "data";
  auto written = make_folders({images, scans});
  if (written) written = write_raw_calibration(scene, day);
  if (written) written = write_raw_times(scene, frames, drive);
  if (written) written = write_text(drive / "poses_camera_0.txt", pose_lines(scene, frames));
  if (written) written = write_frames(scene, frames, images, scans, 10, progress);
  if (!written) return tl::unexpected(written.error());
  return drive;
}

}  // namespace sparsight::synthetic
