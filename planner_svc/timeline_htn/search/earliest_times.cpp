#include "planner_svc/timeline_htn/search/earliest_times.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <set>

namespace roci::planner::timeline_htn::search {

using model::NeedKind, model::Pattern, model::StateKind;
using temporal::no_bound;

namespace {

constexpr std::size_t kMostWays =
    20'000;  // of behaviours that are looked at; behind them nothing is known to take time

/// Is the earliest time of something; no_bound: never.
struct Earliest {
  Duration at{0};
  StateId waits = kNone;  ///< the state that waited last for what is predicted
};

// What never comes is told where nothing else is known.
bool is_sooner(const Earliest& one, const Earliest& other) {
  return one.at < other.at || (one.at == no_bound && other.at == no_bound && other.waits == kNone);
}

class Times {
 public:
  Times(Ground& ground, const Successors& successors, const PartialPlan& begun)
      : ground_(ground), successors_(successors), begun_(begun) {}

  std::optional<TooLate> run() {
    const model::Model& model = ground_.model();
    for (Index g = 0; g < model.problem->goals.size(); ++g) {
      const model::Goal& goal = model.problem->goals[g];
      const StateId state = ground_.find(ground_of(goal.state, {}));
      const Earliest earliest = reached(state, goal.opens);
      if (earliest.waits == kNone || earliest.at <= std::min(goal.closes, model.problem->horizon)) continue;
      return TooLate{g, reason(state, earliest, goal)};
    }
    return std::nullopt;
  }

 private:
  bool is_predicted(const Pattern& pattern) const {
    return model::is_predicted(ground_.model(), pattern.component);
  }

  // The first time from one on at which the predicted timeline is so for as long as it takes; no_bound: there is none.
  Duration next_time(const Pattern& pattern, const std::vector<Index>& objects, bool negated, NeedKind kind,
                     Duration from, Duration lasts) const {
    for (const Index token : begun_.predicted(pattern.component)) {
      const Token& value = begun_.tokens()[token];
      if (ground_.fits(value.state, pattern, objects) == negated) continue;
      const Duration begins = begun_.network().earliest(value.start),
                     ends = begun_.network().earliest(value.end);
      const Duration at = std::max(from, kind == NeedKind::met_by ? ends : begins);
      if (at + (kind == NeedKind::during ? lasts : Duration{0}) <= ends) return at;
    }
    return no_bound;
  }

  // When a value that is no complex one may begin, from a time on.
  Earliest begin(StateId state, Duration from) const {
    const model::State& definition = ground_.definition(state);
    std::vector<Index> objects = ground_.at(state).state.objects;
    objects.resize(objects.size() + definition.free.size(), kNone);
    Earliest out{from, kNone};
    for (bool more = true; more;) {
      more = false;
      for (const model::Need& need : definition.needs) {
        if (!is_predicted(need.state)) continue;
        const Duration at =
            next_time(need.state, objects, false, need.kind, out.at, ground_.at(state).bounds.shortest);
        if (at == out.at) continue;
        out = {at, state};
        if (at == no_bound) return out;
        more = true;
      }
    }
    return out;
  }

  // When a behaviour with these objects may begin.
  Duration begin(const model::Behaviour& behaviour, const std::vector<Index>& objects, Duration from) const {
    for (bool more = true; more;) {
      more = false;
      for (const model::Precondition& condition : behaviour.conditions) {
        if (!is_predicted(condition.state)) continue;
        const Duration at =
            next_time(condition.state, objects, condition.negated, NeedKind::at_start, from, Duration{0});
        more = more || at != from;
        from = at;
        if (at == no_bound) return at;
      }
    }
    return from;
  }

  // When a complex state may begin from a time on, and when one that begins at any time may end.
  std::pair<Earliest, Earliest> complex(StateId state, Duration from) {
    const model::GroundState ground = ground_.at(state).state;
    Earliest begins{no_bound, kNone}, ends{no_bound, kNone};
    if (!above_.insert(state).second) return {{from, kNone}, {}};
    for (const Index index : successors_.behaviours(ground.component, ground.state)) {
      const model::Behaviour& behaviour = ground_.model().behaviours[index];
      for (const auto& objects : successors_.ways(index, state)) {
        if (++ways_ > kMostWays) {
          above_.erase(state);
          return {{from, kNone}, {}};
        }
        const Duration first = begin(behaviour, objects, from);
        if (is_sooner({first, state}, begins)) begins = {first, first == from ? kNone : state};
        const Earliest last = parts(state, behaviour, objects);
        if (is_sooner(last, ends)) ends = last;
      }
    }
    above_.erase(state);
    return {begins, ends};
  }

