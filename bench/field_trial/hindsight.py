"""What could have been had with hindsight: rocks, windows, arrivals, losses of energy and slip known from the start.

The estimators of the mission value the ways on a map that has the hidden rocks (a short flight to the first planner
call gives the values); the reference scheduler then tries sets of goals, best first, past the faults of components. What
science asked for in the flight counts from when it did. The result is an upper bound up to the noise of drives."""

from __future__ import annotations

import itertools
import shutil
from dataclasses import dataclass, field
from pathlib import Path

import problem
import reference
from flights import Flight, Programs, lay_out_mission, mission_work, rehearse
from scenarios import PREDICTED_WINDOWS, UPLOAD_S, Goal, Rock, Scenario

MODEL_SPEED_M_S = 0.1  # mission.yaml: rover.speed_m_s
TRUE_SPEED_M_S = 0.105  # wheel_speed_m_s of nav in simulation, before slip
IDLE_W = 14  # power.idle_w in simulation
Known = list[tuple[float, Goal]]  # with the time from which it is known
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


def lay_out(scenario: Scenario, goals: Known, rocks: list[Rock], mission: Path, folder: Path) -> None:
    """The mission as it truly was, all goals and rocks known at once."""
    shutil.rmtree(folder, ignore_errors=True)
    discs = ", ".join(f"{{x: {x}, y: {y}, radius_m: {radius}}}" for x, y, radius in rocks)
    changes = {
        f"open: {PREDICTED_WINDOWS}": f"open: {scenario.windows}",
        f"work: {mission_work(mission)}": "work: 1",  # the values of that call are wanted, not its plan
        "\nrover:\n  {": f"\nrover:\n  {{keep_out: [{discs}], ",
    }
    lay_out_mission(mission, folder, changes)
    known = Scenario(
        seed=scenario.seed,
        x=scenario.x,
        y=scenario.y,
        heading=scenario.heading,
        battery_j=max(scenario.battery_j - scenario.losses_j, 0),
        slip=scenario.slip,
        rocks=[],
        fallen=[],
        windows=PREDICTED_WINDOWS,
        science=False,
        stimuli=[(UPLOAD_S, goal) for _, goal in goals],
    )
    text = known.yaml().replace("duration_s: 30000", "duration_s: 14")
    (folder / "scenarios" / "known.yaml").write_text(text)


def finds(flight: Flight) -> Known:
    """What science asked for, and when."""
    return [
        (end.arrived_s, Goal(end.id, "science_svc", "photo", end.importance, end.utility, *end.place))
        for end in flight.goals
        if end.key.startswith("science_svc/")
    ]


def facts_of(goal: Goal) -> list[tuple[str, ...]]:
    if goal.kind == "photo":
        return [("sent", f"image-{goal.id}")]
    if goal.kind == "pick_sample":
        return [("picked", f"sample-{goal.id}")]
    return [("dropped", f"sample-{goal.sample}", f"place-{goal.id}")]


class Instance:
    """One scenario with all that was to come known at the first planner call."""

    def __init__(self, programs: Programs, scenario: Scenario, goals: Known, rocks: list[Rock], folder: Path):
        lay_out(scenario, goals, rocks, programs.mission, folder / "planetary")
        rehearse(programs, folder / "planetary", "known", scenario.seed, folder / "flight")
        call = folder / "flight" / "planner_calls" / "1.pddl"
        self.problem = problem.parse(call.read_text())
        self.values = problem.read_values(call.with_suffix(".values")).exact
        slower = MODEL_SPEED_M_S / (TRUE_SPEED_M_S * (1 - scenario.slip))
        times = self.values.get("traverse_time", {})
        self.values["traverse_time"] = {pair: slower * seconds for pair, seconds in times.items()}
        self.outages: reference.Outages = {}
        for component, failed, works in scenario.faults:
            self.outages.setdefault(component, []).append((failed - UPLOAD_S, works - UPLOAD_S))
        for arrived_s, goal in goals:
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
        return reference.schedule(self.problem, self.values, idle_w, self.outages).solvable


def best_subset(
    instance: Instance, given: list[Goal], soft: list[Goal], flown: frozenset[str] | None = None
) -> tuple[float, frozenset[str]]:
    """The set of soft goals with the highest utility for which, with the given ones, a schedule exists; `flown`: ids of a
    set that was achieved, of which nobody need ask."""
    subsets = [subset for size in range(len(soft) + 1) for subset in itertools.combinations(soft, size)]
    subsets.sort(key=lambda subset: (-sum(goal.utility for goal in subset), len(subset)))
    for subset in subsets:
        ids = frozenset(goal.id for goal in subset)
        if ids == flown or instance.solvable(given + list(subset)):
            return sum(goal.utility for goal in subset), ids
    return 0, frozenset()


def look_back(programs: Programs, scenario: Scenario, flight: Flight, folder: Path) -> Hindsight:
    ends = {end.id: end for end in flight.goals}
    out = Hindsight(scenario.seed, flight)
    goals = scenario.goals + finds(flight)
    wanted = [goal for _, goal in goals if goal.id in ends and ends[goal.id].state != "recalled"]
    soft = [goal for goal in wanted if goal.importance != "hard"]
    failed = [goal for goal in wanted if ends[goal.id].state == "failed"]
    given_up = [goal for goal in wanted if ends[goal.id].state in ("failed", "dropped")]
    enumerated = 0 < len(soft) <= LARGEST
    if not given_up and not enumerated:
        return out
    instance = Instance(programs, scenario, goals, scenario.rocks, folder)
    buried = instance
    if scenario.fallen:
        buried = Instance(programs, scenario, goals, scenario.rocks + scenario.fallen, folder)
    for goal in given_up:
        places = [other.id for other in wanted if other.id in (goal.id, goal.sample)]
        if not all(buried.reaches(f"place-{name}") for name in places):
            out.no_way.add(goal.id)
    done = [goal for goal in wanted if goal.importance == "hard" and ends[goal.id].state == "achieved"]
    for goal in failed:
        first = [other for other in wanted if other.id == goal.sample and other not in done]
        out.hard[goal.id] = instance.solvable(done + first + [goal])
    if enumerated:
        out.achieved = sum(goal.utility for goal in soft if ends[goal.id].state == "achieved")
        out.oracle, out.best = best_subset(instance, done, soft)
    return out
