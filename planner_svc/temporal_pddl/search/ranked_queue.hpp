// A ranked queue holds items by rank, the best first; among equally good ones both the oldest and the
// youngest are at hand.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace roci::planner::temporal_pddl::search {

/// Holds a rank; lower is better.
struct Priority {
  std::int64_t first = 0;
  std::int64_t second = 0;
  auto operator<=>(const Priority&) const = default;
};

/// Keeps one chain of items for each rank; their links lie in one vector and are used again. Item is a small
/// plain value.
template <typename Item>
class RankedQueue {
 public:
  void push(Priority priority, const Item& item) {
    const auto [place, fresh] = chains_.try_emplace(priority);
    Chain& chain = place->second;
    const std::uint32_t link = make_link({item, chain.youngest, kNone});
    (fresh ? chain.oldest : links_[chain.youngest].younger) = link;
    chain.youngest = link;
  }
  bool empty() const { return chains_.empty(); }
  /// Returns one of the best items of a queue that is not empty.
  Item& oldest() { return links_[chains_.begin()->second.oldest].item; }
  Item& youngest() { return links_[chains_.begin()->second.youngest].item; }
  void drop_oldest() {
    Chain& chain = chains_.begin()->second;
    const std::uint32_t dropped = chain.oldest;
    chain.oldest = links_[dropped].younger;
    if (chain.oldest != kNone) links_[chain.oldest].older = kNone;
    forget(dropped, chain.oldest == kNone);
  }
  void drop_youngest() {
    Chain& chain = chains_.begin()->second;
    const std::uint32_t dropped = chain.youngest;
    chain.youngest = links_[dropped].older;
    if (chain.youngest != kNone) links_[chain.youngest].younger = kNone;
    forget(dropped, chain.youngest == kNone);
  }
  std::size_t bytes() const { return links_.capacity() * sizeof(Link) + chains_.size() * kChainBytes; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Chain {
    std::uint32_t oldest = kNone;
    std::uint32_t youngest = kNone;
  };
  struct Link {
    Item item;
    std::uint32_t older, younger;  // of the same rank, or the next unused link
  };
  // Counts the map's own pointers and the allocator's share too.
  static constexpr std::size_t kChainBytes = sizeof(std::pair<const Priority, Chain>) + 5 * sizeof(void*);

  std::uint32_t make_link(const Link& link) {
    if (unused_ == kNone) {
      links_.push_back(link);
      return static_cast<std::uint32_t>(links_.size() - 1);
    }
    const std::uint32_t place = unused_;
    unused_ = links_[place].younger;
    links_[place] = link;
    return place;
  }
  void forget(std::uint32_t link, bool last) {
    links_[link].younger = unused_;
    unused_ = link;
    if (last) chains_.erase(chains_.begin());
  }

  std::map<Priority, Chain> chains_;
  std::vector<Link> links_;
  std::uint32_t unused_ = kNone;
};

}  // namespace roci::planner::temporal_pddl::search
