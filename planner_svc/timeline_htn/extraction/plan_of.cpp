#include "planner_svc/timeline_htn/extraction/plan_of.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "planner_svc/timeline_htn/extraction/decision_points.hpp"
#include "planner_svc/timeline_htn/extraction/observed.hpp"

namespace roci::planner::timeline_htn::extraction {

using model::Behaviour, model::NeedKind, model::StateKind, model::Term;
using search::Activity, search::Ground, search::Index, search::kNone, search::Network, search::PartialPlan,
    search::StateId, search::Token;
using temporal::ConstraintKind, temporal::Duration, temporal::FlexiblePlan, temporal::no_bound,
    temporal::PlanActivity, temporal::TimePoint;

namespace {

/// Makes the plan, list by list.
class Extraction {
 public:
  Extraction(const search::Search& search, const Head& head)
      : search_(search),
        plan_(search.plan()),
        ground_(search.ground()),
        model_(search.ground().model()),
        head_(head),
        left_(plan_.activities().size(), false) {
    numbering_.prefix = head.prefix;
    numbering_.shown.assign(plan_.activities().size(), kNone);
  }

  FlexiblePlan run() {
    out_.id = head_.id;
    out_.engine = "timeline_htn";
    out_.origin = head_.origin;
    number_points();
    find_left();
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (is_shown(plan_.activities()[i])) {
        numbering_.shown[i] = static_cast<Index>(out_.activities.size());
        out_.activities.emplace_back().id = numbering_.id_of(i);
      }
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (numbering_.shown[i] != kNone) fill(i, out_.activities[numbering_.shown[i]]);
    add_marks();
    for (Index c = 0; c < model_.components.size(); ++c) add_tokens(c);
    add_constraints();
    out_.decisions = decision_points(search_, numbering_);
    return std::move(out_);
  }

 private:
  bool is_shown(const Activity& one) const {
    return one.state == kNone || ground_.at(one.state).kind != StateKind::resting;
  }

  // An activity with a token begins at the point at which the token does; all other points are their own.
  void number_points() {
    numbering_.points.assign(plan_.network().size(), kNone);
    std::map<TimePoint, TimePoint> same;
    for (const Activity& one : plan_.activities())
      if (one.token != kNone && is_shown(one)) same[one.start] = plan_.tokens()[one.token].start;
    TimePoint next = 0;
    for (TimePoint p = 0; p < numbering_.points.size(); ++p)
      if (!same.contains(p)) numbering_.points[p] = next++;
    for (const auto& [own, token] : same) numbering_.points[own] = numbering_.points[token];
    out_.point_count = next;
  }

  void fill(Index index, PlanActivity& out) {
    const Activity& one = plan_.activities()[index];
    out.start_point = numbering_.points[one.start];
    out.end_point = numbering_.points[one.end];
    out.duration_lower = one.bounds.shortest;
    out.duration_upper = one.bounds.longest;
    out.lateness = temporal::LatenessPolicy::deadline;
    if (one.parent != kNone) out.parent = out_.activities[numbering_.shown[one.parent]].id;
    Index root = index;
    while (plan_.activities()[root].goal == kNone && plan_.activities()[root].parent != kNone)
      root = plan_.activities()[root].parent;
    if (plan_.activities()[root].goal != kNone)
      out.goals_served = {model_.problem->goals[plan_.activities()[root].goal].id};
    if (one.state == kNone) {
      out.name = model_.behaviours[one.behaviour].name;
      out.level = model::to_text(model::Layer::abstract);
      return;
    }
    const model::GroundState& state = ground_.at(one.state).state;
    const model::State& definition = ground_.definition(one.state);
    out.name = ground_.text(one.state);
    out.level = model::to_text(model_.components[state.component].layer);
    out.contingency = definition.contingency;
    if (one.subgoal != kNone) {
      const Behaviour& behaviour = model_.behaviours[plan_.activities()[one.parent].behaviour];
      const std::string& own = behaviour.subgoals[one.subgoal].contingency;
      if (!own.empty()) out.contingency = own;
    }
    out.retries = definition.retries;
    if (definition.command) fill_command(*definition.command, state, out);
    fill_conditions(one, out);
    if (one.token != kNone) {
      fill_impacts(one, out);
    } else if (one.choice != kNone && !definition.command) {
      leave(state, out);
    }
  }

