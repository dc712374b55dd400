#include "drivers/vlp16/sensor_settings.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <cmath>
#include <mutex>
#include <thread>

#include "drivers/vlp16/sensor_web_json.h"

// A sensor's web interface in this process, well-behaved or not.
namespace sparsight {
namespace {

using namespace std::chrono_literals;

constexpr ReadBack kQuick{.pause = 2ms, .attempts = 3};

class FakeSensor {
 public:
  // `diagnostics` answers what the sensor itself has no answer for.
  explicit FakeSensor(const httplib::Server::Handler& diagnostics = nullptr) {
    if (diagnostics) server_.Get("/cgi/diag.json", diagnostics);
    server_.Get("/cgi/settings.json", [this](const httplib::Request&, httplib::Response& answer) {
      const std::lock_guard lock(mutex_);
      ++reads_;
      answer.set_content(settings_text(), "application/json");
    });
    server_.Get("/cgi/status.json", [](const httplib::Request&, httplib::Response& answer) {
      answer.set_content(R"({"gps": {"pps_state": "Locked", "position": "N 1"},
                             "motor": {"state": "On", "rpm": 599, "lock": "Off", "phase": 1},
                             "laser": {"state": "Off"}})",
                         "application/json");
    });
    server_.Post("/cgi/setting", [this](const httplib::Request& request, httplib::Response&) {
      const std::lock_guard lock(mutex_);
      posts_.push_back(request.body);
      if (obeys_ && request.has_param("rpm")) rpm_ = request.get_param_value("rpm");
      if (obeys_ && request.has_param("returns")) returns_ = request.get_param_value("returns");
    });
    server_.Post("/cgi/setting/phaselock",
                 [this](const httplib::Request& request, httplib::Response& answer) {
                   const std::lock_guard lock(mutex_);
                   posts_.push_back(request.body);
                   if (obeys_) enabled_ = request.get_param_value("enabled");
                   if (obeys_) offset_ = request.get_param_value("offset");
                   answer.status = 204;
                 });
    port_ = server_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    while (!server_.is_running()) std::this_thread::sleep_for(1ms);
  }
  ~FakeSensor() {
    server_.stop();
    thread_.join();
  }
  FakeSensor(const FakeSensor&) = delete;
  FakeSensor& operator=(const FakeSensor&) = delete;

  void disobey() { obeys_ = false; }
  SensorWeb web(std::chrono::milliseconds timeout = 2000ms) const {
    return SensorWeb("127.0.0.1", {.port = static_cast<std::uint16_t>(port_), .timeout = timeout});
  }
  std::vector<std::string> posts() const {
    const std::lock_guard lock(mutex_);
    return posts_;
  }
  int reads() const {
    const std::lock_guard lock(mutex_);
    return reads_;
  }

 private:
  std::string settings_text() const {
    return R"({"rpm": )" + rpm_ + R"(, "returns": ")" + returns_ +
           R"(", "laser": "on", "fov": {"start": 0, "end": 359},)" +
           R"( "phaselock": {"enabled": ")" + enabled_ + R"(", "offset": )" + offset_ + "}}";
  }
  httplib::Server server_;
  int port_ = 0;
  std::thread thread_;
  mutable std::mutex mutex_;
  bool obeys_ = true;
  int reads_ = 0;
  std::vector<std::string> posts_;
  std::string rpm_ = "600";
  std::string returns_ = "Strongest";
  std::string enabled_ = "off";
  std::string offset_ = "0";
};

LidarConfig asking_for(std::optional<int> rpm, std::optional<ReturnMode> mode,
                       std::optional<double> phase_lock_deg) {
  LidarConfig config;
  config.rpm = rpm;
  config.return_mode = mode;
  config.phase_lock_deg = phase_lock_deg;
  return config;
}

using Texts = std::vector<std::string>;

TEST(SensorSettings, PostsOnlyWhatDiffers) {
  const FakeSensor sensor;
  const auto changed =
      apply_sensor_settings(asking_for(600, ReturnMode::kLast, std::nullopt), sensor.web(), kQuick);
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(*changed, Texts{"returns=Last"});
  EXPECT_EQ(sensor.posts(), Texts{"returns=Last"});
}

