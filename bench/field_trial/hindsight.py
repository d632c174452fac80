"""What could have been had with hindsight: rocks, windows, arrivals, losses of energy and slip known from the start.

The estimators of the mission value the ways on a map that has the hidden rocks (a short flight to the first planner
call gives the values); the reference scheduler then tries sets of goals, best first. Faults of components are not
counted: they pass. The result is an upper bound up to the noise of drives."""

from __future__ import annotations

import itertools
import math
import shutil
from dataclasses import dataclass, field
from pathlib import Path

import problem
import reference
from flights import MISSION_WORK, Flight, Programs, lay_out_mission, rehearse
from scenarios import PREDICTED_WINDOWS, UPLOAD_S, Goal, Scenario, read_pgm

MODEL_SPEED_M_S = 0.1  # mission.yaml: rover.speed_m_s
TRUE_SPEED_M_S = 0.105  # simulation.drive.wheel_speed_m_s, before slip
IDLE_W = 14  # simulation.power.idle_w
LARGEST = 4  # optional and opportunistic goals of an instance that is enumerated


@dataclass
class Hindsight:
    seed: int
    flight: Flight
    hard: dict[str, bool | None] = field(default_factory=dict)  # failed hard goals: was it achievable
    no_way: set[str] = field(default_factory=set)  # goals given up whose place no way leads to
    oracle: float | None = None  # best utility; None: not enumerated
    achieved: float = 0
    best: frozenset[str] = frozenset()  # ids


def draw_rocks(source: Path, target: Path, rocks: list[tuple[float, float, float]]) -> None:
    """The rocks' picture with more rocks: cells under one become black."""
    width, height, offset, data = read_pgm(source)
    pixels = bytearray(data)
    for x, y, radius in rocks:
        for row in range(height):
            for column in range(width):
                distance = math.hypot(column + 0.5 - x, height - 1 - row + 0.5 - y)
                if distance <= max(radius, 0.71):
                    pixels[offset + row * width + column] = 0
    target.write_bytes(bytes(pixels))


def lay_out(scenario: Scenario, mission: Path, folder: Path) -> None:
    """The mission as it truly was, all goals known at once."""
    shutil.rmtree(folder, ignore_errors=True)
    changes = {f"open: {PREDICTED_WINDOWS}": f"open: {scenario.windows}", f"work: {MISSION_WORK}": "work: 1"}
    lay_out_mission(mission, folder, changes)  # the values of that call are wanted, not its plan
    (folder / "site").unlink()
    shutil.copytree(mission / "site", folder / "site")
    draw_rocks(mission / "site" / "rocks.pgm", folder / "site" / "rocks.pgm", scenario.rocks)
    known = Scenario(
        seed=scenario.seed,
        x=scenario.x,
        y=scenario.y,
        heading=scenario.heading,
        battery_j=max(scenario.battery_j - scenario.losses_j, 0),
        slip=scenario.slip,
        rocks=[],
        windows=PREDICTED_WINDOWS,
        science=False,
        stimuli=[(UPLOAD_S, goal) for _, goal in scenario.goals],
    )
    text = known.yaml().replace("duration_s: 30000", "duration_s: 14")
    (folder / "scenarios" / "known.yaml").write_text(text)


def facts_of(goal: Goal) -> list[tuple[str, ...]]:
    if goal.kind == "photo":
        return [("sent", f"image-{goal.id}")]
    if goal.kind == "pick_sample":
        return [("picked", f"sample-{goal.id}")]
    return [("dropped", f"sample-{goal.sample}", f"place-{goal.id}")]


class Instance:
    """One scenario with all that was to come known at the first planner call."""

    def __init__(self, programs: Programs, scenario: Scenario, folder: Path):
        lay_out(scenario, programs.mission, folder / "planetary")
        rehearse(programs, folder / "planetary", "known", scenario.seed, folder / "flight")
        call = folder / "flight" / "planner_calls" / "1.pddl"
        self.problem = problem.parse(call.read_text())
        self.values = problem.read_values(call.with_suffix(".values"))
        slower = MODEL_SPEED_M_S / (TRUE_SPEED_M_S * (1 - scenario.slip))
        times = self.values.get("traverse_time", {})
        self.values["traverse_time"] = {pair: slower * seconds for pair, seconds in times.items()}
        for arrived_s, goal in scenario.goals:
            if arrived_s > UPLOAD_S:
                self._not_before(goal, arrived_s - UPLOAD_S)
        shutil.rmtree(folder)

    def _not_before(self, goal: Goal, time: float) -> None:
        """Nobody works for a goal before it is known: its image and its sample come with it."""
        image = ("available", f"image-{goal.id}")
        if image in self.problem.facts:
            self.problem.facts.remove(image)
            self.problem.timed.append((time, True, image))
        sample = next((fact for fact in self.problem.facts if fact[:2] == ("sample-at", f"sample-{goal.id}")), None)
        if sample:
            self.problem.facts.remove(sample)
            self.problem.timed.append((time, True, sample))

    def reaches(self, place: str) -> bool:
        start = next(fact[1] for fact in self.problem.facts if fact[0] == "at")
        times = self.values["traverse_time"]
        return place == start or (start, place) in reference.ways(times, times, by_energy=False)

    def solvable(self, goals: list[Goal], idle_w: float = IDLE_W) -> bool | None:
        self.problem.goals = [fact for goal in goals for fact in facts_of(goal)]
        return reference.schedule(self.problem, self.values, idle_w).solvable


def best_subset(instance: Instance, given: list[Goal], soft: list[Goal]) -> tuple[float, frozenset[str]]:
    """The set of soft goals with the highest utility for which, with the given ones, a schedule exists."""
    subsets = [subset for size in range(len(soft) + 1) for subset in itertools.combinations(soft, size)]
    subsets.sort(key=lambda subset: (-sum(goal.utility for goal in subset), len(subset)))
    for subset in subsets:
        if instance.solvable(given + list(subset)):
            return sum(goal.utility for goal in subset), frozenset(goal.id for goal in subset)
    return 0, frozenset()


def look_back(programs: Programs, scenario: Scenario, flight: Flight, folder: Path) -> Hindsight:
    ends = {end.id: end for end in flight.goals}
    out = Hindsight(scenario.seed, flight)
    wanted = [goal for _, goal in scenario.goals if goal.id in ends and ends[goal.id].state != "recalled"]
    soft = [goal for goal in wanted if goal.importance != "hard"]
    failed = [goal for goal in wanted if ends[goal.id].state == "failed"]
    given_up = [goal for goal in wanted if ends[goal.id].state in ("failed", "dropped")]
    enumerated = 0 < len(soft) <= LARGEST and not scenario.science
    if not given_up and not enumerated:
        return out
    instance = Instance(programs, scenario, folder)
    for goal in given_up:
        places = [other.id for other in wanted if other.id in (goal.id, goal.sample)]
        if not all(instance.reaches(f"place-{name}") for name in places):
            out.no_way.add(goal.id)
    done = [goal for goal in wanted if goal.importance == "hard" and ends[goal.id].state == "achieved"]
    for goal in failed:
        first = [other for other in wanted if other.id == goal.sample and other not in done]
        out.hard[goal.id] = instance.solvable(done + first + [goal])
    if enumerated:
        out.achieved = sum(goal.utility for goal in soft if ends[goal.id].state == "achieved")
        out.oracle, out.best = best_subset(instance, done, soft)
    return out
