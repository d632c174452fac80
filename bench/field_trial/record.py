"""All that is known of one seed of a field trial."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from flights import Flight
from hindsight import Hindsight
from losses import Loss
from second_look import SecondLook


@dataclass
class Record:
    scenario: Any  # of the mission that is flown
    flight: Flight
    looks: list[SecondLook] = field(default_factory=list)
    back: Hindsight | None = None
    losses: list[Loss] = field(default_factory=list)
    first_plan_s: float | None = None  # makespan of the first plan (R62)
    reference_s: float | None = None  # the shortest that there is