  // When the last of the parts of a complex state that are planned on may end.
  Earliest parts(StateId state, const model::Behaviour& behaviour, const std::vector<Index>& objects) {
    std::set<Index> beside;
    for (const model::Decision& decision : behaviour.decisions)
      for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
        beside.insert(decision.choices[choice].subgoals.begin(), decision.choices[choice].subgoals.end());
    const Duration first = begin(behaviour, objects, Duration{0});
    Earliest out{first, first > Duration{0} ? state : kNone};
    if (std::ranges::any_of(behaviour.decisions, &model::Decision::binds))
      return out;  // they last for any answer
    for (Index s = 0; s < behaviour.subgoals.size() && out.at != no_bound; ++s) {
      const StateId part =
          beside.contains(s) ? kNone : ground_.find(ground_of(behaviour.subgoals[s].state, objects));
      if (part == kNone || ground_.at(part).kind == StateKind::resting) continue;
      const Earliest last = ended(part, first);
      if (last.at > out.at) out = last;
    }
    return out;
  }

  // When a value that begins no sooner than at a time may end.
  Earliest ended(StateId state, Duration from) {
    if (ground_.at(state).kind == StateKind::complex) {
      auto known = ends_.find(state);
      if (known == ends_.end()) known = ends_.emplace(state, complex(state, Duration{0}).second).first;
      return {std::max(from, known->second.at), known->second.waits};
    }
    Earliest out = begin(state, from);
    if (out.at != no_bound) out.at += ground_.at(state).bounds.shortest;
    return out;
  }

  Earliest begun(StateId state, Duration from) {
    return ground_.at(state).kind == StateKind::complex ? complex(state, from).first : begin(state, from);
  }

  // Dijkstra's shortest paths from where the timeline begins: nobody who comes later to a state leaves it sooner.
  Earliest reached(StateId goal, Duration opens) {
    const StateId initial = begun_.tokens()[begun_.begun(ground_.at(goal).state.component)].state;
    const bool rests = ground_.at(goal).kind == StateKind::resting;
    if (initial == goal) return {};
    using Entry = std::pair<Duration, StateId>;  // when it may end
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::map<StateId, Earliest> ends{{initial, {}}};
    std::set<StateId> settled;
    queue.emplace(Duration{0}, initial);
    Earliest best{no_bound, kNone};
    while (!queue.empty()) {
      const auto [at, state] = queue.top();
      queue.pop();
      if (!settled.insert(state).second) continue;
      if (at >= best.at) break;
      const StateId waits = ends[state].waits;
      for (const StateId after : std::vector<StateId>(ground_.next(state))) {
        const auto since = [&](Earliest one) { return one.waits == kNone ? Earliest{one.at, waits} : one; };
        if (after == goal) {
          const Earliest first = since(begun(after, rests ? at : std::max(at, opens)));
          if (is_sooner(first, best)) best = first;
        }
        if (settled.contains(after)) continue;
        const Earliest last = since(ended(after, at));
        const auto known = ends.find(after);
        // Unless another way leads to the goal this is what keeps it from coming about.
        if (last.at == no_bound && best.at == no_bound &&
            (best.waits == kNone || ground_.may_follow(after, goal)))
          best = last;
        if (last.at == no_bound || (known != ends.end() && known->second.at <= last.at)) continue;
        ends[after] = last;
        queue.emplace(last.at, after);
      }
    }
    return best;
  }

  // What is predicted that the state needs, or that its behaviours ask for.
  std::string awaited(StateId state) const {
    const model::State& definition = ground_.definition(state);
    std::vector<model::Variable> scope = definition.parameters;
    scope.insert(scope.end(), definition.free.begin(), definition.free.end());
    for (const model::Need& need : definition.needs)
      if (is_predicted(need.state)) return to_text(ground_.model(), need.state, scope) + " as predicted";
    return "what is predicted";
  }

  std::string reason(StateId state, const Earliest& earliest, const model::Goal& goal) const {
    const std::string waits = ground_.text(earliest.waits) + " waits for " + awaited(earliest.waits);
    if (earliest.at == no_bound)
      return ground_.text(state) + " does not come about: " + waits + ", and there is no time for it";
    return ground_.text(state) + " comes about at " + temporal::to_text(earliest.at) +
           " at the earliest, since " + waits + ", and its window closes at " +
           temporal::to_text(std::min(goal.closes, ground_.model().problem->horizon));
  }

  Ground& ground_;
  const Successors& successors_;
  const PartialPlan& begun_;
  std::map<StateId, Earliest> ends_;  // of complex states that begin at any time
  std::set<StateId> above_;           // complex states that are being looked at
  std::size_t ways_ = 0;
};

}  // namespace

std::optional<TooLate> too_late(Ground& ground, const Successors& successors, const PartialPlan& begun) {
  const auto& predicted = ground.model().problem->predicted;
  if (std::ranges::none_of(predicted, [](const auto& one) { return one.has_value(); })) return std::nullopt;
  return Times(ground, successors, begun).run();
}

}  // namespace roci::planner::timeline_htn::search
