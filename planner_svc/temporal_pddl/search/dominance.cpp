#include "planner_svc/temporal_pddl/search/dominance.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "planner_svc/temporal_pddl/search/hash_mix.hpp"

namespace roci::planner::temporal_pddl::search {

using constraints::BoundTable, constraints::LongestPathStn, constraints::kNoPath;
using task::ActionId, task::NumberId, task::NumbersView, task::NumericDominance, task::SnapId, task::SnapKind,
    task::StateView, task::Task, task::VariableId, task::Word;
using temporal::Duration;

namespace {

Duration plus(Duration time, Duration more) { return time == kNoPath ? kNoPath : time + more; }

// Returns the positions in prefix.running, ascending by action.
std::vector<std::size_t> by_action(const PlanPrefix& prefix) {
  std::vector<std::size_t> order(prefix.running.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return prefix.running[i].action; });
  return order;
}

bool same_running(const PlanPrefix& a, const PlanPrefix& b) {
  return std::ranges::is_permutation(a.running_actions, b.running_actions);
}

}  // namespace

Dominance::Dominance(const Task& task, const StateStore& store, const BoundTable& bounds,
                     TemporalCheck& check, Duration epsilon, bool end_counts, bool metric_counts)
    : task_(task),
      store_(store),
      bounds_(bounds),
      check_(check),
      epsilon_(epsilon),
      end_counts_(end_counts),
      absolute_(end_counts || task.has_absolute_times()),
      preferences_(numeric_dominance(task, metric_counts)),
      slots_(1024),
      position_(task.variables(), kAbsent) {}

std::uint32_t Dominance::hash(StateView state, const PlanPrefix& prefix) const {
  std::uint64_t h = prefix.timed_done;
  for (const Word word : state.first(state.size() - preferences_.size())) h = mix(h ^ word);
  for (const ActionId action : prefix.running_actions) h += mix(action.value + 0x9e3779b97f4a7c15ull);
  // The last bit tells plans in which nothing runs.
  const auto result = static_cast<std::uint32_t>(mix(h));
  return prefix.running.empty() ? result | 1u : result & ~1u;
}

// Returns whether the facts are equal, and the numbers equal or better.
bool Dominance::as_good(StateView stored, StateView fresh) const {
  const std::size_t packed = stored.size() - preferences_.size();
  if (!std::ranges::equal(stored.first(packed), fresh.first(packed))) return false;
  const NumbersView a = task_.layout.numbers(stored);
  const NumbersView b = task_.layout.numbers(fresh);
  for (std::size_t i = 0; i < preferences_.size(); ++i) {
    const NumberId number(i);
    if (stored[packed + i] == fresh[packed + i]) continue;
    const NumericDominance preference = preferences_[number];
    const bool better = preference == NumericDominance::none ||
                        (preference == NumericDominance::higher && a[number] >= b[number]) ||
                        (preference == NumericDominance::lower && a[number] <= b[number]);
    if (!better) return false;
  }
  return true;
}

bool Dominance::dominated(const Successor& successor) {
  const StateView state = successor.state;
  const PlanPrefix& prefix = successor.prefix;
  const std::uint32_t h = hash(state, prefix);
  const std::size_t mask = slots_.size() - 1;
  Profile fresh;
  std::size_t compared = 0;
  for (std::size_t slot = h & mask; !slots_[slot].node.is_none(); slot = (slot + 1) & mask) {
    const NodeId node = slots_[slot].node;
    if (slots_[slot].hash != h || !as_good(store_.state(node), state)) continue;
    if (!absolute_ && prefix.running.empty()) return true;
    if (store_.parent(node) == prefix.node && store_.transition(node).snap == successor.transition.snap)
      return true;
    rebuild(task_, store_, bounds_, epsilon_, node, other_);
    if (other_.timed_done != prefix.timed_done || !same_running(other_, prefix)) continue;
    if (compared == 0) fresh = profile(prefix, false);
    if (no_worse(profile(other_, true), fresh)) return true;
    if (++compared == kMaxComparisons) return false;
  }
  return false;
}

void Dominance::insert(NodeId node, StateView state, const PlanPrefix& prefix) {
  if (2 * (size_ + 1) > slots_.size()) {
    const std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(slots_.size() * 2));
    for (const Slot& slot : old) {
      if (!slot.node.is_none()) place(slot);
    }
  }
  place({node, hash(state, prefix)});
  ++size_;
}

