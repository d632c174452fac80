#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::model {

namespace {

template <typename Name>
std::string application(const Component& component, const State& state, std::size_t count, const Name& name) {
  std::string out = component.name + "." + state.name;
  for (std::size_t i = 0; i < count; ++i) out += (i == 0 ? "(" : ", ") + name(i);
  return count == 0 ? out : out + ")";
}

}  // namespace

bool is_predicted(const Model& model, Index component) {
  return model.problem && component < model.problem->predicted.size() &&
         model.problem->predicted[component].has_value();
}

std::string to_text(const Model& model, const GroundState& state) {
  const Component& component = model.components[state.component];
  return application(component, component.states[state.state], state.objects.size(),
                     [&](std::size_t i) { return model.objects[state.objects[i]].name; });
}

std::string to_text(const Model& model, const Pattern& pattern, const std::vector<Variable>& scope) {
  const Component& component = model.components[pattern.component];
  return application(component, component.states[pattern.state], pattern.terms.size(), [&](std::size_t i) {
    const Term& term = pattern.terms[i];
    return term.object ? model.objects[term.index].name : scope[term.index].name;
  });
}

temporal::Value value_of(const Model& model, const GroundState& state) {
  temporal::State out{model.components[state.component].states[state.state].name, {}};
  for (const Index object : state.objects) out.arguments.push_back(model.objects[object].name);
  return out;
}

const char* to_text(Layer layer) { return layer == Layer::abstract ? "abstract" : "primitive"; }

const char* to_text(StateKind kind) {
  switch (kind) {
    case StateKind::complex:
      return "complex";
    case StateKind::simple:
      return "simple";
    case StateKind::error:
      return "error";
    case StateKind::resting:
      return "default";
  }
  return "default";
}

}  // namespace roci::planner::timeline_htn::model
