#include "planner_svc/timeline_htn/search/successors.hpp"

#include <algorithm>

#include "planner_svc/timeline_htn/search/decompositions.hpp"

namespace roci::planner::timeline_htn::search {

using model::StateKind, model::Term;

namespace {

constexpr int kTokensLookedBack = 4;
constexpr int kMostNestedNeeds = 64;  // states that need each other would go on for ever

}  // namespace

Successors::Successors(Ground& ground, Bindings& bindings, Order order)
    : ground_(&ground),
      bindings_(&bindings),
      order_(order),
      below_(std::make_unique<Decompositions>(ground, *this)) {
  const auto& behaviours = ground.model().behaviours;
  for (Index b = 0; b < behaviours.size(); ++b)
    if (behaviours[b].achieves)
      behaviours_[{behaviours[b].achieves->component, behaviours[b].achieves->state}].push_back(b);
  for (auto& [state, list] : behaviours_)
    std::ranges::stable_sort(list, std::greater{}, [&](Index b) { return behaviours[b].priority; });
}

Successors::~Successors() = default;

const std::vector<Index>& Successors::behaviours(Index component, Index state) const {
  static const std::vector<Index> none;
  const auto found = behaviours_.find({component, state});
  return found == behaviours_.end() ? none : found->second;
}

std::vector<std::vector<Index>> Successors::ways(Index index, StateId state) const {
  const model::Behaviour& behaviour = ground_->model().behaviours[index];
  const auto& objects = ground_->at(state).state.objects;
  std::vector<Index> bound(behaviour.variables.size(), kNone);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Term& term = behaviour.achieves->terms[i];
    const Index expected = term.object ? term.index : bound[term.index];
    if (expected != kNone && expected != objects[i]) return {};
    if (!term.object) bound[term.index] = objects[i];
  }
  return ground_->bindings(behaviour.variables, std::move(bound), behaviour.where);
}

bool Successors::whole(const PartialPlan& plan, const Ground& ground) {
  if (plan.urgent() != nullptr || !plan.open().empty()) return false;
  for (Index c = 0; c < ground.model().components.size(); ++c) {
    const StateKind kind = ground.at(plan.current_state(c)).kind;
    if (kind != StateKind::resting && kind != StateKind::error) return false;
    if (plan.tokens()[plan.current(c)].ended != 0) return false;
  }
  return true;
}

void Successors::of(const PartialPlan& plan, std::vector<Step>& out) {
  out.clear();
  obstacle_ = {};
  if (const Urgent* item = plan.urgent()) return urgent(plan, *item, out);
  if (plan.open().empty()) return rest(plan, out);
  for (const Index activity : candidates(plan)) place(plan, activity, out);
}

std::vector<Index> Successors::candidates(const PartialPlan& plan) {
  const auto footprint = [&](Index activity) { return ground_->footprint(plan.component(activity)); };
  std::vector<Index> ready;
  for (const Index activity : plan.open())
    if (plan.ready(activity)) ready.push_back(activity);
  std::ranges::stable_sort(ready, {}, [&](Index activity) {
    return std::pair(plan.network().earliest(plan.activities()[activity].start), activity);
  });
  if (ready.size() < 2) return ready;
  // Those that nothing outside of the set interferes with: what waits for one of them comes after it anyway.
  std::vector<Index> chosen{ready.front()};
  ComponentSet touched = footprint(ready.front());
  // Whether the activity comes after the other, or after what the other is a part of.
  const auto waits_for = [&](Index activity, Index other) {
    std::vector<Index> earlier = plan.before(activity);
    for (std::size_t i = 0; i < earlier.size(); ++i) {
      if (plan.complete(earlier[i])) continue;
      for (Index above = other; above != kNone; above = plan.activities()[above].parent)
        if (above == earlier[i]) return true;
      for (const Index more : plan.before(earlier[i]))
        if (std::ranges::find(earlier, more) == earlier.end()) earlier.push_back(more);
    }
    return false;
  };
  for (bool more = true; more;) {
    more = false;
    for (const Index activity : plan.open()) {
      if (std::ranges::find(chosen, activity) != chosen.end() || (footprint(activity) & touched) == 0)
        continue;
      if (std::ranges::any_of(chosen, [&](Index one) { return waits_for(activity, one); })) continue;
      if (std::ranges::find(ready, activity) != ready.end()) {
        chosen.push_back(activity);
        touched |= footprint(activity);
        more = true;
        continue;
      }
      // It comes once others are complete: what of these is ready must be among the chosen.
      // What else holds it up may be anything.
      const bool known = std::ranges::any_of(ready, [&](Index first) { return waits_for(activity, first); });
      for (const Index first : ready) {
        if (std::ranges::find(chosen, first) != chosen.end() || (known && !waits_for(activity, first)))
          continue;
        chosen.push_back(first);
        touched |= footprint(first);
        more = true;
      }
    }
  }
  std::ranges::stable_sort(
      chosen, {}, [&](Index activity) { return std::ranges::find(ready, activity) - ready.begin(); });
  return chosen;
}

