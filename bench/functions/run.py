#!/usr/bin/env python3
"""What the three ways to ask for values of external functions cost, and what their plans cost, as Markdown tables:

  run.py --planner build/release/bin/roci-plan

Each instance is planned in each mode with the same effort for better plans (--improve). Values come from a table, so that the
wall time is the planner's own; what its owner takes for a value comes on top, for each exact one."""

import argparse
import collections
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

import instances

HERE = pathlib.Path(__file__).resolve().parent
MODES = ("eager", "lazy", "two-accuracy")
FAMILIES = {
    "rover": (HERE / "rover.pddl", "way-points", instances.rover, (10, 25, 50, 100, 200, 400)),
    "orbital": (HERE.parent / "growth" / "orbital.pddl", "modules", instances.satellite, (10, 20, 40, 80, 120)),
}


def planned(planner, domain, problem, values, mode, improve, seconds):
    command = [planner, domain, problem, "--functions", values, "--functions-mode", mode, "--improve", str(improve), "--json"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return None
    record = json.loads(done.stdout) if done.stdout else {}
    return record if record.get("verdict") == "solved" else None


def measured(arguments, family):
    domain, _, made, sizes = FAMILIES[family]
    records = collections.defaultdict(dict)  # by size and seed, then by mode
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        shutil.copy(domain, root / "domain.pddl")
        for size in arguments.sizes or sizes:
            for seed in range(arguments.seeds):
                problem, values = made(size, seed)
                (root / "problem.pddl").write_text(problem)
                (root / "values").write_text(values)
                for mode in MODES:
                    record = planned(arguments.planner, root / "domain.pddl", root / "problem.pddl", root / "values", mode,
                                     arguments.improve, arguments.seconds)
                    print(family, size, seed, mode, json.dumps({key: record[key] for key in (
                        "metric", "exact_values", "cheap_values", "function_requests", "rounds", "wall_s")} if record else None),
                        file=sys.stderr, flush=True)
                    if record:
                        records[size, seed][mode] = record
    return records


def median(records, mode, key):
    return statistics.median(record[mode][key] for record in records)


def ratios(records, mode):
    return sorted(record[mode]["metric"] / record["eager"]["metric"] for record in records)


def table(family, records, seeds):
    _, what, _, _ = FAMILIES[family]
    print(f"\n| {what} | solved in all modes | mode | exact values | of eager's | bounds | requests | rounds | wall s | cost to eager's: median | least | most |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for size in sorted({size for size, _ in records}):
        solved = [by_mode for (one, _), by_mode in records.items() if one == size and len(by_mode) == len(MODES)]
        if not solved:
            print(f"| {size} | 0 of {seeds} | | | | | | | | | | |")
            continue
        for mode in MODES:
            share = statistics.median(one[mode]["exact_values"] / one["eager"]["exact_values"] for one in solved)
            cost = ratios(solved, mode)
            print(f"| {size} | {len(solved)} of {seeds} | {mode} | {median(solved, mode, 'exact_values'):.0f} | {100 * share:.1f} % | "
                  f"{median(solved, mode, 'cheap_values'):.0f} | {median(solved, mode, 'function_requests'):.0f} | "
                  f"{median(solved, mode, 'rounds'):.0f} | {median(solved, mode, 'wall_s'):.2f} | "
                  f"{statistics.median(cost):.3f} | {cost[0]:.3f} | {cost[-1]:.3f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--planner", required=True)
    parser.add_argument("--families", nargs="+", choices=FAMILIES, default=list(FAMILIES), help="these alone")
    parser.add_argument("--sizes", nargs="+", type=int, help="these alone")
    parser.add_argument("--seeds", type=int, default=5, help="instances of each size")
    parser.add_argument("--improve", type=int, default=1000, help="evaluations for better plans, as in missions")
    parser.add_argument("--seconds", type=int, default=120, help="of wall time for each run")
    arguments = parser.parse_args()
    arguments.planner = str(pathlib.Path(arguments.planner).resolve())
    for family in arguments.families:
        table(family, measured(arguments, family), arguments.seeds)
    return 0


if __name__ == "__main__":
    sys.exit(main())
