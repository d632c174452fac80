#include "services/vendors/key_slots.hpp"

#include <algorithm>

namespace roci::services::vendors {
namespace {

constexpr std::string_view kMark = "key in slot:";  // with the index behind it, a handle

KeySlots::Handle to_handle(std::uint32_t index) {
  static_assert(kMark.size() + 4 == std::tuple_size_v<KeySlots::Handle>);
  KeySlots::Handle handle;
  std::copy(kMark.begin(), kMark.end(), handle.begin());
  for (std::size_t i = 0; i < 4; ++i)
    handle[kMark.size() + i] = static_cast<std::uint8_t>(index >> (24 - 8 * i));
  return handle;
}

}  // namespace

KeySlots::Handle KeySlots::handle_of(const KeyHash& key) {
  const std::lock_guard lock(mutex_);
  const auto known = of_key_.find(key);
  if (known == of_key_.end()) return to_handle(give(key));
  const Slot& slot = slots_[known->second];
  if (slot.holders == 0) idle_.splice(idle_.end(), idle_, slot.place);
  return to_handle(known->second);
}

KeySlots::Index KeySlots::give(const KeyHash& key) {
  if (idle_.size() < kIdle) {
    slots_.emplace_back();
    idle_.push_back(static_cast<Index>(slots_.size() - 1));
  } else {
    of_key_.erase(slots_[idle_.front()].key);
    idle_.splice(idle_.end(), idle_, idle_.begin());
  }
  const Index index = idle_.back();
  slots_[index].key = key;
  slots_[index].place = std::prev(idle_.end());
  of_key_[key] = index;
  return index;
}

bool KeySlots::hold(std::string_view handle) {
  const std::lock_guard lock(mutex_);
  const auto index = index_of(handle);
  if (!index) return false;
  Slot& slot = slots_[*index];
  if (slot.holders == 0) {
    if (held_.size() >= kHeld) return false;
    held_.splice(held_.end(), idle_, slot.place);
  }
  ++slot.holders;
  return true;
}

void KeySlots::release(std::string_view handle) {
  const std::lock_guard lock(mutex_);
  const auto index = index_of(handle);
  if (!index || slots_[*index].holders == 0) return;
  if (--slots_[*index].holders == 0) idle_.splice(idle_.end(), held_, slots_[*index].place);
}

std::size_t KeySlots::held() const {
  const std::lock_guard lock(mutex_);
  return held_.size();
}

std::optional<KeySlots::Index> KeySlots::index_of(std::string_view handle) const {
  if (handle.size() != kMark.size() + 4 || !handle.starts_with(kMark)) return std::nullopt;
  Index index = 0;
  for (const char byte : handle.substr(kMark.size())) index = index << 8 | static_cast<std::uint8_t>(byte);
  return index < slots_.size() ? std::optional(index) : std::nullopt;
}

}  // namespace roci::services::vendors