std::vector<StateId> Successors::towards(const PartialPlan& plan, Index component, StateId goal,
                                         Index path_from, bool complex_permitted) {
  if (!detours_ && ground_->may_follow(plan.current_state(component), goal)) {
    left_out_ = true;
    return {goal};
  }
  std::vector<std::pair<Index, StateId>> found;
  for (const StateId after : std::vector<StateId>(ground_->next(plan.current_state(component)))) {
    const Index left = ground_->distance(after, goal);
    if (left == kNone || (after != goal && plan.passed(component, after, path_from))) continue;
    if (!complex_permitted && ground_->at(after).kind == StateKind::complex) continue;
    found.emplace_back(left, after);
  }
  if (order_ == Order::last_declared) std::ranges::reverse(found);
  std::ranges::stable_sort(found, {}, &std::pair<Index, StateId>::first);
  std::vector<StateId> out;
  for (const auto& [left, state] : found) {
    if (detours_ || left == found.front().first) {
      out.push_back(state);
    } else {
      left_out_ = true;
    }
  }
  return out;
}

void Successors::place(const PartialPlan& plan, Index index, std::vector<Step>& out) {
  const Activity& activity = plan.activities()[index];
  if (activity.nested) return out.push_back({StepKind::nest, index, 0, 0});
  const Index component = plan.component(index);
  const Token& current = plan.tokens()[plan.current(component)];
  const bool passing = current.cause == index;
  if (current.state == activity.state && !passing && ground_->at(activity.state).kind == StateKind::resting) {
    out.push_back({StepKind::attach, index, plan.current(component), 0});
    // It may end before it is wanted, and come again: because something asks for its end, or may do so later.
    if (current.ended == 0 && !may_go_round(component)) return;
  }
  const Index path_from =
      activity.path_from == kNone ? static_cast<Index>(plan.tokens().size()) : activity.path_from;
  const auto states = towards(plan, component, activity.state, path_from, true);
  for (const StateId state : states) out.push_back({StepKind::append, index, state, 0});
  if (may_pass(plan, activity.state, path_from, states))
    out.push_back({StepKind::pass, index, activity.state, 0});
  if (states.empty())
    obstacle_ = {Obstacle::Kind::no_path,      activity.goal, activity.state, kNone, kNone,
                 plan.current_state(component)};
  attach_back(plan, index, out);
}

// A timeline may leave a state and come back to it, since something else may have to find that state ended, or another
// one in between, earlier than it is wanted. Conditions are not to be brought about in this way.
bool Successors::may_go_round(Index component) {
  if ((ground_->footprint(component) & ground_->looked_at()) != 0) return false;
  round_left_out_ = round_left_out_ || !rounds_;
  return rounds_;
}

// Whether the wanted state may come about on the way, once, and again at its end.
bool Successors::may_pass(const PartialPlan& plan, StateId goal, Index path_from,
                          const std::vector<StateId>& states) {
  const Index component = ground_->at(goal).state.component;
  return ground_->at(goal).kind != StateKind::complex && std::ranges::find(states, goal) != states.end() &&
         !plan.passed(component, goal, path_from) && may_go_round(component);
}