  // What is seen of its timeline while it lasts, and of the default state behind it: who looks ahead finds there what
  // brings a value about, and the executive keeps the timelines that nobody observes.
  void fill_impacts(const Activity& one, PlanActivity& out) const {
    const auto add = [&](StateId state, temporal::ImpactWhen moment) {
      const auto& observed = ground_.definition(state).observed;
      if (observed)
        out.impacts.push_back(
            {observed->timeline, temporal::ImpactKind::assign, moment, observed_value(ground_, state)});
    };
    add(one.state, temporal::ImpactWhen::during);  // gives way where the activity fails
    StateId after = next_state(one.token);
    if (may_be_left(static_cast<Index>(&one - plan_.activities().data())))
      after =
          plan_.tokens()[plan_.tokens()[one.token].before].state;  // a mark says what it has brought about
    if (after != kNone && ground_.at(after).kind == StateKind::resting)
      add(after, temporal::ImpactWhen::at_end);
  }

  // What a choice without a command leaves: a new plan begins from there. Of a command that is seen.
  void leave(const model::GroundState& state, PlanActivity& out) const {
    for (const model::Transition& transition : model_.components[state.component].transitions) {
      const model::State& after = model_.components[state.component].states[transition.to];
      if (transition.from != state.state || after.kind != StateKind::resting || !after.observed) continue;
      std::vector<Index> bound(transition.variables.size(), kNone), objects;
      bool fits = true;
      for (std::size_t i = 0; i < transition.from_terms.size() && fits; ++i) {
        const Term& term = transition.from_terms[i];
        if (!term.object && bound[term.index] == kNone) bound[term.index] = state.objects[i];
        fits = model::object_of(term, bound) == state.objects[i];
      }
      for (const Term& term : transition.to_terms) objects.push_back(model::object_of(term, bound));
      if (!fits || std::ranges::find(objects, kNone) != objects.end()) continue;
      out.impacts.push_back({after.observed->timeline, temporal::ImpactKind::assign,
                             temporal::ImpactWhen::at_end, observed_value(model_, *after.observed, objects)});
      return;
    }
  }

  // Whether a decision below a complex state may leave it undone.
  bool may_be_left(Index activity) const {
    return left_[activity] && plan_.activities()[activity].token != kNone &&
           ground_.at(plan_.activities()[activity].state).kind == StateKind::complex;
  }
  void find_left() {
    for (Index i = 0; i < plan_.activities().size(); ++i) {
      const Index behaviour = plan_.activities()[i].behaviour;
      if (behaviour == kNone ||
          std::ranges::none_of(model_.behaviours[behaviour].decisions, &model::Decision::may_end_plan))
        continue;
      for (Index above = i; above != kNone && !left_[above]; above = plan_.activities()[above].parent)
        left_[above] = true;
    }
  }

  // What such a state has brought about is an activity of its own behind it, so that it is skipped where a decision
  // leaves the state undone.
  void add_marks() {
    for (Index i = 0; i < plan_.activities().size(); ++i) {
      if (numbering_.shown[i] == kNone || !may_be_left(i)) continue;
      const Token& token = plan_.tokens()[plan_.activities()[i].token];
      const StateId after = next_state(plan_.activities()[i].token);
      if (after == kNone || ground_.at(after).kind != StateKind::resting ||
          !ground_.definition(after).observed)
        continue;
      PlanActivity mark;
      mark.id = numbering_.id(out_.activities.size());
      mark.name = ground_.text(after);
      mark.level = out_.activities[numbering_.shown[i]].level;
      mark.parent = out_.activities[numbering_.shown[i]].parent;
      mark.goals_served = out_.activities[numbering_.shown[i]].goals_served;
      mark.start_point = numbering_.points[token.end];
      mark.end_point = out_.point_count++;
      mark.duration_upper = Duration{0};
      mark.lateness = temporal::LatenessPolicy::deadline;
      mark.impacts.push_back({ground_.definition(after).observed->timeline, temporal::ImpactKind::assign,
                              temporal::ImpactWhen::at_end, observed_value(ground_, after)});
      numbering_.marks.emplace_back(token.end, mark.id);
      out_.activities.push_back(std::move(mark));
    }
  }

