"""Why goals were not achieved: each loss gets one class, by what the journal says and what hindsight shows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from flights import Flight, GoalEnd
from hindsight import Hindsight
from second_look import SecondLook

# In the order in which they are asked for; the first that applies counts.
EXPLANATIONS = {
    "missed": "The planner spent its budget on a problem that has a plan. Nearly all have energy for at most twice the best "
    "order; a bound on the energy that open goals still take would end such a search early.",
    "budget": "The planner spent its budget on a problem that has no plan: the goal had to go, but it took long to see.",
    "no way": "No way leads there: closed terrain, rocks, or a place that the rover would touch.",
    "component": "A component failed five times in a row; its goals are given up, since nobody knows for how long. Longer "
    "pauses between the tries would outlast the fault.",
    "energy": "Not enough energy: little at the start, a loss on the way, or what the robot draws while it waits for a "
    "window. The domain does not know the last, nor that the same draw comes on top of a drive (`rover.idle_power_w`: 42 "
    "instead of 28 would count that).",
    "too late": "The world was slower than the model (slip, rocks on the way): a latest start passed, and no plan had "
    "all goals any more.",
    "does not fit": "With the goals that were there before, no plan had this one; it was given up as it came, newest first "
    "(R53), whatever its utility.",
    "other": "Given up after another change of plans.",
}


@dataclass
class Loss:
    seed: int
    goal: GoalEnd
    kind: str
    possible: bool | None  # a hard goal: whether hindsight has a schedule with it; otherwise None


def classify(flight: Flight, goal: GoalEnd, looks: Iterable[SecondLook], back: Hindsight | None) -> str:
    if goal.reason.startswith(("timeout", "out_of_memory")):
        return "missed" if any(look.solvable and look.call.reason in goal.reason for look in looks) else "budget"
    if back and goal.id in back.no_way:
        return "no way"
    if "times in a row" in goal.reason:
        return "component"
    if "battery" in goal.cause:
        return "energy"
    if "latest start" in goal.cause or "blocked" in goal.cause or "stuck" in goal.cause or "collision" in goal.cause:
        return "too late"
    if goal.cause.endswith("arrived"):
        return "does not fit"
    return "other"


def losses_of(flight: Flight, looks: list[SecondLook], back: Hindsight | None) -> list[Loss]:
    out = []
    for goal in flight.goals:
        if goal.state in ("dropped", "failed"):
            possible = back.hard.get(goal.id) if back else None
            out.append(Loss(flight.seed, goal, classify(flight, goal, looks, back), possible))
    return out
