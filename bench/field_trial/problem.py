"""The problems that exec_svc writes, as values: objects, what holds at the start, windows, goals.

Reads that form alone (one fact a line), not PDDL at large. And the values of external functions that a call was given."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

INFINITY = float("inf")


@dataclass
class Problem:
    text: str
    facts: set[tuple[str, ...]] = field(default_factory=set)
    numbers: dict[str, float] = field(default_factory=dict)
    timed: list[tuple[float, bool, tuple[str, ...]]] = field(default_factory=list)
    goals: list[tuple[str, ...]] = field(default_factory=list)

    def windows(self, fact: tuple[str, ...]) -> list[tuple[float, float]]:
        """When the fact holds, as pairs of start and end."""
        out = []
        since = 0.0 if fact in self.facts else None
        for time, holds, what in sorted(self.timed):
            if what != fact:
                continue
            if holds and since is None:
                since = time
            elif not holds and since is not None:
                out.append((since, time))
                since = None
        if since is not None:
            out.append((since, INFINITY))
        return out


def parse(text: str) -> Problem:
    problem = Problem(text)
    init = text[text.index("(:init") : text.index("(:goal")].rstrip().removesuffix(")")
    for line in init.splitlines()[1:]:
        if match := re.match(r"\s+\(= \((\S+)\) (\S+)\)", line):
            problem.numbers[match[1]] = float(match[2])
        elif match := re.match(r"\s+\(at (\d[\d.]*) \(not \((.*)\)\)\)", line):
            problem.timed.append((float(match[1]), False, tuple(match[2].split())))
        elif match := re.match(r"\s+\(at (\d[\d.]*) \((.*)\)\)", line):
            problem.timed.append((float(match[1]), True, tuple(match[2].split())))
        elif match := re.match(r"\s+\(([^()]+)\)$", line):
            problem.facts.add(tuple(match[1].split()))
    goal = text[text.index("(:goal") : text.index("(:metric")]
    problem.goals = [tuple(fact.split()) for fact in re.findall(r"\(([^()]+)\)", goal)]
    return problem


Table = dict[str, dict[tuple[str, ...], float]]  # function → arguments → value


@dataclass
class Values:
    """What a function table says (core/pddl/function_table.hpp)."""

    exact: Table = field(default_factory=dict)
    bounds: Table = field(default_factory=dict)  # lower ones
    closed: set[tuple[str, ...]] = field(default_factory=set)  # (function, argument, …): unreachable, or not known

    def completed(self, exact: Table) -> Values:
        """Has these exact values as well, where nothing else is said."""
        more = {
            name: {key: value for key, value in some.items() if (name, *key) not in self.closed} for name, some in exact.items()
        }
        return Values(_over(self.exact, more), self.bounds, self.closed)

    def cheapest(self) -> Table:
        """Bounds stand where there is no exact value: what has no schedule with these has none."""
        open_bounds = {
            name: {key: value for key, value in some.items() if (name, *key) not in self.closed}
            for name, some in self.bounds.items()
        }
        return _over(self.exact, open_bounds)

    def text(self) -> str:
        """A function table that says the same (of what is closed: that it is not known)."""
        lines = [f"{_application(name, key)} {value!r}" for name, some in self.exact.items() for key, value in some.items()]
        lines += [f"{_application(name, key)} >= {value!r}" for name, some in self.bounds.items() for key, value in some.items()]
        lines += [f"{_application(name, tuple(key))} unknown" for name, *key in sorted(self.closed)]
        return "\n".join(lines) + "\n"


def _over(table: Table, other: Table) -> Table:
    """Both; of what stands in both, what `table` says."""
    return {name: {**other.get(name, {}), **table.get(name, {})} for name in {**other, **table}}


def _application(function: str, arguments: tuple[str, ...]) -> str:
    return f"({' '.join([function, *arguments])})"


def read_values(path: Path) -> Values:
    out = Values()
    for line in path.read_text().splitlines():
        application, value = line[1:].split(") ")
        function, *arguments = application.split(" ")
        if value in ("unreachable", "unknown"):
            out.closed.add((function, *arguments))
        elif value.startswith(">="):
            out.bounds.setdefault(function, {})[tuple(arguments)] = float(value.removeprefix(">="))
        else:
            out.exact.setdefault(function, {})[tuple(arguments)] = float(value)
    return out
