#!/usr/bin/env python3
"""The field trial of missions/europa: seeded flights in which any of 16 uncertainties befall the lander, some again by a planner that knows, and some
again as processes that are killed; writes a report.

    ninja -C build/release programs roci-rehearse
    bench/field_trial/europa.py --runs 200 --knowing 200 --kills 100 --out FOLDER --report docs/field-trial-europa.md

Exit code 0: every rule holds; 1: one does not; 2: wrong use. See README.md."""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import europa_report
from europa_flights import Flight, fly
from europa_kills import KilledFlight, fly_killing
from europa_knowing import knowing
from europa_scenarios import Scenario, draw
from europa_schedules import schedules_of
from flights import Programs, lay_out_mission

ROOT = Path(__file__).resolve().parents[2]


def tell(name: str, flight: Flight) -> None:
    print(f"{name}: {flight.result}, {flight.samples_home} samples, utility {flight.utility():.1f}, {len(flight.refused)} versions refused, "
          f"{flight.wall_s:.0f} s", flush=True)
    for fault in flight.faults:
        print(f"{name}: RULE BROKEN: {fault}", flush=True)


class Trial:
    def __init__(self, arguments: argparse.Namespace):
        self.arguments = arguments
        self.programs = Programs(arguments.bin, ROOT / "missions/europa", None)
        self.mission = lay_out_mission(self.programs.mission, arguments.out / "europa")

    def fly(self, scenario: Scenario, name: str) -> Flight:
        (self.mission / "scenarios" / f"{name}.yaml").write_text(scenario.yaml())
        flight = fly(self.programs, self.mission, scenario, name, self.arguments.out / "flights" / name, self.arguments.flown)
        tell(name, flight)
        return flight

    def one(self, seed: int, with_knowing: bool, with_kills: bool, with_schedules: bool) -> europa_report.Record:
        scenario = draw(seed)
        record = europa_report.Record(scenario, self.fly(scenario, scenario.name))
        if record.flight.result == "crashed":
            return record
        if with_knowing:
            record.knowing = self.fly(knowing(scenario, record.flight), f"known-{seed:04d}")
        if with_kills:
            folder = self.arguments.out / "kills" / scenario.name
            record.killed = fly_killing(self.arguments.bin, self.mission, scenario, folder, record.flight, self.arguments.flown)
            tell(f"killed-{seed:04d} ({record.killed.kills}, {record.killed.dds})", record.killed.flight)
            for fault in record.killed.faults:
                print(f"killed-{seed:04d}: RULE BROKEN: {fault}", flush=True)
        if with_schedules:
            record.schedules = [schedules_of(self.arguments.bin, self.arguments.out / kind / scenario.name)
                                for kind in (("flights", "kills") if with_kills else ("flights",))]
            for fault in (fault for one in record.schedules for fault in one.faults):
                print(f"{scenario.name}: SCHEDULE WRONG: {fault}", flush=True)
        return record


def main() -> int:
    parser = argparse.ArgumentParser(description="Flies seeded missions of the Europa lander and reports what was lost.")
    parser.add_argument("--runs", type=int, default=200, help="number of flights (200)")
    parser.add_argument("--seed", type=int, default=1, help="of the first; the others count up (1)")
    parser.add_argument("--knowing", type=int, default=0, help="how many of the first ones fly again with a planner that knows (0)")
    parser.add_argument("--kills", type=int, default=0, help="how many of the first ones fly again as processes that are killed (0)")
    parser.add_argument("--schedules", type=int, default=0, help="of how many of the first ones every schedule of downlinks is computed anew (0)")
    parser.add_argument("--out", type=Path, required=True, help="folder for scenarios, journals and results")
    parser.add_argument("--report", type=Path, help="Markdown file to write (default: OUT/field-trial-europa.md)")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin", help="programs (build/release/bin)")
    parser.add_argument("--jobs", type=int, default=2, help="flights at the same time (2)")
    parser.add_argument("--flown", action="store_true", help="take the flights that lie in OUT already, fly what is missing")
    arguments = parser.parse_args()
    arguments.out, arguments.bin = arguments.out.resolve(), arguments.bin.resolve()
    for program in ("roci-rehearse", "roci-launch", "roci-network"):
        if not (arguments.bin / program).exists():
            parser.error(f"{program} is missing; build it: ninja -C build/release programs roci-rehearse")
    trial = Trial(arguments)
    with ThreadPoolExecutor(arguments.jobs) as workers:
        records = list(workers.map(lambda i: trial.one(arguments.seed + i, i < arguments.knowing, i < arguments.kills, i < arguments.schedules), range(arguments.runs)))
    target = arguments.report or arguments.out / "field-trial-europa.md"
    europa_report.write(records, target)
    print(f"report: {target}")
    return 1 if any(record.faults for record in records) else 0


if __name__ == "__main__":
    sys.exit(main())
