#include "drivers/vlp16/sensor_web.h"

#include <fmt/format.h>
#include <httplib.h>

#include <cmath>
#include <csignal>
#include <ctime>
#include <utility>

#include "drivers/vlp16/sensor_web_json.h"

namespace sparsight {
namespace {

// The longest answer of a sensor, its diagnostics, has some two thousand characters.
constexpr std::size_t kMaxAnswer = 64 * 1024;

// The library writes to sockets without MSG_NOSIGNAL: a sensor that restarts would end the program.
class BlockedSigpipe {
 public:
  BlockedSigpipe() {
    sigemptyset(&sigpipe_);
    sigaddset(&sigpipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &sigpipe_, &before_);
  }
  ~BlockedSigpipe() {
    const std::timespec no_wait{};
    if (!was_pending_) sigtimedwait(&sigpipe_, nullptr, &no_wait);
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  BlockedSigpipe(const BlockedSigpipe&) = delete;
  BlockedSigpipe& operator=(const BlockedSigpipe&) = delete;

 private:
  sigset_t sigpipe_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

httplib::Client client_of(const std::string& address, const SensorWebOptions& options) {
  httplib::Client client(address, options.port);
  client.set_connection_timeout(options.timeout);
  client.set_read_timeout(options.timeout);
  client.set_write_timeout(options.timeout);
  return client;
}

Error unreachable(const std::string& url, const httplib::Result& result) {
  return {ErrorCode::kUnreadable,
          fmt::format("{}: the LiDAR's web interface does not answer ({}); is the sensor powered, "
                      "and on this network? It scans without, but cannot be set",
                      url, httplib::to_string(result.error()))};
}

Error refused(const std::string& url, int status) {
  return {ErrorCode::kUnreadable,
          fmt::format("{}: the LiDAR's web interface answers HTTP status {}", url, status)};
}

}  // namespace

SensorWeb::SensorWeb(std::string address, const SensorWebOptions& options)
    : address_(std::move(address)), options_(options) {}

std::string SensorWeb::url(const std::string& path) const {
  return fmt::format("http://{}:{}{}", address_, options_.port, path);
}

Result<std::string> SensorWeb::get(const std::string& path) const {
  const BlockedSigpipe blocked;
  httplib::Client client = client_of(address_, options_);
  const auto deadline = std::chrono::steady_clock::now() + options_.timeout;
  std::string body;
  // The library's timeouts are of every single read: an answer that trickles in would never end.
  const auto result = client.Get(path, [&](const char* data, std::size_t size) {
    if (body.size() + size > kMaxAnswer) return false;
    body.append(data, size);
    return std::chrono::steady_clock::now() < deadline;
  });
  if (!result && result.error() == httplib::Error::Canceled) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: the answer is too long or too slow for a LiDAR's", url(path)));
  }
  if (!result) return tl::make_unexpected(unreachable(url(path), result));
  if (result->status != 200) return tl::make_unexpected(refused(url(path), result->status));
  return body;
}

Result<void> SensorWeb::post(const std::string& path, const std::string& form) const {
  const BlockedSigpipe blocked;
  httplib::Client client = client_of(address_, options_);
  const auto result = client.Post(path, form, "application/x-www-form-urlencoded");
  if (!result) return tl::make_unexpected(unreachable(url(path), result));
  // 200, or 204 of newer firmware.
  if (result->status < 200 || result->status > 299) {
    return tl::make_unexpected(refused(url(path), result->status));
  }
  return {};
}

Result<SensorSettings> SensorWeb::settings() const {
  const std::string path = "/cgi/settings.json";
  return get(path).and_then(
      [&](const std::string& body) { return parse_sensor_settings(body, url(path)); });
}

Result<SensorStatus> SensorWeb::status() const {
  const std::string path = "/cgi/status.json";
  return get(path).and_then(
      [&](const std::string& body) { return parse_sensor_status(body, url(path)); });
}

Result<SensorDiagnostics> SensorWeb::diagnostics() const {
  const std::string path = "/cgi/diag.json";
  return get(path).and_then(
      [&](const std::string& body) { return parse_sensor_diagnostics(body, url(path)); });
}

}  // namespace sparsight
