#include "drivers/datasets/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace sparsight {
namespace {

std::uint8_t luma(int red, int green, int blue) {
  // ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B, in 1/65536.
  return static_cast<std::uint8_t>((19595 * red + 38470 * green + 7471 * blue + 32768) >> 16);
}

DecodedImage from_grey(const cv::Mat& mat) {
  DecodedImage image;
  image.grey.width = mat.cols;
  image.grey.height = mat.rows;
  image.grey.pixels.reserve(mat.total());
  for (int row = 0; row < mat.rows; ++row) {
    image.grey.pixels.insert(image.grey.pixels.end(), mat.ptr(row), mat.ptr(row) + mat.cols);
  }
  return image;
}

DecodedImage from_color(const cv::Mat& mat) {
  DecodedImage image;
  image.grey = {mat.cols, mat.rows, std::vector<std::uint8_t>(mat.total())};
  image.color = ColorImage{mat.cols, mat.rows, std::vector<std::uint8_t>(3 * mat.total())};
  const auto channels = static_cast<std::size_t>(mat.channels());
  std::uint8_t* grey = image.grey.pixels.data();
  std::uint8_t* rgb = image.color->rgb.data();
  for (int row = 0; row < mat.rows; ++row) {
    const std::uint8_t* bgr = mat.ptr(row);
    for (int column = 0; column < mat.cols; ++column, bgr += channels, rgb += 3) {
      rgb[0] = bgr[2];
      rgb[1] = bgr[1];
      rgb[2] = bgr[0];
      *grey++ = luma(rgb[0], rgb[1], rgb[2]);
    }
  }
  return image;
}

// Both formats end with a mark of their own. Decoders fill what a truncated file lacks with grey
// (libjpeg), or complain to the terminal (libpng).
bool is_truncated(std::string_view bytes) {
  constexpr std::size_t kPadding = 1024;  // that some writers add after the end
  const std::string_view tail = bytes.substr(bytes.size() - std::min(bytes.size(), kPadding));
  if (bytes.starts_with("\x89PNG")) return tail.find("IEND") == std::string_view::npos;
  if (bytes.starts_with("\xFF\xD8")) return tail.find("\xFF\xD9") == std::string_view::npos;
  return false;
}

cv::Mat decode(std::string_view bytes) {
  // OpenCV asks for a mutable buffer, and does not write to it.
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
  try {
    return cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

cv::Mat to_8_bits(const cv::Mat& mat) {
  if (mat.depth() != CV_16U) return mat;
  cv::Mat upper(mat.rows, mat.cols, CV_MAKETYPE(CV_8U, mat.channels()));
  const int values = mat.cols * mat.channels();
  for (int row = 0; row < mat.rows; ++row) {
    for (int i = 0; i < values; ++i) {
      upper.ptr(row)[i] = static_cast<std::uint8_t>(mat.ptr<std::uint16_t>(row)[i] >> 8);
    }
  }
  return upper;
}

}  // namespace

Result<DecodedImage> decode_image(std::string_view bytes, const std::string& file) {
  const cv::Mat stored = bytes.empty() || is_truncated(bytes) ? cv::Mat() : decode(bytes);
  if (stored.empty()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: not a readable PNG or JPEG image; it may be truncated", file));
  }
  const cv::Mat mat = to_8_bits(stored);
  if (mat.depth() != CV_8U || mat.channels() == 2) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: expected an image of 8 or 16 bits, grey or colour", file));
  }
  return mat.channels() == 1 ? from_grey(mat) : from_color(mat);
}

}  // namespace sparsight
