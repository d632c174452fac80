#include "tests/unit/planner_svc/temporal_pddl/validate/oracle.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace roci::planner::temporal_pddl::validate {

namespace {

bool holds(const std::vector<Clause>& clauses, FactSet facts) {
  return std::all_of(clauses.begin(), clauses.end(), [&](const Clause& clause) {
    return (clause.yes & facts) != 0 || (clause.no & ~facts) != 0;
  });
}

struct Snap {
  int time;
  int step;  // -1: a timed fact
  const SnapAction* action;
};

struct Footprint {
  int time;
  int step;
  FactSet reads;
  FactSet adds;
  FactSet deletes;
  bool reads_number;
  NumberEffect number;
};

Footprint footprint(const Snap& snap, FactSet before) {
  const SnapAction& a = *snap.action;
  FactSet reads = a.trigger;
  for (const Clause& clause : a.conditions) reads |= clause.yes | clause.no;
  const FactSet adds = a.adds | ((a.trigger & before) != 0 ? a.triggered_adds : 0);
  return {snap.time, snap.step, reads, adds, a.deletes, a.needs_number, a.number};
}

bool disturbs(const Footprint& a, const Footprint& b) {
  if ((a.reads & (b.adds | b.deletes)) != 0 || (a.adds & b.deletes) != 0) return true;
  if (a.number != NumberEffect::none && b.reads_number) return true;
  return a.number == NumberEffect::assign && b.number != NumberEffect::none;
}

std::string at(const std::string& kind, int time) {
  std::string digits = std::to_string(time % 1000);
  return kind + "@" + std::to_string(time / 1000) + "." + std::string(3 - digits.size(), '0') + digits;
}

}  // namespace

std::set<std::string> judge(const SmallCase& small, int epsilon) {
  std::set<std::string> found;
  int last = 0;
  for (const SmallStep& step : small.plan) {
    const SmallAction& action = small.actions[step.action];
    last = std::max(last, step.start + (action.durative ? step.duration : 0));
    if (action.durative && (step.duration < action.least || step.duration > action.most)) {
      found.insert(at("time", step.start));
    }
  }
  std::vector<SnapAction> timed(small.timed_facts.size());
  std::vector<Footprint> footprints;
  std::set<int> broken;
  FactSet facts = small.initial;
  for (const SmallTimedFact& fact : small.timed_facts) {  // those at 0 are part of the initial state
    if (fact.time > 0) continue;
    facts &= ~(FactSet{1} << fact.fact);
    if (fact.value) facts |= FactSet{1} << fact.fact;
  }
  int number = 0;
  for (int now = 0; now <= last; ++now) {
    std::vector<Snap> snaps;
    for (std::size_t i = 0; i < timed.size(); ++i) {
      const SmallTimedFact& fact = small.timed_facts[i];
      (fact.value ? timed[i].adds : timed[i].deletes) = FactSet{1} << fact.fact;
      if (fact.time == now && now > 0) snaps.push_back({now, -1, &timed[i]});
    }
    for (int i = 0; i < static_cast<int>(small.plan.size()); ++i) {
      const SmallStep& step = small.plan[i];
      const SmallAction& action = small.actions[step.action];
      if (step.start == now) snaps.push_back({now, i, &action.start});
      if (action.durative && step.start + step.duration == now) snaps.push_back({now, i, &action.end});
    }
    FactSet adds = 0;
    FactSet deletes = 0;
    int assigned = number;
    int increase = 0;
    for (const Snap& snap : snaps) {
      if (!holds(snap.action->conditions, facts)) found.insert(at("condition", now));
      if (snap.action->needs_number && number < 0) found.insert(at("condition", now));
      const Footprint print = footprint(snap, facts);
      for (const Footprint& other : footprints) {
        const bool near = now - other.time < epsilon && (print.step >= 0 || other.step >= 0);
        if (near && (disturbs(print, other) || disturbs(other, print))) found.insert(at("interference", now));
      }
      footprints.push_back(print);
      deletes |= print.deletes & ~print.adds;
      adds |= print.adds;
      if (snap.action->number == NumberEffect::assign) assigned = snap.action->operand;
      if (snap.action->number == NumberEffect::increase) increase += snap.action->operand;
    }
    facts = (facts & ~deletes) | adds;
    number = assigned + increase;
    for (int i = 0; i < static_cast<int>(small.plan.size()); ++i) {
      const SmallStep& step = small.plan[i];
      const SmallAction& action = small.actions[step.action];
      const bool inside = action.durative && step.start <= now && now < step.start + step.duration;
      if (!inside || holds(action.over_all, facts)) continue;
      if (broken.insert(i).second) found.insert(at("invariant", now));  // told once per step
    }
  }
  if (!holds(small.goal, facts)) found.insert(at("goal", last));
  return found;
}

}  // namespace roci::planner::temporal_pddl::validate
