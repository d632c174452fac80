#include <algorithm>

#include "core/temporal/schedule.hpp"
#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

using model::StateKind;

namespace {

/// Executes one schedule against the relations of the model.
class Execution {
 public:
  Execution(const Version& version, const Schedule& at) : version_(version), at_(at) {}

  // A timeline is walked in the order of its times: what was read off the network must come out again.
  void timelines(Faults& out) const {
    for (Index c = 0; c < version_.timelines.size(); ++c) {
      Duration now{0};
      for (const Value& value : version_.timelines[c]) {
        if (at_[value.start] != now || at_[value.end] < now)
          out.push_back("executed, timeline " + version_.model.components[c].name +
                        " has a gap or an overlap at " + to_text(now) + ", before " +
                        version_.text(value.state));
        now = at_[value.end];
      }
    }
  }

  void needs(Faults& out) const {
    for (const auto& timeline : version_.timelines)
      for (std::size_t i = 1; i < timeline.size(); ++i)
        for (const model::Need& need : version_.definition(timeline[i].state).needs)
          if (!met(timeline[i], need))
            out.push_back("executed, " + version_.text(timeline[i].state) + " at " +
                          to_text(at_[timeline[i].start]) + " lacks what it needs of " +
                          version_.model.components[need.state.component].name);
  }

  /// Returns why a decomposition does not hold here; empty: it does.
  std::string why_not(const Part& part, const Decomposition& way) const {
    const model::Behaviour& behaviour = version_.model.behaviours[way.behaviour];
    for (const model::Precondition& condition : behaviour.conditions)
      if (!holds_at(condition, way.binding, part))
        return "behaviour '" + behaviour.name + "' asks for " + (condition.negated ? "not " : "") +
               to_text(version_.model, condition.state, behaviour.variables) + " at its start, and at " +
               to_text(at_[part.start()]) + " that is not so";
    std::vector<Value> resting(behaviour.subgoals.size());
    return rests(part, way, 0, resting) ? ""
                                        : "a state to rest in that behaviour '" + behaviour.name +
                                              "' asks for does not hold at its time";
  }

  void goals(const Decompositions& decompositions, Faults& out) const {
    const model::Problem& problem = *version_.model.problem;
    Duration mended{0};
    for (Index i = 0; i < version_.parts.size(); ++i)
      if (!version_.parts[i].state && !decompositions[i].empty())
        mended = std::max(mended, at_[version_.parts[i].end()]);
    std::vector<std::optional<Duration>> ends(problem.goals.size());
    for (std::size_t round = 0; round < problem.goals.size(); ++round)
      for (Index g = 0; g < problem.goals.size(); ++g) {
        Duration earliest = std::max(problem.goals[g].opens, mended);
        const bool ready = std::ranges::all_of(problem.goals[g].after, [&](Index other) {
          if (ends[other]) earliest = std::max(earliest, *ends[other]);
          return ends[other].has_value();
        });
        if (ready && !ends[g]) ends[g] = reached(problem.goals[g], earliest);
      }
    for (Index g = 0; g < problem.goals.size(); ++g)
      if (!ends[g])
        out.push_back("executed, goal '" + problem.goals[g].id + "', " +
                      to_text(version_.model, problem.goals[g].state, {}) +
                      ", is not reached in its window, after the goals that come first");
  }

 private:
  bool met(const Value& value, const model::Need& need) const {
    const model::State& definition = version_.definition(value.state);
    return std::ranges::any_of(version_.timelines[need.state.component], [&](const Value& other) {
      Binding binding = value.state.objects;
      binding.resize(definition.parameters.size() + definition.free.size(), kNone);
      if (!unify(need.state, other.state, binding)) return false;
      if (need.kind == model::NeedKind::met_by) return at_[other.end] == at_[value.start];
      const TimePoint until = need.kind == model::NeedKind::during ? value.end : value.start;
      return at_[other.start] <= at_[value.start] && at_[until] <= at_[other.end];
    });
  }

  // At a point at which a timeline changes both values count; of its own timeline the one before.
  bool holds_at(const model::Precondition& condition, const Binding& objects, const Part& part) const {
    const Duration start = at_[part.start()];
    const std::vector<Value>& values = version_.timelines[condition.state.component];
    const bool own = part.state && part.value && part.state->component == condition.state.component;
    for (Index i = 0; i < values.size(); ++i) {
      if (own ? i + 1 != *part.value : at_[values[i].start] > start || start > at_[values[i].end]) continue;
      Binding binding = objects;
      if (unify(condition.state, values[i].state, binding) != condition.negated) return true;
    }
    return false;
  }

