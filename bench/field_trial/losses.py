"""Why goals were not achieved: each loss gets one class, by what the journal says and what hindsight shows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from flights import Flight, GoalEnd
from hindsight import Hindsight
from second_look import SecondLook

# In the order in which they are asked for; the first that applies counts.
EXPLANATIONS = {
    "missed": "The planner spent its budget on a problem that has a plan.",
    "budget": "The planner spent its budget on a problem that has no plan: the goal had to go, but it took long to see.",
    "no way": "No way leads there: closed terrain, rocks (on no map, or fallen during the flight), or a place nearer to one "
    "than the rover's margin.",
    "component": "A component was out of order for longer than all tries of the recovery ladder together.",
    "partner": "The goal that was to pick the sample had been recalled or given up.",
    "energy": "Not enough energy: little at the start, a loss on the way, or what the robot draws while it waits for a "
    "window, which the domain cannot say.",
    "lost window": "A communication window that was predicted did not come, and with it went the last plan that had "
    "all goals.",
    "blocked slot": "A slot that was counted on was found blocked, and with it went the last plan that had all goals.",
    "too late": "The world was slower than the model (slip, rocks on the way, joints that stick, latches, faults): a latest start passed, and no plan "
    "had all goals any more.",
    "does not fit": "With the goals that were there before, no plan had this one; it was given up as it came, newest first "
    "(R53), whatever its utility.",
    "other": "Given up after another change of plans.",
}
# What a cause says, in words of the services; the first that fits.
CAUSES = [
    ("no-path", "no way"),
    ("battery", "energy"),
    ("(comm-window) = true (is false)", "lost window"),
    ("slot-blocked", "blocked slot"),
    ("latch-failed", "too late"),
    ("latest start", "too late"),
    ("[blocked]", "too late"),
    ("[stuck]", "too late"),
    ("[collision]", "too late"),
    ("[fault]", "too late"),
    ("arrived", "does not fit"),
]


@dataclass
class Loss:
    seed: int
    goal: GoalEnd
    kind: str
    possible: bool | None  # a hard goal: whether hindsight has a schedule with it; otherwise None


def classify(flight: Flight, goal: GoalEnd, looks: Iterable[SecondLook], back: Hindsight | None) -> str:
    if goal.spent_budget():
        return "missed" if any(look.solvable and look.call.reason in goal.reason for look in looks) else "budget"
    if back and goal.id in back.no_way:
        return "no way"
    if "times in a row" in goal.reason:
        return "component"
    if bereft(flight, goal):
        return "partner"
    return next((kind for words, kind in CAUSES if words in goal.cause), "other")


def bereft(flight: Flight, goal: GoalEnd) -> bool:
    """Whether the sample that the goal is to set down was never picked, since the goal for it had gone."""
    picker = next((other for other in flight.goals if goal.id == f"{other.id}-drop"), None)
    return picker is not None and picker.state in ("recalled", "dropped", "failed") and picker.ended_s <= goal.ended_s


def losses_of(flight: Flight, looks: list[SecondLook], back: Hindsight | None) -> list[Loss]:
    out = []
    for goal in flight.goals:
        if goal.state in ("dropped", "failed"):
            possible = back.hard.get(goal.id) if back else None
            out.append(Loss(flight.seed, goal, classify(flight, goal, looks, back), possible))
    return out
