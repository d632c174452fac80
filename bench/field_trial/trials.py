"""What differs between the missions of the field trial."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import hindsight
import orbital_hindsight
import orbital_reference
import orbital_scenarios
import problem
import reference
import scenarios
from flights import GoalEnd, Programs


@dataclass(frozen=True)
class Trial:
    mission: str  # below missions/
    drawer: Callable[[Path], Callable[[int], Any]]  # mission folder → seed → scenario
    schedule: Callable[..., reference.Schedule]
    look_back: Callable[..., hindsight.Hindsight]
    constants: Callable[[Programs, Path], problem.Table]  # exact values that hold in every flight; a folder to work in
    goal_fact: Callable[[GoalEnd], str]  # a pattern of what a proof says of the goal
    drawn: str  # what is drawn at random, for the report
    target: str  # where the report of the repository stands


def planetary_drawer(mission: Path) -> Callable[[int], scenarios.Scenario]:
    site = scenarios.Site(mission / "site")
    return lambda seed: scenarios.draw(seed, site)


def planetary_fact(goal: GoalEnd) -> str:
    name = re.escape(goal.id)
    return rf"\((sent image-{name}|picked sample-{name}|dropped sample-\S+ place-{name})\)"


def orbital_fact(goal: GoalEnd) -> str:
    if "slot" in goal.arguments:
        module = re.escape(goal.arguments["module"])
        return rf"\((installed {module} {re.escape(goal.arguments['slot'])}|works {module})\)"
    if "module" in goal.arguments:  # conditions that no fact stands for, by what mission.yaml says of them
        return re.escape(f"(seat {goal.arguments['module']} ?s)")
    return re.escape(f"(needs {goal.arguments['mode']} ?r ?s)")


TRIALS = {
    "planetary": Trial(
        "planetary",
        planetary_drawer,
        reference.schedule,
        hindsight.look_back,
        lambda programs, folder: {},  # ways depend on what the map shows
        planetary_fact,
        "goals of all kinds and classes, some in\nflight, narrow windows, hard terrain, rocks that no map shows, slip, faults of components, lost "
        "communication windows,\nlittle energy",
        "docs/field-trial.md",
    ),
    "orbital": Trial(
        "orbital",
        lambda mission: orbital_scenarios.draw,
        orbital_reference.schedule,
        orbital_hindsight.look_back,
        orbital_hindsight.constants,
        orbital_fact,
        "configurations of all kinds and\nclasses, some in flight, windows, modules that fail, are heavier than told or need several tries of their latch, joints that "
        "stick,\nblocked slots, all slots but one taken, faults of components, arrays that give nothing, little energy",
        "docs/field-trial-orbital.md",
    ),
}
