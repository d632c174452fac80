"""The problems that exec_svc writes, as values: objects, what holds at the start, windows, goals.

Reads that form alone (one fact a line), not PDDL at large."""

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


def read_values(path: Path) -> dict[str, dict[tuple[str, ...], float]]:
    """Function → arguments → value; what is unreachable, or not known, is left out."""
    out: dict[str, dict[tuple[str, ...], float]] = {}
    for line in path.read_text().splitlines():
        application, value = line[1:].split(") ")
        function, *arguments = application.split(" ")
        if value not in ("unreachable", "unknown"):
            out.setdefault(function, {})[tuple(arguments)] = float(value)
    return out