TEST(SensorSettings, SetsEverythingThatIsAskedFor) {
  const FakeSensor sensor;
  const LidarConfig config = asking_for(1200, ReturnMode::kDual, 90.5);
  ASSERT_TRUE(apply_sensor_settings(config, sensor.web(), kQuick));
  // Hundredths of degrees.
  EXPECT_EQ(sensor.posts(), (Texts{"rpm=1200", "returns=Dual", "enabled=on&offset=9050"}));
  const auto again = apply_sensor_settings(config, sensor.web(), kQuick);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->empty()) << "nothing differs any more";
}

TEST(SensorSettings, LeavesASensorAloneThatNothingIsAskedOf) {
  const FakeSensor sensor;
  ASSERT_TRUE(apply_sensor_settings({}, sensor.web(), kQuick));
  EXPECT_EQ(sensor.reads(), 0);
  const SensorWeb nowhere("127.0.0.1", {.port = 1, .timeout = 100ms});
  EXPECT_TRUE(apply_sensor_settings({}, nowhere, kQuick));
}

TEST(SensorSettings, ReadsBackWhatWasAnsweredWith200) {
  FakeSensor sensor;
  sensor.disobey();
  const auto changed =
      apply_sensor_settings(asking_for(900, std::nullopt, std::nullopt), sensor.web(), kQuick);
  ASSERT_FALSE(changed);
  EXPECT_NE(changed.error().message.find("rpm=900"), std::string::npos);
  EXPECT_EQ(sensor.reads(), 4) << "before, and three times after";
}

TEST(SensorSettings, RefusesWhatTheSensorCannotDoBeforeAskingIt) {
  const FakeSensor sensor;
  for (const int rpm : {0, 240, 299, 610, 1260, -600}) {
    const auto changed =
        apply_sensor_settings(asking_for(rpm, std::nullopt, std::nullopt), sensor.web(), kQuick);
    ASSERT_FALSE(changed) << rpm;
    EXPECT_NE(changed.error().message.find("lidar.rpm"), std::string::npos);
  }
  for (const double degrees : {-1.0, 360.0, std::nan("")}) {
    const auto changed = apply_sensor_settings(asking_for(std::nullopt, std::nullopt, degrees),
                                               sensor.web(), kQuick);
    ASSERT_FALSE(changed) << degrees;
    EXPECT_NE(changed.error().message.find("lidar.phase_lock_deg"), std::string::npos);
  }
  EXPECT_EQ(sensor.reads(), 0);
}

TEST(SensorSettings, APhaseThatRoundsToAFullTurnIsNone) {
  const FakeSensor sensor;
  ASSERT_TRUE(
      apply_sensor_settings(asking_for(std::nullopt, std::nullopt, 359.999), sensor.web(), kQuick));
  EXPECT_EQ(sensor.posts(), Texts{"enabled=on&offset=0"});
}

TEST(SensorSettings, AnUnreachableSensorIsAClearError) {
  const SensorWeb web("127.0.0.1", {.port = 1, .timeout = 200ms});
  const auto changed =
      apply_sensor_settings(asking_for(600, std::nullopt, std::nullopt), web, kQuick);
  ASSERT_FALSE(changed);
  EXPECT_NE(changed.error().message.find("http://127.0.0.1:1/cgi/settings.json"),
            std::string::npos);
  EXPECT_NE(changed.error().message.find("does not answer"), std::string::npos);
}

TEST(SensorWeb, ReadsStatus) {
  const FakeSensor sensor;
  const auto status = sensor.web().status();
  ASSERT_TRUE(status) << status.error().message;
  EXPECT_EQ(status->pps, PpsState::kLocked);
  EXPECT_EQ(status->gps_position, "N 1");
  EXPECT_EQ(status->motor_on, true);
  EXPECT_EQ(status->motor_rpm, 599);
  EXPECT_EQ(status->laser_on, false);
}

TEST(SensorWeb, SaysSoWhenAnswersAreErrors) {
  const FakeSensor sensor;
  const auto missing = sensor.web().diagnostics();
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("404"), std::string::npos);
  EXPECT_FALSE(sensor.web().post("/cgi/nothing", "a=b"));
}

