"""What goals and scenarios that are drawn at random have in common, whatever the mission."""

from __future__ import annotations

from typing import Any


class DrawnGoal:
    """Has issuer, id, kind, importance, utility, opens_s and closes_s as fields."""

    @property
    def key(self) -> str:
        return f"{self.issuer}/{self.id}"

    def yaml(self) -> str:
        window = f", opens_s: {self.opens_s}, closes_s: {self.closes_s}" if self.closes_s else ""
        return (f"{{issuer: {self.issuer}, id: {self.id}, kind: {self.kind}, importance: {self.importance}, "
                f"utility: {self.utility}{window}, arguments: {{{self.arguments_yaml()}}}}}")

    def arguments_yaml(self) -> str:
        raise NotImplementedError


class DrawnScenario:
    """Has seed and stimuli as fields: seconds, and a goal or another stimulus as YAML."""

    @property
    def name(self) -> str:
        return f"seed-{self.seed:04d}"

    @property
    def goals(self) -> list[tuple[int, Any]]:
        """With the time at which each becomes known."""
        return [(at, what) for at, what in self.stimuli if isinstance(what, DrawnGoal)]

    def stimuli_yaml(self) -> list[str]:
        lines = ["stimuli:"]
        for at, what in self.stimuli:
            text = f"goal: {what.yaml()}" if isinstance(what, DrawnGoal) else what
            lines.append(f"  - {{at_s: {at}, {text}}}")
        return lines
