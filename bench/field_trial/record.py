"""All that is known of one seed of a field trial."""

from __future__ import annotations

import pickle
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from flights import Flight
from hindsight import Hindsight
from long_calls import LongCall
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


@dataclass
class Range:
    """Is what one command flew: all that a report is written from."""

    records: list[Record]
    long: list[LongCall]
    work: int

    def save(self, folder: Path) -> None:
        (folder / "records.pickle").write_bytes(pickle.dumps(self))

    @staticmethod
    def load(folder: Path) -> Range:
        """Only for folders of one's own: a pickle is a program."""
        return pickle.loads((folder / "records.pickle").read_bytes())
