#include "planner_svc/timeline_htn/extraction/plan_of.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>

namespace roci::planner::timeline_htn::extraction {

using model::Behaviour, model::NeedKind, model::StateKind, model::Term;
using search::Activity, search::Ground, search::Index, search::kNone, search::Network, search::PartialPlan,
    search::StateId, search::Token;
using temporal::ConstraintKind, temporal::Duration, temporal::FlexiblePlan, temporal::no_bound,
    temporal::PlanActivity, temporal::TemporalConstraint, temporal::TimePoint;

namespace {

constexpr double kMostAlternatives = 256;  // of one condition; above, any arguments will do

/// Makes the plan, list by list.
class Extraction {
 public:
  Extraction(const search::Search& search, const Head& head)
      : plan_(search.plan()),
        ground_(search.ground()),
        bindings_(search.bindings()),
        model_(search.ground().model()),
        head_(head),
        shown_(plan_.activities().size(), kNone),
        left_(plan_.activities().size(), false) {}

  FlexiblePlan run() {
    out_.id = head_.id;
    out_.engine = "timeline_htn";
    out_.origin = head_.origin;
    number_points();
    find_left();
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (is_shown(plan_.activities()[i])) {
        shown_[i] = static_cast<Index>(out_.activities.size());
        out_.activities.emplace_back().id = head_.prefix + std::to_string(out_.activities.size());
      }
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (shown_[i] != kNone) fill(i, out_.activities[shown_[i]]);
    add_marks();
    for (Index c = 0; c < model_.components.size(); ++c) add_tokens(c);
    add_constraints();
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (plan_.activities()[i].behaviour != kNone) add_decisions(i);
    return std::move(out_);
  }

 private:
  bool is_shown(const Activity& one) const {
    return one.state == kNone || ground_.at(one.state).kind != StateKind::resting;
  }

  // An activity with a token begins at the point at which the token does; all other points are their own.
  void number_points() {
    point_.assign(plan_.network().size(), kNone);
    for (const Activity& one : plan_.activities())
      if (one.token != kNone && is_shown(one)) same_[one.start] = plan_.tokens()[one.token].start;
    TimePoint next = 0;
    for (TimePoint p = 0; p < point_.size(); ++p)
      if (!same_.contains(p)) point_[p] = next++;
    for (const auto& [own, token] : same_) point_[own] = point_[token];
    out_.point_count = next;
  }

  temporal::Condition observed(StateId state) const {
    const auto& definition = ground_.definition(state);
    if (!definition.observed) return {};
    return temporal::compare(definition.observed->timeline, temporal::ConditionOp::eq, observed_value(state));
  }
  temporal::Value observed_value(StateId state) const {
    return seen_as(*ground_.definition(state).observed, ground_.at(state).state.objects);
  }
  temporal::Value seen_as(const model::Observed& observed, const std::vector<Index>& objects) const {
    if (observed.word == "true") return true;
    if (observed.word == "false") return false;
    char* end = nullptr;
    const double number = std::strtod(observed.word.c_str(), &end);
    if (end != observed.word.c_str() && *end == '\0') return number;
    temporal::State out{observed.word, {}};
    for (const Term& term : observed.terms)
      out.arguments.push_back(model_.objects[model::object_of(term, objects)].name);
    return out;
  }

