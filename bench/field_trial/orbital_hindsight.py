"""What could have been had in the orbital mission with hindsight: blocked slots, failing modules and all goals known from the start.

A short flight to the first planner call gives the problem and the values of the arm; the reference scheduler then tries sets of goals, best first.
Joints that stick, loads that are heavier and latches that need tries are left out, and energy counts only where the arrays give nothing: the result is an upper
bound."""

from __future__ import annotations

import shutil
from pathlib import Path

import problem
from flights import MISSION_WORK, Flight, Programs, lay_out_mission, rehearse
from hindsight import LARGEST, Hindsight, best_subset
from orbital_reference import Scheduler
from orbital_scenarios import UPLOAD_S, Goal, Scenario


def raised(flight: Flight) -> list[Goal]:
    """What was asked for on board."""
    return [
        Goal(end.id, "ground", "replace", end.importance, int(end.utility), tuple(end.arguments.items()))
        for end in flight.goals
        if end.key.startswith("science_svc/")
    ]


class Instance:
    """One scenario with all that was to come known at the first planner call."""

    def __init__(self, programs: Programs, scenario: Scenario, goals: list[Goal], folder: Path):
        shutil.rmtree(folder, ignore_errors=True)
        # The values of that call are wanted, not its plan.
        lay_out_mission(programs.mission, folder / "orbital", {f"work: {MISSION_WORK}": "work: 1"})
        known = Scenario(scenario.seed, scenario.battery_j, [], {}, {}, scenario.ballast, [(UPLOAD_S, goal) for goal in goals])
        text = known.yaml().replace("duration_s: 37000", "duration_s: 14")
        (folder / "orbital" / "scenarios" / "known.yaml").write_text(text)
        rehearse(programs, folder / "orbital", "known", scenario.seed, folder / "flight")
        call = folder / "flight" / "planner_calls" / "1.pddl"
        self.problem = problem.parse(call.read_text())
        self.values = problem.read_values(call.with_suffix(".values"))
        for slot in scenario.blocked:
            self.problem.facts -= {("free", slot), ("free-first", slot)}
        for module in scenario.failing:
            self.problem.facts -= {("works", module)}
        self.energy_j = self.problem.numbers["battery"] if scenario.dark else None
        # One condition for each goal, in the order in which they came.
        parts = Scheduler(self.problem, self.values, None).goal
        self.conditions = dict(zip((goal.id for goal in goals), parts[1:] if parts[0] == "and" else [parts]))
        shutil.rmtree(folder)

    def solvable(self, goals: list[Goal]) -> bool | None:
        scheduler = Scheduler(self.problem, self.values, self.energy_j)
        scheduler.goal = ["and", *(self.conditions[goal.id] for goal in goals)]
        return scheduler.run().solvable


def look_back(programs: Programs, scenario: Scenario, flight: Flight, folder: Path) -> Hindsight:
    ends = {end.id: end for end in flight.goals}
    out = Hindsight(scenario.seed, flight)
    goals = [goal for _, goal in scenario.goals] + raised(flight)
    wanted = [goal for goal in goals if goal.id in ends and ends[goal.id].state not in ("recalled", "rejected")]
    soft = [goal for goal in wanted if goal.importance != "hard"]
    failed = [goal for goal in wanted if ends[goal.id].state == "failed"]
    enumerated = 0 < len(soft) <= LARGEST
    if not failed and not enumerated:
        return out
    instance = Instance(programs, scenario, wanted, folder)
    done = [goal for goal in wanted if goal.importance == "hard" and ends[goal.id].state == "achieved"]
    for goal in failed:
        out.hard[goal.id] = instance.solvable(done + [goal])
    if enumerated:
        out.achieved = sum(goal.utility for goal in soft if ends[goal.id].state == "achieved")
        out.oracle, out.best = best_subset(instance, done, soft)
    return out