  void fill_command(const model::Command& command, const model::GroundState& state, PlanActivity& out) const {
    out.owner = command.owner;
    out.robot = command.robot;
    out.subsystem = command.subsystem;
    out.command_name = command.name;
    out.answer_within = command.answer_within;
    for (const model::Argument& argument : command.arguments)
      out.arguments.push_back({argument.name, model::text_of(model_, argument, state.objects)});
  }

  // What others must be seen in at the start and all the while; what is seen of its own timeline in the end.
  void fill_conditions(const Activity& one, PlanActivity& out) const {
    std::vector<temporal::Condition> pre, maintenance;
    for (const model::Need& need : ground_.definition(one.state).needs) {
      const auto& observed_as = model_.components[need.state.component].states[need.state.state].observed;
      if (need.kind == NeedKind::met_by || !observed_as) continue;
      temporal::Condition condition = met_condition(ground_, one.state, need, *observed_as);
      if (need.kind == NeedKind::during) maintenance.push_back(condition);
      pre.push_back(std::move(condition));
    }
    if (!pre.empty()) out.pre = temporal::all_of(pre);
    if (!maintenance.empty()) out.maintenance = temporal::all_of(maintenance);
    if (one.token == kNone || out.owner.empty()) return;
    const StateId after = next_state(one.token);
    if (after != kNone && ground_.at(after).kind == StateKind::resting)
      out.post = observed_condition(ground_, after);
  }

  StateId next_state(Index token) const {
    const Index component = ground_.at(plan_.tokens()[token].state).state.component;
    StateId after = kNone;
    for (Index one = plan_.current(component); one != token; one = plan_.tokens()[one].before)
      after = plan_.tokens()[one].state;
    return after;
  }

  void add_tokens(Index component) {
    std::vector<Index> values;
    for (Index token = plan_.current(component); token != kNone; token = plan_.tokens()[token].before)
      values.push_back(token);
    for (auto value = values.rbegin(); value != values.rend(); ++value) {
      const Token& token = plan_.tokens()[*value];
      out_.tokens.push_back({model_.components[component].name,
                             model::value_of(model_, ground_.at(token.state).state),
                             numbering_.points[token.start], numbering_.points[token.end]});
    }
  }

  // Joins the edges between two points to one constraint. An activity may end before its token does.
  void add_constraints() {
    std::set<std::pair<TimePoint, TimePoint>> ends;
    for (const Activity& one : plan_.activities())
      if (one.token != kNone && is_shown(one)) ends.emplace(plan_.tokens()[one.token].end, one.end);
    std::map<std::pair<TimePoint, TimePoint>, std::pair<Duration, Duration>> bounds;
    for (const Network::Edge& edge : plan_.network().edges()) {
      if (ends.contains({edge.from, edge.to})) continue;
      const TimePoint from = numbering_.points[edge.from], to = numbering_.points[edge.to];
      if (from == to) continue;
      const bool forward = from < to;
      const auto [entry, added] =
          bounds.emplace(forward ? std::pair(from, to) : std::pair(to, from), std::pair(-no_bound, no_bound));
      auto& [lower, upper] = entry->second;
      if (forward) {
        lower = std::max(lower, edge.weight);
      } else {
        upper = std::min(upper, -edge.weight);
      }
    }
    for (const auto& [points, range] : bounds) {
      auto [from, to] = points;
      auto [lower, upper] = range;
      if (upper < Duration{0} || (upper == no_bound && lower == -no_bound)) {
        std::swap(from, to);
        std::swap(lower, upper);
        lower = temporal::bounded(lower) ? -lower : -no_bound;
        upper = temporal::bounded(upper) ? -upper : no_bound;
      }
      const auto kind = from == temporal::origin_point ? ConstraintKind::window : ConstraintKind::ordering;
      out_.constraints.push_back({from, to, kind, lower, upper});
    }
  }

  const search::Search& search_;
  const PartialPlan& plan_;
  const Ground& ground_;
  const model::Model& model_;
  const Head& head_;
  Numbering numbering_;
  std::vector<bool> left_;  // is above a decision that may leave undone what is planned behind it
  FlexiblePlan out_;
};

}  // namespace

FlexiblePlan plan_of(const search::Search& search, const Head& head) {
  return Extraction(search, head).run();
}

}  // namespace roci::planner::timeline_htn::extraction