  void fill(Index index, PlanActivity& out) {
    const Activity& one = plan_.activities()[index];
    out.start_point = point_[one.start];
    out.end_point = point_[one.end];
    out.duration_lower = one.bounds.shortest;
    out.duration_upper = one.bounds.longest;
    out.lateness = temporal::LatenessPolicy::deadline;
    if (one.parent != kNone) out.parent = out_.activities[shown_[one.parent]].id;
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
            {observed->timeline, temporal::ImpactKind::assign, moment, observed_value(state)});
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
                             temporal::ImpactWhen::at_end, seen_as(*after.observed, objects)});
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
      if (shown_[i] == kNone || !may_be_left(i)) continue;
      const Token& token = plan_.tokens()[plan_.activities()[i].token];
      const StateId after = next_state(plan_.activities()[i].token);
      if (after == kNone || ground_.at(after).kind != StateKind::resting ||
          !ground_.definition(after).observed)
        continue;
      PlanActivity mark;
      mark.id = head_.prefix + std::to_string(out_.activities.size());
      mark.name = ground_.text(after);
      mark.level = out_.activities[shown_[i]].level;
      mark.parent = out_.activities[shown_[i]].parent;
      mark.goals_served = out_.activities[shown_[i]].goals_served;
      mark.start_point = point_[token.end];
      mark.end_point = out_.point_count++;
      mark.duration_upper = Duration{0};
      mark.lateness = temporal::LatenessPolicy::deadline;
      mark.impacts.push_back({ground_.definition(after).observed->timeline, temporal::ImpactKind::assign,
                              temporal::ImpactWhen::at_end, observed_value(after)});
      marks_.emplace_back(token.end, mark.id);
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
      temporal::Condition condition = seen(one.state, need, *observed_as);
      if (need.kind == NeedKind::during) maintenance.push_back(condition);
      pre.push_back(std::move(condition));
    }
    if (!pre.empty()) out.pre = temporal::all_of(pre);
    if (!maintenance.empty()) out.maintenance = temporal::all_of(maintenance);
    if (one.token == kNone || out.owner.empty()) return;
    const StateId after = next_state(one.token);
    if (after != kNone && ground_.at(after).kind == StateKind::resting) out.post = observed(after);
  }

  // What is seen where the need is met. Its free names may be any object: all of them where they are all that is seen
  // of the state, else one after the other.
  temporal::Condition seen(StateId needing, const model::Need& need, const model::Observed& as) const {
    std::vector<Index> objects = ground_.at(needing).state.objects;
    const std::size_t bound = objects.size();
    const auto& free = ground_.definition(needing).free;
    objects.resize(bound + free.size(), kNone);
    const auto value_of = [&] {
      std::vector<Index> other;
      for (const Term& term : need.state.terms) other.push_back(model::object_of(term, objects));
      return seen_as(as, other);
    };
    std::vector<Index> open;
    for (const Term& term : as.terms) {
      const Term& name = need.state.terms[term.index];
      if (!name.object && name.index >= bound && std::ranges::find(open, name.index) == open.end())
        open.push_back(name.index);
    }
    double ways = 1;
    for (const Index name : open)
      ways *= static_cast<double>(
          std::ranges::count(model_.objects, free[name - bound].type, &model::Object::type));
    if (!open.empty() && (open.size() == as.terms.size() || ways > kMostAlternatives))
      return temporal::compare(as.timeline, temporal::ConditionOp::eq, temporal::State{as.word, {}});
    std::vector<temporal::Condition> any;
    const std::function<void(std::size_t)> each = [&](std::size_t next) {
      if (next == open.size()) {
        any.push_back(temporal::compare(as.timeline, temporal::ConditionOp::eq, value_of()));
        return;
      }
      for (Index object = 0; object < model_.objects.size(); ++object) {
        if (model_.objects[object].type != free[open[next] - bound].type) continue;
        objects[open[next]] = object;
        each(next + 1);
      }
    };
    each(0);
    return any.size() == 1 ? any.front() : temporal::any_of(any);
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
                             model::value_of(model_, ground_.at(token.state).state), point_[token.start],
                             point_[token.end]});
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
      const TimePoint from = point_[edge.from], to = point_[edge.to];
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

  // The activities below one of the partial plan, itself included.
  void below(Index activity, std::set<std::string>& ids) const {
    for (Index i = 0; i < plan_.activities().size(); ++i) {
      Index above = i;
      while (above != kNone && above != activity) above = plan_.activities()[above].parent;
      if (above == activity && shown_[i] != kNone) ids.insert(out_.activities[shown_[i]].id);
    }
  }

  // The activities that cannot start before the point.
  void behind(TimePoint point, std::set<std::string>& ids) const {
    std::vector<char> reached(plan_.network().size(), 0);
    std::vector<TimePoint> queue{point};
    reached[point] = 1;
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const Network::Edge& edge : plan_.network().edges())
        if (edge.from == queue[i] && edge.weight >= Duration{0} && reached[edge.to] == 0) {
          reached[edge.to] = 1;
          queue.push_back(edge.to);
        }
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (shown_[i] != kNone && reached[plan_.activities()[i].start] != 0)
        ids.insert(out_.activities[shown_[i]].id);
    for (const auto& [start, id] : marks_)
      if (reached[start] != 0) ids.insert(id);
  }

  Index part(Index activity, Index subgoal) const {
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (plan_.activities()[i].parent == activity && plan_.activities()[i].subgoal == subgoal) return i;
    return kNone;
  }

  void add_decisions(Index activity) {
    const Behaviour& behaviour = model_.behaviours[plan_.activities()[activity].behaviour];
    for (const model::Decision& decision : behaviour.decisions) {
      temporal::DecisionPoint out;
      out.id = out_.activities[shown_[activity]].id + "." + decision.name;
      out.resolver = decision.resolver;
      out.resolver_kind = decision.resolver_kind;
      const Index subject = decision.before.subgoal ? part(activity, *decision.before.subgoal) : activity;
      const Activity& before = plan_.activities()[subject];
      const TimePoint point = decision.before.end ? before.end : before.start;
      out.decide_before = point_[point];
      if (decision.over) {
        choose_object(activity, decision, point, out);
      } else if (decision.variable) {
        bind(activity, behaviour, *decision.variable, out);
      } else {
        choose(activity, decision, point, out);
      }
      if (!out.choices.empty() || !out.bindings.empty()) out_.decisions.push_back(std::move(out));
    }
  }

  void choose(Index activity, const model::Decision& decision, TimePoint point,
              temporal::DecisionPoint& out) const {
    std::vector<std::set<std::string>> own(decision.choices.size());
    std::set<std::string> after;
    behind(point, after);
    for (std::size_t c = 0; c < own.size(); ++c) {
      for (const Index subgoal : decision.choices[c].subgoals) below(part(activity, subgoal), own[c]);
      for (const std::string& id : own[c]) after.erase(id);
    }
    for (std::size_t c = 0; c < own.size(); ++c) {
      const model::Choice& choice = decision.choices[c];
      if (c == 0 || choice.instead) own[c].insert(after.begin(), after.end());
      out.choices.push_back({choice.name, {own[c].begin(), own[c].end()}, choice.rule});
    }
  }

  // The object that the plan reckons with first, then the others as they stand in the model.
  void choose_object(Index activity, const model::Decision& decision, TimePoint point,
                     temporal::DecisionPoint& out) const {
    std::map<Index, std::set<std::string>> others;
    for (Index i = 0; i < plan_.activities().size(); ++i) {
      const Activity& one = plan_.activities()[i];
      if (one.parent == activity && one.choice != kNone &&
          std::ranges::find(decision.subgoals, one.subgoal) != decision.subgoals.end())
        others[one.choice].insert(out_.activities[shown_[i]].id);
    }
    if (others.empty()) return;
    std::set<std::string> ids;
    for (const Index subgoal : decision.subgoals) below(part(activity, subgoal), ids);
    behind(point, ids);
    for (const auto& [object, aside] : others)
      for (const std::string& id : aside) ids.erase(id);
    const auto& objects = bindings_.at(plan_.activities()[activity].binding);
    out.choices.push_back(
        {model_.objects[objects[*decision.variable]].name, {ids.begin(), ids.end()}, temporal::Condition{}});
    for (const auto& [object, aside] : others)
      out.choices.push_back(
          {model_.objects[object].name, {aside.begin(), aside.end()}, temporal::Condition{}});
  }

  void bind(Index activity, const Behaviour& behaviour, Index variable, temporal::DecisionPoint& out) const {
    for (Index subgoal = 0; subgoal < behaviour.subgoals.size(); ++subgoal) {
      const Index index = part(activity, subgoal);
      if (index == kNone || shown_[index] == kNone) continue;
      const auto& terms = behaviour.subgoals[subgoal].state.terms;
      const auto& command = ground_.definition(plan_.activities()[index].state).command;
      if (!command) continue;
      for (const model::Argument& argument : command->arguments)
        if (argument.term && terms[argument.term->index] == Term{variable, false})
          out.bindings.push_back({out_.activities[shown_[index]].id, argument.name});
    }
    const auto& objects = bindings_.at(plan_.activities()[activity].binding);
    for (const Index object : search::admissible(ground_, behaviour, variable, objects))
      out.admissible.push_back(model_.objects[object].name);
  }

  const PartialPlan& plan_;
  const Ground& ground_;
  const search::Bindings& bindings_;
  const model::Model& model_;
  const Head& head_;
  std::vector<Index> shown_;  // activity of the plan, by activity of the partial plan
  std::vector<bool> left_;    // is above a decision that may leave undone what is planned behind it
  std::vector<TimePoint> point_;
  std::map<TimePoint, TimePoint> same_;
  std::vector<std::pair<TimePoint, std::string>> marks_;  // start in the partial plan, id
  FlexiblePlan out_;
};

}  // namespace

FlexiblePlan plan_of(const search::Search& search, const Head& head) {
  return Extraction(search, head).run();
}

}  // namespace roci::planner::timeline_htn::extraction
