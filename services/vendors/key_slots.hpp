// Key slots stand for the keys of received samples toward Fast DDS. Its readers keep each instance whose writer went
// without a word for as long as they live, some 300 bytes, and each that a living writer has begun; their own limit
// stops the topic (docs/resilience.md, "What is bounded"). So a reader is shown slots, of which there are few, in the
// place of key hashes, which are as many as somebody likes.
#pragma once

#include <array>
#include <cstdint>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "services/vendors/instance_table.hpp"

namespace roci::services::vendors {

/// Gives each key hash a slot. A slot that readers hold is that key's for as long; one that nobody holds any more, or
/// not yet, goes to a new key when so many others were given later that what was received under it has been taken.
/// There is one of these for all topics of a participant, since a reader meets the slots of its own topic only. Any
/// thread may call it.
class KeySlots {
 public:
  using KeyHash = std::array<std::uint8_t, 16>;
  using Handle = std::array<std::uint8_t, 16>;  ///< names a slot in the place of a key hash

  /// So many slots that nobody holds wait before the first of them is given anew.
  static constexpr std::size_t kIdle = 4'096;
  static constexpr std::size_t kHeld = InstanceTable::kInstances;  ///< as many as one topic follows
  static constexpr std::size_t kSlots = kHeld + kIdle;

  /// Returns the slot of this key; it always finds one.
  Handle handle_of(const KeyHash&);

  /// Takes in that a reader follows the instance that it knows by this handle. Returns whether the slot is held now:
  /// with kHeld of them, no other is. A handle that names no slot is refused.
  bool hold(std::string_view handle);
  /// Takes in that a reader follows it no longer, for each time that it was held.
  void release(std::string_view handle);

  std::size_t held() const;

 private:
  using Index = std::uint32_t;
  struct Slot {
    KeyHash key{};
    std::size_t holders = 0;
    std::list<Index>::iterator place;  // in idle_, or in held_
  };

  Index give(const KeyHash&);
  std::optional<Index> index_of(std::string_view handle) const;

  mutable std::mutex mutex_;
  std::vector<Slot> slots_;
  std::list<Index> idle_;  // the one that was met longest ago is the first
  std::list<Index> held_;
  std::map<KeyHash, Index> of_key_;  // ordered, since whoever sends samples chooses their hashes
};

}  // namespace roci::services::vendors