// What waited for others, or is a part of what did, may be met by a default state that ended just as they did.
void Successors::attach_back(const PartialPlan& plan, Index index, std::vector<Step>& out) {
  const Activity& activity = plan.activities()[index];
  const bool waited = !plan.before(index).empty() || activity.parent != kNone;
  // What mends an error leaves no values behind that nothing asked for, so not when it is on its way already.
  const bool begun = activity.path_from != kNone && plan.is_mending(index);
  if (ground_->at(activity.state).kind != StateKind::resting || !waited || begun) return;
  Index token = plan.tokens()[plan.current(plan.component(index))].before;
  for (int back = 0; back < kTokensLookedBack && token != kNone;
       ++back, token = plan.tokens()[token].before) {
    if (plan.tokens()[token].state != activity.state) continue;
    if (detours_) {
      out.push_back({StepKind::attach, index, token, 0});
    } else {
      left_out_ = true;
    }
  }
}

void Successors::urgent(const PartialPlan& plan, const Urgent& item, std::vector<Step>& out) {
  if (item.kind == UrgentKind::decompose) return decompositions(plan, item.subject, out);
  if (item.kind == UrgentKind::need) return needs(plan, item, out);
  if (item.kind == UrgentKind::condition) return conditions(plan, item, out);
  const Index component = ground_->at(item.goal).state.component;
  const auto states = towards(plan, component, item.goal, item.path_from, false);
  for (const StateId state : states) out.push_back({StepKind::path_to_need, item.subject, state, item.need});
  if (may_pass(plan, item.goal, item.path_from, states))
    out.push_back({StepKind::pass_to_need, item.subject, item.goal, item.need});
}

void Successors::decompositions(const PartialPlan& plan, Index activity, std::vector<Step>& out) {
  const StateId state = plan.activities()[activity].state;
  const auto add = [&](Index behaviour, Index binding) {
    out.push_back({StepKind::decompose, activity, behaviour, binding});
  };
  if (state == kNone) {
    for (const auto& [behaviour, binding] : plan.mending(activity)) add(behaviour, binding);
    return;
  }
  const model::GroundState& ground = ground_->at(state).state;
  for (const Index behaviour : behaviours(ground.component, ground.state)) {
    auto all = ways(behaviour, state);
    if (order_ == Order::last_declared) std::ranges::reverse(all);
    for (const auto& objects : all)
      if (below_->derivable(behaviour, objects) && recursion_can_end(plan, activity, behaviour, objects))
        add(behaviour, bindings_->number(objects));
  }
  if (out.empty())
    obstacle_ = {Obstacle::Kind::no_behaviour, plan.activities()[activity].goal, state, kNone, kNone, kNone};
}

bool Successors::recursion_can_end(const PartialPlan& plan, Index activity, Index index,
                                   const std::vector<Index>& objects) {
  std::vector<StateId> above;
  for (Index one = activity; one != kNone; one = plan.activities()[one].parent)
    if (plan.activities()[one].state != kNone) above.push_back(plan.activities()[one].state);
  std::ranges::sort(above);
  for (const model::Subgoal& subgoal : ground_->model().behaviours[index].subgoals) {
    const model::Pattern& pattern = subgoal.state;
    const bool recursive = std::ranges::any_of(above, [&](StateId state) {
      const model::GroundState& one = ground_->at(state).state;
      return one.component == pattern.component && one.state == pattern.state;
    });
    if (!recursive) continue;
    model::GroundState part{pattern.component, pattern.state, {}};
    for (const Term& term : pattern.terms) part.objects.push_back(model::object_of(term, objects));
    const StateId state = ground_->find(part);
    if (state != kNone && !below_->derivable_without(state, above)) return false;
  }
  return true;
}

