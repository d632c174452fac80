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
    parser.add_argument("--results", type=Path, nargs="+", help="what bench_europa printed, instead of flying")
    parser.add_argument("--keep", type=Path, help="where to keep what it printed")
    parser.add_argument("--out", type=Path, default=ROOT / "docs", help="the folder of the page; pictures/ stands in it")
    args = parser.parse_args()
    if args.runs < 2 or args.sweep_runs == 1:
        parser.error("an interval needs two runs at least")
    swept: list[tuple[str, float, Results]] = []
    if args.results:
        results = Results.load(*args.results)
    else:
        base = ["--network", args.network, "--runs", str(args.runs)]
        points = [(name, option, value) for name, (option, values) in SWEPT.items() for value in values] if args.sweep_runs else []
        orders = [[*base, f"--bias={bias}"] for bias in BIASES]
        orders += [["--network", args.network, "--runs", str(args.sweep_runs), "--bias=0", option, str(value)]
                   for _, option, value in points]
        with ThreadPoolExecutor(2) as two:
            documents = list(two.map(lambda options: flown(args.bench, options), orders))
        results = Results(*documents[:len(BIASES)])
        swept = [(name, value, Results(document)) for (name, _, value), document in zip(points, documents[len(BIASES):])]
        if args.keep:
            args.keep.mkdir(parents=True, exist_ok=True)
            for bias, document in zip(BIASES, documents):
                (args.keep / f"bias{bias}.json").write_text(json.dumps(document))
    causes = json.loads(CAUSES.read_text()) if CAUSES.exists() else {}
    command = shlex.join(["bench/europa/report/run.py", *sys.argv[1:]])
    (args.out / "pictures").mkdir(parents=True, exist_ok=True)
    (args.out / "europa-experiments.md").write_text(page.page(results, swept, causes, command, forecast()))
    for name, picture in page.pictures(results).items():
        (args.out / "pictures" / f"europa-{name}.svg").write_text(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
