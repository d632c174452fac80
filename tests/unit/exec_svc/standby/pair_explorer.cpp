#include "tests/unit/exec_svc/standby/pair_explorer.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iostream>
#include <utility>

namespace roci::exec::testing {

using standby::LeaseSettings;
using standby::Member;
using standby::Moment;

namespace {

using namespace std::chrono_literals;

constexpr Moment kStep = 500ms;
constexpr Moment kOldest = 8s;       // older is as old: no rule counts longer, with the settings below
constexpr int kStepsToRecover = 60;  // half a minute

LeaseSettings quick_settings() {
  LeaseSettings out;
  out.solo_timeout = 3 * out.term;
  return out;
}

struct Node {
  PairWorld world;
  int goals = 0, recalls = 0, cuts = 0, kills = 0;
  std::size_t next = 0;  // event to be tried
};

using Link = std::function<void(Network&, bool)>;

// The links of three hosts, and of an owner that stands on a host of its own.
std::vector<std::pair<std::string, Link>> links() {
  std::vector<std::pair<std::string, Link>> out;
  out.emplace_back("between the members", [](Network& net, bool cut) { net.cut = cut; });
  for (const std::size_t member : {0U, 1U}) {
    const std::string name = member == 0 ? "first" : "second";
    out.emplace_back(name + " to owner 0",
                     [member](Network& net, bool cut) { net.owner_cut[member][0] = cut; });
    out.emplace_back(name + " to all owners", [member](Network& net, bool cut) {
      net.owner_cut[member] = {cut, cut, cut};
    });
    out.emplace_back(name + " with owner 0 from the other with the rest", [member](Network& net, bool cut) {
      net.cut = cut;
      net.owner_cut[member] = {false, cut, cut};
      net.owner_cut[1 - member] = {cut, false, false};
    });
    out.emplace_back("the host of " + name, [member](Network& net, bool cut) {
      net.cut = cut;
      net.owner_cut[member] = {cut, cut, cut};
    });
  }
  return out;
}

bool is_whole(const Network& net) {
  const auto none = [](const auto& cuts) { return std::ranges::none_of(cuts, [](bool cut) { return cut; }); };
  return !net.cut && none(net.owner_cut[0]) && none(net.owner_cut[1]) && none(net.ground_cut);
}

// Hashes of states, 8 bytes each and a quarter to a half left free: a search of 10^8 states stays below 2 GB. Two states
// of n have the same hash with a probability of n^2 / 2^65.
class StateHashes {
 public:
  // Returns whether it is new.
  bool insert(std::uint64_t hash) {
    if (2 * (size_ + 1) > slots_.size() + slots_.size() / 2) grow();
    if (!put(hash)) return false;
    ++size_;
    return true;
  }
  bool contains(std::uint64_t hash) const {
    std::size_t at = hash & (slots_.size() - 1);
    for (; slots_[at] != 0; at = (at + 1) & (slots_.size() - 1))
      if (slots_[at] == named(hash)) return true;
    return false;
  }
  std::size_t size() const { return size_; }

 private:
  static std::uint64_t named(std::uint64_t hash) { return hash == 0 ? 1 : hash; }  // 0: free
  bool put(std::uint64_t hash) {
    std::size_t at = hash & (slots_.size() - 1);
    for (; slots_[at] != 0; at = (at + 1) & (slots_.size() - 1))
      if (slots_[at] == named(hash)) return false;
    slots_[at] = named(hash);
    return true;
  }
  void grow() {
    const auto old = std::exchange(slots_, std::vector<std::uint64_t>(2 * slots_.size()));
    for (const std::uint64_t hash : old)
      if (hash != 0) put(hash);
  }

  std::vector<std::uint64_t> slots_ = std::vector<std::uint64_t>(1024);
  std::size_t size_ = 0;
};

// What may happen next in a node, and how it changes it.
struct Event {
  std::string what;
  std::function<bool(const Node&, const Bounds&)> may;
  std::function<void(Node&)> happen;
};

std::vector<Event> all_events() {
  std::vector<Event> out;
  out.push_back({"", [](const Node&, const Bounds&) { return true; }, [](Node&) {}});
  out.push_back({"a goal is asked for",
                 [](const Node& node, const Bounds& bounds) { return node.goals < bounds.goals; },
                 [](Node& next) { next.world.ask_for_a_goal(), ++next.goals; }});
  out.push_back({"goal 1 is recalled",
                 [](const Node& node, const Bounds& bounds) {
                   return node.recalls < bounds.recalls && !node.world.acknowledged_goals().empty();
                 },
                 [](Node& next) {
                   next.world.recall(*next.world.acknowledged_goals().begin()), ++next.recalls;
                 }});
  for (const Member member : {Member::first, Member::second}) {
    const std::string name = member == Member::first ? "first" : "second";
    out.push_back({name + " starts",
                   [member](const Node& node, const Bounds&) { return !node.world.alive(member); },
                   [member](Node& next) { next.world.start(member); }});
    out.push_back({name + " dies",
                   [member](const Node& node, const Bounds& bounds) {
                     return node.world.alive(member) && node.kills < bounds.kills;
                   },
                   [member](Node& next) { next.world.kill(member), ++next.kills; }});
  }
  out.push_back({"all links are whole",
                 [](const Node& node, const Bounds&) { return !is_whole(node.world.network); },
                 [](Node& next) { next.world.network = {}; }});
  for (const auto& [name, link] : links())
    out.push_back({"cut: " + name,
                   [](const Node& node, const Bounds& bounds) { return node.cuts < bounds.cuts; },
                   [link = link](Node& next) { link(next.world.network, true), ++next.cuts; }});
  return out;
}

class Explorer {
 public:
  Explorer(const Bounds& bounds, Bug bug) : bounds_(bounds), bug_(bug) {}

  Exploration run() {
    Node start{PairWorld(1, quick_settings(), bug_)};
    start.world.be_deterministic(kStep);
    start.world.run(3s);
    enter(std::move(start));
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
    const std::string state = node.world.fingerprint(kOldest);
    const std::string budget = std::to_string(node.goals) + "." + std::to_string(node.recalls) + "." +
                               std::to_string(node.cuts) + "." + std::to_string(node.kills);
    if (!known_.insert(std::hash<std::string>()(state + budget))) return;
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
    std::vector<std::size_t> passed;
    const auto good = [&] {
      const auto leader = world.leader();
      return leader && world.commands(*leader) && world.copy_is_near() && world.lost().empty() &&
             world.settled();
    };
    for (int step = 0; step < kStepsToRecover && world.faults.empty(); ++step) {
      const std::size_t state = std::hash<std::string>()(world.fingerprint(kOldest));
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
    for (const std::size_t state : passed) recovers_.insert(state);
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
  const std::vector<Event> events_ = all_events();
  std::vector<Node> path_;  // from the begin to the node that is looked at
  StateHashes known_;
  StateHashes recovers_;    // of states that end well by themselves
  Exploration out_;
};

}  // namespace

Exploration explore(const Bounds& bounds, Bug bug) { return Explorer(bounds, bug).run(); }

}  // namespace roci::exec::testing
