#include "drivers/datasets/kitti_raw_calibration.h"

#include <fmt/format.h>

#include "drivers/datasets/calibration_text.h"
#include "drivers/datasets/file_bytes.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

Result<CalibrationText> read_text(const fs::path& file) {
  auto bytes = read_file_bytes(file);
  if (!bytes && bytes.error().code == ErrorCode::kNotFound) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such file; it is in the day's calibration archive "
                            "(YYYY_MM_DD_calib.zip) and belongs beside the drive's folder",
                            file.string()));
  }
  return bytes.and_then(
      [&](const std::string& text) { return CalibrationText::parse(text, file.string()); });
}

// A rotation and a translation in fields of their own.
Result<Eigen::Isometry3d> transform_from(const CalibrationText& text, const std::string& rotation,
                                         const std::string& translation) {
  const auto R = text.rotation(rotation);
  if (!R) return tl::unexpected(R.error());
  const auto t = text.numbers(translation, 3);
  if (!t) return tl::unexpected(t.error());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = *R;
  T.translation() = Eigen::Map<const Eigen::Vector3d>(t->data());
  return T;
}

Result<RigCalibration> rectified(const CalibrationText& cameras, int camera,
                                 const Eigen::Isometry3d& T_camera_0_lidar) {
  const auto projection = rectified_camera(cameras, fmt::format("P_rect_{:02}", camera));
  if (!projection) return tl::unexpected(projection.error());
  const auto R_rect = cameras.rotation("R_rect_00");
  if (!R_rect) return tl::unexpected(R_rect.error());
  return RigCalibration{projection->intrinsics,
                        projection->T_camera_reference * *R_rect * T_camera_0_lidar};
}

Result<RigCalibration> as_taken(const CalibrationText& cameras, int camera,
                                const Eigen::Isometry3d& T_camera_0_lidar) {
  const std::string K_field = fmt::format("K_{:02}", camera);
  const auto K = cameras.numbers(K_field, 9);
  if (!K) return tl::unexpected(K.error());
  if ((*K)[0] <= 0 || (*K)[4] <= 0)
    return cameras.refuse(K_field, "its focal lengths must be positive");
  const auto D = cameras.numbers(fmt::format("D_{:02}", camera), 5);
  if (!D) return tl::unexpected(D.error());
  const auto T_camera_camera_0 =
      transform_from(cameras, fmt::format("R_{:02}", camera), fmt::format("T_{:02}", camera));
  if (!T_camera_camera_0) return tl::unexpected(T_camera_camera_0.error());
  RigCalibration calibration;
  calibration.camera = {0,       0,       (*K)[0], (*K)[4], (*K)[2], (*K)[5],
                        (*D)[0], (*D)[1], (*D)[2], (*D)[3], (*D)[4]};
  calibration.T_camera_lidar = *T_camera_camera_0 * T_camera_0_lidar;
  return calibration;
}

bool has_size(const CalibrationText& text, const std::string& field, ImageSize size) {
  const auto numbers = text.numbers(field, 2);
  return numbers && (*numbers)[0] == size.width && (*numbers)[1] == size.height;
}

bool images_are_as_taken(const fs::path& drive, const CalibrationText& cameras, int camera,
                         ImageSize size) {
  if (fs::absolute(drive).lexically_normal().string().find("_extract") != std::string::npos) {
    return true;
  }
  return has_size(cameras, fmt::format("S_{:02}", camera), size) &&
         !has_size(cameras, fmt::format("S_rect_{:02}", camera), size);
}

}  // namespace

Result<RigCalibration> read_kitti_raw_calibration(const fs::path& drive,
                                                  const ImageFolder& images) {
  const fs::path day = (fs::absolute(drive) / "..").lexically_normal();
  const auto cameras = read_text(day / "calib_cam_to_cam.txt");
  if (!cameras) return tl::unexpected(cameras.error());
  const auto lidar = read_text(day / "calib_velo_to_cam.txt");
  if (!lidar) return tl::unexpected(lidar.error());
  const auto T_camera_0_lidar = transform_from(*lidar, "R", "T");
  if (!T_camera_0_lidar) return tl::unexpected(T_camera_0_lidar.error());
  const auto size = image_size(images);
  if (!size) return tl::unexpected(size.error());
  auto calibration = images_are_as_taken(drive, *cameras, images.camera, *size)
                         ? as_taken(*cameras, images.camera, *T_camera_0_lidar)
                         : rectified(*cameras, images.camera, *T_camera_0_lidar);
  if (!calibration) return calibration;
  const auto intrinsics = with_image_size(calibration->camera, *size, cameras->file());
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  calibration->camera = *intrinsics;
  return calibration;
}

}  // namespace sparsight
