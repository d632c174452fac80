"""The Markdown report of the Europa lander's field trial."""

from __future__ import annotations

import math
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from xml.sax.saxutils import escape

from europa_flights import RANKS, Flight
from europa_kills import KilledFlight
from europa_scenarios import UNCERTAINTIES, Scenario
from europa_schedules import Schedules
from report import HAND, examples, percent, seeds_of, table

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "europa/report"))
from estimate import Estimate, mean, ratio  # noqa: E402


@dataclass
class Record:
    scenario: Scenario
    flight: Flight
    knowing: Flight | None = None
    killed: KilledFlight | None = None
    schedules: list[Schedules] = field(default_factory=list)  # of the flight, and of the killed one

    @property
    def faults(self) -> list[str]:
        return self.flight.faults + (self.killed.faults if self.killed else []) + [fault for one in self.schedules for fault in one.faults]


def shown(estimate: Estimate, factor: float = 1, unit: str = "") -> str:
    half = f" ± {factor * estimate.half:.1f}" if math.isfinite(estimate.half) else ""
    return f"{factor * estimate.mean:.1f}{half}{unit}"


def pairs(records: list[Record]) -> list[Record]:
    return [one for one in records if one.knowing and one.knowing.utility() > 0]


def share(records: list[Record]) -> str:
    some = pairs(records)
    if len(some) < 2:
        return "–"
    return shown(ratio([one.flight.utility() for one in some], [one.knowing.utility() for one in some]), 100, " %")


def flights_section(records: list[Record]) -> str:
    flights = [one.flight for one in records]
    results = Counter(one.result for one in flights)
    faults = [(one.scenario.seed, fault) for one in records for fault in one.flight.faults]
    refused = [one for one in flights if one.refused]
    out = f"## Flights\n\n{len(records)} flights: " + ", ".join(f"{count} {name}" for name, count in results.most_common())
    out += f". In {sum(one.battery_s is not None for one in flights)} of them the battery was empty before the 22 days were over.\n\n"
    out += (f"**Rules** (a defined end; every zone in its range; the subway map; no session above `downlink_limit_j` and no sol above `sol_limit_j`; nothing done or sent twice): "
            f"{'all hold' if not faults else str(len(faults)) + ' broken'}.\n")
    out += "".join(f"- seed {seed}: {fault}\n" for seed, fault in faults)
    slow = [one for one in flights if one.long_sessions]
    if slow:
        out += f"\nIn {len(slow)} flights a link slower than foreseen made sessions longer than the limits of a downlink or a sol permit a plan ({examples([one.seed for one in slow])}).\n"
    total = sum(len(one.refused) for one in flights)
    out += f"\n**Plan versions refused** by the independent checker or the executive, and so never flown: {total}"
    out += f" in {len(refused)} flights ({examples([one.seed for one in refused])}).\n" if refused else ".\n"
    checked = [(one.scenario.seed, schedules) for one in records for schedules in one.schedules]
    if checked:
        wrong = [(seed, fault) for seed, one in checked for fault in one.faults]
        out += (f"\n**Schedules of downlinks**, each computed anew by the independent checker from the records of {len(checked)} flights, "
                f"killed ones among them: {sum(one.checked for _, one in checked)}, {'none of them wrong' if not wrong else 'wrong in ' + str(len(wrong)) + ' records'}.\n")
        out += "".join(f"- seed {seed}: {fault}\n" for seed, fault in wrong)
    rows = []
    for name, text in (("", "all ranks"), *((rank, rank) for rank in RANKS)):
        some = pairs(records)
        rows.append([text, shown(mean([one.utility(name) for one in flights])),
                     shown(mean([one.flight.utility(name) for one in some])) if some else "–",
                     shown(mean([one.knowing.utility(name) for one in some])) if some else "–"])
    out += "\n## Utility received on Earth\n\nOf each product what the network says it is worth; mean with its 95 % interval.\n\n"
    out += table(["rank", f"{len(flights)} flights", f"the {len(pairs(records))} flown twice", "the same, knowing"], rows)
    some = pairs(records)
    if some:
        less = [one for one in some if one.flight.utility() < 0.9 * one.knowing.utility()]
        out += (f"\nAgainst the same flight with a planner that knows (`europa_knowing.py` says what it is told): **{share(records)}**; below 90 % in "
                f"{len(less)} of {len(some)} flights{' (' + examples([one.scenario.seed for one in less]) + ')' if less else ''}, above 100 % in "
                f"{sum(one.flight.utility() > one.knowing.utility() for one in some)}. The one that knows is no bound: it plans with the same engine, and is "
                "told nothing of failures, hollow successes, collapses, drops and hidden views.\n")
    samples = Counter(one.samples_home for one in flights)
    out += "\nSamples on Earth: " + ", ".join(f"{samples[count]} flights with {count}" for count in sorted(samples)) + ".\n"
    return out


def uncertainties_section(records: list[Record], picture: str) -> str:
    rows = []
    for name in UNCERTAINTIES:
        some = [one for one in records if name in one.scenario.drawn]
        others = [one for one in records if name not in one.scenario.drawn]
        if len(some) > 1 and len(others) > 1:
            rows.append([name, len(some), shown(mean([one.flight.utility() for one in some])), shown(mean([one.flight.utility() for one in others])),
                         shown(mean([float(one.flight.samples_home) for one in some])), share(some)])
    return ("\n## By uncertainty\n\n" + f"![Utility received with and without each uncertainty]({picture})\n\n"
            + table(["uncertainty", "flights with it", "utility with it", "utility without it", "samples with it", "of the one that knows"], rows))


