#include "planner_svc/timeline_htn/adapter/owners_values.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "planner_svc/engine/function_words.hpp"
#include "planner_svc/engine/owners_words.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"

namespace roci::planner::timeline_htn::adapter {

using engine::FunctionOutcome, engine::FunctionUse;
using model::AskedNumber, model::Index, model::Model;
using temporal::Verdict;

namespace {

std::set<AskedNumber> read_by(const search::Search& search) {
  const Model& model = search.ground().model();
  std::set<AskedNumber> out;
  const auto add = [&](search::StateId state) {
    if (state != search::kNone)
      add_asked(model, search.ground().definition(state), search.ground().at(state).state.objects, out);
  };
  for (const search::Token& token : search.plan().tokens()) add(token.state);
  for (const search::Activity& activity : search.plan().activities()) {
    add(activity.state);
    if (activity.behaviour == search::kNone) continue;
    const model::Behaviour& behaviour = model.behaviours[activity.behaviour];
    const std::vector<Index>& objects = search.bindings().at(activity.binding);
    for (const model::Test& test : behaviour.where) add_asked(model, test, objects, out);
    for (const model::SubgoalConstraint& constraint : behaviour.constraints) {
      add_asked(model, constraint.lower, objects, out);
      add_asked(model, constraint.upper, objects, out);
    }
  }
  return out;
}

std::string key_of(const engine::FunctionCall& call) { return call.module + application(call); }

std::set<std::string> keys_of(const Model& model, const std::set<AskedNumber>& numbers) {
  std::set<std::string> out;
  for (const AskedNumber& number : numbers) {
    const model::AskedNumbers& asked = *model.numbers[number.table].asked;
    engine::FunctionCall call{asked.module, asked.function, {}};
    for (const Index object : number.row) call.arguments.push_back(model.objects[object].name);
    out.insert(key_of(call));
  }
  return out;
}

// The objects of the goal, with those that a relation holds of beside one of them.
std::set<std::string> named_by(const Model& model, const model::Goal& goal) {
  std::set<Index> own;
  for (const model::Term& term : goal.state.terms) own.insert(term.index);
  std::set<std::string> out;
  for (const Index object : own) out.insert(model.objects[object].name);
  for (const model::Relation& relation : model.relations)
    for (const auto& row : relation.rows)
      if (std::ranges::any_of(row, [&](Index object) { return own.contains(object); }))
        for (const Index object : row) out.insert(model.objects[object].name);
  return out;
}

}  // namespace

std::vector<temporal::FunctionValueUse> values_of(const search::Search& search,
                                                  const temporal::FlexiblePlan& plan,
                                                  std::span<const FunctionUse> uses) {
  std::vector<temporal::FunctionValueUse> out;
  if (uses.empty()) return out;
  const std::set<std::string> read = keys_of(search.ground().model(), read_by(search));
  for (const FunctionUse& use : uses)
    if (use.answer.outcome == FunctionOutcome::value &&
        (!plan.decisions.empty() || read.contains(key_of(use.call))))
      out.push_back(engine::recorded(use));
  return out;
}

void explain(engine::Answer& answer, const Model& model, const engine::Request& request,
             std::span<const FunctionUse> uses) {
  if (answer.verdict != Verdict::unsolvable) return;
  if (const std::string doubt = engine::doubt_of(uses); !doubt.empty()) {
    answer.verdict = Verdict::timeout;
    answer.lacks_values = true;
    answer.reason = doubt + "; without that, " + answer.reason;
  }
  bool said = false;
  for (engine::BlockingGoal& blocking : answer.blocking)
    for (const model::Goal& goal : model.problem->goals) {
      if (goal.id != blocking.issuer + "/" + blocking.id) continue;
      const auto [words, proved] = engine::words_against(named_by(model, goal), request.objects, uses);
      if (words.empty()) continue;
      answer.reason += "; " + words;
      blocking.reason = words;
      blocking.proved = proved;
      said = true;
      break;
    }
  if (const std::string words = engine::denial_of(uses); !said && !words.empty() && !answer.lacks_values)
    answer.reason += "; " + words;
}

}  // namespace roci::planner::timeline_htn::adapter
