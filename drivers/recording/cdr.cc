#include "drivers/recording/cdr.h"

#include <algorithm>
#include <array>

namespace sparsight {
namespace {

constexpr std::array<std::uint8_t, 4> kEncapsulation{0x00, 0x01, 0x00, 0x00};  // CDR_LE, no options

std::size_t padding(std::size_t position, std::size_t size) {
  return (size - position % size) % size;
}

}  // namespace

CdrWriter::CdrWriter(std::vector<std::uint8_t>& out)
    : out_(out), writer_(out), origin_(out.size() + kEncapsulation.size()) {
  writer_.bytes(kEncapsulation);
}

void CdrWriter::align(std::size_t size) {
  out_.resize(out_.size() + padding(out_.size() - origin_, size));
}

void CdrWriter::text(std::string_view text) {
  length(text.size() + 1);
  writer_.bytes(bytes_of(text));
  writer_.number(std::uint8_t{0});
}

void CdrWriter::sequence(Bytes bytes) {
  length(bytes.size());
  writer_.bytes(bytes);
}

CdrReader::CdrReader(Bytes message) : reader_(message) {
  const Bytes header = reader_.take(kEncapsulation.size());
  little_endian_ = reader_.ok() && header[0] == kEncapsulation[0] && header[1] == kEncapsulation[1];
  size_ = reader_.left();
}

void CdrReader::align(std::size_t size) { reader_.take(padding(size_ - reader_.left(), size)); }

std::string_view CdrReader::text() {
  const std::string_view text = text_of(sequence());
  return text.substr(0, text.find('\0'));
}

}  // namespace sparsight