  // Tries values for the subgoals that the timeline alone shows, from one on.
  bool rests(const Part& part, const Decomposition& way, Index subgoal, std::vector<Value>& resting) const {
    const model::Behaviour& behaviour = version_.model.behaviours[way.behaviour];
    while (subgoal < resting.size() && way.part_of[subgoal] != kNone) ++subgoal;
    if (subgoal == resting.size()) return solvable(part, way, resting);
    for (const Value& value : version_.timelines[behaviour.subgoals[subgoal].state.component]) {
      Binding binding = way.binding;
      if (at_[value.end] < at_[part.start()] || at_[value.start] > at_[part.end()] ||
          !unify(behaviour.subgoals[subgoal].state, value.state, binding))
        continue;
      resting[subgoal] = value;
      if (rests(part, way, subgoal + 1, resting)) return true;
    }
    return false;
  }

  // Whether the constraints leave times for those subgoals: start and end of each are points of a small network.
  bool solvable(const Part& part, const Decomposition& way, const std::vector<Value>& resting) const {
    const model::Behaviour& behaviour = version_.model.behaviours[way.behaviour];
    using temporal::ConstraintKind, temporal::no_bound;
    std::vector<temporal::TemporalConstraint> constraints;
    const auto add = [&](TimePoint from, TimePoint to, Duration lower, Duration upper) {
      constraints.push_back({from, to, ConstraintKind::ordering, lower, upper});
    };
    const auto point = [](Index subgoal, bool end) { return 1 + 2 * subgoal + (end ? 1 : 0); };
    // The points of what is known stand in the network, too, fixed; the activity itself comes last.
    const auto known = static_cast<Index>(resting.size());
    const auto fix = [&](Index subgoal, const Part& one) {
      add(0, point(subgoal, false), at_[one.start()], at_[one.start()]);
      add(0, point(subgoal, true), at_[one.end()], at_[one.end()]);
    };
    fix(known, part);
    for (Index i = 0; i < known; ++i) {
      if (way.part_of[i] != kNone) {
        fix(i, version_.parts[way.part_of[i]]);
        continue;
      }
      add(0, point(i, false), std::max(at_[resting[i].start], at_[part.start()]), no_bound);
      add(point(i, false), point(i, true), Duration{0}, no_bound);
      add(0, point(i, true), Duration{0}, std::min(at_[resting[i].end], at_[part.end()]));
    }
    for (const model::SubgoalConstraint& constraint : behaviour.constraints) {
      const auto range = bounds_of_constraint(version_.model, constraint, way.binding);
      if (!range) return false;
      add(point(constraint.from.subgoal.value_or(known), constraint.from.end),
          point(constraint.to.subgoal.value_or(known), constraint.to.end), range->lower, range->upper);
    }
    return earliest_schedule(point(known, true) + 1, constraints).has_value();
  }

  // The earliest end of the goal's state from a time on, if it starts in the window.
  std::optional<Duration> reached(const model::Goal& goal, Duration earliest) const {
    std::optional<Duration> out;
    const auto note = [&](Duration start, Duration end) {
      if (start >= earliest && start <= goal.closes && (!out || end < *out)) out = end;
    };
    Binding none;
    const bool resting =
        version_.model.components[goal.state.component].states[goal.state.state].kind == StateKind::resting;
    for (const Value& value : version_.timelines[goal.state.component])
      if (resting && unify(goal.state, value.state, none)) {
        const Duration start = std::max(at_[value.start], earliest);
        if (start <= at_[value.end]) note(start, start);
      }
    for (const Part& part : version_.parts)
      if (!resting && !part.aside && part.state && unify(goal.state, *part.state, none))
        note(at_[part.start()], at_[part.end()]);
    return out;
  }

  const Version& version_;
  const Schedule& at_;
};

}  // namespace

void execute(const Version& version, const Schedule& schedule, Decompositions& decompositions, Faults& out) {
  const Execution execution(version, schedule);
  execution.timelines(out);
  execution.needs(out);
  execution.goals(decompositions, out);
  for (Index i = 0; i < decompositions.size(); ++i) {
    if (decompositions[i].empty()) continue;
    std::string why_not;
    std::erase_if(decompositions[i], [&](const Decomposition& way) {
      const std::string wrong = execution.why_not(version.parts[i], way);
      if (!wrong.empty()) why_not = wrong;
      return !wrong.empty();
    });
    if (decompositions[i].empty())
      out.push_back("executed, " + version.text(version.parts[i]) + " is decomposed by no behaviour; " +
                    why_not);
  }
}

}  // namespace roci::planner::timeline_htn::checking
