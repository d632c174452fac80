#include "tests/unit/planner_svc/timeline_htn/search/oracle.hpp"

#include <algorithm>
#include <functional>

#include "core/temporal/stn.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::Index, model::NeedKind, model::StateKind;
using temporal::Duration, temporal::no_bound, temporal::Stn, temporal::TimePoint;

namespace {

Duration number(const model::Model& model, const model::Expression& expression, Duration otherwise) {
  return expression.empty() ? otherwise : temporal::seconds(*model::evaluate(model, expression, {}));
}

}  // namespace

bool Oracle::solvable() {
  parts_.clear();
  bounds_.clear();
  asked_.clear();
  for (const model::Goal& goal : model_.problem->goals) {
    const std::size_t start = 2 * parts_.size() + 1;
    parts_.push_back({goal.state.component, goal.state.state, start, start + 1});
    bounds_.push_back({0, start, goal.opens, goal.closes});
  }
  for (std::size_t g = 0; g < model_.problem->goals.size(); ++g)
    for (const Index before : model_.problem->goals[g].after)
      bounds_.push_back({parts_[before].end, parts_[g].start, Duration{0}, no_bound});
  return decompose(0);
}

bool Oracle::allows(const std::vector<Sequence>& sequences) {
  fixed_ = &sequences;
  const bool out = solvable();
  fixed_ = nullptr;
  return out;
}

// Gives every complex part a behaviour.
bool Oracle::decompose(std::size_t next) {
  while (next < parts_.size() &&
         model_.components[parts_[next].component].states[parts_[next].state].kind != StateKind::complex)
    ++next;
  if (next == parts_.size()) {
    sequences_.assign(model_.components.size(), {});
    return add_sequences(0);
  }
  const Part whole = parts_[next];
  for (const Behaviour& behaviour : model_.behaviours) {
    if (!behaviour.achieves || behaviour.achieves->component != whole.component ||
        behaviour.achieves->state != whole.state)
      continue;
    const std::size_t parts = parts_.size(), bounds = bounds_.size(), asked = asked_.size();
    for (const model::Precondition& condition : behaviour.conditions)
      if (model::is_predicted(model_, condition.state.component)) asked_.push_back({whole.start, &condition});
    for (const model::Subgoal& subgoal : behaviour.subgoals) {
      const std::size_t start = 2 * parts_.size() + 1;
      parts_.push_back({subgoal.state.component, subgoal.state.state, start, start + 1});
      bounds_.push_back({whole.start, start, Duration{0}, no_bound});
      bounds_.push_back({start + 1, whole.end, Duration{0}, no_bound});
    }
    const auto point = [&](const model::Point& one) {
      const Part& part = one.subgoal ? parts_[parts + *one.subgoal] : whole;
      return one.end ? part.end : part.start;
    };
    for (const auto& one : behaviour.constraints)
      bounds_.push_back({point(one.from), point(one.to), number(model_, one.lower, -no_bound),
                         number(model_, one.upper, no_bound)});
    if (decompose(next + 1)) return true;
    parts_.resize(parts);
    bounds_.resize(bounds);
    asked_.resize(asked);
  }
  return false;
}

bool Oracle::add_sequences(std::size_t component) {
  if (component == model_.components.size()) return feasible();
  if (fixed_ != nullptr) {
    sequences_[component] = (*fixed_)[component];
    return add_sequences(component + 1);
  }
  Sequence sequence{model_.problem->initial[component]->state};
  if (model::is_predicted(model_, static_cast<Index>(component))) {
    for (const model::PredictedState& value : *model_.problem->predicted[component])
      if (value.at < model_.problem->horizon) sequence.push_back(value.state.state);
    sequences_[component] = sequence;
    return add_sequences(component + 1);
  }
  return extend(component, sequence);
}

bool Oracle::extend(std::size_t component, Sequence& sequence) {
  const model::Component& one = model_.components[component];
  if (one.states[sequence.back()].kind == StateKind::resting) {
    // Every simple and complex part needs a value of its own, and complex values are parts.
    bool fits = true;
    for (Index s = 0; s < one.states.size(); ++s) {
      if (one.states[s].kind == StateKind::resting) continue;
      const auto wanted = std::ranges::count_if(
          parts_, [&](const Part& part) { return part.component == component && part.state == s; });
      const auto there = std::ranges::count(sequence, s);
      fits = fits && (one.states[s].kind == StateKind::complex ? there == wanted : there >= wanted);
    }
    if (fits) {
      sequences_[component] = sequence;
      if (add_sequences(component + 1)) return true;
    }
  }
  if (sequence.size() == most_) return false;
  std::vector<Index> tried;
  for (const model::Transition& transition : one.transitions) {
    if (transition.from != sequence.back() || std::ranges::find(tried, transition.to) != tried.end())
      continue;
    tried.push_back(transition.to);
    sequence.push_back(transition.to);
    if (extend(component, sequence)) return true;
    sequence.pop_back();
  }
  return false;
}

