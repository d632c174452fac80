"""The Markdown report of the field trial of missions/faster."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from report import HAND, table


def seeds(flights: list) -> str:
    return ", ".join(str(one.seed) for one in flights) or "–"


def counted(texts: list[str], head: str) -> str:
    return table([head, "how often"], [[text, str(count)] for text, count in Counter(texts).most_common()]) if texts else "None.\n"


def share(part: int, whole: int) -> str:
    return f"{part} of {whole} ({100 * part / whole:.1f} %)" if whole else "–"


def quantiles(values: list[float]) -> str:
    ordered = sorted(values)
    return f"{ordered[len(ordered) // 2]:.2f}, at most {ordered[-1]:.2f}" if ordered else "–"


def measured_entries(killed: list) -> str:
    known = [one.entries for one in killed if one.entries is not None]
    unknown = f"not measured in {len(killed) - len(known)} of them" if len(known) < len(killed) else ""
    return ", ".join(text for text in (str(sum(known)) if known else "", unknown) if text)


def range_of(flights: list) -> str:
    return f"seeds {flights[0].seed} to {flights[-1].seed}"


def arrivals(records: list, beside: list, earlier: list) -> str:
    """`beside`: flights of other ranges of seeds, a list for each; `earlier`: records of an earlier state of the mission."""
    before = [one.flight for one in earlier]
    flown = [("as it stands", [one.flight for one in records]),
             ("repair switched off", [one.unrepaired for one in records if one.unrepaired]),
             ("the primary's wheels feel nothing", [one.unfeeling for one in records if one.unfeeling]),
             *((range_of(other), other) for other in beside)]
    if earlier:
        flown += [(f"earlier state, {range_of(before)}", before),
                  ("earlier state, repair switched off", [one.unrepaired for one in earlier if one.unrepaired])]
    rows = []
    for name, flights in flown:
        possible = [one for one in flights if one.way_m is not None]
        rows.append([name, str(len(flights)), share(sum(one.arrived for one in possible), len(possible)),
                     str(sum(one.bogged for one in flights)), str(sum(one.entries for one in flights)),
                     f"{sum(not one.replans for one in flights)}", str(sum(len(one.replans) for one in flights))])
    rows = [row for row in rows if row[1] != "0"]
    out = "## Who arrives\n\n" + table(["", "flights", "arrived where a way exists", "primaries dug in", "entries into marked soil",
                                          "flights without a new plan", "new plans"], rows)
    late = [one for one in [one.flight for one in records] + [one for other in beside for one in other] if not one.arrived]
    out += f"\nNot arrived: seeds {seeds(late)}.\n\n"
    return out + "".join(f"- seed {one.seed}: {reason_of(one)}\n" for one in late)


def reason_of(flight) -> str:
    told = {True: "; the last communication went out", False: "; the last communication is lost, too", None: ""}[flight.told]
    return flight.reason.splitlines()[0][:220] + told if flight.reason else told.removeprefix("; ")


def wheels(records: list) -> str:
    """What the soil sensing of the primary's own wheels costs and brings, by the seeds that were flown with it and without."""
    pairs = [(one.flight, one.unfeeling) for one in records if one.unfeeling]
    if not pairs:
        return ""
    felt, unfelt = [one for one, _ in pairs], [one for _, one in pairs]

    def of_both(what: str) -> str:
        return f"{sum(getattr(one, what) for one in felt)} with it, {sum(getattr(one, what) for one in unfelt)} without"

    return f"""
**The primary's own wheels** found soil that does not bear it in {sum(one.flight.felt > 0 for one in records)} of the {len(records)} flights; in the others their sensing changes nothing, since its noise comes of a stream of its own.
Flown again without it were seeds {seeds(felt)}. Of these arrive {of_both("arrived")}; primaries dug in: {of_both("bogged")}; new plans: {sum(len(one.replans) for one in felt)} with it, {sum(len(one.replans) for one in unfelt)} without.
"""