TEST(SensorWeb, SaysSoWhenAnswersAreNoJson) {
  const FakeSensor sensor([](const httplib::Request&, httplib::Response& answer) {
    answer.set_content("<html>login</html>", "text/html");
  });
  const auto html = sensor.web().diagnostics();
  ASSERT_FALSE(html);
  EXPECT_NE(html.error().message.find("JSON"), std::string::npos);
}

TEST(SensorWeb, GivesUpOnAnswersWithoutEnd) {
  const std::string block(10'000, ' ');  // outlives the sensor, which goes on sending it
  const FakeSensor sensor([&block](const httplib::Request&, httplib::Response& answer) {
    answer.set_chunked_content_provider("text/plain",
                                        [&block](std::size_t, httplib::DataSink& sink) {
                                          return sink.write(block.data(), block.size());
                                        });
  });
  const auto endless = sensor.web().diagnostics();
  ASSERT_FALSE(endless);
  EXPECT_NE(endless.error().message.find("too long or too slow"), std::string::npos);
}

TEST(SensorWeb, GivesUpOnAnswersThatTrickle) {
  const FakeSensor sensor([](const httplib::Request&, httplib::Response& answer) {
    answer.set_chunked_content_provider("text/plain", [](std::size_t, httplib::DataSink& sink) {
      std::this_thread::sleep_for(20ms);
      return sink.write(" ", 1);
    });
  });
  const auto before = std::chrono::steady_clock::now();
  EXPECT_FALSE(sensor.web(100ms).diagnostics());
  EXPECT_LT(std::chrono::steady_clock::now() - before, 2s);
}

TEST(SensorWebJson, TakesNumbersWrittenAsText) {
  const auto settings = parse_sensor_settings(
      R"({"rpm": "600", "returns": "dual", "laser": "Off",
          "phaselock": {"enabled": "On", "offset": "9000"}})",
      "here");
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->rpm, 600);
  EXPECT_EQ(settings->return_mode, ReturnMode::kDual);
  EXPECT_EQ(settings->laser_on, false);
  EXPECT_EQ(settings->phase_lock, true);
  EXPECT_EQ(settings->phase_lock_centideg, 9000);
}

TEST(SensorWebJson, LeavesOutWhatIsAbsentOrSenseless) {
  const auto settings = parse_sensor_settings(
      R"({"rpm": 1e300, "returns": "All", "laser": 3, "fov": 7, "phaselock": {"offset": "9x"}})",
      "here");
  ASSERT_TRUE(settings);
  EXPECT_FALSE(settings->rpm);
  EXPECT_FALSE(settings->return_mode);
  EXPECT_FALSE(settings->laser_on);
  EXPECT_FALSE(settings->view_start_deg);
  EXPECT_FALSE(settings->phase_lock);
  EXPECT_FALSE(settings->phase_lock_centideg);
}

TEST(SensorWebJson, RefusesWhatIsNoObject) {
  for (const char* const text : {"", "[]", "7", "{\"rpm\": ", "null"}) {
    const auto settings = parse_sensor_settings(text, "here");
    ASSERT_FALSE(settings) << text;
    EXPECT_EQ(settings.error().message.rfind("here: ", 0), 0U);
  }
}

TEST(SensorWebJson, PutsDiagnosticsInUnits) {
  // 1.3000 V, by the parabola of the LM20's data sheet; 1.8640 V, its zero; 2.5 V and 60 mV.
  const auto diagnostics = parse_sensor_diagnostics(
      R"({"volt_temp": {"top": {"lm20_temp": 1065}, "bot": {"lm20_temp": 1527, "i_out": 2097}}})",
      "here");
  ASSERT_TRUE(diagnostics);
  EXPECT_NEAR(*diagnostics->top_temperature_c, 48.24, 0.01);
  EXPECT_NEAR(*diagnostics->bottom_temperature_c, 0.0, 0.02);
  EXPECT_NEAR(*diagnostics->current_a, 0.598, 0.001);
}

}  // namespace
}  // namespace sparsight
