"""A scheduler that shares nothing with the planner: decides whether a problem of the planetary domain has a plan,
and how short one can be.

It enumerates every order of the stops (images, picks, drops) by dynamic programming over (done, place, arm, held), with
all labels (time, energy, radio free) that no other label beats. Images are sent first come, first served, which is best
for jobs of one length. Exact up to the separation of 1 ms, with these liberties: two activities at one place do not
overlap (the rover's stops are places of their own), and it takes the fastest way between two places.

Hindsight (hindsight.py) also counts what the robot draws while it waits: `idle_w` for the whole time, and for what the
domain charges with it (all but transmissions) only what comes on top. And it knows when components are out of order:
a drive then stands and goes on, all else begins afterwards.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from problem import INFINITY, Problem

# Durations and energies of missions/planetary/domain.pddl, which hold what the robot draws all the time.
IMAGE = (40.0, 1160.0)
PICK = (60.0, 1740.0)
DROP = (30.0, 870.0)
SEND = (120.0, 3000.0)
COMPONENT = {"drive": "nav", "move-arm": "arm", "take-image": "camera", "pick": "gripper", "drop": "gripper"}
GAP_S = 0.00101  # more than the planner's separation, so that rounding to microseconds does no harm
LABEL_LIMIT = 400000  # a problem with more is left undecided

Values = dict[tuple[str, str], float]
Outages = dict[str, list[tuple[float, float]]]  # component → from, to


class Stop(NamedTuple):
    kind: str  # image, pick, drop
    what: str
    place: str


class State(NamedTuple):
    done: int  # bits, by the index of the stop
    place: str
    pose: str
    held: str


class Label(NamedTuple):
    time: float
    energy: float  # used
    radio: float  # free from then on
    steps: tuple  # the way here, newest first: (step, (step, (… ()))), each "start: (action) [duration]"

    def beats(self, other: Label) -> bool:
        return self.time <= other.time and self.energy <= other.energy and self.radio <= other.radio


@dataclass
class Schedule:
    solvable: bool | None  # None: undecided
    makespan_s: float = INFINITY
    plan: str = ""  # in the form of the planning competitions


class Way(NamedTuple):
    seconds: float
    joules: float
    places: tuple[str, ...]


def ways(times: Values, energies: Values, by_energy: bool) -> dict[tuple[str, str], Way]:
    """Between all places, over others if that is faster; or cheaper."""
    best = {(a, b): Way(times[a, b], energies[a, b], (a, b)) for a, b in times}
    measure = (lambda way: way.joules) if by_energy else (lambda way: way.seconds)
    places = sorted({a for a, _ in times})
    for middle in places:
        for a in places:
            for b in places:
                first, second = best.get((a, middle)), best.get((middle, b))
                if first is None or second is None or middle in (a, b):
                    continue
                over = Way(
                    first.seconds + second.seconds + GAP_S, first.joules + second.joules, first.places + second.places[1:]
                )
                if (a, b) not in best or measure(over) < measure(best[a, b]):
                    best[a, b] = over
    return best


def step(start: float, action: str, duration: float) -> str:
    return f"{start:.6f}: ({action}) [{duration:.6f}]"


class Scheduler:
    """`generous`: energies are underestimated, so that no schedule means no plan. Otherwise a schedule is a plan."""

    def __init__(
        self, problem: Problem, values: dict[str, Values], generous: bool, idle_w: float = 0, outages: Outages | None = None
    ):
        self.problem = problem
        self.idle_w = idle_w
        self.outages = {component: sorted(times) for component, times in (outages or {}).items()}
        self.drive_s = values.get("traverse_time", {})
        drive_j = values.get("traverse_energy", {})
        self.ways = ways(self.drive_s, drive_j, by_energy=False)
        if generous:
            cheap = ways(self.drive_s, drive_j, by_energy=True)
            self.ways = {pair: way._replace(joules=cheap[pair].joules) for pair, way in self.ways.items()}
        self.arm_s, self.arm_j = values["arm_move_time"], values["arm_move_energy"]
        self.comm = problem.windows(("comm-window",))
        self.energy = problem.numbers["battery"] - problem.numbers["reserve"]
        self.stops, self.stored, self.possible = self._stops()
        self.labels = 0

    def _stops(self) -> tuple[list[Stop], list[str], bool]:
        """The stops that the goals need, images that only wait to be sent, and whether each goal has its stop."""
        facts = self.problem.facts
        targets = {fact[1]: fact[2] for fact in facts if fact[0] == "target"}
        some_time = facts | {fact for _, _, fact in self.problem.timed}
        samples = {fact[1]: fact[2] for fact in some_time if fact[0] == "sample-at"}
        held = self._first("holding")
        stops: set[Stop] = set()
        stored = []
        possible = True
        for goal in self.problem.goals:
            if goal in facts:
                continue
            if goal[0] == "sent" and ("have-image", goal[1]) in facts:
                stored.append(goal[1])
            elif goal[0] == "sent":
                stops.add(Stop("image", goal[1], targets[goal[1]]))
            else:
                if goal[0] == "dropped":
                    stops.add(Stop("drop", goal[1], goal[2]))
                if goal[1] != held:
                    possible = possible and goal[1] in samples
                    stops.add(Stop("pick", goal[1], samples.get(goal[1], "")))
        return sorted(stops), sorted(stored), possible

    def _first(self, name: str) -> str:
        return next((fact[1] for fact in self.problem.facts if fact[0] == name), "")

    def run(self) -> Schedule:
        if not self.possible:
            return Schedule(False)
        label: Label | None = Label(0, 0, 0, ())
        for image in self.stored:
            label = self._send(label, image) if label else None
        if label is None or not self._has_energy(label):
            return Schedule(False)
        start = State(0, self._first("at"), self._first("arm-at"), self._first("holding"))
        everything = (1 << len(self.stops)) - 1
        fronts: dict[State, list[Label]] = {start: [label]}
        queue = [(start, label)]
        best: Label | None = None
        while queue:
            state, label = queue.pop()
            if not any(label is one for one in fronts[state]):
                continue  # beaten since
            if state.done == everything:
                if best is None or max(label.time, label.radio) < max(best.time, best.radio):
                    best = label
                continue
            for following, reached in self._moves(state, label):
                if self._has_energy(reached) and self._keep(fronts, following, reached):
                    queue.append((following, reached))
            if self.labels > LABEL_LIMIT:
                break
        if best is None:
            return Schedule(None if queue else False)
        return Schedule(True, max(best.time, best.radio), self._plan(best))

    def _plan(self, label: Label) -> str:
        steps, rest = [], label.steps
        while rest:
            steps.append(rest[0])
            rest = rest[1]
        return "\n".join(sorted(steps, key=lambda line: float(line.split(":")[0]))) + "\n"

    def _has_energy(self, label: Label) -> bool:
        return label.energy + self.idle_w * max(label.time, label.radio) <= self.energy + 1e-6

    def _keep(self, fronts: dict[State, list[Label]], state: State, label: Label) -> bool:
        front = fronts.setdefault(state, [])
        if any(one.beats(label) for one in front):
            return False
        front[:] = [one for one in front if not label.beats(one)]
        front.append(label)
        self.labels += 1
        return True

    def _free(self, component: str, start: float, duration: float) -> float:
        """The first time from `start` on at which the component works for so long."""
        for failed, works in self.outages.get(component, []):
            if start + duration > failed and start < works:
                start = works
        return start

    def _drive_end(self, start: float, duration: float) -> float:
        end = start + duration
        for failed, works in self.outages.get("nav", []):
            if end > failed and start < works:
                end += works - max(start, failed)
        return end

    def _act(self, label: Label, action: str, duration: float, energy: float, start: float | None = None) -> Label:
        start = label.time if start is None else start
        component = COMPONENT[action.split(" ")[0]]
        if component == "nav":
            end = self._drive_end(start, duration)
        else:
            start = self._free(component, start, duration)
            end = start + duration
        return Label(
            end + GAP_S,
            label.energy + energy - self.idle_w * duration,
            label.radio,
            (step(start, action, duration), label.steps),
        )

    def _send(self, label: Label, image: str) -> Label | None:
        for opens, closes in self.comm:
            start = self._free("radio", max(label.time + GAP_S, label.radio, opens), SEND[0])
            if start + SEND[0] <= closes:
                steps = (step(start, f"transmit {image}", SEND[0]), label.steps)
                return Label(label.time, label.energy + SEND[1], start + SEND[0] + GAP_S, steps)
        return None

    def _turn(self, label: Label, pose: str, to: str) -> Label | None:
        if pose == to:
            return label
        if (pose, to) not in self.arm_s:
            return None
        return self._act(label, f"move-arm {pose} {to}", self.arm_s[pose, to], self.arm_j[pose, to])

    def _go(self, state: State, label: Label, place: str) -> tuple[str, Label] | None:
        """The arm's pose and the label at the place."""
        if state.place == place:
            return state.pose, label
        stowed = self._turn(label, state.pose, "stow")
        way = self.ways.get((state.place, place))
        if stowed is None or way is None:
            return None
        energy = stowed.energy + way.joules
        for a, b in zip(way.places, way.places[1:]):
            stowed = self._act(stowed, f"drive {a} {b}", self.drive_s[a, b], 0)
            energy -= self.idle_w * self.drive_s[a, b]
        return "stow", stowed._replace(energy=energy)

    def _moves(self, state: State, label: Label) -> Iterator[tuple[State, Label]]:
        for i, stop in enumerate(self.stops):
            full = stop.kind == "pick" and state.held
            if state.done >> i & 1 or full or (stop.kind == "drop" and state.held != stop.what):
                continue
            there = self._go(state, label, stop.place)
            if there is not None:
                arrived = State(state.done | 1 << i, stop.place, there[0], state.held)
                yield from self._do(stop, arrived, there[1])
        if state.held and not any(
            stop.kind == "drop" and stop.what == state.held and not state.done >> i & 1 for i, stop in enumerate(self.stops)
        ):  # nobody wants it anywhere: the gripper can be emptied for another sample
            yield from self._do(Stop("drop", state.held, state.place), state, label)

    def _do(self, stop: Stop, state: State, label: Label) -> Iterator[tuple[State, Label]]:
        if stop.kind == "image":
            for opens, closes in self.problem.windows(("available", stop.what)):
                start = self._free("camera", max(label.time, opens), IMAGE[0])
                if start + IMAGE[0] <= closes:
                    sent = self._send(self._act(label, f"take-image {stop.what} {stop.place}", *IMAGE, start), stop.what)
                    if sent is not None:
                        yield state, sent
                    return
        elif stop.kind == "pick":
            turned = self._turn(label, state.pose, "sampling")
            known = self.problem.windows(("sample-at", stop.what, stop.place))
            if turned and known:
                start = max(turned.time, known[0][0])
                picked = self._act(turned, f"pick {stop.what} {stop.place}", *PICK, start)
                yield state._replace(pose="sampling", held=stop.what), picked
        else:
            turned = self._turn(label, state.pose, "deposit")
            if turned:
                dropped = self._act(turned, f"drop {stop.what} {stop.place}", *DROP)
                yield state._replace(pose="deposit", held=""), dropped


def schedule(
    problem: Problem, values: dict[str, Values], idle_w: float = 0, outages: Outages | None = None
) -> Schedule:
    """solvable: true only with a schedule in hand; false only if there is none even with too little energy counted."""
    strict = Scheduler(problem, values, False, idle_w, outages).run()
    if strict.solvable is not False:
        return strict
    generous = Scheduler(problem, values, True, idle_w, outages).run()
    return Schedule(False) if generous.solvable is False else Schedule(None)