def write(records: list, target: Path, beside: list = (), earlier: list = ()) -> None:
    """What stands in `target` from HAND on was written by hand, and stays."""
    old = target.read_text() if target.exists() else ""
    by_hand = old[old.index(HAND):] if HAND in old else ""
    flights = [one.flight for one in records]
    repairs = [repair for one in flights for repair in one.repairs]
    drives = [one for one in repairs if one.cause == "no-go" and one.used_s is not None]
    paths = [one for one in repairs if one.cause == "no-go" and one.paths_s is not None]
    first, last = flights[0].seed, flights[-1].seed
    text = f"""# Field trial: two rovers over hidden traps

{len(flights)} flights of `missions/faster`, scenario `hidden`, seeds {first} to {last}: four sand traps where the seed puts them, which no map shows and no camera
sees. Whether a way exists for the primary says an exact search on the true map (`tests/scenario/true_way.hpp`): in {sum(one.way_m is not None for one in flights)} of them.
Written by `bench/field_trial/faster.py` ([how it works](../bench/field_trial/README.md)). One flight again, alone:

    roci-launch missions/faster --scenario hidden --seed {first} --dds inproc --speed max --headless --run-folder FOLDER

{arrivals(records, list(beside), list(earlier))}{wheels(records)}
## Repairs

By the error that they are for, {len(repairs)} in all; of {sum(one.ended_well for one in repairs)} the step went on to its end without a new plan:

{counted([one.cause for one in repairs if one.ended_well], "error, repaired without a new plan")}
{counted([one.cause for one in repairs if not one.ended_well], "error whose step failed all the same")}
**From the No-Go to both new paths**: {len(paths)} times both paths were worked out within the scout's decision. Time used in seconds of mission time, median
{quantiles([one.paths_s for one in paths])}; share of the time that the decision had left, median {quantiles([one.paths_s / one.allowed_s for one in paths])}.
**To the drive on**: {len(drives)} times the scout drove on within its decision, having come back first. Time used, median
{quantiles([one.used_s for one in drives])}; share, median {quantiles([one.used_s / one.allowed_s for one in drives])}.

## New plans by cause

{counted([cause for one in flights for cause in one.replans], "cause")}
"""
    off = [one.unrepaired for one in records if one.unrepaired]
    state = ""
    if not off and earlier:
        off, state = [one.unrepaired for one in earlier if one.unrepaired], ", of the earlier state"
    if off:
        text += f"With repair switched off ({len(off)} flights{state}):\n\n{counted([cause for one in off for cause in one.replans], 'cause')}\n"
    killed = [one.killed for one in records if one.killed]
    state = ""
    if not killed and earlier:
        killed, state = [one.killed for one in earlier if one.killed], " of the earlier state"
    if killed:
        text += f"""## Services killed

{len(killed)} of the flights{state} again over DDS, every service a process, one to three of them killed by `kill -9` ({sum(one.killed for one in killed)} kills):
{sum(len(one.goals_lost) for one in killed)} goals lost, {sum(len(one.doubled) for one in killed)} commands doubled,
{share(sum(one.result in ("achieved", "partial") for one in killed), len(killed))} with a defined end, {share(sum(one.arrived for one in killed), len(killed))} arrived;
entries into marked soil: {measured_entries(killed)}.

{table(["seed", "transport", "killed", "end", "arrived"], [[str(one.seed), one.dds, one.kills, one.result, "yes" if one.arrived else "no"] for one in killed])}
"""
    faults = [(one.flight.seed, fault) for one in records for fault in one.faults]
    text += f"## Rules\n\nEvery goal has an end, the primary is never in soil that its map had as No-Go, nothing is done twice: {len(faults)} broken.\n"
    text += "".join(f"- seed {seed}: {fault}\n" for seed, fault in faults)
    target.write_text(text + by_hand)
