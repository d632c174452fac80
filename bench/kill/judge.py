"""What a flight lost, did twice, or did otherwise than the same flight without kills."""

from collections import Counter
from dataclasses import dataclass, field

from effects import doubled_effects
from flight import Flight

REJECTED, PENDING, PLANNED, ACHIEVED, DROPPED, FAILED, RECALLED = range(7)
FINAL = {REJECTED, ACHIEVED, DROPPED, FAILED, RECALLED}


@dataclass
class Judgement:
    COUNTS = ("missions", "kills", "defined ends", "goals", "goals lost", "effects", "effects doubled", "resumed",
              "planned anew", "same goals achieved")
    counts: Counter = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)


def judge(flight: Flight, calm: Flight) -> Judgement:
    out = Judgement()
    out.counts["missions"] = 1
    out.counts["kills"] = flight.killed
    defined = flight.exit_code in (0, 1) and flight.result in ("achieved", "partial")
    out.counts["defined ends"] = int(defined)
    if not defined:
        out.faults.append(f"no defined end: exit {flight.exit_code}, result '{flight.result}', {flight.error[-300:]}")
    lost = [key for key in flight.requested if key not in flight.goals]
    lost += [key for key, (state, reason) in flight.goals.items()
             if state not in FINAL and "waiting for the ground" not in reason]
    out.counts["goals"] = len(flight.goals)
    out.counts["goals lost"] = len(lost)
    out.faults += [f"lost goal {key}" for key in lost]
    doubled = doubled_effects(flight.effects)
    out.counts["effects"] = len(flight.effects)
    out.counts["effects doubled"] = sum(count - 1 for count in doubled.values())
    out.faults += [f"{what} {count} times" for what, count in doubled.items()]
    out.counts["resumed"] = sum(event.startswith("executive.resumed") for event in flight.events)
    anew = [event for event in flight.events if event.startswith("journal.diverged")]
    out.counts["planned anew"] = len(anew)
    out.faults += anew
    out.counts["same goals achieved"] = int(achieved(flight) == achieved(calm))
    return out


def achieved(flight: Flight) -> set[str]:
    """Of those that the scenario asks for; science raises goals of its own by what it sees."""
    return {key for key, (state, _) in flight.goals.items() if state == ACHIEVED and key in flight.requested}