void Successors::needs(const PartialPlan& plan, const Urgent& item, std::vector<Step>& out) {
  const model::Need& need = ground_->definition(plan.tokens()[item.subject].state).needs[item.need];
  const std::vector<Index> variables = plan.need_variables(item.subject);
  const Index component = need.state.component;
  if (ground_->is_predicted(component)) {
    const Token& needing = plan.tokens()[item.subject];
    const TimePoint until = need.kind == model::NeedKind::during ? needing.end : needing.start;
    for (const Index token : still_to_come(plan, component, until))
      if (ground_->fits(plan.tokens()[token].state, need.state, variables))
        out.push_back({StepKind::need_here, item.subject, token, item.need});
    if (out.empty())
      obstacle_ = {
          Obstacle::Kind::window, plan.goal_of(needing.cause), needing.state, kNone, item.need, kNone};
    return;
  }
  const auto here = [&](Index token) {
    if (ground_->fits(plan.tokens()[token].state, need.state, variables))
      out.push_back({StepKind::need_here, item.subject, token, item.need});
  };
  const Index current = plan.current(component);
  here(current);
  const Index running = plan.tokens()[current].activity;
  if (running == kNone || plan.complete(running) ||
      ground_->at(plan.tokens()[current].state).kind != StateKind::complex)
    for (const StateId goal : ground_->reachable(plan.current_state(component), need.state, variables))
      if (goal != plan.current_state(component))
        out.push_back({StepKind::need_path, item.subject, goal, item.need});
  // A simple state that holds at another time, or one that is to end or may have to, may be left and come again.
  const StateId held = plan.current_state(component);
  int nested = 0;
  for (const Urgent* one = &item; one != nullptr; one = plan.below(*one)) ++nested;
  const bool ends = ground_->at(held).kind == StateKind::simple || plan.tokens()[current].ended != 0;
  if (nested <= kMostNestedNeeds && ground_->fits(held, need.state, variables) &&
      (ends || may_go_round(component)))
    out.push_back({StepKind::need_path, item.subject, held, item.need});
  Index token = plan.tokens()[current].before;
  for (int back = 0; back < kTokensLookedBack && token != kNone; ++back, token = plan.tokens()[token].before)
    here(token);
  if (out.empty())
    obstacle_ = {Obstacle::Kind::need,         kNone, plan.tokens()[item.subject].state, kNone, item.need,
                 plan.current_state(component)};
}

// The values of a predicted timeline that end no earlier than the point.
std::vector<Index> Successors::still_to_come(const PartialPlan& plan, Index component, TimePoint point) {
  std::vector<Index> out = plan.predicted(component);
  const auto first = std::ranges::find_if(out, [&](Index token) {
    return plan.network().earliest(plan.tokens()[token].end) >= plan.network().earliest(point);
  });
  passed_by_ = passed_by_ || first != out.begin();
  out.erase(out.begin(), first);
  return out;
}

void Successors::conditions(const PartialPlan& plan, const Urgent& item, std::vector<Step>& out) {
  const Activity& activity = plan.activities()[item.subject];
  const model::Precondition& condition =
      ground_->model().behaviours[activity.behaviour].conditions[item.need];
  for (const Index token : still_to_come(plan, condition.state.component, activity.start))
    if (ground_->fits(plan.tokens()[token].state, condition.state, bindings_->at(activity.binding)) !=
        condition.negated)
      out.push_back({StepKind::condition_here, item.subject, token, item.need});
  if (out.empty())
    obstacle_ = {Obstacle::Kind::window,
                 plan.goal_of(item.subject),
                 activity.state,
                 activity.behaviour,
                 item.need,
                 kNone};
}

void Successors::rest(const PartialPlan& plan, std::vector<Step>& out) {
  bool first = true;
  for (Index c = 0; c < ground_->model().components.size(); ++c) {
    const StateId state = plan.current_state(c);
    const StateKind kind = ground_->at(state).kind;
    const bool ended = plan.tokens()[plan.current(c)].ended != 0;
    if ((kind == StateKind::resting || kind == StateKind::error) && !ended) continue;
    if (!first && !detours_) {
      left_out_ = true;  // what the others need on their ways may have to come before this one rests
      return;
    }
    std::vector<std::pair<Index, StateId>> found;
    for (const StateId after : std::vector<StateId>(ground_->next(state))) {
      const Index left = ground_->distance_to_rest(after);
      if (left == kNone || ground_->at(after).kind == StateKind::complex) continue;
      const bool nearer = ended || left < ground_->distance_to_rest(state);
      if (nearer || (detours_ && !plan.passed_to_rest(c, after)))
        found.emplace_back(left, after);
      else
        left_out_ = true;
    }
    std::ranges::stable_sort(found, {}, &std::pair<Index, StateId>::first);
    for (const auto& [left, after] : found) out.push_back({StepKind::rest, c, after, 0});
    if (found.empty()) {
      out.clear();
      obstacle_ = {Obstacle::Kind::no_path, kNone, kNone, kNone, kNone, state};
      return;
    }
    first = false;
  }
}

}  // namespace roci::planner::timeline_htn::search
