#include <algorithm>

#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

using model::StateKind;

namespace {

bool follows(const model::Component& component, const GroundState& before, const GroundState& after) {
  return std::ranges::any_of(component.transitions, [&](const model::Transition& transition) {
    Binding binding(transition.variables.size(), kNone);
    return unify({before.component, transition.from, transition.from_terms}, before, binding) &&
           unify({after.component, transition.to, transition.to_terms}, after, binding);
  });
}

// What is known to come stands in the plan, at its times, and nothing else.
void check_predicted(const Version& version, Index c, Faults& out) {
  const model::Problem& problem = *version.model.problem;
  if (c >= problem.predicted.size() || !problem.predicted[c]) return;
  const std::vector<Value>& values = version.timelines[c];
  const std::string name = "timeline " + version.model.components[c].name + ": ";
  std::size_t next = 1;
  Binding none;
  for (const model::PredictedState& known : *problem.predicted[c]) {
    if (known.at >= problem.horizon) break;
    const std::string expected =
        to_text(version.model, known.state, {}) + " is predicted from " + to_text(known.at) + " on";
    if (next == values.size() || !unify(known.state, values[next].state, none)) {
      out.push_back(name + expected + ", and the plan has " +
                    (next == values.size() ? std::string("nothing") : version.text(values[next].state)) +
                    " there");
      return;
    }
    if (!version.network.implies(0, values[next].start, known.at, known.at))
      out.push_back(name + expected + ", and in the plan it comes at " +
                    to_text(version.network.between(0, values[next].start).lower) + " to " +
                    to_text(version.network.between(0, values[next].start).upper));
    ++next;
  }
  if (next < values.size())
    out.push_back(name + "the plan has " + version.text(values[next].state) + ", which nothing predicts");
}

void check_values(const Version& version, Index c, Faults& out) {
  const model::Component& component = version.model.components[c];
  const std::vector<Value>& values = version.timelines[c];
  const auto fault = [&](const std::string& what) {
    out.push_back("timeline " + component.name + ": " + what);
  };
  if (values.empty()) return fault("the plan does not have it");
  Binding none;
  if (!unify(*version.model.problem->initial[c], values.front().state, none))
    fault("it begins with " + version.text(values.front().state) + ", not as the problem says, with " +
          to_text(version.model, *version.model.problem->initial[c], {}));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const GroundState& state = values[i].state;
    const StateKind kind = version.definition(state).kind;
    if (!exists(version.model, state))
      fault("there is no state " + version.text(state) +
            ": what its 'where' or its duration says does not hold");
    if (i > 0 && kind == StateKind::error) fault("the error state " + version.text(state) + " is planned");
    if (i > 0 && !follows(component, values[i - 1].state, state))
      fault("no transition leads from " + version.text(values[i - 1].state) + " to " + version.text(state));
  }
  check_predicted(version, c, out);
  const StateKind last = version.definition(values.back().state).kind;
  if (last != StateKind::resting && (last != StateKind::error || values.size() > 1))
    fault("it ends with " + version.text(values.back().state) + ", which is no state to rest in");
}

// A simple or complex value is an activity's; only what the problem begins with is nobody's.
void check_activity_of_each(const Version& version, Index c, const std::vector<const Part*>& owner,
                            Faults& out) {
  const std::vector<Value>& values = version.timelines[c];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const StateKind kind = version.definition(values[i].state).kind;
    const bool needs_one = kind == StateKind::simple || kind == StateKind::complex;
    if (needs_one && i > 0 && owner[i] == nullptr)
      out.push_back("timeline " + version.model.components[c].name + " holds " +
                    version.text(values[i].state) + ", and no activity of the plan is it");
    if (kind == StateKind::complex || kind == StateKind::error || !exists(version.model, values[i].state))
      continue;
    const temporal::PlanActivity* activity = owner[i] == nullptr ? nullptr : owner[i]->activity;
    const model::Bounds bounds = bounds_of(version, values[i].state, activity);
    const Duration shortest = i == 0 ? Duration{0} : bounds.shortest;  // it may have begun before
    if (!version.network.implies(values[i].start, values[i].end, shortest, bounds.longest))
      out.push_back("timeline " + version.model.components[c].name + " holds " +
                    version.text(values[i].state) + " for " +
                    to_text(version.network.between(values[i].start, values[i].end).lower) + " to " +
                    to_text(version.network.between(values[i].start, values[i].end).upper) +
                    ", and it lasts " + to_text(shortest) + " to " + to_text(bounds.longest));
  }
}

void place(Version& version, Part& part, std::vector<std::vector<const Part*>>& owners, Faults& out) {
  const std::vector<Value>& values = version.timelines[part.state->component];
  const StateKind kind = version.definition(*part.state).kind;
  if (kind == StateKind::error)
    out.push_back(version.text(part) + " is an error state, and those are not planned");
  if (part.aside || kind == StateKind::error || (kind == StateKind::complex && part.within)) return;
  for (Index i = 0; i < values.size() && !part.value; ++i) {
    const bool resting = kind == StateKind::resting;
    const Part*& owner = owners[part.state->component][i];
    if (values[i].state != *part.state || (owner != nullptr && !resting)) continue;
    if (resting ? !version.network.implies(values[i].start, part.start(), Duration{0}, temporal::no_bound)
                : !version.network.same_time(values[i].start, part.start()))
      continue;
    if (!version.network.implies(part.end(), values[i].end, Duration{0}, temporal::no_bound)) continue;
    part.value = i;
    if (!resting) owner = &part;
  }
  if (!part.value)
    out.push_back(version.text(part) + " does not stand on the timeline " +
                  version.model.components[part.state->component].name + " at its time");
}

