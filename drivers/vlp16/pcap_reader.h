#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "drivers/vlp16/udp_datagram.h"
#include "hal/result.h"

struct pcap;

namespace sparsight {

struct CapturedDatagram {
  std::chrono::nanoseconds captured{0};  // since 1970, by the clock of the machine that captured
  UdpDatagram datagram;                  // valid until the next one is read
};

// UDP datagrams of a capture file: pcap with stamps in microseconds or nanoseconds, or pcapng, of
// an Ethernet interface. Thread-bound.
class PcapReader {
 public:
  static Result<PcapReader> open(const std::filesystem::path& file);
  // `bytes` must outlive the reader; `name` is for error messages.
  static Result<PcapReader> read(std::span<const std::uint8_t> bytes, const std::string& name);

  // Nothing after the last; other traffic is passed over.
  std::optional<CapturedDatagram> next();
  // Truncated records and fragments.
  std::uint64_t refused() const { return refused_; }
  // What is wrong with the file where it could not be read on; empty if it ended well.
  const std::string& damage() const { return damage_; }

 private:
  struct Close {
    void operator()(pcap* handle) const;
  };
  explicit PcapReader(pcap* handle) : handle_(handle) {}
  static Result<PcapReader> from_stream(std::FILE* stream, const std::string& name);

  std::unique_ptr<pcap, Close> handle_;
  std::uint64_t refused_ = 0;
  std::string damage_;
};

}  // namespace sparsight
