#!/usr/bin/env python3
"""How time and memory of the planner grow with goals, sites, windows, envelopes, modules, objects and variables, as Markdown tables:

  run.py --planner build/release/bin/roci-plan --validate build/release/bin/roci-validate

The problems are made by rover.py, envelopes.py, orbital.py, deliveries.py and workshop.py and run by ../ipc/run.py, three of each size. The slope is
that of a line through the logarithms of size and median, fitted to the larger half of the sizes. Memory is the engine's own count, without the program."""

import argparse
import collections
import json
import math
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

import deliveries
import envelopes
import orbital
import rover
import workshop

HERE = pathlib.Path(__file__).resolve().parent
SEEDS = 3
DOUBLING = (2, 4, 8, 16, 32)
MODULES = (4, 6, 10, 20, 40, 80, 140, 200)
DOMAINS = {"rover": HERE / "rover.pddl", "envelopes": HERE / "envelopes.pddl", "deliveries": HERE / "deliveries.pddl",
           "workshop": HERE / "workshop.pddl", "orbital": HERE.parents[1] / "missions" / "orbital" / "domain.pddl"}
# name: domain, what grows, its sizes, the problem of a size and perhaps the values of its external functions
FAMILIES = {
    "goals": ("rover", "goals among 64 sites", DOUBLING, lambda n, seed: rover.problem(64, n, 0, seed)),
    "sites": ("rover", "sites, 4 goals", (8, 16, 32, 64, 128, 256, 512), lambda n, seed: rover.problem(n, 4, 0, seed)),
    "windows": ("rover", "windows of each of 4 goals, 16 sites", (1, 2, 4, 8, 16, 32, 64),
                lambda n, seed: rover.problem(16, 4, n, seed)),
    "envelopes": ("envelopes", "furnaces of 4 jobs", DOUBLING + (64, 128), lambda n, seed: envelopes.problem(n, 4, seed)),
    "contents": ("envelopes", "jobs of each of 4 furnaces", DOUBLING + (64, 128),
                 lambda n, seed: envelopes.problem(4, n, seed)),
    "modules": ("orbital", "modules of a satellite, 4 of them to be elsewhere", MODULES,
                lambda n, seed: orbital.reconfiguration(n, 4, seed)),
    "moved": ("orbital", "modules of a satellite, all to be elsewhere", MODULES,
              lambda n, seed: orbital.reconfiguration(n, n, seed)),
    "objects": ("deliveries", "places of deliveries, 0.4 other objects for each", (25, 50, 100, 200, 400),
                lambda n, seed: deliveries.problem(n, seed)),
    "variables": ("workshop", "pieces of a workshop, any two of which may be joined", (50, 100, 200, 400, 800),
                  lambda n, seed: workshop.problem(n, seed)),
}


def write_tree(root, names):
    for name in names:
        domain, _, sizes, made = FAMILIES[name]
        folder = root / "growth" / name
        (folder / "instances").mkdir(parents=True)
        shutil.copy(DOMAINS[domain], folder / "domain.pddl")
        for size in sizes:
            for seed in range(SEEDS):
                file = folder / "instances" / f"instance-{10 * size + seed}.pddl"
                problem = made(size, seed)
                text, values = problem if isinstance(problem, tuple) else (problem, "")
                file.write_text(text)
                file.with_suffix(".values").write_text(values)


def measure(arguments, root):
    records = root / "records.jsonl"
    planner = pathlib.Path(arguments.planner).resolve()
    subprocess.run([sys.executable, HERE.parent / "ipc" / "run.py", "--root", root, "--planner", "growth", "--out", records,
                    "--command", f"{planner} {{domain}} {{problem}} --functions {{values}} --stats {{stats}}", "--validate",
                    pathlib.Path(arguments.validate).resolve(), "--seconds", str(arguments.seconds)],
                   check=True, stdout=sys.stderr)
    return [json.loads(line) for line in records.read_text().splitlines()]


def slope(points):
    """Of log y over log x, by least squares; none for fewer than two points."""
    logs = [(math.log(x), math.log(y)) for x, y in points if y > 0]
    if len(logs) < 2:
        return None
    mean_x = statistics.fmean(x for x, _ in logs)
    mean_y = statistics.fmean(y for _, y in logs)
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)


def table(family, records):
    _, what, sizes, _ = FAMILIES[family]
    by_size = collections.defaultdict(list)
    for record in records:
        if record["domain"] == f"growth/{family}":
            by_size[record["instance"] // 10].append(record)
    print(f"\n| {what} | solved | ground actions | evaluated | CPU s | engine kB | peak MB | actions | makespan s |\n"
          "| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    curves = collections.defaultdict(list)
    for size in sizes:
        solved = [record for record in by_size[size] if record["status"] == "ok"]
        if not solved:
            print(f"| {size} | 0 of {SEEDS} | | | | | | | |")
            continue
        for record in solved:
            record.update(record["stats"], actions=record["actions"], makespan=record["makespan"])
        median = {key: statistics.median(record[key] for record in solved)
                  for key in ("ground_actions", "evaluated", "cpu_s", "engine_peak_bytes", "peak_rss_kb", "actions", "makespan")}
        for name, key in (("evaluations", "evaluated"), ("time", "cpu_s"), ("memory", "engine_peak_bytes")):
            curves[name].append((size, median[key]))
        print(f"| {size} | {len(solved)} of {SEEDS} | {median['ground_actions']:.0f} | {median['evaluated']:.0f} | "
              f"{median['cpu_s']:.3f} | {median['engine_peak_bytes'] / 1000:.0f} | {median['peak_rss_kb'] / 1000:.1f} | "
              f"{median['actions']:.0f} | {median['makespan']:.0f} |")
    slopes = {name: slope(points[len(points) // 2:]) for name, points in curves.items()}
    texts = [f"{name} {'–' if value is None else format(value, '.1f')}" for name, value in slopes.items()]
    print("\nSlope: " + ", ".join(texts) + ".")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planner", required=True)
    parser.add_argument("--validate", default="roci-validate")
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=list(FAMILIES), help="these alone")
    parser.add_argument("--seconds", type=int, default=30, help="of CPU time for each run")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        write_tree(root, arguments.families)
        records = measure(arguments, root)
    for family in arguments.families:
        table(family, records)
    return 0


if __name__ == "__main__":
    sys.exit(main())