void Dominance::place(Slot slot) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = slot.hash & mask;
  while (!slots_[at].node.is_none()) at = (at + 1) & mask;
  slots_[at] = slot;
}

// Appends the variables that the plan touches and notes their places in position_, which the caller clears
// again.
void Dominance::find_touched(const PlanPrefix& prefix, std::vector<VariableId>& touched) {
  const auto touch = [&](std::span<const VariableId> variables) {
    for (const VariableId variable : variables) {
      if (position_[variable] != kAbsent) continue;
      position_[variable] = static_cast<std::uint32_t>(touched.size());
      touched.push_back(variable);
    }
  };
  for (const SnapId step : prefix.steps) {
    touch(task_.reads[step]);
    touch(task_.writes[step]);
    if (task_.snaps[step].kind == SnapKind::end) touch(task_.invariant_reads[task_.snaps[step].action]);
  }
}

Dominance::Profile Dominance::profile(const PlanPrefix& prefix, bool stored) {
  Profile result;
  find_touched(prefix, result.touched);
  const auto order = by_action(prefix);
  const auto add_source = [&](const std::vector<Duration>& distances) {
    result.releases.push_back(releases(prefix, distances, result.touched.size()));
    auto& starts = result.starts.emplace_back();
    for (const std::size_t i : order) starts.push_back(distances[prefix.running[i].step]);
    if (end_counts_) starts.push_back(distances.empty() ? kNoPath : std::ranges::max(distances));
  };
  const LongestPathStn network = TemporalCheck::network(prefix);
  for (const std::size_t i : order) add_source(*network.longest_from(prefix.running[i].step));
  if (absolute_) {
    const std::vector<Duration> earliest = *check_.earliest(prefix);
    add_source(earliest);
    const auto windows = stored ? check_.chosen_windows(prefix, earliest) : check_.widest_windows(prefix);
    const auto latest = TemporalCheck::latest(prefix, windows);
    for (const std::size_t i : order) result.latest.push_back(latest[prefix.running[i].step]);
  }
  for (const VariableId variable : result.touched) position_[variable] = kAbsent;
  return result;
}

std::vector<Dominance::Release> Dominance::releases(const PlanPrefix& prefix,
                                                    const std::vector<Duration>& distances,
                                                    std::size_t touched) const {
  std::vector<Release> result(touched);
  for (std::size_t i = 0; i < prefix.steps.size(); ++i) {
    const SnapId step = prefix.steps[i];
    const Duration at = distances[i];
    const auto raise = [](Duration& time, Duration to) { time = std::max(time, to); };
    for (const VariableId variable : task_.reads[step]) {
      Release& release = result[position_[variable]];
      raise(release.change, plus(at, epsilon_));
      raise(release.erase, plus(at, epsilon_));
    }
    if (task_.snaps[step].kind == SnapKind::end) {
      for (const VariableId variable : task_.invariant_reads[task_.snaps[step].action]) {
        raise(result[position_[variable]].erase, at);
      }
    }
    for (const VariableId variable : task_.writes[step]) {
      Release& release = result[position_[variable]];
      raise(release.read, at);
      raise(release.change, plus(at, epsilon_));
      raise(release.erase, plus(at, epsilon_));
    }
  }
  return result;
}

bool Dominance::no_worse(const Profile& stored, const Profile& fresh) {
  for (std::size_t i = 0; i < stored.latest.size(); ++i) {
    if (stored.latest[i] < fresh.latest[i]) return false;
  }
  for (std::size_t source = 0; source < stored.starts.size(); ++source) {
    for (std::size_t i = 0; i < stored.starts[source].size(); ++i) {
      if (stored.starts[source][i] > fresh.starts[source][i]) return false;
    }
  }
  for (std::uint32_t i = 0; i < fresh.touched.size(); ++i) position_[fresh.touched[i]] = i;
  bool result = true;
  for (std::size_t i = 0; i < stored.touched.size() && result; ++i) {
    const std::uint32_t j = position_[stored.touched[i]];
    for (std::size_t source = 0; source < stored.releases.size() && result; ++source) {
      const Release& a = stored.releases[source][i];
      const Release b = j == kAbsent ? Release{} : fresh.releases[source][j];
      result = a.read <= b.read && a.change <= b.change && a.erase <= b.erase;
    }
  }
  for (const VariableId variable : fresh.touched) position_[variable] = kAbsent;
  return result;
}

}  // namespace roci::planner::temporal_pddl::search
