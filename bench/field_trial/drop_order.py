"""R53, checked from outside: among the goals in question the newest opportunistic one goes, else the optional one of least
utility (of equals the newest); a hard one fails only if neither is there. In question are the goals that a proof names, or all that are open."""

from __future__ import annotations

import re
from collections.abc import Callable

from flights import Flight, GoalEnd

ENDS = {"goal.achieved", "goal.dropped", "goal.failed", "goal.recalled"}


Pattern = Callable[[GoalEnd], str]  # of what a proof says of a goal


def to_go(candidates: list[GoalEnd]) -> GoalEnd | None:
    """The one that has to go; None: only hard ones are left. In order of arrival."""
    opportunistic = [goal for goal in candidates if goal.importance == "opportunistic"]
    if opportunistic:
        return opportunistic[-1]
    optional = [goal for goal in candidates if goal.importance == "optional"]
    return min(reversed(optional), key=lambda goal: goal.utility) if optional else None


def broken_drop_order(flight: Flight, pattern: Pattern) -> list[str]:
    by_key = {goal.key: goal for goal in flight.goals}
    faults = []
    open_goals: list[GoalEnd] = []
    for time_s, code, words in flight.events:
        key = re.match(r"(?:hard )?goal (\S+)", words)
        goal = by_key.get(key.group(1)) if key else None
        if goal is None:
            continue
        if code == "goal.accepted":
            open_goals = [*(one for one in open_goals if one is not goal), goal]
        if code in ("goal.dropped", "goal.failed") and "in a row" not in words:
            proved = "\ndetails: " in goal.reason and not goal.spent_budget()
            candidates = [one for one in open_goals if proved and re.search(pattern(one), goal.reason)] or open_goals
            right = to_go(candidates)
            if right is not None and right is not goal:
                faults.append(f"goal {goal.key} went at {time_s:.1f} s, but it was the turn of {right.key}")
        if code in ENDS:
            open_goals = [one for one in open_goals if one is not goal]
    return faults
