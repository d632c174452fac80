#include "core/temporal/timelines/check.hpp"

#include <cmath>
#include <stdexcept>

#include "core/temporal/timelines/exact.hpp"

namespace roci::temporal::timelines {
namespace {

constexpr std::size_t kMostStates = 64;

std::string joined(const std::vector<std::string>& faults) {
  std::string text;
  for (const std::string& fault : faults) text += (text.empty() ? "" : "; ") + fault;
  return text;
}

std::string quoted(const std::string& name) { return "'" + name + "'"; }

bool is_state(const Definition& definition, double value) {
  return value >= 0 && value < static_cast<double>(definition.states.size()) && value == std::floor(value);
}

bool countable(double number, double most) { return std::isfinite(number) && std::abs(number) <= most; }
bool is_bound(double bound) {
  return !std::isnan(bound) && (std::isinf(bound) || std::abs(bound) <= kMostAmount);
}

/// Returns nothing, or what follows "the impact on timeline 'x' ".
const char* fault_of(const Definition& definition, const Impact& impact) {
  const bool during = impact.moment == ImpactWhen::during;
  if (impact.kind == ImpactKind::rate) {
    if (definition.kind != Kind::cumulative_rate)
      return "is a rate, which only a cumulative-rate timeline has";
    return countable(impact.amount, kMostRate) ? nullptr : "is no finite rate of at most 1e9 per second";
  }
  if (!countable(impact.amount, kMostAmount)) return "is no finite number of at most 1e15";
  if (impact.kind == ImpactKind::assign && during)
    return "assigns during the task; an assignment acts at the start or at the end";
  switch (definition.kind) {
    case Kind::atomic:
      if (impact.kind != ImpactKind::delta || !during || impact.amount != 1)
        return "is not a delta of 1 during the task, the only one that an atomic timeline has";
      return nullptr;
    case Kind::state:
      if (impact.kind != ImpactKind::assign)
        return "is not an assignment, the only one that a state timeline has";
      return is_state(definition, impact.amount) ? nullptr : "assigns none of the timeline's states";
    case Kind::claimable:
      if (impact.kind != ImpactKind::delta || !during)
        return "is not a delta during the task, the only one that a claimable timeline has";
      return nullptr;
    case Kind::cumulative:
    case Kind::cumulative_rate:
      return nullptr;
  }
  return "has no kind";
}

/// Returns nothing, or what follows "the constraint on timeline 'x' ".
const char* fault_of(const Definition& definition, const Constraint& constraint) {
  if (definition.kind == Kind::state) {
    if (std::isfinite(constraint.lowest) || std::isfinite(constraint.highest) ||
        std::isnan(constraint.lowest) || std::isnan(constraint.highest))
      return "has bounds, though the timeline has states";
    if (constraint.states == 0) return "permits no state, and so never holds";
    if (definition.states.size() < kMostStates && constraint.states >> definition.states.size() != 0)
      return "permits a state that the timeline does not have";
    return nullptr;
  }
  if (constraint.states != 0) return "names states, though the timeline has numbers";
  if (!is_bound(constraint.lowest) || !is_bound(constraint.highest))
    return "has a bound that is neither a number of at most 1e15 nor infinite";
  return constraint.lowest <= constraint.highest
             ? nullptr
             : "has its lowest value above its highest, and so never holds";
}

/// Calls `found` with each fault until it returns false.
template <class Found>
void each_fault(std::span<const Definition> definitions, const Footprint& footprint, Found found) {
  if (footprint.duration < Duration{0} || footprint.duration > kLastTime)
    if (!found("the duration", nullptr, "is negative or longer than 317 years")) return;
  for (const Impact& impact : footprint.impacts) {
    const bool there = impact.timeline < definitions.size();
    const Definition* on = there ? &definitions[impact.timeline] : nullptr;
    const char* fault = there ? fault_of(*on, impact) : "is on a timeline that is not there";
    if (fault != nullptr && !found("the impact", on, fault)) return;
  }
  for (const Constraint& constraint : footprint.constraints) {
    const bool there = constraint.timeline < definitions.size();
    const Definition* on = there ? &definitions[constraint.timeline] : nullptr;
    const char* fault = there ? fault_of(*on, constraint) : "is on a timeline that is not there";
    if (fault != nullptr && !found("the constraint", on, fault)) return;
  }
}

void check_states(const Definition& definition, const std::string& timeline,
                  std::vector<std::string>& faults) {
  if (definition.states.empty() || definition.states.size() > kMostStates)
    faults.push_back(timeline + " has " + std::to_string(definition.states.size()) +
                     " states; 1 to 64 are possible");
  else if (!is_state(definition, definition.initial))
    faults.push_back(timeline + " starts in a state that it does not have");
  if (std::isfinite(definition.lowest) || std::isfinite(definition.highest))
    faults.push_back(timeline + " has a range of numbers, though its range are its states");
  for (std::size_t i = 0; i < definition.states.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (definition.states[i] == definition.states[j])
        faults.push_back(timeline + " has the state " + quoted(definition.states[i]) + " twice");
}

}  // namespace

const char* to_string(Kind kind) {
  switch (kind) {
    case Kind::atomic:
      return "atomic";
    case Kind::state:
      return "state";
    case Kind::claimable:
      return "claimable";
    case Kind::cumulative:
      return "cumulative";
    case Kind::cumulative_rate:
      return "cumulative rate";
  }
  return "unknown";
}

std::vector<std::string> check(const Definition& definition) {
  std::vector<std::string> faults;
  const std::string timeline = "the timeline " + quoted(definition.name);
  if (definition.name.empty()) faults.emplace_back("a timeline has no name");
  if (definition.kind == Kind::state) {
    check_states(definition, timeline, faults);
    return faults;
  }
  if (!definition.states.empty())
    faults.push_back(timeline + " has states, though it is " + to_string(definition.kind));
  if (!is_bound(definition.lowest) || !is_bound(definition.highest)) {
    faults.push_back(timeline +
                     " has a range with a bound that is neither a number of at most 1e15 nor infinite");
  } else if (definition.lowest > definition.highest) {
    faults.push_back(timeline + " has a range whose lowest value is above its highest");
  } else if (!countable(definition.initial, kMostAmount)) {
    faults.push_back(timeline + " has an initial value that is no finite number of at most 1e15");
  } else if (definition.kind == Kind::atomic) {
    if (definition.initial != 0)
      faults.push_back(timeline + " is atomic and does not start at 0, which is free");
    if ((std::isfinite(definition.lowest) && definition.lowest != 0) ||
        (std::isfinite(definition.highest) && definition.highest != 1))
      faults.push_back(timeline + " is atomic and has another range than 0 to 1");
  } else if (definition.initial < definition.lowest || definition.initial > definition.highest) {
    faults.push_back(timeline + " has an initial value outside of its range");
  }
  return faults;
}

std::vector<std::string> check(std::span<const Definition> definitions, const Footprint& footprint) {
  std::vector<std::string> faults;
  each_fault(definitions, footprint, [&](const char* what, const Definition* on, const char* fault) {
    faults.push_back(what + (on ? " on the timeline " + quoted(on->name) : std::string{}) + " " + fault);
    return true;
  });
  return faults;
}

bool permitted(std::span<const Definition> definitions, const Footprint& footprint) {
  bool fine = true;
  each_fault(definitions, footprint,
             [&](const char*, const Definition*, const char*) { return fine = false; });
  return fine;
}

void refuse_faults(const Definition& definition) {
  if (const auto faults = check(definition); !faults.empty()) throw std::invalid_argument(joined(faults));
}

void refuse_faults(std::span<const Definition> definitions, const Footprint& footprint) {
  if (!permitted(definitions, footprint)) throw std::invalid_argument(joined(check(definitions, footprint)));
}

}  // namespace roci::temporal::timelines
