#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "drivers/recording/byte_reader.h"
#include "drivers/recording/byte_writer.h"

namespace sparsight {

// The serialization of ROS 2 messages: CDR (OMG formal/02-06-51, 15.3) with the encapsulation
// header of DDS (OMG DDSI-RTPS 2.3, 10.2.1.2). Every number stands at a multiple of its size,
// counted from behind the header. By hand, as an image is to be copied once, straight into the
// chunk, and what a length claims must be checked before memory is taken; tests compare it with
// Fast CDR.

// Appends one message.
class CdrWriter {
 public:
  explicit CdrWriter(std::vector<std::uint8_t>& out);

  template <typename T>
  void number(T value) {
    align(sizeof(T));
    writer_.number(value);
  }
  void boolean(bool value) { writer_.number(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void text(std::string_view text);
  void array(Bytes bytes) { writer_.bytes(bytes); }  // of a fixed length: that is not written
  void sequence(Bytes bytes);
  void length(std::size_t count) { number(static_cast<std::uint32_t>(count)); }

 private:
  void align(std::size_t size);

  std::vector<std::uint8_t>& out_;
  ByteWriter writer_;
  const std::size_t origin_;
};

// Reads one message that nobody vouches for; as with ByteReader, read all and ask ok() once.
class CdrReader {
 public:
  explicit CdrReader(Bytes message);

  template <typename T>
  T number() {
    align(sizeof(T));
    return reader_.number<T>();
  }
  bool boolean() { return reader_.number<std::uint8_t>() != 0; }
  std::string_view text();
  Bytes array(std::size_t count) { return reader_.take(count); }
  Bytes sequence() { return reader_.take(number<std::uint32_t>()); }
  std::uint32_t length() { return number<std::uint32_t>(); }

  bool ok() const { return little_endian_ && reader_.ok(); }

 private:
  void align(std::size_t size);

  ByteReader reader_;
  bool little_endian_ = false;
  std::size_t size_ = 0;
};

}  // namespace sparsight
