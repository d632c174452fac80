#include "tests/unit/exec_svc/standby/pair_explorer.hpp"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <utility>

#include "core/pseudorandom/split_mix.hpp"

namespace roci::exec::testing {

using standby::Member;

namespace {

constexpr int kStepsToRecover = 60;  // half a minute

struct Node : Course {
  std::size_t next = 0;  // event to be tried
};

// Hashes of states, 8 bytes each and a quarter to a half left free: a search of 10^8 states stays below 2 GB. Two states
// of n have the same hash with a probability of n^2 / 2^65.
class StateHashes {
 public:
  // Returns whether it is new.
  bool insert(std::uint64_t hash) {
    if (2 * (size_ + 1) > slots_.size() + slots_.size() / 2) grow();
    std::uint64_t& slot = slots_[slot_of(hash)];
    if (slot != 0) return false;
    slot = named(hash);
    ++size_;
    return true;
  }
  bool contains(std::uint64_t hash) const { return slots_[slot_of(hash)] != 0; }
  std::size_t size() const { return size_; }

 private:
  static std::uint64_t named(std::uint64_t hash) { return hash == 0 ? 1 : hash; }  // 0: free
  // Where it is, or would be.
  std::size_t slot_of(std::uint64_t hash) const {
    std::size_t at = hash & (slots_.size() - 1);
    while (slots_[at] != 0 && slots_[at] != named(hash)) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  void grow() {
    const auto old = std::exchange(slots_, std::vector<std::uint64_t>(2 * slots_.size()));
    for (const std::uint64_t hash : old)
      if (hash != 0) slots_[slot_of(hash)] = hash;
  }

  std::vector<std::uint64_t> slots_ = std::vector<std::uint64_t>(1024);
  std::size_t size_ = 0;
};

class Explorer {
 public:
  Explorer(const Bounds& bounds, Bug bug) : bounds_(bounds), bug_(bug) {}

  Exploration run() {
    enter(Node{{new_pair(bug_)}});
    while (!path_.empty() && out_.way.empty()) {
      const Node& node = path_.back();
      if (node.next == events_.size()) {
        path_.pop_back();
        continue;
      }
      const Event& event = events_[path_.back().next++];
      if (!event.may(node, bounds_)) continue;
      ++out_.transitions;
      Node next = node;
      event.happen(next);
      next.world.run(bounds_.pace * kStep);
      enter(std::move(next));
    }
    out_.states = known_.size();
    return out_;
  }

 private:
  void enter(Node node) {
    std::uint64_t state = node.world.fingerprint(kOldest);
    for (const int spent : {node.goals, node.recalls, node.cuts, node.kills})
      state = pseudorandom::finalized(state + static_cast<std::uint64_t>(spent) + 1);
    if (!known_.insert(state)) return;
    if (known_.size() % 1'000'000 == 0)
      std::cerr << known_.size() << " states, " << out_.transitions << " transitions so far\n";
    if (!node.world.faults.empty()) return report(node.world.faults.front());
    if (const std::string broken = after_all_is_mended(node.world); !broken.empty()) return report(broken);
    node.next = 0;
    path_.push_back(std::move(node));
  }

  // In every state: were all mended now, somebody would lead, and all would be there.
  std::string after_all_is_mended(PairWorld world) {
    world.network = {};
    for (const Member member : {Member::first, Member::second})
      if (!world.alive(member)) world.start(member);
    std::vector<std::uint64_t> passed;
    const auto good = [&] {
      const auto leader = world.leader();
      return leader && world.commands(*leader) && world.copy_is_near() && world.lost().empty() &&
             world.settled();
    };
    for (int step = 0; step < kStepsToRecover && world.faults.empty(); ++step) {
      const std::uint64_t state = world.fingerprint(kOldest);
      if (recovers_.contains(state)) break;
      passed.push_back(state);
      if (good()) break;
      world.run(kStep);
      if (step + 1 < kStepsToRecover) continue;
      const auto lost = world.lost();
      if (!lost.empty()) return "lost: " + lost.front();
      return "half a minute after all was mended nobody leads, or the copy is behind";
    }
    if (!world.faults.empty()) return world.faults.front() + ", once all was mended";
    for (const std::uint64_t state : passed) recovers_.insert(state);
    return "";
  }

  // Events lead from each node of the path to the next.
  void report(const std::string& fault) {
    int quiet = 0;
    const auto tell_quiet = [&] {
      if (quiet > 0) out_.way.push_back(std::to_string(std::exchange(quiet, 0)) + " steps");
    };
    for (const Node& node : path_) {
      const std::string& what = events_[node.next - 1].what;
      if (what.empty()) {
        ++quiet;
        continue;
      }
      tell_quiet();
      out_.way.push_back(what);
    }
    tell_quiet();
    out_.way.push_back(fault);
  }

  Bounds bounds_;
  Bug bug_;
  const std::vector<Event>& events_ = all_events();
  std::vector<Node> path_;  // from the begin to the node that is looked at
  StateHashes known_;
  StateHashes recovers_;    // of states that end well by themselves
  Exploration out_;
};

}  // namespace

Exploration explore(const Bounds& bounds, Bug bug) { return Explorer(bounds, bug).run(); }

}  // namespace roci::exec::testing
