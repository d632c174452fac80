"""A scheduler that shares nothing with the planner: decides whether a problem of the orbital domain has a plan, and how short one can be.

One arm does one thing after the other, so a plan is a sequence of transfers: go to a slot, localize, grasp, carry, localize, place; each step as
early as light and windows allow, which is never worse. Labels (time, energy) that no other label of the same arrangement beats are kept; A* takes first
what may be ready first (orbital_bound.py).
Exact up to the separation of 1 ms, with this liberty: it never charges, so where energy is short it leaves the problem undecided. What may be moved, and
where to, is read as the domain means it (missions/orbital/README.md)."""

from __future__ import annotations

import heapq
import itertools
import re

from orbital_bound import GRASP, LOCALIZE, PLACE, Bound, State, clauses
from problem import Problem
from reference import GAP_S, Schedule, step

LABEL_LIMIT = 10000  # a problem with more is left undecided


def read(text: str):
    """The first formula of a text, as nested lists."""
    stack: list[list] = [[]]
    for token in re.findall(r"[()]|[^\s()]+", text):
        if token == "(":
            stack.append([])
        elif token == ")":
            done = stack.pop()
            stack[-1].append(done)
            if len(stack) == 1:
                break
        else:
            stack[-1].append(token)
    return stack[0][0]


