#pragma once

#include <string_view>
#include <vector>

#include "drivers/recording/bytes.h"
#include "hal/calibration.h"
#include "hal/camera.h"

namespace sparsight {

// Each append_… adds one CDR message to the bytes; each read_… is false if the message is not
// sound.

// sensor_msgs/Image: the bytes as the camera gave them. `encoding` is ROS's name where it has one;
// Y10 and Y12 are "mono16" there, and CameraFrameInfo says how many bits count.
void append_image(const CameraFrame& frame, std::vector<std::uint8_t>& out);
std::string_view ros_encoding(PixelFormat format);

// sensor_msgs/CompressedImage, for kMjpeg.
void append_compressed_image(const CameraFrame& frame, std::vector<std::uint8_t>& out);

// sparsight_msgs/CameraFrameInfo: everything of the frame but its bytes.
void append_frame_info(const CameraFrame& frame, std::vector<std::uint8_t>& out);

// sensor_msgs/CameraInfo.
void append_camera_info(const CameraIntrinsics& camera, HostTime stamp,
                        std::vector<std::uint8_t>& out);

bool read_frame_info(Bytes message, CameraFrame& frame);

// Of an Image or CompressedImage that belongs to a frame info read before: the bytes only.
bool read_image_bytes(Bytes message, CameraFrame& frame);
bool read_compressed_bytes(Bytes message, CameraFrame& frame);

// Of an Image that came without frame info, written by other tools: what it says itself.
bool read_foreign_image(Bytes message, CameraFrame& frame);

}  // namespace sparsight