// Tries every value for every part and need.
bool Oracle::feasible() {
  std::size_t points = 2 * parts_.size() + 1;
  std::vector<std::size_t> first(sequences_.size());  // point at which the first value of a timeline ends
  for (std::size_t c = 0; c < sequences_.size(); ++c) {
    first[c] = points;
    points += sequences_[c].size();
  }
  const auto start_of = [&](std::size_t c, std::size_t i) {
    return static_cast<TimePoint>(i == 0 ? 0 : first[c] + i - 1);
  };
  const auto end_of = [&](std::size_t c, std::size_t i) { return static_cast<TimePoint>(first[c] + i); };
  Stn network(points);
  for (TimePoint p = 1; p < points; ++p)
    if (!network.add(0, p, Duration{0}, model_.problem->horizon)) return false;
  std::vector<std::function<bool(const std::function<bool(Stn)>&, const Stn&)>> choices;
  for (std::size_t c = 0; c < sequences_.size(); ++c) {
    for (std::size_t i = 0; i < sequences_[c].size(); ++i) {
      const model::State& state = model_.components[c].states[sequences_[c][i]];
      const auto bounds = *model::bounds(model_, state, {});
      const Duration shortest = i == 0 ? Duration{0} : bounds.shortest;
      if (!network.add(start_of(c, i), end_of(c, i), shortest, bounds.longest)) return false;
      if (i == 0) continue;
      for (const model::Need& need : state.needs) {
        choices.push_back([&, c, i](const std::function<bool(Stn)>& go_on, const Stn& so_far) {
          const std::size_t d = need.state.component;
          for (std::size_t j = 0; j < sequences_[d].size(); ++j) {
            if (sequences_[d][j] != need.state.state) continue;
            Stn next = so_far;
            bool fits = false;
            if (need.kind == NeedKind::met_by) {
              fits = next.add(end_of(d, j), start_of(c, i), Duration{0}, Duration{0});
            } else {
              const TimePoint inside = need.kind == NeedKind::during ? end_of(c, i) : start_of(c, i);
              fits = next.add(start_of(d, j), start_of(c, i), Duration{0}) &&
                     next.add(inside, end_of(d, j), Duration{0});
            }
            if (fits && go_on(std::move(next))) return true;
          }
          return false;
        });
      }
    }
    if (model::is_predicted(model_, static_cast<Index>(c)))
      for (std::size_t i = 1; i < sequences_[c].size(); ++i) {
        const Duration at = (*model_.problem->predicted[c])[i - 1].at;
        if (!network.add(0, start_of(c, i), at, at)) return false;
      }
    const TimePoint last = end_of(c, sequences_[c].size() - 1);
    if (!network.add(0, last, model_.problem->horizon, model_.problem->horizon)) return false;
  }
  for (const Bound& bound : bounds_)
    if (!network.add(static_cast<TimePoint>(bound.from), static_cast<TimePoint>(bound.to), bound.lower,
                     bound.upper))
      return false;
  for (const Asked& one : asked_)
    choices.push_back([&](const std::function<bool(Stn)>& go_on, const Stn& so_far) {
      const std::size_t d = one.condition->state.component;
      const auto start = static_cast<TimePoint>(one.start);
      for (std::size_t j = 0; j < sequences_[d].size(); ++j) {
        if ((sequences_[d][j] == one.condition->state.state) == one.condition->negated) continue;
        Stn next = so_far;
        if (next.add(start_of(d, j), start, Duration{0}) && next.add(start, end_of(d, j), Duration{0}) &&
            go_on(std::move(next)))
          return true;
      }
      return false;
    });
  std::vector<std::vector<bool>> taken;
  for (const Sequence& sequence : sequences_) taken.emplace_back(sequence.size(), false);
  for (const Part& part : parts_) {
    choices.push_back([&](const std::function<bool(Stn)>& go_on, const Stn& so_far) {
      const std::size_t c = part.component;
      const bool rests = model_.components[c].states[part.state].kind == StateKind::resting;
      const auto start = static_cast<TimePoint>(part.start), end = static_cast<TimePoint>(part.end);
      for (std::size_t j = rests ? 0 : 1; j < sequences_[c].size(); ++j) {
        if (sequences_[c][j] != part.state || (!rests && taken[c][j])) continue;
        Stn next = so_far;
        const Duration slack = rests ? no_bound : Duration{0};
        if (!next.add(start_of(c, j), start, Duration{0}, slack) ||
            !next.add(end, end_of(c, j), Duration{0}, slack) || !next.add(start, end, Duration{0}))
          continue;
        taken[c][j] = taken[c][j] || !rests;
        if (go_on(std::move(next))) return true;
        if (!rests) taken[c][j] = false;
      }
      return false;
    });
  }
  std::function<bool(std::size_t, const Stn&)> choose = [&](std::size_t i, const Stn& so_far) {
    if (i == choices.size()) return true;
    return choices[i]([&](Stn next) { return choose(i + 1, next); }, so_far);
  };
  return choose(0, network);
}

}  // namespace roci::planner::timeline_htn::search
