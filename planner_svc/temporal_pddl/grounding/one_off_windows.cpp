#include "planner_svc/temporal_pddl/grounding/one_off_windows.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace roci::planner::temporal_pddl {

namespace {

struct History {
  bool initially = false;
  std::vector<std::pair<Duration, bool>> changes;  // time, new value

  // The one interval in which the fact is true, if there is no other.
  std::optional<TimeWindow> only_window() const {
    const bool value_alternates = [&] {
      bool value = initially;
      for (const auto& change : changes) {
        if (change.second == value) return false;
        value = change.second;
      }
      return true;
    }();
    if (!value_alternates) return std::nullopt;
    if (initially && changes.size() == 1) return TimeWindow{Duration{0}, changes[0].first};
    if (!initially && changes.size() == 1) return TimeWindow{changes[0].first, kUnbounded};
    if (!initially && changes.size() == 2) return TimeWindow{changes[0].first, changes[1].first};
    return std::nullopt;
  }
};

class Extraction {
 public:
  Extraction(GroundModel& model, Duration epsilon) : model_(model), epsilon_(epsilon) {}

  void run() {
    collect_histories();
    exclude_touched();
    for (const auto& [atom, history] : histories_) {
      if (const auto window = history.only_window()) windows_.emplace(atom, *window);
    }
    if (windows_.empty()) return;
    for (auto& action : model_.actions) restrict(action);
    std::erase_if(model_.actions, [](const GroundAction& action) {
      return action.start_window.open > action.start_window.close ||
             action.end_window.open > action.end_window.close ||
             (action.end_window.close != kUnbounded &&
              action.end_window.close - action.start_window.open < action.min_duration);
    });
    const auto extracted = [&](std::uint32_t atom) { return windows_.contains(atom); };
    for (auto& timed : model_.timed) {
      std::erase_if(timed.effects.adds, extracted);
      std::erase_if(timed.effects.deletes, extracted);
    }
    std::erase_if(model_.timed, [](const TimedChange& timed) {
      return timed.effects.adds.empty() && timed.effects.deletes.empty() && timed.effects.numeric.empty();
    });
  }

 private:
  void collect_histories() {
    for (const auto& timed : model_.timed) {
      for (const std::uint32_t atom : timed.effects.deletes)
        histories_[atom].changes.emplace_back(timed.time, false);
      for (const std::uint32_t atom : timed.effects.adds)
        histories_[atom].changes.emplace_back(timed.time, true);
    }
    for (const std::uint32_t atom : model_.initial_atoms) {
      const auto history = histories_.find(atom);
      if (history != histories_.end()) history->second.initially = true;
    }
  }

  void exclude_touched() {
    const auto exclude_negated = [&](const Conjunction& conjunction) {
      for (const auto literal : conjunction.literals) {
        if (literal.negated) histories_.erase(literal.atom);
      }
    };
    for (const auto& action : model_.actions) {
      for (const auto* effects : {&action.start_effects, &action.end_effects}) {
        for (const std::uint32_t atom : effects->adds) histories_.erase(atom);
        for (const std::uint32_t atom : effects->deletes) histories_.erase(atom);
      }
      for (const auto* conjunction : {&action.at_start, &action.over_all, &action.at_end})
        exclude_negated(*conjunction);
    }
    for (const auto& goal : model_.goal) {
      for (const auto literal : goal.literals) histories_.erase(literal.atom);
    }
  }

  // Moves the conditions on windowed facts out of `conjunction` and into the window, with a margin inside of
  // it.
  void take(Conjunction& conjunction, Duration margin, TimeWindow& window) const {
    std::erase_if(conjunction.literals, [&](GroundLiteral literal) {
      const auto found = windows_.find(literal.atom);
      if (found == windows_.end()) return false;
      const TimeWindow& bounds = found->second;
      if (bounds.open > Duration{0}) window.open = std::max(window.open, bounds.open + margin);
      if (bounds.close != kUnbounded) window.close = std::min(window.close, bounds.close - margin);
      return true;
    });
  }

  void restrict(GroundAction& action) const {
    take(action.at_start, epsilon_, action.start_window);
    take(action.at_end, epsilon_, action.end_window);
    TimeWindow whole;
    take(action.over_all, Duration{0}, whole);
    for (auto* window : {&action.start_window, &action.end_window}) {
      window->open = std::max(window->open, whole.open);
      window->close = std::min(window->close, whole.close);
    }
  }

  GroundModel& model_;
  Duration epsilon_;
  std::map<std::uint32_t, History> histories_;
  std::map<std::uint32_t, TimeWindow> windows_;
};

}  // namespace

void extract_one_off_windows(GroundModel& model, Duration epsilon) { Extraction(model, epsilon).run(); }

}  // namespace roci::planner::temporal_pddl
