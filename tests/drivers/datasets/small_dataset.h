#pragma once

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <vector>

// Data sets of a few tiny frames, written as the real ones are distributed, to be damaged by tests.
namespace sparsight::testing {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(fs::temp_directory_path() /
              fmt::format("sparsight_test_{:016x}",
                          (std::uint64_t{std::random_device()()} << 32) | std::random_device()())) {
    fs::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

inline void write_file(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

inline std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Keeps the first part of a file only.
inline void truncate_file(const fs::path& file, double share) {
  fs::resize_file(file,
                  static_cast<std::uintmax_t>(share * static_cast<double>(fs::file_size(file))));
}

inline std::string scan_bytes(const std::vector<std::array<float, 4>>& points) {
  std::string bytes(points.size() * 16, '\0');
  if (!points.empty()) std::memcpy(bytes.data(), points.data(), bytes.size());
  return bytes;
}

// `rings` rings of 90 points on a cylinder of 10 m, KITTI's order.
inline std::vector<std::array<float, 4>> cylinder_scan(int rings) {
  std::vector<std::array<float, 4>> points;
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < 90; ++i) {
      const double azimuth = (4.0 * i + 2.0) * CV_PI / 180.0;
      points.push_back({static_cast<float>(10.0 * std::cos(azimuth)),
                        static_cast<float>(10.0 * std::sin(azimuth)),
                        static_cast<float>(0.5 - 0.1 * ring), 0.25F});
    }
  }
  return points;
}

// An image of one colour with some texture in its first row, so that rows cannot be mixed up.
inline cv::Mat small_image(int type, int frame, int width = 40, int height = 12) {
  cv::Mat image(height, width, type, cv::Scalar(10.0 * frame, 20, 30, 255));
  image.at<std::uint8_t>(0, 0) = 255;
  return image;
}

inline void write_image(const fs::path& file, const cv::Mat& image) {
  fs::create_directories(file.parent_path());
  cv::imwrite(file.string(), image);
}

// A KITTI odometry sequence of five frames.
struct SmallSequence {
  TemporaryFolder temporary;
  fs::path folder = temporary.path() / "sequences" / "42";
  int frames = 5;

  explicit SmallSequence(int camera = 0, int type = CV_8UC1) {
    std::string times;
    for (int i = 0; i < frames; ++i) {
      write_image(image(i, camera), small_image(type, i));
      write_file(scan(i), scan_bytes(cylinder_scan(8)));
      times += fmt::format("{:.6e}\n", 0.1 * i);
    }
    write_file(folder / "times.txt", times);
    write_file(folder / "calib.txt", calibration());
  }
  fs::path image(int frame, int camera = 0) const {
    return folder / fmt::format("image_{}", camera) / fmt::format("{:06}.png", frame);
  }
  fs::path scan(int frame) const { return folder / "velodyne" / fmt::format("{:06}.bin", frame); }

  static std::string calibration() {
    return "P0: 50 0 20 0 0 60 6 0 0 0 1 0\n"
           "P1: 50 0 20 -25 0 60 6 0 0 0 1 0\n"
           "P2: 50 0 20 5 0 60 6 0.6 0 0 1 0.003\n"
           "P3: 50 0 20 -20 0 60 6 0.6 0 0 1 0.003\n"
           "Tr: 0 -1 0 0.1 0 0 -1 -0.2 1 0 0 -0.3\n";
  }
};

// A KITTI raw drive of five frames. The scanner faces forward at full tenths of a second; images
// arrive 16 ms later.
struct SmallDrive {
  TemporaryFolder temporary;
  fs::path day = temporary.path() / "2011_09_26";
  fs::path folder;
  int frames = 5;

  explicit SmallDrive(const std::string& name = "2011_09_26_drive_0042_sync",
                      const cv::Size& size = {40, 12})
      : folder(day / name) {
    for (int i = 0; i < frames; ++i) {
      write_image(image(i), small_image(CV_8UC1, i, size.width, size.height));
      write_file(scan(i), scan_bytes(cylinder_scan(8)));
    }
    write_times("image_00/timestamps.txt", 0.016);
    write_times("velodyne_points/timestamps.txt", 0.0);
    write_times("velodyne_points/timestamps_start.txt", -0.05);
    write_times("velodyne_points/timestamps_end.txt", 0.05);
    write_file(day / "calib_cam_to_cam.txt", camera_calibration());
    write_file(day / "calib_velo_to_cam.txt",
               "calib_time: 15-Mar-2012 11:37:16\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0.1 -0.2 -0.3\n"
               "delta_f: 0 0\n");
  }
  fs::path image(int frame) const {
    return folder / "image_00/data" / fmt::format("{:010}.png", frame);
  }
  fs::path scan(int frame) const {
    return folder / "velodyne_points/data" / fmt::format("{:010}.bin", frame);
  }
  static std::string time_line(double seconds) {
    return fmt::format("2011-09-26 13:02:{:012.9f}\n", 25.0 + seconds);
  }
  void write_times(const std::string& file, double offset) const {
    std::string lines;
    for (int i = 0; i < frames; ++i) lines += time_line(0.1 * i + offset);
    write_file(folder / file, lines);
  }
  static std::string camera_calibration() {
    return "calib_time: 09-Jan-2012 13:57:47\n"
           "S_00: 44 16\nK_00: 55 0 22 0 65 8 0 0 1\nD_00: -0.37 0.2 0.002 0.001 -0.07\n"
           "R_00: 1 0 0 0 1 0 0 0 1\nT_00: 0 0 0\n"
           "S_rect_00: 40 12\nR_rect_00: 1 0 0 0 1 0 0 0 1\n"
           "P_rect_00: 50 0 20 0 0 60 6 0 0 0 1 0\n"
           "S_01: 44 16\nK_01: 56 0 22 0 66 8 0 0 1\nD_01: -0.36 0.2 0.002 0.001 -0.07\n"
           "R_01: 1 0 0 0 1 0 0 0 1\nT_01: -0.5 0 0\n"
           "S_rect_01: 40 12\nR_rect_01: 1 0 0 0 1 0 0 0 1\n"
           "P_rect_01: 50 0 20 -25 0 60 6 0 0 0 1 0\n";
  }
};

}  // namespace sparsight::testing
