"""A scheduler that shares nothing with the planner: decides whether a problem of the planetary domain has a plan,
and how short one can be.

It enumerates every order of the stops (images, picks, drops) by dynamic programming over (done, place, arm, held), with
all labels (time, energy, radio free) that no other label beats. Images are sent first come, first served, which is best
for jobs of one length. Exact up to the separation of 1 ms, with these liberties: two activities at one place do not
overlap (the rover's stops are places of their own), and it takes the fastest way between two places.

Hindsight (hindsight.py) counts what the domain does not know as well: the power that the robot draws all the time.
"""

from __future__ import annotations

from dataclasses import dataclass

from problem import INFINITY, Problem

# Durations and energies of missions/planetary/domain.pddl.
IMAGE = (40.0, 600.0)
PICK = (60.0, 900.0)
DROP = (30.0, 450.0)
SEND = (120.0, 3000.0)
GAP_S = 0.001
LABEL_LIMIT = 400000  # a problem with more is left undecided

Label = tuple[float, float, float]  # time, energy used, time from which the radio is free
Values = dict[tuple[str, str], float]


@dataclass(frozen=True)
class Stop:
    kind: str  # image, pick, drop
    what: str
    place: str


@dataclass
class Schedule:
    solvable: bool | None  # None: too many labels
    makespan_s: float = INFINITY


def closure(times: Values, energies: Values, by_energy: bool) -> tuple[Values, Values]:
    """Ways over other places: the fastest with its energy, or the cheapest with its time."""
    places = sorted({a for a, _ in times})
    best = {(a, b): (energies[a, b], times[a, b]) if by_energy else (times[a, b], energies[a, b]) for a, b in times}
    for middle in places:
        for a in places:
            for b in places:
                if (a, middle) in best and (middle, b) in best:
                    first, second = best[a, middle], best[middle, b]
                    way = (first[0] + second[0] + GAP_S, first[1] + second[1])
                    if (a, b) not in best or way < best[a, b]:
                        best[a, b] = way
    leading = {pair: value[0] for pair, value in best.items()}
    following = {pair: value[1] for pair, value in best.items()}
    return (following, leading) if by_energy else (leading, following)


def send(label: Label, windows: list[tuple[float, float]]) -> Label | None:
    time, energy, radio = label
    for opens, closes in windows:
        start = max(time + GAP_S, radio, opens)
        if start + SEND[0] <= closes:
            return time, energy + SEND[1], start + SEND[0] + GAP_S
    return None