void check_command(const Version& version, const Part& part, Faults& out) {
  const temporal::PlanActivity& activity = *part.activity;
  const auto command = part.state ? version.definition(*part.state).command : std::nullopt;
  const auto fault = [&](const std::string& what) { out.push_back(version.text(part) + ": " + what); };
  if (!command) {
    if (!activity.owner.empty()) fault("it commands " + activity.owner + ", and its state has no command");
    return;
  }
  if (activity.owner != command->owner || activity.robot != command->robot ||
      activity.subsystem != command->subsystem || activity.command_name != command->name)
    return fault("its command, " + activity.command_name + " of " + activity.owner +
                 ", is not that of its state, " + command->name + " of " + command->owner);
  std::vector<temporal::Property> arguments;
  for (const model::Argument& argument : command->arguments)
    arguments.push_back({argument.name, model::text_of(version.model, argument, part.state->objects)});
  if (activity.arguments != arguments) fault("the arguments of its command are not those of its state");
}

// The point that has come of a need's pattern: free variables fit all.
bool fits(const model::Need& need, const GroundState& needing, std::size_t variables,
          const GroundState& other) {
  Binding binding = needing.objects;
  binding.resize(variables, kNone);
  return unify(need.state, other, binding);
}

}  // namespace

model::Bounds bounds_of(const Version& version, const GroundState& state,
                        const temporal::PlanActivity* activity) {
  const model::State& definition = version.definition(state);
  model::Bounds out = bounds(version.model, definition, state.objects).value_or(model::Bounds{});
  if (activity == nullptr || !definition.command) return out;
  for (const temporal::DecisionPoint& decision : version.plan.decisions)
    for (const temporal::ArgumentBinding& binding : decision.bindings) {
      const auto argument =
          std::ranges::find(definition.command->arguments, binding.argument, &model::Argument::name);
      if (binding.activity != activity->id || argument == definition.command->arguments.end() ||
          !argument->term)
        continue;
      for (const std::string& name : decision.admissible) {
        const auto object = std::ranges::find(version.model.objects, name, &model::Object::name);
        if (object == version.model.objects.end() || argument->term->object) continue;
        GroundState other = state;
        other.objects[argument->term->index] = static_cast<Index>(object - version.model.objects.begin());
        if (!exists(version.model, other)) continue;
        const model::Bounds more = *bounds(version.model, definition, other.objects);
        out.shortest = std::min(out.shortest, more.shortest);
        out.longest = std::max(out.longest, more.longest);
      }
    }
  return out;
}

void check_timelines(Version& version, Faults& out) {
  std::vector<std::vector<const Part*>> owners;
  for (Index c = 0; c < version.timelines.size(); ++c) {
    check_values(version, c, out);
    owners.emplace_back(version.timelines[c].size(), nullptr);
  }
  for (Part& part : version.parts) {
    if (part.state) place(version, part, owners, out);
    check_command(version, part, out);
    if (!part.state || version.definition(*part.state).kind != StateKind::simple ||
        !exists(version.model, *part.state))
      continue;
    const model::Bounds bounds = bounds_of(version, *part.state, part.activity);
    if (!version.network.implies(part.start(), part.end(), bounds.shortest, bounds.longest))
      out.push_back(version.text(part) + " may last other than its state does, " + to_text(bounds.shortest) +
                    " to " + to_text(bounds.longest));
  }
  for (Index c = 0; c < version.timelines.size(); ++c) check_activity_of_each(version, c, owners[c], out);
}

void check_needs(const Version& version, Faults& out) {
  for (const std::vector<Value>& timeline : version.timelines)
    for (std::size_t i = 1; i < timeline.size();
         ++i) {  // what the problem begins with is not the plan's affair
      const Value& value = timeline[i];
      const model::State& definition = version.definition(value.state);
      for (const model::Need& need : definition.needs) {
        const auto no_later = [&](TimePoint a, TimePoint b) {
          return version.network.implies(a, b, Duration{0}, temporal::no_bound);
        };
        const bool met =
            std::ranges::any_of(version.timelines[need.state.component], [&](const Value& other) {
              if (!fits(need, value.state, definition.parameters.size() + definition.free.size(),
                        other.state))
                return false;
              if (need.kind == model::NeedKind::met_by)
                return version.network.same_time(other.end, value.start);
              const bool during = need.kind == model::NeedKind::during;
              return no_later(other.start, value.start) &&
                     no_later(during ? value.end : value.start, other.end);
            });
        if (met) continue;
        std::vector<model::Variable> scope = definition.parameters;
        scope.insert(scope.end(), definition.free.begin(), definition.free.end());
        static constexpr const char* kWords[] = {"during", "at_start", "met_by"};
        out.push_back(version.text(value.state) + " needs " + kWords[static_cast<int>(need.kind)] + " " +
                      to_text(version.model, need.state, scope) +
                      ", and no value of that timeline is always so");
      }
    }
}

}  // namespace roci::planner::timeline_htn::checking
