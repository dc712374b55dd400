#include "tools/map/paged_keyframes.h"

#include <utility>

namespace sparsight {

void PagedKeyframes::take_over(std::vector<KeyframeFile> files, std::vector<Place> places) {
  files_ = std::move(files);
  places_ = std::move(places);
}

void PagedKeyframes::write_to(KeyframeFile file) {
  written_ = static_cast<std::uint32_t>(files_.size());
  files_.push_back(std::move(file));
}

std::size_t PagedKeyframes::put(const KeyframeBulk& bulk) {
  Place place;
  if (written_) {
    place.file = *written_;
    place.record = files_[*written_].append(bulk);
  }
  if (!place.record) {
    ++not_kept_;
    if (written_) message_ = files_[*written_].message();
  }
  places_.push_back(place);
  return places_.size() - 1;
}

std::optional<KeyframeBulk> PagedKeyframes::get(std::size_t number) {
  if (number >= places_.size() || !places_[number].record) return std::nullopt;
  const Place& place = places_[number];
  auto bulk = files_[place.file].read(*place.record);
  if (bulk) return std::move(*bulk);
  ++damaged_;
  message_ = bulk.error().message;
  return std::nullopt;
}

}  // namespace sparsight
