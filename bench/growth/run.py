#!/usr/bin/env python3
"""How time and memory of the planner grow with goals, sites and windows; a Markdown section on standard output:

  run.py --planner build/release/bin/roci-plan --validate build/release/bin/roci-validate

The problems are made by rover.py and run by ../ipc/run.py, three of each size. The slope is that of a line through the
logarithms of size and median, fitted to the larger half of the sizes. Memory is the engine's own count, without the program."""

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

import rover

HERE = pathlib.Path(__file__).resolve().parent
SEEDS = 3
# name: what grows, its sizes, the problem of a size
FAMILIES = {
    "goals": ("goals among 64 sites", (2, 4, 8, 16, 32), lambda n, seed: rover.problem(64, n, 0, seed)),
    "sites": ("sites, 4 goals", (8, 16, 32, 64, 128, 256, 512), lambda n, seed: rover.problem(n, 4, 0, seed)),
    "windows": ("windows of each of 4 goals, 16 sites", (1, 2, 4, 8, 16, 32, 64),
                lambda n, seed: rover.problem(16, 4, n, seed)),
}


def write_tree(root):
    for family, (_, sizes, problem) in FAMILIES.items():
        folder = root / "growth" / family
        (folder / "instances").mkdir(parents=True)
        shutil.copy(HERE / "rover.pddl", folder / "domain.pddl")
        for size in sizes:
            for seed in range(SEEDS):
                (folder / "instances" / f"instance-{10 * size + seed}.pddl").write_text(problem(size, seed))


def measure(arguments, root):
    records = root / "records.jsonl"
    planner = pathlib.Path(arguments.planner).resolve()
    subprocess.run([sys.executable, HERE.parent / "ipc" / "run.py", "--root", root, "--planner", "growth", "--out", records,
                    "--command", f"{planner} {{domain}} {{problem}} --stats {{stats}}", "--validate",
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
    what, sizes, _ = FAMILIES[family]
    by_size = collections.defaultdict(list)
    for record in records:
        if record["domain"] == f"growth/{family}":
            by_size[record["instance"] // 10].append(record)
    print(f"\n| {what} | solved | ground actions | evaluated | CPU s | engine kB |\n| --- | --- | --- | --- | --- | --- |")
    curves = collections.defaultdict(list)
    for size in sizes:
        solved = [record for record in by_size[size] if record["status"] == "ok"]
        if not solved:
            print(f"| {size} | 0 of {SEEDS} | | | | |")
            continue
        median = {"evaluations": statistics.median(record["stats"]["evaluated"] for record in solved),
                  "time": statistics.median(record["cpu_s"] for record in solved),
                  "memory": statistics.median(record["stats"]["engine_peak_bytes"] for record in solved)}
        for name, value in median.items():
            curves[name].append((size, value))
        actions = statistics.median(record["stats"]["ground_actions"] for record in solved)
        print(f"| {size} | {len(solved)} of {SEEDS} | {actions:.0f} | {median['evaluations']:.0f} | {median['time']:.3f} | "
              f"{median['memory'] / 1000:.0f} |")
    slopes = {name: slope(points[len(points) // 2:]) for name, points in curves.items()}
    texts = [f"{name} {'–' if value is None else format(value, '.1f')}" for name, value in slopes.items()]
    print("\nSlope: " + ", ".join(texts) + ".")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planner", required=True)
    parser.add_argument("--validate", default="roci-validate")
    parser.add_argument("--seconds", type=int, default=30, help="of CPU time for each run")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        write_tree(root)
        records = measure(arguments, root)
    for family in FAMILIES:
        table(family, records)
    return 0


if __name__ == "__main__":
    sys.exit(main())
