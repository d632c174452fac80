#include "planner_svc/utility_htn/search/node_store.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/pseudorandom/split_mix.hpp"

namespace roci::planner::utility_htn::search {

using temporal::RankVector, temporal::Time;
using temporal::timelines::Timelines;

namespace {

std::uint64_t mixed(std::uint64_t bits) { return pseudorandom::SplitMix64(bits).next(); }

std::uint64_t key_of(const Placed& placed) {
  std::uint64_t key = mixed(placed.chain);
  for (const Time start : placed.starts) key = mixed(key ^ static_cast<std::uint64_t>(start.count()));
  return key;
}

void sort(std::vector<Placed>& chains) {
  std::ranges::sort(chains, {}, [](const Placed& placed) { return placed.chain; });
}

std::size_t bytes_of(const RankVector& utility) { return utility.scores().capacity() * sizeof(double); }

}  // namespace

NodeStore::NodeStore(ChainTable& table, Timelines& timelines, RankVector utility, double cost)
    : table_(table), timelines_(timelines), begin_(timelines.mark()), taken_(table.taken()) {
  Node& root = nodes_.emplace_back();
  root.utility = std::move(utility);
  root.cost = cost;
}

NodeStore::~NodeStore() { timelines_.undo(begin_); }

void NodeStore::go_to(NodeId id) {
  std::vector<NodeId> wanted;
  for (NodeId at = id; at != 0; at = nodes_[at].parent) wanted.push_back(at);
  std::ranges::reverse(wanted);
  const auto shared = static_cast<std::size_t>(std::ranges::mismatch(here_, wanted).in1 - here_.begin());
  if (here_.size() > shared) {
    timelines_.undo(marks_[shared]);
    while (here_.size() > shared) leave();
  }
  for (std::size_t depth = shared; depth < wanted.size(); ++depth) {
    Placed each = placed(nodes_[wanted[depth]]);
    const std::size_t mark = timelines_.mark();
    const std::span<const Link> links = table_.links(each.chain);
    for (std::size_t link = 0; link < links.size(); ++link)
      timelines_.place(links[link].id, links[link].footprint, each.starts[link]);
    enter(wanted[depth], std::move(each), mark);
  }
}

bool NodeStore::known(const Placed& added) const {
  const std::uint64_t key = nodes_[here_.empty() ? 0 : here_.back()].key + key_of(added);
  const auto [first, last] = by_key_.equal_range(key);
  if (first == last) return false;
  std::vector<Placed> mine = placed_;
  mine.push_back(added);
  sort(mine);
  return std::any_of(first, last, [&](const auto& entry) {
    std::vector<Placed> other = path(entry.second);
    sort(other);
    return other == mine;
  });
}

NodeId NodeStore::add(Placed added, std::size_t mark, double cost, RankVector utility) {
  const NodeId parent = here_.empty() ? 0 : here_.back();
  const auto id = static_cast<NodeId>(nodes_.size());
  Node node;
  node.parent = parent;
  node.depth = nodes_[parent].depth + 1;
  node.chain = added.chain;
  node.starts = static_cast<std::uint32_t>(starts_.size());
  node.cost = cost;
  node.utility = std::move(utility);
  node.key = nodes_[parent].key + key_of(added);
  by_key_.emplace(node.key, id);
  starts_.insert(starts_.end(), added.starts.begin(), added.starts.end());
  extra_bytes_ += bytes_of(node.utility);
  nodes_.push_back(std::move(node));
  enter(id, std::move(added), mark);
  return id;
}

std::vector<Placed> NodeStore::path(NodeId id) const {
  std::vector<Placed> out;
  for (NodeId at = id; at != 0; at = nodes_[at].parent) out.push_back(placed(nodes_[at]));
  std::ranges::reverse(out);
  return out;
}

std::size_t NodeStore::bytes() const {
  constexpr std::size_t kOfMapEntry = sizeof(std::pair<std::uint64_t, NodeId>) + 3 * sizeof(void*);
  return nodes_.capacity() * sizeof(Node) + starts_.capacity() * sizeof(Time) + by_key_.size() * kOfMapEntry +
         extra_bytes_;
}

void NodeStore::account(const Node& node) {
  extra_bytes_ += node.prospects.capacity() * sizeof(Prospect);
  for (const Prospect& prospect : node.prospects)
    extra_bytes_ += bytes_of(prospect.utility) + bytes_of(prospect.ratio);
}

Placed NodeStore::placed(const Node& node) const {
  const auto begin = starts_.begin() + node.starts;
  const auto count = static_cast<std::ptrdiff_t>(table_.chain(node.chain).links.size());
  return {node.chain, {begin, begin + count}};
}

void NodeStore::enter(NodeId id, Placed placed, std::size_t mark) {
  taken_[table_.chain(placed.chain).task] = true;
  here_.push_back(id);
  placed_.push_back(std::move(placed));
  marks_.push_back(mark);
}

void NodeStore::leave() {
  taken_[table_.chain(placed_.back().chain).task] = false;
  here_.pop_back();
  placed_.pop_back();
  marks_.pop_back();
}

}  // namespace roci::planner::utility_htn::search
