#include <algorithm>
#include <charconv>

#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

std::optional<Seen> seen(const Version& version, const GroundState& state) {
  const auto& observed = version.definition(state).observed;
  if (!observed) return std::nullopt;
  double number = 0;
  const char *begin = observed->word.data(), *end = begin + observed->word.size();
  if (observed->word == "true" || observed->word == "false")
    return Seen{observed->timeline, observed->word == "true"};
  if (const auto read = std::from_chars(begin, end, number); read.ec == std::errc{} && read.ptr == end)
    return Seen{observed->timeline, number};
  temporal::State value{observed->word, {}};
  for (const model::Term& term : observed->terms)
    value.arguments.push_back(version.model.objects[model::object_of(term, state.objects)].name);
  return Seen{observed->timeline, value};
}

namespace {

bool fits(const Version& version, const Part& part, const model::Need& need, const GroundState& other) {
  Binding binding = part.state->objects;
  binding.resize(binding.size() + version.definition(*part.state).free.size(), kNone);
  return unify(need.state, other, binding);
}

temporal::Truth with(const temporal::Condition& condition, const Seen& seen) {
  return temporal::evaluate(condition, [&](const std::string& timeline) -> std::optional<temporal::Value> {
    if (timeline != seen.timeline) return std::nullopt;
    return seen.value;
  });
}

// Holds the condition against each value of the other timeline: none that meets the need may make it false,
// and each of the others must.
void check(const Version& version, const Part& part, const model::Need& need,
           const temporal::Condition& condition, const char* when, Faults& out) {
  const auto& needs = version.definition(*part.state).needs;
  const auto& observed = version.model.components[need.state.component].states[need.state.state].observed;
  if (!observed) return;
  const std::vector<Value>& values = version.timelines[need.state.component];
  std::vector<Seen> met;
  for (const Value& other : values)
    if (fits(version, part, need, other.state)) met.push_back(*seen(version, other.state));
  for (const Value& other : values) {
    const auto shown = seen(version, other.state);
    if (!shown || shown->timeline != observed->timeline) continue;
    const bool fits_all = std::ranges::all_of(needs, [&](const model::Need& one) {
      return one.state.component != need.state.component || one.kind == model::NeedKind::met_by ||
             fits(version, part, one, other.state);
    });
    const bool permits = with(condition, *shown) != temporal::Truth::no;
    if (fits_all && !permits)
      out.push_back(version.text(part) + ": its condition " + when + ", " + temporal::describe(condition) +
                    ", is false in " + version.text(other.state) + ", which meets its need");
    if (std::ranges::find(met, *shown) == met.end() && permits)
      out.push_back(version.text(part) + ": its condition " + when + ", " + temporal::describe(condition) +
                    ", does not wait for what it needs of " +
                    version.model.components[need.state.component].name + ": it permits " +
                    version.text(other.state));
  }
}

}  // namespace

void check_conditions(const Version& version, Faults& out) {
  for (const Part& part : version.parts) {
    if (!part.state) continue;
    for (const model::Need& need : version.definition(*part.state).needs) {
      if (need.kind == model::NeedKind::met_by) continue;
      check(version, part, need, part.activity->pre, "at its start", out);
      if (need.kind == model::NeedKind::during)
        check(version, part, need, part.activity->maintenance, "while it lasts", out);
    }
  }
}

}  // namespace roci::planner::timeline_htn::checking
