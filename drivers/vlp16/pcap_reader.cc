#include "drivers/vlp16/pcap_reader.h"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

namespace sparsight {
namespace {

// pcapng can name times that 64 bits of nanoseconds cannot: year 2242 is enough.
constexpr std::int64_t kMaxSeconds = std::int64_t{1} << 33;
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

// The reader was asked for nanoseconds; `tv_usec` then holds them.
std::optional<std::chrono::nanoseconds> stamp_of(const pcap_pkthdr& header) {
  const std::int64_t seconds = header.ts.tv_sec;
  const std::int64_t nanoseconds = header.ts.tv_usec;
  if (seconds < 0 || seconds > kMaxSeconds) return std::nullopt;
  if (nanoseconds < 0 || nanoseconds >= kNanosecondsPerSecond) return std::nullopt;
  return std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds);
}

}  // namespace

void PcapReader::Close::operator()(pcap* handle) const { pcap_close(handle); }

Result<PcapReader> PcapReader::open(const std::filesystem::path& file) {
  std::FILE* const stream = std::fopen(file.c_str(), "rb");
  if (stream == nullptr) {
    const int error = errno;
    return fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
                fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(error)));
  }
  return from_stream(stream, file.string());
}

Result<PcapReader> PcapReader::read(std::span<const std::uint8_t> bytes, const std::string& name) {
  std::FILE* const stream =
      bytes.empty() ? nullptr
                    // Opened for reading, so that the bytes are never written.
                    : fmemopen(const_cast<std::uint8_t*>(bytes.data()), bytes.size(), "rb");
  if (stream == nullptr) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: an empty capture file", name));
  }
  return from_stream(stream, name);
}

Result<PcapReader> PcapReader::from_stream(std::FILE* stream, const std::string& name) {
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  pcap_t* const handle =
      pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, error.data());
  if (handle == nullptr) {
    std::fclose(stream);
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: not a capture file: {}", name, error.data()));
  }
  PcapReader reader(handle);
  if (const int type = pcap_datalink(handle); type != DLT_EN10MB) {
    const char* const type_name = pcap_datalink_val_to_name(type);
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: link type {} is not Ethernet; capture on the LiDAR's interface "
                            "itself (tcpdump -i eth0), not on \"any\"",
                            name, type_name != nullptr ? type_name : std::to_string(type)));
  }
  return reader;
}

std::optional<CapturedDatagram> PcapReader::next() {
  pcap_pkthdr* header = nullptr;
  const u_char* bytes = nullptr;
  int status = 0;
  while ((status = pcap_next_ex(handle_.get(), &header, &bytes)) == 1) {
    const auto captured = stamp_of(*header);
    const auto datagram = udp_of_ethernet({bytes, header->caplen});
    if (captured && datagram) return CapturedDatagram{*captured, *datagram};
    if (!captured || datagram.error() != FrameFault::kOther) ++refused_;
  }
  if (status == PCAP_ERROR && damage_.empty()) {
    damage_ = pcap_geterr(handle_.get());
    ++refused_;
  }
  return std::nullopt;
}

}  // namespace sparsight
