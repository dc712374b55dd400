#include "drivers/recording/message_schemas.h"

#include <algorithm>
#include <array>
#include <vector>

namespace sparsight {
namespace {

struct Definition {
  std::string_view type;
  std::string_view text;
};

// Fields of the ROS types as ROS 2 (Humble to Rolling) defines them; comments left out.
constexpr Definition kDefinitions[] = {
    {"builtin_interfaces/msg/Time", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/msg/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"geometry_msgs/msg/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/msg/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/msg/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"geometry_msgs/msg/Pose",
     "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/msg/Transform",
     "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/msg/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {message_type::kPoseStamped, "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {message_type::kTransforms, "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/msg/RegionOfInterest",
     "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    {message_type::kCameraInfo,
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
     "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\n"
     "uint32 binning_y\nsensor_msgs/RegionOfInterest roi\n"},
    {message_type::kImage,
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\n"
     "uint8 is_bigendian\nuint32 step\nuint8[] data\n"},
    {message_type::kCompressedImage, "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"velodyne_msgs/msg/VelodynePacket", "builtin_interfaces/Time stamp\nuint8[1206] data\n"},
    {message_type::kVelodyneScan,
     "std_msgs/Header header\nvelodyne_msgs/VelodynePacket[] packets\n"},
    {message_type::kCameraFrameInfo,
     "# What the driver knew of the image with the same log time. Times: CLOCK_MONOTONIC, ns.\n"
     "uint8 GREY8=0\nuint8 GREY10=1\nuint8 GREY12=2\nuint8 GREY16=3\nuint8 BAYER_RGGB8=4\n"
     "uint8 BAYER_GRBG8=5\nuint8 BAYER_GBRG8=6\nuint8 BAYER_BGGR8=7\nuint8 YUYV=8\n"
     "uint8 UYVY=9\nuint8 NV12=10\nuint8 MJPEG=11\n"
     "uint32 sequence  # the driver's count; a gap is frames lost before they reached us\n"
     "uint32 epoch  # counts restarts of streaming\n"
     "int64 driver_time\nint64 arrival\nint64 exposure  # duration; 0 where it is not known\n"
     "bool damaged  # the driver's error flag, or fewer bytes than the format needs\n"
     "uint8 format\nint32 width\nint32 height\nint32 stride_bytes\n"},
    {message_type::kEdge,
     "uint8 EXPOSURE=0\nuint8 PPS=1\nuint8 line\nbool rising\n"
     "int64 time  # CLOCK_MONOTONIC, ns\n"},
    {message_type::kPositionPacket,
     "int64 arrival  # CLOCK_MONOTONIC, ns\n"
     "uint8[512] payload  # as received: VLP-16 manual 63-9243, position packet\n"},
    {message_type::kDeviceState,
     "uint8 CAMERA=0\nuint8 LIDAR=1\nuint8 TRIGGER=2\nuint8 STOPPED=0\nuint8 STREAMING=1\n"
     "uint8 SILENT=2\nuint8 GONE=3\nuint8 ENDED=4\nuint8 device\nuint8 state\n"
     "int64 at  # CLOCK_MONOTONIC, ns\n"},
    {message_type::kSyncState,
     "# When a frame was exposed and how the LiDAR's clock maps to the host's. Times: "
     "CLOCK_MONOTONIC, ns.\n"
     "uint8 ARRIVAL=0\nuint8 ESTIMATED=1\nuint8 MEASURED=2\n"
     "uint32 frame_sequence\nuint32 frame_epoch\nint64 exposure_middle\n"
     "int64 exposure_uncertainty\nuint8 exposure_quality\n"
     "bool lidar_clock_known\nint64 lidar_offset  # host time = sensor time + this\n"
     "float64 lidar_drift_ppm\nint64 lidar_uncertainty\nuint32 lidar_epoch\n"
     "uint8 lidar_quality\n"},
};

std::string_view text_of_type(std::string_view type) {
  const auto* const found = std::ranges::find(kDefinitions, type, &Definition::type);
  return found == std::end(kDefinitions) ? std::string_view{} : found->text;
}

// "std_msgs/Header" in a definition means "std_msgs/msg/Header".
std::string full_name(std::string_view name) {
  const std::size_t slash = name.find('/');
  return std::string(name.substr(0, slash)) + "/msg" + std::string(name.substr(slash));
}

// Adds every type named in a definition behind it, each once, those it contains after it.
void collect(std::string_view text, std::vector<std::string_view>& names) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::string_view name = line.substr(0, line.find_first_of(" ["));
    if (line.starts_with('#') || name.find('/') == std::string_view::npos) continue;
    if (std::ranges::find(names, name) != names.end()) continue;
    names.push_back(name);
    collect(text_of_type(full_name(name)), names);
  }
}

}  // namespace

std::string schema_text(std::string_view type) {
  std::string text(text_of_type(type));
  std::vector<std::string_view> names;
  collect(text_of_type(type), names);
  for (const std::string_view name : names) {
    text += std::string(80, '=') + "\nMSG: " + std::string(name) + '\n';
    text += text_of_type(full_name(name));
  }
  return text;
}

}  // namespace sparsight
