#!/usr/bin/env python3
"""Flies hundreds of missions with real processes and kills services in them; counts what was lost or done twice."""

import argparse
import json
import random
import shutil
import statistics
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from flight import CRASH_POINTS, KILLABLE, LIVE_KILLABLE, PAIR_VICTIMS, VENDORS, Kills, fly
from judge import Judgement, judge

ROOT = Path(__file__).resolve().parents[2]


def draw(rng: random.Random, number: int, standby: bool, live: bool) -> Kills:
    """Half by crash points of exec_svc, half by kill -9 of any service, or of a pair's members, at random moments."""
    if number % 2 == 0:
        points = [f"{rng.choice(CRASH_POINTS)}:{int(10 ** rng.uniform(0, 2.5))}" for _ in range(rng.randint(1, 3))]
        return Kills(crash=",".join(points))
    if standby:
        victims = [rng.choice(PAIR_VICTIMS) for _ in range(rng.randint(1, 3))]
        return Kills(at=sorted((rng.uniform(0.01, 0.95), victim) for victim in victims))
    # exec_svc as often as all others, a live robot as often as the rest together; a moment is a share of the mission time of the undisturbed flight.
    killable = KILLABLE + ["exec_svc"] * len(KILLABLE) + (LIVE_KILLABLE * len(KILLABLE) if live else [])
    victims = [rng.choice(killable) for _ in range(rng.randint(1, 3))]
    return Kills(at=sorted((rng.uniform(0.01, 0.95), victim) for victim in victims))


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2, help="flights at a time")
    parser.add_argument("--mission", type=Path, default=ROOT / "missions/planetary")
    parser.add_argument("--scenarios", default="nominal,opportunistic,blocked_window,comm_lost,battery_low,too_many,arm_fault")
    parser.add_argument("--clock", default="simulated", help="live: samples may leave by halves; flights take their time")
    parser.add_argument("--speed", default="max", help="with --clock live e.g. 300")
    parser.add_argument("--standby", action="store_true", help="a pair of executives; the leader is what dies")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--out", type=Path, help="keep the run folders of flights that were not as they should be here")
    parser.add_argument("--json", action="store_true", help="the last line of standard output is the result as JSON")
    return parser.parse_args()


def table(rows: dict[str, Counter]) -> str:
    columns = list(Judgement.COUNTS)
    lines = ["| killed | " + " | ".join(columns) + " |", "|" + "---|" * (len(columns) + 1)]
    for name, counts in sorted(rows.items()):
        lines.append(f"| {name} | " + " | ".join(str(counts[column]) for column in columns) + " |")
    return "\n".join(lines)


def take_over_table(take_overs: dict[str, list[float]]) -> str:
    lines = ["| seconds from the leader's end to its successor's first step | take-overs | least | median | most |", "|---|---|---|---|---|"]
    for name, times in sorted(take_overs.items()):
        if times:
            lines.append(f"| {name} | {len(times)} | {min(times):.2f} | {statistics.median(times):.2f} | {max(times):.2f} |")
    return "\n".join(lines)


def main() -> int:
    options = parse()
    rng = random.Random(options.seed)
    scenarios = options.scenarios.split(",")
    work = Path(tempfile.mkdtemp(prefix="roci_kill_"))
    plans = []
    for number in range(options.runs):
        plans.append((number, rng.choice(VENDORS), rng.choice(scenarios), rng.randint(1, 3), draw(rng, number, options.standby, options.clock == "live")))
    calm = {}
    for scenario, seed in sorted({(plan[2], plan[3]) for plan in plans}):
        calm[scenario, seed] = fly(options, work / f"calm-{scenario}-{seed}", "fastdds", scenario, seed, Kills())

    def one(plan) -> tuple:
        number, dds, scenario, seed, kills = plan
        undisturbed = calm[scenario, seed]
        flight = fly(options, work / f"{number}", dds, scenario, seed, kills, undisturbed.sim_s)
        return plan, flight, judge(flight, undisturbed)

    rows: dict[str, Counter] = {}
    faults = []
    take_overs: dict[str, list[float]] = {}
    with ThreadPoolExecutor(options.jobs) as pool:
        for (number, dds, scenario, seed, kills), flight, judgement in pool.map(one, plans):
            for name in ("all", dds, "crash points" if kills.crash else "kill -9"):
                rows.setdefault(name, Counter()).update(judgement.counts)
            take_overs.setdefault(dds, []).extend(flight.take_overs_s)
            if judgement.faults:
                faults.append({"run": number, "dds": dds, "scenario": scenario, "seed": seed, "kills": kills.text(),
                               "faults": judgement.faults})
                print(f"run {number} {dds} {scenario} seed {seed} {kills.text()}: {'; '.join(judgement.faults)}",
                      file=sys.stderr)
                if options.out:
                    shutil.copytree(flight.folder, options.out / str(number), dirs_exist_ok=True)
            shutil.rmtree(flight.folder, ignore_errors=True)
    shutil.rmtree(work, ignore_errors=True)
    print(table(rows))
    if options.standby:
        print(take_over_table(take_overs))
    if options.json:
        print(json.dumps({"runs": options.runs, "seed": options.seed, "counts": rows, "take_overs_s": take_overs,
                          "faults": faults}))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
