#include "planner_svc/timeline_htn/extraction/decision_points.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace roci::planner::timeline_htn::extraction {

using model::Behaviour, model::Term;
using search::Activity, search::Ground, search::Index, search::kNone, search::Network, search::PartialPlan;
using temporal::DecisionPoint, temporal::Duration;

namespace {

class DecisionPoints {
 public:
  DecisionPoints(const search::Search& search, const Numbering& numbering)
      : plan_(search.plan()),
        ground_(search.ground()),
        bindings_(search.bindings()),
        model_(search.ground().model()),
        numbering_(numbering) {}

  std::vector<DecisionPoint> run() {
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (plan_.activities()[i].behaviour != kNone) add_decisions_of(i);
    return std::move(out_);
  }

 private:
  void add_decisions_of(Index activity) {
    const Behaviour& behaviour = model_.behaviours[plan_.activities()[activity].behaviour];
    for (const model::Decision& decision : behaviour.decisions) {
      DecisionPoint out;
      out.id = numbering_.id_of(activity) + "." + decision.name;
      out.resolver = decision.resolver;
      out.resolver_kind = decision.resolver_kind;
      const Index subject = decision.before.subgoal ? part(activity, *decision.before.subgoal) : activity;
      const Activity& before = plan_.activities()[subject];
      const search::TimePoint point = decision.before.end ? before.end : before.start;
      out.decide_before = numbering_.points[point];
      if (decision.over) {
        choose_object(activity, decision, point, out);
      } else if (decision.variable) {
        bind(activity, behaviour, *decision.variable, out);
      } else {
        choose(activity, decision, point, out);
      }
      if (!out.choices.empty() || !out.bindings.empty()) out_.push_back(std::move(out));
    }
  }

  void choose(Index activity, const model::Decision& decision, search::TimePoint point,
              DecisionPoint& out) const {
    std::vector<std::set<std::string>> own(decision.choices.size());
    std::set<std::string> after;
    add_behind(point, after);
    for (std::size_t c = 0; c < own.size(); ++c) {
      for (const Index subgoal : decision.choices[c].subgoals) add_below(part(activity, subgoal), own[c]);
      for (const std::string& id : own[c]) after.erase(id);
    }
    for (std::size_t c = 0; c < own.size(); ++c) {
      const model::Choice& choice = decision.choices[c];
      if (c == 0 || choice.instead) own[c].insert(after.begin(), after.end());
      out.choices.push_back({choice.name, {own[c].begin(), own[c].end()}, choice.rule});
    }
  }

  // The object that the plan reckons with first, then the others as they stand in the model.
  void choose_object(Index activity, const model::Decision& decision, search::TimePoint point,
                     DecisionPoint& out) const {
    std::map<Index, std::set<std::string>> others;
    for (Index i = 0; i < plan_.activities().size(); ++i) {
      const Activity& one = plan_.activities()[i];
      if (one.parent == activity && one.choice != kNone &&
          std::ranges::find(decision.subgoals, one.subgoal) != decision.subgoals.end())
        others[one.choice].insert(numbering_.id_of(i));
    }
    if (others.empty()) return;
    std::set<std::string> ids;
    for (const Index subgoal : decision.subgoals) add_below(part(activity, subgoal), ids);
    add_behind(point, ids);
    for (const auto& [object, aside] : others)
      for (const std::string& id : aside) ids.erase(id);
    const auto& objects = bindings_.at(plan_.activities()[activity].binding);
    out.choices.push_back(
        {model_.objects[objects[*decision.variable]].name, {ids.begin(), ids.end()}, temporal::Condition{}});
    for (const auto& [object, aside] : others)
      out.choices.push_back(
          {model_.objects[object].name, {aside.begin(), aside.end()}, temporal::Condition{}});
  }

  void bind(Index activity, const Behaviour& behaviour, Index variable, DecisionPoint& out) const {
    for (Index subgoal = 0; subgoal < behaviour.subgoals.size(); ++subgoal) {
      const Index index = part(activity, subgoal);
      if (index == kNone || numbering_.shown[index] == kNone) continue;
      const auto& terms = behaviour.subgoals[subgoal].state.terms;
      const auto& command = ground_.definition(plan_.activities()[index].state).command;
      if (!command) continue;
      for (const model::Argument& argument : command->arguments)
        if (argument.term && terms[argument.term->index] == Term{variable, false})
          out.bindings.push_back({numbering_.id_of(index), argument.name});
    }
    const auto& objects = bindings_.at(plan_.activities()[activity].binding);
    for (const Index object : search::admissible(ground_, behaviour, variable, objects))
      out.admissible.push_back(model_.objects[object].name);
  }

  Index part(Index activity, Index subgoal) const {
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (plan_.activities()[i].parent == activity && plan_.activities()[i].subgoal == subgoal) return i;
    return kNone;
  }

  // The activities below one of the partial plan, itself included.
  void add_below(Index activity, std::set<std::string>& ids) const {
    for (Index i = 0; i < plan_.activities().size(); ++i) {
      Index above = i;
      while (above != kNone && above != activity) above = plan_.activities()[above].parent;
      if (above == activity && numbering_.shown[i] != kNone) ids.insert(numbering_.id_of(i));
    }
  }

  // The activities that cannot start before the point.
  void add_behind(search::TimePoint point, std::set<std::string>& ids) const {
    std::vector<char> reached(plan_.network().size(), 0);
    std::vector<search::TimePoint> queue{point};
    reached[point] = 1;
    for (std::size_t i = 0; i < queue.size(); ++i)
      for (const Network::Edge& edge : plan_.network().edges())
        if (edge.from == queue[i] && edge.weight >= Duration{0} && reached[edge.to] == 0) {
          reached[edge.to] = 1;
          queue.push_back(edge.to);
        }
    for (Index i = 0; i < plan_.activities().size(); ++i)
      if (numbering_.shown[i] != kNone && reached[plan_.activities()[i].start] != 0)
        ids.insert(numbering_.id_of(i));
    for (const auto& [start, id] : numbering_.marks)
      if (reached[start] != 0) ids.insert(id);
  }

  const PartialPlan& plan_;
  const Ground& ground_;
  const search::Bindings& bindings_;
  const model::Model& model_;
  const Numbering& numbering_;
  std::vector<DecisionPoint> out_;
};

}  // namespace

std::vector<DecisionPoint> decision_points(const search::Search& search, const Numbering& numbering) {
  return DecisionPoints(search, numbering).run();
}

}  // namespace roci::planner::timeline_htn::extraction
