"""How much time the rest of an orbital plan takes at least: what makes the reference scheduler find its way.

Admissible: each module that has to move is grasped, carried and placed on its own, and the arm does one thing after the other."""

from __future__ import annotations

import itertools
from typing import NamedTuple

LOCALIZE, GRASP, PLACE = (30.0, 3000.0), (45.0, 4500.0), (60.0, 6000.0)  # s, J, as in missions/orbital/domain.pddl
Atom = tuple[str, str]  # a module installed in a slot
Clause = frozenset[Atom]  # one of them has to be


class State(NamedTuple):
    where: tuple[Atom, ...]  # sorted; what is held is left out
    arm: str
    localized: bool
    held: str


def clauses(scheduler) -> list[Clause]:
    """The goal as a conjunction of such; what has another form is left out, which makes the bound lower."""
    found = _ground(scheduler, scheduler.goal, {})
    return [clause for clause in found if clause] if found is not None else []


def _ground(scheduler, formula, bound: dict[str, str]) -> list[Clause] | None:
    """None: false whatever is installed; an empty clause: not told."""
    head, *parts = formula
    if head == "and":
        return _all([_ground(scheduler, part, bound) for part in parts])
    if head == "or":
        return _some([_ground(scheduler, part, bound) for part in parts])
    if head in ("exists", "forall"):
        typed = " ".join(parts[0]).split()  # "?m - module"
        domains = [scheduler.objects.get(kind, []) for kind in typed[2::3]]
        cases = [
            _ground(scheduler, parts[1], {**bound, **dict(zip(typed[::3], some))}) for some in itertools.product(*domains)
        ]
        return _some(cases) if head == "exists" else _all(cases)
    if head == "installed":
        module, slot = (bound.get(word, word) for word in parts)
        return [frozenset([(module, slot)])]
    if "installed" in str(parts):
        if head == "imply" and "installed" not in str(parts[0]):
            return _ground(scheduler, parts[1], bound) if scheduler.holds(parts[0], set(), bound) else []
        return [frozenset()]
    return [] if scheduler.holds(formula, set(), bound) else None


def _all(cases: list[list[Clause] | None]) -> list[Clause] | None:
    return None if None in cases else [clause for case in cases for clause in case]


def _some(cases: list[list[Clause] | None]) -> list[Clause] | None:
    possible = [case for case in cases if case is not None]
    if not possible:
        return None
    if any(not case for case in possible):
        return []
    if any(len(case) != 1 or not case[0] for case in possible):
        return [frozenset()]
    return [frozenset().union(*(case[0] for case in possible))]


class Bound:
    """Seconds that the rest takes at least; None: what is still to do cannot be done in its window any more."""

    def __init__(self, goal: list[Clause], scheduler):
        self.goal = goal
        self.wanted = {module for clause in goal for module, _ in clause}
        self.carry = self._least(scheduler.values.get("ra_carry_dur", {}))
        self.move = self._least(scheduler.values.get("ra_move_dur", {}))
        self.closes = {}
        for atom in scheduler.wanted - scheduler.fits:
            windows = scheduler.problem.windows(("allowed", *atom))
            self.closes[atom] = max((closes for _, closes in windows), default=0.0)

    @staticmethod
    def _least(durations: dict[Atom, float]) -> dict[str, float]:
        out: dict[str, float] = {}
        for (_, to), seconds in durations.items():
            out[to] = min(seconds, out.get(to, seconds))
        return out

    def _lift(self, state: State, slot: str) -> float:
        """Seconds from now until what lies in the slot is in the tool."""
        if state.arm == slot:
            return GRASP[0] + (0.0 if state.localized else LOCALIZE[0])
        return self.move.get(slot, 0.0) + LOCALIZE[0] + GRASP[0]

    def _put(self, state: State, where: dict[str, str], atom: Atom) -> float:
        module, slot = atom
        if module == state.held:
            if state.arm == slot:
                return PLACE[0] + (0.0 if state.localized else LOCALIZE[0])
            return self.carry.get(slot, 0.0) + LOCALIZE[0] + PLACE[0]
        return self._lift(state, where.get(module, "")) + self.carry.get(slot, 0.0) + LOCALIZE[0] + PLACE[0]

    def __call__(self, state: State, installed, time: float) -> float | None:
        where, lying = dict(state.where), {slot: module for module, slot in state.where}
        rest = 0.0
        counted: set[Atom] = set()
        away: set[str] = set()  # modules that lie in another's slot, and are wanted nowhere
        for clause in self.goal:
            if clause & installed:
                continue
            least = None
            for atom in clause:
                seconds = self._put(state, where, atom)
                if time + seconds <= self.closes.get(atom, float("inf")) and (least is None or seconds < least):
                    least = seconds
            if least is None:
                return None
            if counted & clause:
                continue
            counted |= clause
            rest += least
            slots = {slot for _, slot in clause}
            if len(slots) == 1:
                other = lying.get(*slots)
                if other and other not in self.wanted:
                    away.add(other)
        for module in away:
            rest += self._lift(state, where[module]) + min(self.carry.values(), default=0.0) + LOCALIZE[0] + PLACE[0]
        if state.held and state.held not in self.wanted:
            rest += PLACE[0]
        return rest
