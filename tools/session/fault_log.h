#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hal/result.h"

namespace sparsight {

// Faults of a session by kind: all are counted, the first ones are kept word for word.
class FaultLog {
 public:
  struct Entry {
    std::uint64_t sequence;
    Error error;
  };

  // True for the first of its kind.
  bool add(std::uint64_t sequence, const Error& error);

  std::size_t count() const { return count_; }
  const std::map<std::string, std::size_t>& count_by_kind() const { return count_by_kind_; }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  static constexpr std::size_t kMaxEntries = 200;
  std::size_t count_ = 0;
  std::map<std::string, std::size_t> count_by_kind_;
  std::vector<Entry> entries_;
};

const char* name_of(ErrorCode code);

}  // namespace sparsight
