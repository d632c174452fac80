#include "tests/unit/core/temporal/timelines/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roci::temporal::timelines::oracle {
namespace {

std::int64_t millionths(double number) { return std::llround(number * 1e6); }

/// Is one thing that happens; `rank` puts assignments before all else.
struct Happening {
  int rank = 0;
  TaskId task = 0;
  std::size_t order = 0;
  ImpactKind kind = ImpactKind::delta;
  std::int64_t amount = 0;
};

void act(std::vector<Happening> happenings, std::int64_t& value, std::int64_t& rate) {
  std::ranges::sort(happenings, [](const Happening& a, const Happening& b) {
    return std::tie(a.rank, a.task, a.order) < std::tie(b.rank, b.task, b.order);
  });
  for (const Happening& it : happenings) {
    if (it.kind == ImpactKind::assign) value = it.amount;
    if (it.kind == ImpactKind::delta) value += it.amount;
    if (it.kind == ImpactKind::rate) rate += it.amount;
  }
}

bool breaks(const Definition& definition, const Constraint& constraint, std::int64_t value) {
  if (definition.kind == Kind::state) return (constraint.states >> (value / 1'000'000) & 1) == 0;
  return (std::isfinite(constraint.lowest) && value < millionths(constraint.lowest)) ||
         (std::isfinite(constraint.highest) && value > millionths(constraint.highest));
}

bool asked(const Constraint& constraint, const Placed& task, std::int64_t t, Side side) {
  const bool point = task.start == task.end;
  switch (constraint.phase) {
    case Phase::pre:
      return t == task.start && side == Side::between;
    case Phase::post:
      return t == task.end && side == (point ? Side::after : Side::between);
    case Phase::maintenance:
      break;
  }
  if (point || t < task.start || t > task.end) return false;
  return (t > task.start || side == Side::after) && (t < task.end || side == Side::before);
}

}  // namespace

std::vector<std::array<std::int64_t, 3>> World::values(Index timeline) const {
  std::vector<std::array<std::int64_t, 3>> values;
  std::int64_t value = millionths(definitions[timeline].initial);
  std::int64_t rate = 0;
  for (std::int64_t t = 0; t <= kEnd; ++t) {
    std::vector<Happening> ends;
    std::vector<Happening> starts;
    for (const auto& [id, task] : tasks) {
      const bool point = task.start == task.end;
      for (std::size_t i = 0; i < task.footprint.impacts.size(); ++i) {
        const Impact& impact = task.footprint.impacts[i];
        if (impact.timeline != timeline) continue;
        // In the world's unit of time, the microsecond, a rate of 1e6 per second is 1.
        const std::int64_t amount =
            impact.kind == ImpactKind::rate ? std::llround(impact.amount) : millionths(impact.amount);
        const int rank = impact.kind == ImpactKind::assign ? 0 : 1;
        const bool during = impact.moment == ImpactWhen::during;
        if (during && point) continue;
        if (impact.moment != ImpactWhen::at_end && t == task.start)
          starts.push_back({rank, id, i, impact.kind, amount});
        if (impact.moment != ImpactWhen::at_start && t == task.end)
          (point ? starts : ends)
              .push_back({rank, id, i + (point ? 1000 : 0), impact.kind, during ? -amount : amount});
      }
    }
    std::array<std::int64_t, 3> now{value, 0, 0};
    act(ends, value, rate);
    now[1] = value;
    act(starts, value, rate);
    if (const auto seen = observations.find({timeline, t}); seen != observations.end())
      value = millionths(seen->second);
    now[2] = value;
    values.push_back(now);
    value += rate;
  }
  return values;
}

std::set<Breach> World::breaches() const {
  std::set<Breach> breaches;
  for (Index line = 0; line < definitions.size(); ++line) {
    const Definition& definition = definitions[line];
    Constraint range{.timeline = line, .lowest = definition.lowest, .highest = definition.highest};
    if (definition.kind == Kind::atomic) range.lowest = 0;
    if (definition.kind == Kind::atomic) range.highest = 1;
    if (definition.kind == Kind::state) range.states = ~std::uint64_t{0};
    const auto all = values(line);
    for (std::int64_t t = 0; t <= kEnd; ++t)
      for (const Side side : {Side::before, Side::between, Side::after}) {
        const std::int64_t value = all[static_cast<std::size_t>(t)][static_cast<std::size_t>(side)];
        if (breaks(definition, range, value)) breaches.insert({line, std::nullopt, 0, t, side});
        for (const auto& [id, task] : tasks)
          for (std::size_t c = 0; c < task.footprint.constraints.size(); ++c) {
            const Constraint& constraint = task.footprint.constraints[c];
            if (constraint.timeline == line && asked(constraint, task, t, side) &&
                breaks(definition, constraint, value))
              breaches.insert({line, id, c, t, side});
          }
      }
  }
  return breaches;
}

