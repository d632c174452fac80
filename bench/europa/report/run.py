#!/usr/bin/env python3
"""Flies the experiments of MEXEC, section V.A, and writes docs/europa-experiments.md and docs/pictures/europa-*.svg.

Two processes of bench_europa fly at a time. With --results nothing is flown: the files are what bench_europa printed."""

from __future__ import annotations

import argparse
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import page
from flights import Results

ROOT = Path(__file__).resolve().parents[3]
SETTINGS = ROOT / "bench/europa/experiments.yaml"
CAUSES = Path(__file__).with_name("causes.json")
BIASES = ["0", "0.1", "-0.1"]
# What is swept, as bench_europa names it: factors of the values of the settings would hide what was flown.
SWEPT = {"c_g [J]": ("--ground-j", [1e6, 2e6, 8e6, 16e6]), "c_r [J]": ("--replanning-j", [0, 1e6, 2e6, 4e6]),
         "share of d": ("--discovery-share", [0, 0.6, 1]), "u_d": ("--discovery-utility", [0.05, 0.3])}


def flown(bench: Path, options: list[str]) -> dict:
    done = subprocess.run([bench, *options], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(f"bench_europa {' '.join(options)} failed: {done.stderr.splitlines()[-1] if done.stderr else done.returncode}")
    return json.loads(done.stdout)


def fly(bench: Path, network: str, runs: int, sweep_runs: int) -> dict:
    """All that the page is made of, and the command that makes it again."""
    points = [(name, option, value) for name, (option, values) in SWEPT.items() for value in values] if sweep_runs else []
    orders = [["--network", network, "--runs", str(runs), f"--bias={bias}"] for bias in BIASES]
    orders += [["--network", network, "--runs", str(sweep_runs), "--bias=0", option, str(value)] for _, option, value in points]
    with ThreadPoolExecutor(2) as two:
        documents = list(two.map(lambda options: flown(bench, options), orders))
    swept = [[name, value, document] for (name, _, value), document in zip(points, documents[len(BIASES):])]
    command = ["bench/europa/report/run.py", "--network", network, "--runs", str(runs), "--sweep-runs", str(sweep_runs)]
    return {"command": command, "variants": documents[:len(BIASES)], "swept": swept}


def forecast() -> float:
    """The share of a prescient planner's utility that was registered before the experiments."""
    found = re.search(r"^forecast_replan_share: \{value: ([0-9.]+)", SETTINGS.read_text(), re.MULTILINE)
    if not found:
        raise SystemExit(f"{SETTINGS}: forecast_replan_share is missing")
    return float(found[1])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/bench/bench_europa", help="the program that flies")
    parser.add_argument("--network", default="missions/europa/network.yaml", help="the network that is flown")
    parser.add_argument("--runs", type=int, default=50, help="flights of each strategy and variant")
    parser.add_argument("--sweep-runs", type=int, default=0, help="flights of each strategy and swept value; 0 sweeps nothing")
    parser.add_argument("--results", type=Path, help="what --keep has written, instead of flying: for a cause that was added")
    parser.add_argument("--keep", type=Path, help="the file that keeps what was flown")
    parser.add_argument("--out", type=Path, default=ROOT / "docs", help="the folder of the page; pictures/ stands in it")
    args = parser.parse_args()
    if args.runs < 2 or args.sweep_runs == 1:
        parser.error("an interval needs two runs at least")
    flights = json.loads(args.results.read_text()) if args.results else fly(args.bench, args.network, args.runs, args.sweep_runs)
    if args.keep:
        args.keep.write_text(json.dumps(flights))
    results = Results(*flights["variants"])
    swept = [(name, value, Results(document)) for name, value, document in flights["swept"]]
    causes = json.loads(CAUSES.read_text()) if CAUSES.exists() else {}
    command = shlex.join(flights["command"])
    (args.out / "pictures").mkdir(parents=True, exist_ok=True)
    (args.out / "europa-experiments.md").write_text(page.page(results, swept, causes, command, forecast()))
    for name, picture in page.pictures(results).items():
        (args.out / "pictures" / f"europa-{name}.svg").write_text(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
