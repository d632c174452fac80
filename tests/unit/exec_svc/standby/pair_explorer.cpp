#include "tests/unit/exec_svc/standby/pair_explorer.hpp"

#include <algorithm>
#include <deque>
#include <functional>
#include <memory>
#include <unordered_set>
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
  int goals = 0, recalls = 0, cuts = 0, kills = 0, quiet = 0;
  std::size_t parent = 0;  // in the history
};

struct Event {
  std::string what;
  std::size_t before = 0;
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

class Explorer {
 public:
  Explorer(const Bounds& bounds, Bug bug) : bounds_(bounds), bug_(bug) {}

  Exploration run() {
    history_.push_back({"begin", 0});
    Node start{PairWorld(1, quick_settings(), bug_)};
    start.world.be_deterministic(kStep);
    start.world.run(3s);
    enter(std::move(start));
    while (!open_.empty() && out_.way.empty() && known_.size() < bounds_.states) {
      const Node node = std::move(open_.front());
      open_.pop_front();
      expand(node);
    }
    out_.states = known_.size();
    out_.complete = open_.empty() && out_.way.empty();
    return out_;
  }

 private:
  void expand(const Node& node) {
    const auto add = [&](const std::string& what, const std::function<void(Node&)>& change) {
      Node next = node;
      next.quiet = 0;
      change(next);
      go_on(std::move(next), what);
    };
    if (node.goals < bounds_.goals)
      add("a goal is asked for", [](Node& next) { next.world.ask_for_a_goal(), ++next.goals; });
    if (node.recalls < bounds_.recalls && !node.world.acknowledged_goals().empty())
      add("goal 1 is recalled",
          [](Node& next) { next.world.recall(*next.world.acknowledged_goals().begin()), ++next.recalls; });
    for (const Member member : {Member::first, Member::second}) {
      const std::string name = member == Member::first ? "first" : "second";
      if (!node.world.alive(member))
        add(name + " starts", [member](Node& next) { next.world.start(member); });
      if (node.world.alive(member) && node.kills < bounds_.kills)
        add(name + " dies", [member](Node& next) { next.world.kill(member), ++next.kills; });
    }
    if (!is_whole(node.world.network))
      add("all links are whole", [](Node& next) { next.world.network = {}; });
    if (node.cuts < bounds_.cuts) {
      for (const auto& [name, link] : links_)
        add("cut: " + name, [&link = link](Node& next) { link(next.world.network, true), ++next.cuts; });
    }
    if (node.quiet < bounds_.quiet_steps) {
      Node next = node;
      ++next.quiet;
      go_on(std::move(next), "");
    }
  }

  void go_on(Node next, const std::string& what) {
    ++out_.transitions;
    history_.push_back({what, next.parent});
    next.parent = history_.size() - 1;
    next.world.run(kStep);
    enter(std::move(next));
  }

  void enter(Node node) {
    const std::string state = node.world.fingerprint(kOldest);
    const std::string budget = std::to_string(node.goals) + "." + std::to_string(node.recalls) + "." +
                               std::to_string(node.cuts) + "." + std::to_string(node.kills);
    if (!out_.way.empty()) return;
    if (!known_.insert(std::hash<std::string>()(state + budget)).second) return;
    if (!node.world.faults.empty()) return report(node.parent, node.world.faults.front());
    if (const std::string broken = after_all_is_mended(node.world); !broken.empty())
      return report(node.parent, broken);
    open_.push_back(std::move(node));
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
    recovers_.insert(passed.begin(), passed.end());
    return "";
  }

  void report(std::size_t at, const std::string& fault) {
    out_.way.push_back(fault);
    int quiet = 0;
    for (; at != 0; at = history_[at].before) {
      if (history_[at].what.empty()) {
        ++quiet;
        continue;
      }
      if (quiet > 0) out_.way.push_back(std::to_string(std::exchange(quiet, 0)) + " steps");
      out_.way.push_back(history_[at].what);
    }
    std::ranges::reverse(out_.way);
  }

  Bounds bounds_;
  Bug bug_;
  std::vector<std::pair<std::string, Link>> links_ = links();
  std::deque<Node> open_;
  std::unordered_set<std::size_t> known_;     // hashes of states
  std::unordered_set<std::size_t> recovers_;  // hashes of states that end well by themselves
  std::vector<Event> history_;
  Exploration out_;
};

}  // namespace

Exploration explore(const Bounds& bounds, Bug bug) { return Explorer(bounds, bug).run(); }

}  // namespace roci::exec::testing
