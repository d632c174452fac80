#include "planner_svc/temporal_pddl/grounding/simplification/timed_windows.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace roci::planner::temporal_pddl::grounding::simplification {

using call::WindowExtraction;
using instantiation::ActionWindows, instantiation::Conjunction, instantiation::GroundAction,
    instantiation::GroundLiteral, instantiation::GroundModel, instantiation::ReadVariable,
    instantiation::TimedChange, instantiation::WindowMisfit;
using task::TimeWindow, task::TimeWindows, task::any_time, task::is_any_time;
using temporal::Duration, temporal::no_bound;

namespace {

struct History {
  bool initially = false;
  std::vector<std::pair<Duration, bool>> changes;  // time, new value

  // Returns when the fact is true, or nothing if some timed change does not change it.
  std::optional<TimeWindows> windows() const {
    TimeWindows result;
    if (initially) result.push_back({});
    bool value = initially;
    for (const auto& [time, becomes] : changes) {
      if (becomes == value) return std::nullopt;
      value = becomes;
      if (value) {
        result.push_back({time, no_bound});
      } else {
        result.back().close = time;
      }
    }
    return result;
  }
};

class Extraction {
 public:
  Extraction(GroundModel& model, WindowExtraction mode, Duration epsilon)
      : model_(model), mode_(mode), epsilon_(epsilon) {}

  void run() {
    collect_histories();
    exclude_touched();
    for (const auto& [atom, history] : histories_) {
      auto windows = history.windows();
      if (windows && (mode_ == WindowExtraction::recurring || windows->size() == 1)) {
        windows_.emplace(atom, std::move(*windows));
      }
    }
    if (windows_.empty()) return;
    for (auto& action : model_.actions) restrict(action);
    for (const auto& action : model_.actions) note_window_misfit(action);
    std::erase_if(model_.actions, [](const GroundAction& action) {
      const auto& windows = action.windows;
      return windows && (windows->start.empty() || windows->end.empty() || windows->span.empty());
    });
    const auto extracted = [&](std::uint32_t atom) { return windows_.contains(atom); };
    for (auto& timed : model_.timed) {
      erase_if(timed.effects.adds, extracted);
      erase_if(timed.effects.deletes, extracted);
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
      for (const ReadVariable& read : model_.read_set_of(action)) {
        if (!read.is_number) histories_.erase(read.index);
      }
    }
    for (const auto& rule : model_.rules) {
      for (const auto literal : rule.body.literals) histories_.erase(literal.atom);
    }
    for (const auto& goal : model_.goal) {
      for (const auto literal : goal.literals) histories_.erase(literal.atom);
    }
  }

  // Moves the conditions on windowed facts out of `conjunction`. Returns the times when all of them hold,
  // with a margin at both ends.
  TimeWindows take(Conjunction& conjunction, Duration margin) const {
    TimeWindows result = any_time();
    erase_if(conjunction.literals, [&](GroundLiteral literal) {
      const auto found = windows_.find(literal.atom);
      if (found == windows_.end()) return false;
      result = intersection(result, shrunk(found->second, margin, margin));
      return true;
    });
    return result;
  }

  void note_window_misfit(const GroundAction& action) {
    if (!action.windows) return;
    const auto& span = action.windows->span;
    if (span.empty() || !shrunk(span, Duration{0}, action.min_duration).empty()) return;
    WindowMisfit note{action.schema,
                      {action.arguments.begin(), action.arguments.end()},
                      {action.start_effects.adds.begin(), action.start_effects.adds.end()},
                      action.min_duration,
                      {}};
    const auto& adds = action.end_effects.adds;
    note.adds.insert(note.adds.end(), adds.begin(), adds.end());
    for (const TimeWindow& window : span) note.window = std::max(note.window, window.close - window.open);
    model_.window_misfits.push_back(std::move(note));
  }

  void restrict(GroundAction& action) const {
    const TimeWindows start = take(action.at_start, epsilon_);
    const TimeWindows end = take(action.at_end, epsilon_);
    const TimeWindows span = take(action.over_all, Duration{0});
    if (is_any_time(start) && is_any_time(end) && is_any_time(span)) return;
    action.windows = std::make_shared<ActionWindows>(
        ActionWindows{intersection(start, shrunk(span, Duration{0}, action.min_duration)),
                      intersection(end, shrunk(span, action.min_duration, Duration{0})), span});
  }

  GroundModel& model_;
  WindowExtraction mode_;
  Duration epsilon_;
  std::map<std::uint32_t, History> histories_;
  std::map<std::uint32_t, TimeWindows> windows_;
};

}  // namespace

void extract_timed_windows(GroundModel& model, WindowExtraction mode, Duration epsilon) {
  if (mode != WindowExtraction::none) Extraction(model, mode, epsilon).run();
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
