#!/usr/bin/env python3
"""The field trial of missions/faster: seeded flights over sand traps that nobody knows, the same with repair switched off or with a primary
whose wheels feel nothing, and the same as processes that are killed; writes the results as JSON and a page.

    ninja -C build/release programs roci-rehearse true-way
    bench/field_trial/faster.py --runs 200 --unrepaired 200 --kills 100 --out FOLDER --flown --report docs/field-trial-faster.md

Exit code 0: every rule holds; 1: one does not; 2: wrong use. See README.md."""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

import faster_report
from faster_flights import Flight, Repair, fly, without_repairs, without_soil_sensing
from faster_kills import KilledFlight, fly_killing
from flights import Programs

ROOT = Path(__file__).resolve().parents[2]


@dataclass
class Record:
    flight: Flight
    unrepaired: Flight | None = None
    killed: KilledFlight | None = None
    unfeeling: Flight | None = None  # with a primary whose wheels feel nothing

    @property
    def faults(self) -> list[str]:
        return [fault for one in (self.flight, self.unrepaired, self.killed, self.unfeeling) if one for fault in one.faults]


def ways(tool: Path, mission: Path, first: int, count: int) -> dict[int, float | None]:
    """By seed the length of a shortest way on the true map."""
    done = subprocess.run([str(tool), str(mission), "hidden", str(first), str(first + count - 1)], capture_output=True, text=True, check=True)
    return {one["seed"]: one.get("length_m") for one in map(json.loads, done.stdout.splitlines())}


def loaded(folder: Path) -> list[Record]:
    """The records of a trial that was flown before. Raises OSError, ValueError, KeyError or TypeError where none was."""

    def flight(told: dict | None) -> Flight | None:
        return Flight(**{**told, "repairs": [Repair(**one) for one in told["repairs"]]}) if told else None

    records = [Record(flight(one["flight"]), flight(one.get("unrepaired")), KilledFlight(**one["killed"]) if one.get("killed") else None,
                      flight(one.get("unfeeling"))) for one in json.loads((folder / "results.json").read_text())]
    if not records:
        raise ValueError(f"{folder / 'results.json'} has no flight")
    return records


def tell(name: str, flight: Flight | KilledFlight) -> None:
    print(f"{name}: {flight.result}, {'arrived' if flight.arrived else 'did not arrive: ' + getattr(flight, 'reason', '')}", flush=True)
    for fault in flight.faults:
        print(f"{name}: RULE BROKEN: {fault}", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description="Flies two rovers over hidden traps and reports who arrives.")
    parser.add_argument("--runs", type=int, default=200, help="number of flights (200)")
    parser.add_argument("--seed", type=int, default=1, help="of the first; the others count up (1)")
    parser.add_argument("--unrepaired", type=int, default=0, help="how many of the first ones fly again with repair switched off (0)")
    parser.add_argument("--kills", type=int, default=0, help="how many of the first ones fly again as processes that are killed (0)")
    parser.add_argument("--unfeeling", type=int, default=0, help="of how many of the first ones those fly again, with a primary whose wheels feel nothing, in which they found soft soil (0)")
    parser.add_argument("--out", type=Path, required=True, help="folder for journals and results")
    parser.add_argument("--report", type=Path, help="Markdown file to write (default: OUT/field-trial-faster.md)")
    parser.add_argument("--mission", type=Path, default=ROOT / "missions/faster", help="its folder (missions/faster)")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin", help="programs (build/release/bin)")
    parser.add_argument("--least", type=float, default=0.95, help="share that must arrive where a way exists (0.95)")
    parser.add_argument("--flown", action="store_true", help="take the flights that lie in OUT already, fly what is missing")
    parser.add_argument("--beside", type=Path, nargs="+", default=[], help="OUT folders of other ranges of seeds, told beside this one")
    parser.add_argument("--earlier", type=Path, help="OUT folder of a trial of an earlier state, told beside this one as such")
    arguments = parser.parse_args()
    out, programs = arguments.out.resolve(), Programs(arguments.bin.resolve(), arguments.mission.resolve(), None)
    tool = programs.bin.parent / "tests/true-way"
    for program in (programs.rehearse, programs.bin / "roci-launch", tool):
        if not program.exists():
            parser.error(f"{program} is missing; build it: ninja -C build/release programs roci-rehearse true-way")
    try:
        beside = [[one.flight for one in loaded(folder)] for folder in arguments.beside]
        earlier = loaded(arguments.earlier) if arguments.earlier else []
    except (OSError, ValueError, KeyError, TypeError) as fault:
        parser.error(f"--beside and --earlier want folders that --out has written: {fault}")
    out.mkdir(parents=True, exist_ok=True)
    exists = ways(tool, programs.mission, arguments.seed, arguments.runs)
    bare = without_repairs(programs.mission, out / "without_repairs") if arguments.unrepaired else None
    numb = without_soil_sensing(programs.mission, out / "without_soil_sensing") if arguments.unfeeling else None
    records = []
    for number in range(arguments.runs):
        seed = arguments.seed + number
        name = f"{seed:04d}"
        record = Record(fly(programs, programs.mission, seed, out / "flights" / name, exists[seed], arguments.flown))
        tell(name, record.flight)
        if number < arguments.unrepaired:
            record.unrepaired = fly(programs, bare, seed, out / "unrepaired" / name, exists[seed], arguments.flown)
            tell(f"{name} without repairs", record.unrepaired)
        if number < arguments.unfeeling and record.flight.felt:
            record.unfeeling = fly(programs, numb, seed, out / "unfeeling" / name, exists[seed], arguments.flown)
            tell(f"{name} with wheels that feel nothing", record.unfeeling)
        if number < arguments.kills:
            record.killed = fly_killing(programs.bin, programs.mission, seed, out / "killed" / name, record.flight.sim_s, arguments.flown)
            tell(f"{name} killed ({record.killed.kills}; {record.killed.dds})", record.killed)
        records.append(record)
        (out / "results.json").write_text(json.dumps([asdict(one) for one in records], indent=1))
        faster_report.write(records, arguments.report or out / "field-trial-faster.md", beside, earlier)
    broken = any(record.faults for record in records)
    with_way = [record.flight for record in records if record.flight.way_m is not None]
    short = sum(flight.arrived for flight in with_way) < arguments.least * len(with_way)
    print(f"report: {arguments.report or out / 'field-trial-faster.md'}")
    return 1 if broken or short else 0


if __name__ == "__main__":
    sys.exit(main())