def losses_section(records: list[Record]) -> str:
    losses = [loss for one in records for loss in one.flight.losses]
    by_cause = Counter(loss.cause for loss in losses)
    rows = [[cause, count, len({loss.seed for loss in losses if loss.cause == cause}), examples([loss.seed for loss in losses if loss.cause == cause])]
            for cause, count in by_cause.most_common()]
    codes: Counter[str] = Counter(code for one in records for _, _, code in one.flight.failures)
    return ("\n## What was lost, and why\n\nWhat a flight began and did not bring home, and sites that it never opened; residual data are meant to stay "
            "where there is no energy left for them.\n\n" + table(["cause", "samples, sites or products", "flights", "seeds"], rows)
            + "\nCommands that failed, by code: " + (", ".join(f"{code} {count}" for code, count in codes.most_common()) or "none") + ".\n")


def kills_section(records: list[Record]) -> str:
    some = [one for one in records if one.killed]
    if not some:
        return ""
    rows = []
    for dds in ["all", *sorted({one.killed.dds for one in some})]:
        part = [one for one in some if dds in ("all", one.killed.dds)]
        killed = [one.killed for one in part]
        rows.append([dds, len(part), sum(one.killed for one in killed), sum(one.flight.result in ("achieved", "partial") for one in killed),
                     sum(one.goals_lost for one in killed), sum(len(one.products_lost) for one in killed),
                     sum("times" in fault for one in killed for fault in one.faults), sum(len(one.flight.refused) for one in killed),
                     f"{sum(one.killed.flight.samples_home == one.flight.samples_home for one in part)}",
                     percent(sum(one.flight.utility() for one in killed), sum(one.flight.utility() for one in part))])
    out = ("\n## With kills\n\nThe same seeds over DDS, every service a process of its own; one to three of planner and executive die by `kill -9` at drawn "
           "moments, and are started again.\n\n")
    out += table(["transport", "flights", "kills", "defined ends", "goals lost", "products lost", "done twice", "versions refused",
                  "as many samples as without", "utility of that without"], rows)
    faults = [(one.scenario.seed, one.killed.kills, fault) for one in some for fault in one.killed.faults]
    return out + "".join(f"- seed {seed} ({kills}): {fault}\n" for seed, kills, fault in faults)


def bars(records: list[Record]) -> str:
    """Mean utility with and without each uncertainty, with 95 % intervals, as SVG."""
    rows = []
    for name in UNCERTAINTIES:
        some = [one.flight.utility() for one in records if name in one.scenario.drawn]
        others = [one.flight.utility() for one in records if name not in one.scenario.drawn]
        if len(some) > 1 and len(others) > 1:
            rows.append((name, mean(some), mean(others)))
    widest = max((one.mean + min(one.half, 2 * one.mean) for row in rows for one in row[1:]), default=1) or 1
    height, scale = 34 * len(rows) + 46, 440 / widest
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="760" height="{height}" font-family="sans-serif" font-size="13">',
           f'<rect width="760" height="{height}" fill="white"/>',
           '<rect x="180" y="8" width="12" height="12" fill="#c0562c"/><text x="198" y="19">with it</text>',
           '<rect x="270" y="8" width="12" height="12" fill="#8aa4bd"/><text x="288" y="19">without it (utility received; lines: 95 % interval)</text>']
    for i, (name, some, others) in enumerate(rows):
        y = 34 * i + 32
        out.append(f'<text x="170" y="{y + 18}" text-anchor="end">{escape(name)}</text>')
        for one, top, colour in ((some, y, "#c0562c"), (others, y + 13, "#8aa4bd")):
            low, high, end = max(0, one.low) * scale, min(one.high, widest) * scale, one.mean * scale
            out.append(f'<rect x="180" y="{top}" width="{end:.0f}" height="12" fill="{colour}"/>')
            out.append(f'<line x1="{180 + low:.0f}" y1="{top + 6}" x2="{180 + high:.0f}" y2="{top + 6}" stroke="#333"/>')
            out.append(f'<text x="{188 + high:.0f}" y="{top + 11}" font-size="11">{one.mean:.2f}</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def write(records: list[Record], target: Path) -> None:
    (target.parent / "pictures").mkdir(parents=True, exist_ok=True)
    picture = target.parent / "pictures" / f"{target.stem}.svg"
    picture.write_text(bars(records))
    schedules = sum(bool(one.schedules) for one in records)
    known, killed = sum(one.knowing is not None for one in records), sum(one.killed is not None for one in records)
    first = records[0].scenario.seed
    command = f"bench/field_trial/europa.py --runs {len(records)} --seed {first} --knowing {known} --kills {killed}{f' --schedules {schedules}' if schedules else ''} --out FOLDER --report docs/field-trial-europa.md"
    head = f"""# Field trial: the Europa lander

{len(records)} flights of `missions/europa`, seeds {seeds_of(records)}; into each a seed draws any of the 16 uncertainties of MEXEC, section IV.C.3 (R117, R120):
whether it befalls the flight, how strongly and when. {known} were flown again by a planner that knows, {killed} again as processes that are killed.
Written by `{command}`
([how it works](../bench/field_trial/README.md)). One flight again, alone, with all processes:

    bench/field_trial/europa.py --runs 1 --seed {first} --out FOLDER && ./run FOLDER/europa --scenario seed-{first:04d} --seed {first}

"""
    old = target.read_text() if target.exists() else ""
    by_hand = old[old.index(HAND):] if HAND in old else ""
    sections = [flights_section(records), uncertainties_section(records, f"pictures/{picture.name}"), losses_section(records), kills_section(records)]
    target.write_text(head + "".join(sections) + by_hand)
