#include "drivers/v4l2/format_agreement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/v4l2/fake_video.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;
using VideoFormat = testing::FakeVideo::Format;

constexpr VideoFormat kGrey{V4L2_PIX_FMT_GREY, 800, 600, 800, 480000};
constexpr VideoFormat kTwelve{V4L2_PIX_FMT_Y12, 800, 600, 1600, 960000};
constexpr VideoFormat kYuyv{V4L2_PIX_FMT_YUYV, 800, 600, 1600, 960000};
constexpr VideoFormat kBayer{V4L2_PIX_FMT_SBGGR8, 800, 600, 800, 480000};
constexpr VideoFormat kJpeg{V4L2_PIX_FMT_MJPEG, 800, 600, 0, 500000};
constexpr VideoFormat kUnknown{V4L2_PIX_FMT_RGB565, 800, 600, 2400, 1440000};

class FormatAgreementTest : public ::testing::Test {
 protected:
  Result<AgreedFormat> agree(std::vector<VideoFormat> offered) {
    video_.formats = std::move(offered);
    auto device = VideoDevice::open(video_, "/dev/video0");
    return agree_on_format(*device, config_);
  }
  PixelFormat chosen(std::vector<VideoFormat> offered) {
    const auto agreed = agree(std::move(offered));
    EXPECT_TRUE(agreed) << agreed.error().message;
    return agreed ? agreed->format : PixelFormat::kNv12;
  }
  std::string refusal(std::vector<VideoFormat> offered) {
    const auto agreed = agree(std::move(offered));
    return agreed ? "none" : agreed.error().message;
  }

  testing::FakeVideo video_;
  CameraConfig config_;
};

TEST_F(FormatAgreementTest, TakesTheFirstInTheOrderOfPixelFormatWhateverTheDriversOrder) {
  EXPECT_EQ(chosen({kUnknown, kJpeg, kYuyv, kTwelve, kGrey}), PixelFormat::kGrey8);
  EXPECT_EQ(chosen({kJpeg, kYuyv, kTwelve}), PixelFormat::kGrey12);
  EXPECT_EQ(chosen({kYuyv, kBayer}), PixelFormat::kBayerBggr8);
  EXPECT_EQ(chosen({kUnknown, kJpeg}), PixelFormat::kMjpeg);
}

TEST_F(FormatAgreementTest, TakesTheOneAskedForOrNone) {
  config_.format = "YUYV";
  EXPECT_EQ(chosen({kGrey, kYuyv}), PixelFormat::kYuyv);
  EXPECT_EQ(refusal({kGrey, kUnknown}),
            "/dev/video0: [camera] format = \"YUYV\" is not among what it offers (GREY, RGBP)");
}

TEST_F(FormatAgreementTest, PassesByAFormatThatComesAtAnotherSize) {
  EXPECT_EQ(chosen({{V4L2_PIX_FMT_GREY, 640, 480, 640, 307200}, kYuyv}), PixelFormat::kYuyv);
}

TEST_F(FormatAgreementTest, SaysWhyEachIsRefused) {
  EXPECT_THAT(refusal({{V4L2_PIX_FMT_GREY, 640, 480, 640, 307200},
                       {V4L2_PIX_FMT_YUYV, 800, 600, 800, 960000},
                       {V4L2_PIX_FMT_NV12, 800, 600, 800, 480000}}),
              HasSubstr("does not deliver 800x600: GREY comes at 640x480, YUYV has rows of 800 "
                        "bytes only, NV12 has buffers of 480000 bytes only"));
}

TEST_F(FormatAgreementTest, HonoursTheStrideAndFillsInOneThatIsNotGiven) {
  EXPECT_EQ(agree({{V4L2_PIX_FMT_GREY, 800, 600, 1024, 614400}})->stride_bytes, 1024);
  EXPECT_EQ(agree({{V4L2_PIX_FMT_Y10, 800, 600, 0, 960000}})->stride_bytes, 1600);
}

TEST_F(FormatAgreementTest, ReadsTheRateBack) {
  EXPECT_DOUBLE_EQ(agree({kGrey})->rate_hz, 30.0);
  config_.rate_hz = 29.97;
  EXPECT_DOUBLE_EQ(agree({kGrey})->rate_hz, 29.97);
}

TEST_F(FormatAgreementTest, RefusesALowerRateThanAskedFor) {
  video_.slowest_period = {1, 15};
  EXPECT_EQ(refusal({kYuyv}),
            "/dev/video0: gives 15 Hz as YUYV 800x600, not 30; set [camera] rate_hz or another "
            "format");
}

TEST_F(FormatAgreementTest, AcceptsARateThatIsSaidInOtherNumbersAndOneThatIsNotSaid) {
  video_.slowest_period = {1001, 30000};
  EXPECT_NEAR(agree({kGrey})->rate_hz, 29.97, 0.001);
  video_.keeps_rate = false;  // an externally triggered sensor
  EXPECT_EQ(agree({kGrey})->rate_hz, 0.0);
}

}  // namespace
}  // namespace sparsight
