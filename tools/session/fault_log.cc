#include "tools/session/fault_log.h"

namespace sparsight {

bool FaultLog::add(std::uint64_t sequence, const Error& error) {
  ++count_;
  if (entries_.size() < kMaxEntries) entries_.push_back({sequence, error});
  return ++count_by_kind_[name_of(error.code)] == 1;
}

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kNotFound:
      return "not found";
    case ErrorCode::kUnreadable:
      return "unreadable";
    case ErrorCode::kMalformed:
      return "malformed";
    case ErrorCode::kMissingField:
      return "missing field";
    case ErrorCode::kOutOfRange:
      return "out of range";
    case ErrorCode::kWrongSize:
      return "wrong size";
  }
  return "unknown";
}

}  // namespace sparsight
