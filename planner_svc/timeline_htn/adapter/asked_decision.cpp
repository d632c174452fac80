#include "planner_svc/timeline_htn/adapter/asked_decision.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace roci::planner::timeline_htn::adapter {

using model::Index, model::StateKind;
using temporal::DecisionPoint, temporal::FlexiblePlan, temporal::PlanActivity;

namespace {

std::set<std::string> ids_of(const DecisionPoint& point) {
  std::set<std::string> out;
  if (!point.choices.empty())
    out.insert(point.choices.front().activities.begin(), point.choices.front().activities.end());
  for (const temporal::ArgumentBinding& one : point.bindings) out.insert(one.activity);
  return out;
}

/// Is an activity with those below it.
struct Family {
  const PlanActivity& above;
  std::multimap<std::string, std::string> children;  // name, id
};

class Finding {
 public:
  Finding(search::Ground& ground, const FlexiblePlan& plan, const DecisionPoint& point)
      : ground_(ground), plan_(plan), ids_(ids_of(point)), name_(point.id.substr(point.id.rfind('.') + 1)) {
    for (const DecisionPoint& all : plan.decisions)
      for (std::size_t c = 1; c < all.choices.size(); ++c)
        beside_.insert(all.choices[c].activities.begin(), all.choices[c].activities.end());
  }

  std::optional<AskedDecision> run() {
    for (const PlanActivity& above : plan_.activities) {
      Family family{above, {}};
      bool any = false;
      for (const PlanActivity& child : plan_.activities) {
        if (child.parent != above.id) continue;
        family.children.emplace(child.name, child.id);
        any = any || ids_.contains(child.id);
      }
      if (!any) continue;
      if (auto found = in(family)) return found;
    }
    return std::nullopt;
  }

 private:
  std::optional<AskedDecision> in(const Family& family) {
    const auto& behaviours = ground_.model().behaviours;
    for (Index b = 0; b < behaviours.size(); ++b) {
      const auto decision = std::ranges::find(behaviours[b].decisions, name_, &model::Decision::name);
      if (decision == behaviours[b].decisions.end()) continue;
      const std::vector<Index> open(behaviours[b].variables.size(), search::kNone);
      for (const auto& objects : ground_.bindings(behaviours[b].variables, open, behaviours[b].where)) {
        AskedDecision out{b, static_cast<Index>(decision - behaviours[b].decisions.begin()), objects, {}};
        if (fits(family, out)) return out;
      }
    }
    return std::nullopt;
  }

  bool fits(const Family& family, AskedDecision& asked) {
    const model::Behaviour& behaviour = asked.of(ground_.model());
    if (behaviour.achieves ? family.above.name != text(*behaviour.achieves, asked.objects)
                           : family.above.name != behaviour.name)
      return false;
    for (const model::Subgoal& subgoal : behaviour.subgoals) {
      const auto& state = ground_.model().components[subgoal.state.component].states[subgoal.state.state];
      const auto [first, last] = family.children.equal_range(text(subgoal.state, asked.objects));
      if (first == last && state.kind != StateKind::resting) return false;
      asked.concerned.push_back(std::any_of(first, last, [&](const auto& child) {
        return ids_.contains(child.second) && !beside_.contains(child.second);
      }));
    }
    return std::ranges::find(asked.concerned, true) != asked.concerned.end();
  }

  std::string text(const model::Pattern& pattern, const std::vector<Index>& objects) const {
    model::GroundState out{pattern.component, pattern.state, {}};
    for (const model::Term& term : pattern.terms) out.objects.push_back(model::object_of(term, objects));
    return to_text(ground_.model(), out);
  }

  search::Ground& ground_;
  const FlexiblePlan& plan_;
  std::set<std::string> ids_, beside_;
  std::string name_;
};

}  // namespace

std::optional<AskedDecision> find_asked(search::Ground& ground, const FlexiblePlan& plan,
                                        const DecisionPoint& point) {
  return Finding(ground, plan, point).run();
}

}  // namespace roci::planner::timeline_htn::adapter