class Scheduler:
    """`generous`: energies are underestimated, so that no schedule means no plan. Otherwise a schedule is a plan."""

    def __init__(self, problem: Problem, values: dict[str, Values], generous: bool, idle_w: float = 0):
        self.problem = problem
        self.idle_w = idle_w
        drive_s, drive_j = values.get("traverse_time", {}), values.get("traverse_energy", {})
        self.drive_s, self.drive_j = closure(drive_s, drive_j, by_energy=False)
        if generous:
            self.drive_j = closure(drive_s, drive_j, by_energy=True)[1]
        self.arm_s, self.arm_j = closure(values["arm_move_time"], values["arm_move_energy"], by_energy=False)
        self.comm = problem.windows(("comm-window",))
        self.energy = problem.numbers["battery"] - problem.numbers["reserve"]
        self.stops, self.stored, self.possible = self._stops()
        self.labels = 0

    def _stops(self) -> tuple[list[Stop], int, bool]:
        """The stops that the goals need, images that only wait to be sent, and whether each goal has its stop."""
        facts = self.problem.facts
        targets = {fact[1]: fact[2] for fact in facts if fact[0] == "target"}
        places = {fact[1]: fact[2] for fact in facts if fact[0] == "sample-at"}
        held = {fact[1] for fact in facts if fact[0] == "holding"}
        stops: set[Stop] = set()
        stored = 0
        possible = True
        for goal in self.problem.goals:
            if goal in facts:
                continue
            if goal[0] == "sent":
                if ("have-image", goal[1]) in facts:
                    stored += 1
                else:
                    stops.add(Stop("image", goal[1], targets[goal[1]]))
                continue
            if goal[0] == "dropped":
                stops.add(Stop("drop", goal[1], goal[2]))
            if goal[1] not in held:
                possible = possible and goal[1] in places
                stops.add(Stop("pick", goal[1], places.get(goal[1], "")))
        return sorted(stops, key=lambda stop: (stop.kind, stop.what)), stored, possible

    def _first(self, name: str) -> str:
        return next((fact[1] for fact in self.problem.facts if fact[0] == name), "")

    def run(self) -> Schedule:
        if not self.possible:
            return Schedule(False)
        label: Label | None = (0.0, 0.0, 0.0)
        for _ in range(self.stored):
            label = send(label, self.comm) if label else None
        if label is None or not self._has_energy(label):
            return Schedule(False)
        start = (0, self._first("at"), self._first("arm-at"), self._first("holding"))
        everything = (1 << len(self.stops)) - 1
        fronts: dict[tuple, list[Label]] = {start: [label]}
        queue = [(start, label)]
        best = INFINITY
        while queue:
            state, label = queue.pop()
            if label not in fronts[state]:
                continue  # beaten since
            if state[0] == everything:
                best = min(best, max(label[0], label[2]))
                continue
            for following, reached in self._moves(state, label):
                if self._has_energy(reached) and self._keep(fronts, following, reached):
                    queue.append((following, reached))
            if self.labels > LABEL_LIMIT:
                return Schedule(True, best) if best < INFINITY else Schedule(None)
        return Schedule(best < INFINITY, best)

    def _has_energy(self, label: Label) -> bool:
        return label[1] + self.idle_w * max(label[0], label[2]) <= self.energy + 1e-6

    def _keep(self, fronts: dict, state: tuple, label: Label) -> bool:
        front = fronts.setdefault(state, [])
        if any(a <= label[0] and b <= label[1] and c <= label[2] for a, b, c in front):
            return False
        front[:] = [one for one in front if not all(x <= y for x, y in zip(label, one))]
        front.append(label)
        self.labels += 1
        return True

    def _arm(self, label: Label, pose: str, to: str) -> Label | None:
        if pose == to:
            return label
        if (pose, to) not in self.arm_s:
            return None
        return label[0] + self.arm_s[pose, to] + GAP_S, label[1] + self.arm_j[pose, to], label[2]

    def _go(self, state: tuple, label: Label, place: str) -> tuple[str, Label] | None:
        """The arm's pose and the label at the place."""
        _, here, pose, _ = state
        if here == place:
            return pose, label
        stowed = self._arm(label, pose, "stow")
        if stowed is None or (here, place) not in self.drive_s:
            return None
        return "stow", (
            stowed[0] + self.drive_s[here, place] + GAP_S,
            stowed[1] + self.drive_j[here, place],
            stowed[2],
        )

    def _moves(self, state: tuple, label: Label):
        done, here, pose, held = state
        for i, stop in enumerate(self.stops):
            if done >> i & 1:
                continue
            if stop.kind == "pick" and held or stop.kind == "drop" and held != stop.what:
                continue
            there = self._go(state, label, stop.place)
            if there is not None:
                yield from self._do(stop, (done | 1 << i, stop.place, there[0], held), there[1])
        wanted_later = any(stop.kind == "drop" and stop.what == held and not done >> i & 1 for i, stop in enumerate(self.stops))
        if held and not wanted_later:  # the gripper is to be empty for another sample
            yield from self._do(Stop("drop", held, here), state, label)

    def _do(self, stop: Stop, state: tuple, label: Label):
        done, here, pose, held = state
        if stop.kind == "image":
            for opens, closes in self.problem.windows(("available", stop.what)):
                start = max(label[0], opens)
                if start + IMAGE[0] <= closes:
                    sent = send((start + IMAGE[0] + GAP_S, label[1] + IMAGE[1], label[2]), self.comm)
                    if sent is not None:
                        yield state, sent
                    return
            return
        turned = self._arm(label, pose, "sampling" if stop.kind == "pick" else "deposit")
        if turned is None:
            return
        duration, energy = PICK if stop.kind == "pick" else DROP
        start = turned[0]
        if stop.kind == "pick":
            known = self.problem.windows(("sample-at", stop.what, stop.place))
            if not known:
                return
            start = max(start, known[0][0])
        reached = (start + duration + GAP_S, turned[1] + energy, turned[2])
        if stop.kind == "pick":
            yield (done, here, "sampling", stop.what), reached
        else:
            yield (done, here, "deposit", ""), reached


def schedule(problem: Problem, values: dict[str, Values], idle_w: float = 0) -> Schedule:
    """solvable: true only with a schedule in hand; false only if there is none even with too little energy counted."""
    strict = Scheduler(problem, values, False, idle_w).run()
    if strict.solvable is not False:
        return strict
    generous = Scheduler(problem, values, True, idle_w).run()
    return Schedule(False) if generous.solvable is False else Schedule(None)