class Scheduler:
    def __init__(self, problem: Problem, values: dict, energy_j: float | None):
        self.problem, self.values, self.energy_j = problem, values, energy_j
        self.facts = problem.facts
        text = problem.text
        self.goal = read(text[text.index("(:goal") + 6 :])
        words = read("(" + text[text.index("(:objects") + 9 : text.index("(:init")].strip().removesuffix(")") + ")")
        self.objects: dict[str, list[str]] = {}
        names: list[str] = []
        kind = iter(words)
        for word in kind:
            if word == "-":
                self.objects.setdefault(next(kind), []).extend(names)
                names = []
            else:
                names.append(word)
        self.light = problem.windows(("sunlit",))
        self.slots = self.objects.get("socket", [])
        self._relevance()

    def _all(self, predicate: str) -> set[tuple[str, ...]]:
        return {fact[1:] for fact in self.facts if fact[0] == predicate}

    def _relevance(self) -> None:
        wanted, serves, seat = self._all("wanted"), self._all("serves"), self._all("seat")
        lay, self.free_first = self._all("lay-first"), {slot for (slot,) in self._all("free-first")}
        held = {module for (module,) in self._all("held-first")}
        replaced, modes = {m for (m,) in self._all("to-replace")}, {c for (c,) in self._all("to-configure")}
        asked = {(role, s) for d, s in seat if d in replaced for m, role in serves if m == d}
        asked |= {(role, s) for c, role, s in self._all("needs") if c in modes}
        self.fits = {(m, s) for role, s in asked for m, other in serves if other == role}
        # When a module may be placed where goals need it: in the windows of all of them.
        self.placing: dict[tuple[str, str], list[tuple[str, ...]]] = {(m, s): [("allowed", m, s)] for m, s in wanted}
        for d, s in seat:
            for m in {m for m, role in serves if (d, role) in serves} if d in replaced else ():
                self.placing.setdefault((m, s), []).append(("replacing", d))
        for c, role, s in self._all("needs"):
            for m in {m for m, other in serves if other == role} if c in modes else ():
                self.placing.setdefault((m, s), []).append(("configuring", c))
        aim = wanted | self.fits
        target = {s for _, s in wanted} | {s for _, s in asked}
        self.movers = held | {m for m, _ in aim} | {m for m, s in lay if s in target}
        self.wanted, self.bound = wanted, {m for m, _ in wanted}
        self.of_use = target | self.free_first | {s for m, s in lay if m in self.movers}

    def may_lie(self, module: str, slot: str) -> bool:
        if (module, slot) in self.wanted:
            return True
        return module in self.movers and (slot in self.free_first or (module not in self.bound and slot in self.of_use))

    def holds(self, formula, installed: set[tuple[str, str]], bound: dict[str, str]) -> bool:
        head, *parts = formula
        if head == "and":
            return all(self.holds(part, installed, bound) for part in parts)
        if head == "or":
            return any(self.holds(part, installed, bound) for part in parts)
        if head == "not":
            return not self.holds(parts[0], installed, bound)
        if head == "imply":
            return not self.holds(parts[0], installed, bound) or self.holds(parts[1], installed, bound)
        if head in ("exists", "forall"):
            typed = " ".join(parts[0]).split()
            variables, domains = [], []
            for i in range(0, len(typed), 3):  # "?m - module"
                variables.append(typed[i])
                domains.append(self.objects.get(typed[i + 2], []))
            choices = (
                self.holds(parts[1], installed, {**bound, **dict(zip(variables, some))}) for some in itertools.product(*domains)
            )
            return any(choices) if head == "exists" else all(choices)
        arguments = tuple(bound.get(word, word) for word in parts)
        return arguments in installed if head == "installed" else (head, *arguments) in self.facts

    def _in_light(self, time: float, duration: float) -> float | None:
        return self._inside(self.light, time, duration)

    @staticmethod
    def _inside(windows, time: float, duration: float) -> float | None:
        for opens, closes in windows:
            start = max(time, opens + GAP_S if opens > 0 else 0.0)
            if start + duration + GAP_S <= closes:
                return start
        return None

    def _inside_all(self, facts, time: float, duration: float) -> float | None:
        before = None
        while time is not None and time != before:
            before = time
            for fact in facts:
                time = self._inside(self.problem.windows(fact), time, duration) if time is not None else None
        return time

    def run(self) -> Schedule:
        lies = {m: s for m, s in self._all("at-slot")}
        firm = self._all("installed")  # a module that moves is firm once it is placed
        arm = next(fact[1] for fact in self.facts if fact[0] == "arm-at")
        held = next((fact[1] for fact in self.facts if fact[0] == "holding"), "")
        start = State(tuple(sorted(lies.items())), arm, ("localized", arm) in self.facts, held)
        blocked = set(self.slots) - self.free_first - set(lies.values())  # nothing can be placed there
        if held and not self.free_first and arm not in lies.values():
            blocked.discard(arm)
        bound = Bound(clauses(self), self)
        # Earliest end, number, time, energy, state, what is installed, steps.
        queue: list[tuple[float, int, float, float, State, frozenset, tuple]] = []
        rest = bound(start, frozenset(firm), 0.0)
        if rest is not None:
            queue.append((rest, 0, 0.0, 0.0, start, frozenset(firm), ()))
        kept: dict[tuple, list[tuple[float, float]]] = {}
        count, numbers = itertools.count(1), itertools.count(1)
        while queue:
            _, _, time, energy, state, installed, steps = heapq.heappop(queue)
            key = (state, installed)
            if any(t <= time and e <= energy for t, e in kept.get(key, [])):
                continue
            kept.setdefault(key, []).append((time, energy))
            if self.holds(self.goal, set(installed), {}):
                return Schedule(True, time, self._text(steps))
            if next(count) > LABEL_LIMIT:
                return Schedule(None)
            for then in self._moves(time, energy, state, installed, steps, blocked):
                rest = bound(then[2], then[3], then[0])
                if rest is not None and (self.energy_j is None or then[1] <= self.energy_j):
                    heapq.heappush(queue, (then[0] + rest, next(numbers), *then))
        return Schedule(False)

    @staticmethod
    def _text(steps: tuple) -> str:
        lines = []
        while steps:
            line, steps = steps
            lines.append(line)
        return "\n".join(reversed(lines)) + "\n"

    def _go(self, time, energy, state: State, slot: str, steps, verb: str):
        """To the slot, and localized there; None: no way, or no light any more."""
        if state.arm != slot:
            taken = self.values.get(f"ra_{verb}_dur", {}).get((state.arm, slot))
            joules = self.values.get(f"ra_{verb}_energy", {}).get((slot,))
            if taken is None or joules is None or slot not in self.of_use:
                return None
            steps = (step(time, f"{verb} {state.arm} {slot}", taken), steps)
            time, energy = time + taken + GAP_S, energy + joules
        elif state.localized:
            return time, energy, steps
        begin = self._in_light(time, LOCALIZE[0])
        if begin is None:
            return None
        return begin + LOCALIZE[0] + GAP_S, energy + LOCALIZE[1], (step(begin, f"localize {slot}", LOCALIZE[0]), steps)

    def _moves(self, time, energy, state: State, installed, steps, blocked):
        where = dict(state.where)
        if state.held:
            taken = set(where.values()) | blocked
            for slot in self.slots:
                if slot in taken or not self.may_lie(state.held, slot):
                    continue
                there = self._go(time, energy, state, slot, steps, "carry")
                if there is None:
                    continue
                begin, joules, way = there
                begin = self._inside_all(self.placing.get((state.held, slot), []), begin, PLACE[0])
                if begin is None:
                    continue
                way = (step(begin, f"place {state.held} {slot}", PLACE[0]), way)
                placed = tuple(sorted({**where, state.held: slot}.items()))
                yield (begin + PLACE[0] + GAP_S, joules + PLACE[1], State(placed, slot, True, ""),
                       installed | {(state.held, slot)}, way)
            return
        for module, slot in where.items():
            if module not in self.movers:
                continue
            there = self._go(time, energy, state, slot, steps, "move")
            if there is None:
                continue
            begin, joules, way = there
            rest = tuple(pair for pair in state.where if pair[0] != module)
            yield (begin + GRASP[0] + GAP_S, joules + GRASP[1], State(rest, slot, True, module),
                   installed - {(module, slot)}, (step(begin, f"grasp {module} {slot}", GRASP[0]), way))


def schedule(problem: Problem, values: dict) -> Schedule:
    """solvable: true only with a schedule in hand; false only if there is none however much energy there is."""
    spare = problem.numbers.get("battery", 0) - problem.numbers.get("reserve", 0)
    strict = Scheduler(problem, values, spare).run()
    if strict.solvable is not False:
        return strict
    generous = Scheduler(problem, values, None).run()
    return Schedule(False) if generous.solvable is False else Schedule(None)
