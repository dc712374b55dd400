#include "drivers/recording/cdr.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <variant>
#include <vector>

namespace sparsight {
namespace {

using CdrValue =
    std::variant<std::uint8_t, std::uint16_t, std::uint32_t, std::uint64_t, std::int32_t,
                 std::int64_t, double, bool, std::string, std::vector<std::uint8_t>>;

CdrValue any_cdr_value() {
  switch (*rc::gen::inRange(0, 10)) {
    case 0:
      return *rc::gen::arbitrary<std::uint8_t>();
    case 1:
      return *rc::gen::arbitrary<std::uint16_t>();
    case 2:
      return *rc::gen::arbitrary<std::uint32_t>();
    case 3:
      return *rc::gen::arbitrary<std::uint64_t>();
    case 4:
      return *rc::gen::arbitrary<std::int32_t>();
    case 5:
      return *rc::gen::arbitrary<std::int64_t>();
    case 6:
      return *rc::gen::arbitrary<double>();
    case 7:
      return *rc::gen::arbitrary<bool>();
    case 8:
      return *rc::gen::container<std::string>(rc::gen::inRange('a', 'z'));
    default:
      return *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  }
}

struct WriteCdr {
  CdrWriter& writer;
  void operator()(bool value) const { writer.boolean(value); }
  void operator()(const std::string& value) const { writer.text(value); }
  void operator()(const std::vector<std::uint8_t>& value) const { writer.sequence(value); }
  template <typename T>
  void operator()(T value) const {
    writer.number(value);
  }
};

struct ReadCdr {  // true if what is read is what was written
  CdrReader& reader;
  bool operator()(bool value) const { return reader.boolean() == value; }
  bool operator()(const std::string& value) const { return reader.text() == value; }
  bool operator()(const std::vector<std::uint8_t>& value) const {
    const Bytes bytes = reader.sequence();
    return std::vector<std::uint8_t>(bytes.begin(), bytes.end()) == value;
  }
  template <typename T>
  bool operator()(T value) const {
    return reader.number<T>() == value;
  }
};

std::vector<std::uint8_t> cdr_bytes(const std::vector<CdrValue>& values) {
  std::vector<std::uint8_t> out{7, 7, 7};  // alignment counts from the message, not the buffer
  CdrWriter writer(out);
  for (const CdrValue& value : values) std::visit(WriteCdr{writer}, value);
  return {out.begin() + 3, out.end()};
}

RC_GTEST_PROP(Cdr, IsWhatFastCdrWrites, ()) {
  std::vector<CdrValue> values;
  for (int i = *rc::gen::inRange(0, 30); i > 0; --i) values.push_back(any_cdr_value());
  namespace fast = eprosima::fastcdr;
  std::vector<char> memory(1 << 16);  // zeroed: Fast CDR passes over padding, we write zeros
  fast::FastBuffer buffer(memory.data(), memory.size());
  fast::Cdr cdr(buffer, fast::Cdr::LITTLE_ENDIANNESS, fast::Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  for (const CdrValue& value : values) {
    std::visit([&](const auto& v) { cdr << v; }, value);
  }
  const auto size = static_cast<long>(cdr.getSerializedDataLength());
  RC_ASSERT(cdr_bytes(values) == std::vector<std::uint8_t>(memory.begin(), memory.begin() + size));
}

RC_GTEST_PROP(Cdr, IsReadBack, ()) {
  std::vector<CdrValue> values;
  for (int i = *rc::gen::inRange(1, 30); i > 0; --i) values.push_back(any_cdr_value());
  const std::vector<std::uint8_t> bytes = cdr_bytes(values);
  CdrReader reader(bytes);
  for (const CdrValue& value : values) RC_ASSERT(std::visit(ReadCdr{reader}, value));
  RC_ASSERT(reader.ok());
  const std::size_t cut = *rc::gen::inRange<std::size_t>(0, bytes.size());
  CdrReader short_reader(Bytes(bytes).first(cut));
  for (const CdrValue& value : values) std::visit(ReadCdr{short_reader}, value);
  RC_ASSERT(!short_reader.ok());
}

TEST(Cdr, RefusesOtherEncapsulations) {
  for (const std::uint8_t kind : std::vector<std::uint8_t>{0x00, 0x02, 0x03, 0x07}) {
    const std::vector<std::uint8_t> bytes{0x00, kind, 0x00, 0x00, 1, 2, 3, 4};
    EXPECT_FALSE(CdrReader(bytes).ok()) << int{kind};
  }
  EXPECT_FALSE(CdrReader({}).ok());
}

TEST(Cdr, BelievesNoLength) {
  const std::vector<std::uint8_t> bytes{0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff, 1, 2, 3};
  CdrReader reader(bytes);
  EXPECT_TRUE(reader.sequence().empty());
  EXPECT_FALSE(reader.ok());
  CdrReader text_reader(bytes);
  EXPECT_EQ(text_reader.text(), "");
  EXPECT_FALSE(text_reader.ok());
}

}  // namespace
}  // namespace sparsight