std::vector<Interval> World::valid_starts(const Footprint& footprint, Interval window) const {
  const std::set<Breach> without = breaches();
  std::vector<Interval> valid;
  for (std::int64_t start = std::max<std::int64_t>(window.earliest.count(), 0);
       start <= window.latest.count() && start + footprint.duration.count() <= kEnd; ++start) {
    World with = *this;
    with.tasks[std::numeric_limits<TaskId>::max()] = {footprint, start, start + footprint.duration.count()};
    if (!std::ranges::includes(without, with.breaches())) continue;
    if (!valid.empty() && valid.back().latest.count() == start - 1) {
      valid.back().latest = Time{start};
    } else {
      valid.push_back({Time{start}, Time{start}});
    }
  }
  return valid;
}

std::vector<Conflict> World::conflicts(Time from, Time to) const {
  std::vector<Conflict> stretches;
  for (const auto& [line, task, constraint, t, side] : breaches()) {
    const auto same =
        std::ranges::find_if(stretches, [&, l = line, k = task, c = constraint, at = t](const Conflict& it) {
          return it.timeline == l && it.task == k && it.constraint == c && it.to.count() + 1 >= at;
        });
    if (same != stretches.end()) {
      same->to = Time{t};
    } else {
      stretches.push_back({line, task, constraint, Time{t}, Time{t}});
    }
  }
  std::erase_if(stretches, [&](const Conflict& it) { return it.to < from || it.from > to; });
  std::ranges::sort(stretches, [](const Conflict& a, const Conflict& b) {
    return std::tie(a.timeline, a.from, a.task, a.constraint) <
           std::tie(b.timeline, b.from, b.task, b.constraint);
  });
  return stretches;
}

Definition Draw::definition(Kind kind) {
  Definition definition{.name = "line", .kind = kind};
  if (kind == Kind::atomic) return definition;
  if (kind == Kind::state) {
    definition.states = {"a", "b", "c"};
    definition.initial = between(0, 2);
    return definition;
  }
  if (chance(80)) definition.lowest = between(-3, 0);
  if (chance(80)) definition.highest = between(2, 8);
  definition.initial = between(0, 2);
  return definition;
}

std::vector<Definition> Draw::definitions() {
  constexpr std::array kinds{Kind::atomic,     Kind::state,           Kind::claimable,
                             Kind::cumulative, Kind::cumulative_rate, Kind::cumulative_rate};
  std::vector<Definition> all;
  const int count = between(1, 3);
  for (int i = 0; i < count; ++i) all.push_back(definition(kinds[static_cast<std::size_t>(between(0, 5))]));
  return all;
}

double Draw::observed(const Definition& definition) {
  return definition.kind == Kind::state || definition.kind == Kind::atomic ? between(0, 1)
                                                                           : between(-1, 7) / 2.0;
}

Impact Draw::impact(const std::vector<Definition>& definitions, Index timeline) {
  const Kind kind = definitions[timeline].kind;
  const auto edge = [&] { return chance(50) ? ImpactWhen::at_start : ImpactWhen::at_end; };
  const auto any = [&] { return chance(40) ? ImpactWhen::during : edge(); };
  if (kind == Kind::atomic) return {timeline, ImpactKind::delta, ImpactWhen::during, 1};
  if (kind == Kind::state) return {timeline, ImpactKind::assign, edge(), static_cast<double>(between(0, 2))};
  if (kind == Kind::claimable)
    return {timeline, ImpactKind::delta, ImpactWhen::during, static_cast<double>(between(-2, 4))};
  if (kind == Kind::cumulative_rate && chance(50))
    return {timeline, ImpactKind::rate, any(), 250'000.0 * between(-5, 5)};
  if (chance(30)) return {timeline, ImpactKind::assign, edge(), static_cast<double>(between(0, 5))};
  return {timeline, ImpactKind::delta, any(), between(-6, 6) / 2.0};
}

Constraint Draw::constraint(const std::vector<Definition>& definitions, Index timeline) {
  constexpr std::array phases{Phase::pre, Phase::maintenance, Phase::post};
  Constraint constraint{.timeline = timeline, .phase = phases[static_cast<std::size_t>(between(0, 2))]};
  if (definitions[timeline].kind == Kind::state) {
    constraint.states = static_cast<std::uint64_t>(between(1, 6));
    return constraint;
  }
  if (chance(60)) constraint.lowest = between(-2, 3);
  if (chance(60))
    constraint.highest = std::max(between(0, 6), static_cast<int>(std::max(-9.0, constraint.lowest)));
  return constraint;
}

Footprint Draw::footprint(const std::vector<Definition>& definitions, int longest) {
  Footprint footprint{.duration = Duration{chance(10) ? 0 : between(1, longest)}};
  const int impacts = between(0, 3);
  const int constraints = between(0, 2);
  const auto line = [&] { return static_cast<Index>(between(0, static_cast<int>(definitions.size()) - 1)); };
  for (int i = 0; i < impacts; ++i) footprint.impacts.push_back(impact(definitions, line()));
  for (int i = 0; i < constraints; ++i) footprint.constraints.push_back(constraint(definitions, line()));
  return footprint;
}

}  // namespace roci::temporal::timelines::oracle
