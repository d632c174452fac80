"""What could have been had in the orbital mission with hindsight: blocked slots, failing modules and all goals known from the start.

A short flight to the first planner call gives the problem and the values of the arm; the reference scheduler then tries sets of goals, best first.
Joints that stick, loads that are heavier and latches that need tries are left out, and energy counts only where the arrays give nothing: the result is an upper
bound."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import problem
from flights import Flight, Programs, lay_out_mission, mission_work, rehearse
from hindsight import LARGEST, Hindsight, best_subset
from orbital_reference import Scheduler, read
from orbital_scenarios import DURATION_S, UPLOAD_S, Goal, Scenario


def raised(flight: Flight) -> list[Goal]:
    """What was asked for on board."""
    return [
        Goal(end.id, "ground", "replace", end.importance, int(end.utility), tuple(end.arguments.items()))
        for end in flight.goals
        if end.key.startswith("science_svc/")
    ]


def told(goals: list[Goal]) -> list[tuple[int, Goal]]:
    return [(UPLOAD_S, goal) for goal in goals]


def first_call(programs: Programs, scenario: Scenario, changes: dict[str, str], folder: Path) -> Path:
    """Flies to the first planner call: its problem, beside its values. Its plan is not wanted."""
    shutil.rmtree(folder, ignore_errors=True)
    work = mission_work(programs.mission)
    lay_out_mission(programs.mission, folder / "orbital", {f"work: {work}": "work: 1", **changes})
    text = scenario.yaml().replace(f"duration_s: {DURATION_S}", "duration_s: 14")
    (folder / "orbital" / "scenarios" / "known.yaml").write_text(text)
    rehearse(programs, folder / "orbital", "known", scenario.seed, folder / "flight")
    return folder / "flight" / "planner_calls" / "1.pddl"


def constants(programs: Programs, folder: Path) -> problem.Table:
    """Exact values that hold in every flight. A motion depends on its ends and its load alone (arm_svc/README.md), so
    between the slots, and from where the arm rests, they are those of any flight; a flight asks for few of them."""
    goal = Goal("h1", "ground", "install", "hard", 1, (("module", "radar-1"), ("slot", "s3")))
    call = first_call(programs, Scenario(1, 600000, [], {}, {}, [], told([goal])), {"functions: two_accuracy": "functions: eager"}, folder)
    values = problem.read_values(call.with_suffix(".values")).exact
    shutil.rmtree(folder)
    return {name: {key: value for key, value in some.items() if "arm-here" not in key} for name, some in values.items()}


def condition(mission: str, goal: Goal) -> list:
    """What mission.yaml says under `goal` of the goal's kind: the problem leaves out what holds at the start."""
    kind = mission[mission.index(f"\n  {goal.kind}:\n", mission.index("\ngoal_kinds:\n")) :]
    formulas = re.findall(r'"([^"]*)"', re.split(r"\n {2,4}\w", kind.split("\n    goal:")[1])[0])
    for name, value in goal.arguments:
        formulas = [formula.replace(f"{{{name}}}", value) for formula in formulas]
    return ["and", *(read(formula) for formula in formulas)]


def failure_of(goal: Goal, scenario: Scenario) -> tuple[float, tuple[str, ...]] | None:
    """Seconds from the first call at which the window of such a goal closes, since its module fails then, and the fact of the window."""
    arguments = dict(goal.arguments)
    if goal.kind != "install" or arguments["module"] not in scenario.failing:
        return None
    return float(scenario.failing[arguments["module"]] - UPLOAD_S), ("allowed", arguments["module"], arguments["slot"])


def close(task: problem.Problem, time: float, fact: tuple[str, ...]) -> None:
    """From this time on the fact holds no more, whatever the problem says."""
    task.timed = [one for one in task.timed if one[2] != fact or one[0] < time]
    task.timed.append((time, False, fact))


class Instance:
    """One scenario with all that was to come known at the first planner call."""

    def __init__(self, programs: Programs, scenario: Scenario, goals: list[Goal], done: list[Goal], folder: Path):
        call = first_call(programs, Scenario(scenario.seed, scenario.battery_j, [], {}, {}, scenario.ballast, told(goals)), {}, folder)
        self.problem = problem.parse(call.read_text())
        self.values = problem.read_values(call.with_suffix(".values")).completed(programs.constants).exact
        for slot in scenario.blocked:
            self.problem.facts -= {("free", slot), ("free-first", slot)}
        mission = (programs.mission / "mission.yaml").read_text()
        self.conditions = {goal.id: condition(mission, goal) for goal in goals}
        for goal in goals:
            if closes := failure_of(goal, scenario):
                self.conditions[goal.id].remove(["works", closes[1][1]])
                if goal not in done:
                    close(self.problem, *closes)
        for module in scenario.failing:
            self.problem.facts -= {("works", module)}
        self.energy_j = self.problem.numbers["battery"] if scenario.dark else None
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
    flown = frozenset(goal.id for goal in soft if ends[goal.id].state == "achieved")
    if enumerated and len(flown) == len(soft):
        out.oracle = out.achieved = sum(goal.utility for goal in soft)
        out.best, enumerated = flown, False
    if not failed and not enumerated:
        return out
    met = [goal for goal in wanted if ends[goal.id].state == "achieved"]
    instance = Instance(programs, scenario, wanted, met, folder)
    done = [goal for goal in wanted if goal.importance == "hard" and ends[goal.id].state == "achieved"]
    for goal in failed:
        out.hard[goal.id] = instance.solvable(done + [goal])
    if enumerated:
        out.achieved = sum(goal.utility for goal in soft if ends[goal.id].state == "achieved")
        out.oracle, out.best = best_subset(instance, done, soft, flown)
    return out
