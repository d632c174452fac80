#include "planner_svc/timeline_htn/extraction/observed.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace roci::planner::timeline_htn::extraction {

using model::Term;
using search::Ground, search::Index, search::kNone, search::StateId;

namespace {

constexpr double kMostAlternatives = 256;  // of one condition; above, any arguments will do

}  // namespace

temporal::Value observed_value(const model::Model& model, const model::Observed& observed,
                               const std::vector<Index>& objects) {
  if (observed.word == "true") return true;
  if (observed.word == "false") return false;
  char* end = nullptr;
  const double number = std::strtod(observed.word.c_str(), &end);
  if (end != observed.word.c_str() && *end == '\0') return number;
  temporal::State out{observed.word, {}};
  for (const Term& term : observed.terms)
    out.arguments.push_back(model.objects[model::object_of(term, objects)].name);
  return out;
}

temporal::Value observed_value(const Ground& ground, StateId state) {
  return observed_value(ground.model(), *ground.definition(state).observed, ground.at(state).state.objects);
}

temporal::Condition observed_condition(const Ground& ground, StateId state) {
  const auto& observed = ground.definition(state).observed;
  if (!observed) return {};
  return temporal::compare(observed->timeline, temporal::ConditionOp::eq, observed_value(ground, state));
}

temporal::Condition met_condition(const Ground& ground, StateId needing, const model::Need& need,
                                  const model::Observed& observed) {
  const model::Model& model = ground.model();
  std::vector<Index> objects = ground.at(needing).state.objects;
  const std::size_t bound = objects.size();
  const auto& free = ground.definition(needing).free;
  objects.resize(bound + free.size(), kNone);
  const auto value_of = [&] {
    std::vector<Index> other;
    for (const Term& term : need.state.terms) other.push_back(model::object_of(term, objects));
    return observed_value(model, observed, other);
  };
  std::vector<Index> open;
  for (const Term& term : observed.terms) {
    const Term& name = need.state.terms[term.index];
    if (!name.object && name.index >= bound && std::ranges::find(open, name.index) == open.end())
      open.push_back(name.index);
  }
  double ways = 1;
  for (const Index name : open)
    ways *=
        static_cast<double>(std::ranges::count(model.objects, free[name - bound].type, &model::Object::type));
  if (!open.empty() && (open.size() == observed.terms.size() || ways > kMostAlternatives))
    return temporal::compare(observed.timeline, temporal::ConditionOp::eq,
                             temporal::State{observed.word, {}});
  std::vector<temporal::Condition> any;
  const std::function<void(std::size_t)> each = [&](std::size_t next) {
    if (next == open.size()) {
      any.push_back(temporal::compare(observed.timeline, temporal::ConditionOp::eq, value_of()));
      return;
    }
    for (Index object = 0; object < model.objects.size(); ++object) {
      if (model.objects[object].type != free[open[next] - bound].type) continue;
      objects[open[next]] = object;
      each(next + 1);
    }
  };
  each(0);
  return any.size() == 1 ? any.front() : temporal::any_of(any);
}

}  // namespace roci::planner::timeline_htn::extraction
