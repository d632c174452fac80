"""What bench_europa says of its flights."""

from __future__ import annotations

import json
from pathlib import Path

STRATEGIES = {"static": "Static", "ground": "Ground", "fe": "FE", "replan": "Replan"}


class Results:
    """Flights by bias and strategy; those of one seed stand at the same place in each list."""

    def __init__(self, *documents: dict):
        if not documents:
            raise ValueError("there are no results")
        same = ("network", "runs", "first_seed", "budget")
        for document in documents[1:]:
            for key in same:
                if document[key] != documents[0][key]:
                    raise ValueError(f"results of different {key} do not belong together: {document[key]}, {documents[0][key]}")
        self.network, self.runs, self.first_seed, self.budget = (documents[0][key] for key in same)
        self.variants = {round(variant["bias"], 6): variant for document in documents for variant in document["variants"]}

    @classmethod
    def load(cls, *files: Path) -> Results:
        return cls(*(json.loads(file.read_text()) for file in files))

    def biases(self) -> list[float]:
        return sorted(self.variants, key=lambda bias: (bias != 0, -bias))  # as modelled, more, less

    def flights(self, bias: float, strategy: str) -> list[dict]:
        return self.variants[bias][strategy]

    def utilities(self, bias: float, strategy: str) -> list[float]:
        return [flight["utility"] for flight in self.flights(bias, strategy)]

    def counts(self, bias: float, strategy: str, prefix: str) -> list[float]:
        """How many chains whose name begins so each flight completed."""
        return [float(sum(point[2].startswith(prefix) for point in flight["course"])) for flight in self.flights(bias, strategy)]

    def expected(self, bias: float, strategy: str) -> float:
        return self.variants[bias]["expected"][strategy]

    def prescient(self, bias: float) -> list[float]:
        """What a planner brings home, seed by seed, that knows energies and failures beforehand and pays for them as a flight does."""
        return [known["utility"] for known in self.variants[bias]["prescient"]]

    def losses(self, bias: float) -> dict[str, list[float]]:
        """What lies between that and each flight of Replan: the worth, to the same planner, of the energy that went into chains which were not
        completed, and of the energy that was left; the rest is what was chosen, in which order and how late it was known."""
        flights, known = self.flights(bias, "replan"), self.prescient(bias)
        return {"chains that were not completed": [most - flight["ladder"][0] for most, flight in zip(known, flights)],
                "energy that was left": [flight["ladder"][0] - flight["ladder"][1] for flight in flights],
                "choice, order and what was known too late": [flight["ladder"][1] - flight["utility"] for flight in flights]}

    def faults(self) -> int:
        return sum(len(flight["faults"]) for bias in self.variants for strategy in STRATEGIES
                   for flight in self.variants[bias].get(strategy, []))


def utility_at(flight: dict, spent: float) -> float:
    """What a flight had brought home when it had spent so much."""
    return max((point[1] for point in flight["course"] if point[0] <= spent), default=0.0)
