#include "tests/unit/exec_svc/standby/pair_events.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::testing {

using standby::Member;

namespace {

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

std::vector<Event> make_events() {
  std::vector<Event> out;
  out.push_back({"", [](const Course&, const Bounds&) { return true; }, [](Course&) {}});
  out.push_back({"a goal is asked for",
                 [](const Course& course, const Bounds& bounds) { return course.goals < bounds.goals; },
                 [](Course& next) { next.world.ask_for_a_goal(), ++next.goals; }});
  out.push_back({"goal 1 is recalled",
                 [](const Course& course, const Bounds& bounds) {
                   return course.recalls < bounds.recalls && !course.world.acknowledged_goals().empty();
                 },
                 [](Course& next) {
                   next.world.recall(*next.world.acknowledged_goals().begin()), ++next.recalls;
                 }});
  for (const Member member : {Member::first, Member::second}) {
    const std::string name = member == Member::first ? "first" : "second";
    out.push_back({name + " starts",
                   [member](const Course& course, const Bounds&) { return !course.world.alive(member); },
                   [member](Course& next) { next.world.start(member); }});
    out.push_back({name + " dies",
                   [member](const Course& course, const Bounds& bounds) {
                     return course.world.alive(member) && course.kills < bounds.kills;
                   },
                   [member](Course& next) { next.world.kill(member), ++next.kills; }});
  }
  out.push_back({"all links are whole",
                 [](const Course& course, const Bounds&) { return !is_whole(course.world.network); },
                 [](Course& next) { next.world.network = {}; }});
  for (const auto& [name, link] : links())
    out.push_back({"cut: " + name,
                   [](const Course& course, const Bounds& bounds) { return course.cuts < bounds.cuts; },
                   [link = link](Course& next) { link(next.world.network, true), ++next.cuts; }});
  return out;
}

}  // namespace

PairWorld new_pair(Bug bug) {
  standby::LeaseSettings quick;
  quick.solo_timeout = 3 * quick.term;
  PairWorld out(1, quick, bug);
  out.be_deterministic(kStep);
  out.run(std::chrono::seconds(3));
  return out;
}

const std::vector<Event>& all_events() {
  static const std::vector<Event> events = make_events();
  return events;
}

}  // namespace roci::exec::testing
