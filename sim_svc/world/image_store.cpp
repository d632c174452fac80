#include "sim_svc/world/image_store.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace roci::sim::world {

void ImageStore::add(Image image) {
  std::erase(sent_, image.id);
  changed_.insert(image.id);
  images_.insert_or_assign(image.id, std::move(image));
}

bool ImageStore::has_room_for(const std::string& id) const {
  const Image* const earlier = find(id);
  return images_.size() - sent_.size() < kStored || (earlier != nullptr && !earlier->sent);
}

const Image* ImageStore::find(const std::string& id) const {
  const auto found = images_.find(id);
  return found == images_.end() ? nullptr : &found->second;
}

std::optional<Image> ImageStore::set_sent(const std::string& id) {
  const auto found = images_.find(id);
  if (found == images_.end()) return std::nullopt;
  Image& image = found->second;
  if (!std::exchange(image.sent, true)) sent_.push_back(id);
  changed_.insert(id);
  std::vector<std::uint8_t> picture = std::exchange(image.preview, std::vector<std::uint8_t>());
  Image out = image;
  out.preview = std::move(picture);
  forget_oldest_sent();
  return out;
}

void ImageStore::forget_oldest_sent() {
  for (; sent_.size() > kSent; sent_.pop_front()) {
    changed_.insert(sent_.front());
    images_.erase(sent_.front());
  }
}

void ImageStore::note_missing(const std::string& id) {
  changed_.insert(id);
  missing_.insert(id);
}

std::vector<ImageStore::Change> ImageStore::take_changes() {
  std::vector<Change> out;
  const auto missing = std::exchange(missing_, {});
  for (const std::string& id : std::exchange(changed_, {})) {
    const Image* const image = find(id);
    const State absent = missing.contains(id) ? State::missing : State::forgotten;
    out.push_back({id, image == nullptr ? absent : image->sent ? State::sent : State::stored});
  }
  return out;
}

void ImageStore::restore(std::map<std::string, Image> images) {
  images_ = std::move(images);
  std::vector<const Image*> sent;
  for (const auto& [id, image] : images_) {
    changed_.insert(id);
    if (image.sent) sent.push_back(&image);
  }
  std::ranges::sort(sent, {}, [](const Image* image) { return std::tie(image->taken, image->id); });
  sent_.clear();
  for (const Image* image : sent) sent_.push_back(image->id);
  forget_oldest_sent();
}

}  // namespace roci::sim::world
