// Due instances are those that a Fast DDS writer is to forget, until it may. This is pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "services/transport/transport.hpp"

namespace roci::services::vendors {

/// Says what to write so that finished instances go. When a change that unregisters an instance is confirmed by all,
/// Fast DDS 2.9 walks its history down from the newest change, takes out all that the instance has, and goes on at the
/// same place of what is left (docs/dds.md, report 7). This class says what to write so that the walk ends and misses
/// nothing:
/// - only while every reader has confirmed everything, so that no change but what follows is walked;
/// - one instance is kept for ever: its changes are older than all that is walked, and the walk ends at them;
/// - of several instances with older changes, the newest is followed by as many changes of the kept one as an
///   instance has, so that there is something left at the place where the walk goes on.
/// Where a history keeps one sample of an instance, or none that is confirmed, nothing older is taken out with it: none
/// of this is needed but the first.
class DueInstances {
 public:
  using Key = std::string;  ///< the vendor's hash

  struct Instance {
    Key key;
    transport::Payload payload;  ///< key only
  };
  struct Group {
    std::vector<Instance> unregistered;  ///< in this order
    std::optional<Instance> kept;        ///< to be disposed `times` after them
    int times = 0;
  };

  /// Takes how many changes of an instance stay that all readers have confirmed (`depth`; 0: none).
  explicit DueInstances(int depth) : depth_(depth) {}

  /// Takes in that the history has a further change of the instance, which is to be forgotten no longer.
  void changed(const Key&);
  /// Takes in that the instance is to be forgotten. Returns false if it is the one that is kept, which must be
  /// disposed now.
  bool forget(Instance);
  std::size_t waiting() const { return due_.size(); }
  /// Returns what to write now that everything is confirmed; nothing of it waits any longer.
  Group take();

 private:
  bool leaves_older_changes() const { return depth_ > 1; }

  int depth_;
  std::vector<Instance> waiting_;  // the oldest first, and some that are not due any more
  std::unordered_set<Key> due_;    // of these
  // Of each instance, as far as others can be older; empty unless they matter.
  std::unordered_map<Key, int> changes_;
  std::optional<Instance> kept_;
};

}  // namespace roci::services::vendors
