#!/usr/bin/env python3
"""Flies the experiments of MEXEC, section V.A, and writes docs/europa-experiments.md and docs/pictures/europa-*.svg.

Two processes of bench_europa fly at a time, if nothing else is asked. With --results nothing is flown: the files are what bench_europa printed."""

from __future__ import annotations

import argparse
import hashlib
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
SWEPT = {"c_g [J]": ("--ground-j", [1e6, 8e6, 16e6]), "c_r [J]": ("--replanning-j", [0, 1e6, 4e6]),
         "share of d": ("--discovery-share", [0, 1]), "u_d": ("--discovery-utility", [0.05, 0.3])}
# What replanning does without or otherwise, and at which bias that is flown.
OTHERS = [("no repair", "0", ["--without", "repair"]), ("no optimize", "0", ["--without", "optimize"]),
          ("no learning", "0", ["--without", "learning"]), ("no discovery", "0", ["--without", "discovery"]),
          ("no retries", "0", ["--without", "retry"]), ("downlinks asked for", "0", ["--downlinks"]),
          ("robust", "0", ["--robust"]), ("robust", "0.1", ["--robust"])]
MISSION = "missions/europa/network-rsm1.yaml"
SIZES, DAYS = [(3, 3), (5, 5), (10, 5), (30, 10)], "2"  # sites and targets; days of mission time
FAILING = "transport_sample"  # whose first execution fails in figure 5
FIGURES = {"mission": ["--strategy", "replan", "--look-days", "6", "--look-for", "mono_panorama", "downlink", "discard_sample"],
           **{f"{strategy} {kind}": ["--strategy", strategy, "--failure", f"{FAILING}={kind}"]
              for strategy, kind in (("replan", "none"), ("static", "flexible"), ("ground", "flexible"), ("fe", "flexible"),
                                     ("replan", "replanning"))}}


def flown(bench: Path, options: list[str], parts: Path | None = None) -> dict:
    """What the program tells of the flights; with a folder of parts from there if it flew them before."""
    part = parts / (hashlib.sha256(shlex.join([bench.name, *options]).encode()).hexdigest()[:16] + ".json") if parts else None
    if part and part.exists():
        return json.loads(part.read_text())
    document = told(bench, options)
    if part:
        part.write_text(json.dumps(document))
    return document


def told(bench: Path, options: list[str]) -> dict:
    done = subprocess.run([bench, *options], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(f"bench_europa {' '.join(options)} failed: {done.stderr.splitlines()[-1] if done.stderr else done.returncode}")
    return json.loads(done.stdout)


def fly(bench: Path, network: str, runs: int, few: int, jobs: int = 2, parts: Path | None = None) -> dict:
    """All that the page is made of, and the command that makes it again. What is swept, left out or judged otherwise is flown `few` times."""
    base = ["--network", network]
    points = [(name, option, value) for name, (option, values) in SWEPT.items() for value in values]
    variants = [[*base, "--runs", str(runs), f"--bias={bias}"] for bias in BIASES]
    swept = [[*base, "--runs", str(few), "--bias=0", "--strategy", "ground", "fe", "replan", option, str(value)]
             for _, option, value in points]
    others = [(name, bias, [*base, "--runs", str(few), f"--bias={bias}", "--strategy", "replan", "--no-prescient", *options])
              for name, bias, options in OTHERS]
    tool = bench.with_name("bench_europa_cycles")
    costs = [["--seed", str(seed)] for seed in (1, 2, 3)]
    costs += [["--sites", str(sites), "--targets", str(targets), "--days", DAYS] for sites, targets in SIZES]
    figures = {name: [*base, "--runs", "1", "--bias=0", "--no-prescient", "--executions", *options] for name, options in FIGURES.items()}
    figures["mission"][1] = MISSION
    with ThreadPoolExecutor(jobs) as pool:
        def all_of(orders: list[list[str]], program: Path = bench) -> list[dict]:
            return list(pool.map(lambda options: flown(program, options, parts), orders))

        out = {"variants": all_of(variants)}
        out["swept"] = [[name, value, document] for (name, _, value), document in zip(points, all_of(swept))] if few else []
        out["others"] = [[name, bias, document] for (name, bias, _), document in
                         zip(others, all_of([order for _, _, order in others]))] if few else []
        out["cycles"] = all_of(costs, tool)
        out["figures"] = dict(zip(figures, all_of(list(figures.values()))))
    out["command"] = ["bench/europa/report/run.py", "--network", network, "--runs", str(runs), "--few", str(few)]
    return out


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
    parser.add_argument("--few", type=int, default=8,
                        help="flights of each strategy for what is swept, left out or judged otherwise; 0: none of that")
    parser.add_argument("--jobs", type=int, default=2, help="how many programs fly at a time")
    parser.add_argument("--parts", type=Path, help="a folder that keeps what each program has told, so that a run that was broken off goes on; "
                        "empty it for another engine")
    parser.add_argument("--results", type=Path, help="what --keep has written, instead of flying: for a cause that was added")
    parser.add_argument("--keep", type=Path, help="the file that keeps what was flown")
    parser.add_argument("--out", type=Path, default=ROOT / "docs", help="the folder of the page; pictures/ stands in it")
    args = parser.parse_args()
    if args.runs < 2 or args.few == 1:
        parser.error("an interval needs two runs at least")
    if args.parts:
        args.parts.mkdir(parents=True, exist_ok=True)
    flights = json.loads(args.results.read_text()) if args.results else fly(args.bench, args.network, args.runs, args.few, args.jobs, args.parts)
    if args.keep:
        args.keep.write_text(json.dumps(flights))
    results = Results(*flights["variants"])
    causes = json.loads(CAUSES.read_text()) if CAUSES.exists() else {}
    told = page.Told(results, [(name, value, Results(document)) for name, value, document in flights["swept"]],
                     [(name, float(bias), Results(document)) for name, bias, document in flights["others"]], flights["cycles"],
                     flights["figures"], causes, shlex.join(flights["command"]), forecast())
    (args.out / "pictures").mkdir(parents=True, exist_ok=True)
    (args.out / "europa-experiments.md").write_text(page.page(told))
    for name, picture in page.pictures(told).items():
        (args.out / "pictures" / f"europa-{name}.svg").write_text(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
