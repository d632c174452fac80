#include "core/temporal/timelines/effect.hpp"

#include <algorithm>

namespace roci::temporal::timelines {
namespace {

/// Adds the step to another, as if both acted at one place.
void join(Effect::Step& step, const Effect::Step& other) {
  if (other.assign) step.assign = other.assign;
  step.delta += other.delta;
  step.rate += other.rate;
}

}  // namespace

bool Effect::none() const {
  const auto nothing = [](const Step& step) { return !step.assign && step.delta == 0 && step.rate == 0; };
  return nothing(start) && nothing(end);
}

Effect effect_on(Index timeline, const Footprint& footprint) {
  Effect effect;
  effect.duration = footprint.duration.count();
  for (const Impact& impact : footprint.impacts) {
    if (impact.timeline != timeline) continue;
    Effect::Step step;
    if (impact.kind == ImpactKind::assign) step.assign = exact_amount(impact.amount);
    if (impact.kind == ImpactKind::delta) step.delta = exact_amount(impact.amount);
    if (impact.kind == ImpactKind::rate) step.rate = exact_rate(impact.amount);
    join(impact.moment == ImpactWhen::at_end ? effect.end : effect.start, step);
    if (impact.moment == ImpactWhen::during) join(effect.end, {{}, -step.delta, -step.rate});
  }
  if (effect.duration == 0) {
    join(effect.start, effect.end);
    effect.end = {};
  }
  return effect;
}

Bounds bounds_of(const Constraint& constraint) {
  return {exact_amount(constraint.lowest), exact_amount(constraint.highest), constraint.states};
}

Outside outside(const Bounds& bounds, Exact at_first, Exact rate, Stretch stretch) {
  Outside out;
  const Exact length = stretch.last - stretch.first;
  const bool first_fine = bounds.admits(at_first);
  if (bounds.states != 0 || rate == 0) {
    if (!first_fine) out.parts[out.count++] = stretch;
    return out;
  }
  if (first_fine && bounds.admits(at_first + rate * length)) return out;
  // Mirrored where it falls, the value rises from below the lowest through the bounds to above the highest.
  const Exact value = rate > 0 ? at_first : -at_first;
  const Exact rise = rate > 0 ? rate : -rate;
  const Exact lowest = rate > 0 ? bounds.lowest : -bounds.highest;
  const Exact highest = rate > 0 ? bounds.highest : -bounds.lowest;
  const Exact below = value < lowest ? (lowest - value + rise - 1) / rise : 0;  // so many steps are too low
  const Exact fine = value <= highest ? (highest - value) / rise + 1 : 0;  // from this step on it is too high
  if (below > 0)
    out.parts[out.count++] = {stretch.first,
                              stretch.first + static_cast<Micros>(std::min(below - 1, length))};
  const Exact above = std::max(below, fine);
  if (above <= length) out.parts[out.count++] = {stretch.first + static_cast<Micros>(above), stretch.last};
  return out;
}

}  // namespace roci::temporal::timelines
