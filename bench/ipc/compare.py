#!/usr/bin/env python3
"""Compares runs: a table by domain, the losses, and scatter plots of CPU time and peak memory.

  compare.py roci roci.jsonl peers.csv --plots FOLDER > table.md

The first argument names the planner that the others are compared with. Records come as JSON lines of run.py, or as CSV
with columns planner domain instance valid cpu_s peak_rss_kb makespan. Only instances that every planner was run on count."""

import argparse
import csv
import json
import math
import pathlib
import statistics
import sys

import scatter

FLOOR_S = 0.001  # shorter times count as this: what a record resolves
PLOTS = [("time", lambda record: max(record["cpu_s"], FLOOR_S), scatter.seconds, "CPU time to the first plan"),
         ("memory", lambda record: record["peak_rss_kb"] / 1024, scatter.megabytes, "Peak memory")]


def read(path):
    if path.suffix == ".csv":
        with open(path) as file:
            for row in csv.DictReader(file):
                yield {"planner": row["planner"], "domain": row["domain"], "instance": int(row["instance"]),
                       "valid": row["valid"] == "1", "cpu_s": float(row["cpu_s"] or 0),
                       "peak_rss_kb": int(row["peak_rss_kb"] or 0), "makespan": float(row["makespan"] or 0)}
    else:
        for line in path.read_text().splitlines():
            yield json.loads(line)


def by_instance(paths):
    """{instance: {planner: record}}, of instances that every planner was run on; and the planners."""
    runs = {}
    for path in paths:
        for record in read(path):
            runs.setdefault((record["domain"], record["instance"]), {})[record["planner"]] = record
    planners = sorted({planner for records in runs.values() for planner in records})
    return {key: runs[key] for key in sorted(runs) if len(runs[key]) == len(planners)}, planners


def solved(records, planner):
    return records[planner]["valid"]


def totals(runs, planners, ours):
    peers = [planner for planner in planners if planner != ours]
    rows = []
    for planner in planners:
        own = [records[planner] for records in runs.values() if solved(records, planner)]
        rows.append([planner, len(own), f"{statistics.median(r['cpu_s'] for r in own):.3f}",
                     f"{statistics.median(r['peak_rss_kb'] for r in own) / 1024:.0f}",
                     f"{ipc_score(runs, planners, planner):.1f}"])
    union = sum(any(solved(records, peer) for peer in peers) for records in runs.values())
    text = table(["planner", "solved", "median CPU s", "median MB", "quality"], rows)
    return text + f"\n{len(runs)} instances; any of {', '.join(peers)}: {union}.\n"


def ipc_score(runs, planners, planner):
    """Sum of best makespan / own makespan: the quality score of the competitions."""
    score = 0
    for records in runs.values():
        if solved(records, planner):
            best = min(records[other]["makespan"] for other in planners if solved(records, other))
            score += best / records[planner]["makespan"] if records[planner]["makespan"] > 0 else 1
    return score


def pairs(runs, planners, ours):
    rows = []
    for peer in planners:
        if peer == ours:
            continue
        both = [(r[ours], r[peer]) for r in runs.values() if solved(r, ours) and solved(r, peer)]
        faster = sum(a["cpu_s"] <= b["cpu_s"] for a, b in both)
        ratio = math.exp(statistics.fmean(math.log(max(b["cpu_s"], FLOOR_S) / max(a["cpu_s"], FLOOR_S)) for a, b in both))
        big = [b["peak_rss_kb"] / a["peak_rss_kb"] for a, b in both if b["peak_rss_kb"] > 50 * 1024]
        rows.append([peer, len(both), f"{100 * faster / len(both):.0f} %", f"{ratio:.1f}",
                     f"{statistics.median(big):.1f} ({len(big)})" if big else "-",
                     sum(solved(r, ours) and not solved(r, peer) for r in runs.values()),
                     sum(solved(r, peer) and not solved(r, ours) for r in runs.values())])
    return table(["peer", "both solve", f"{ours} no slower", "peer's time / ours", "memory where the peer needs > 50 MB",
                  f"{ours} alone", "peer alone"], rows)


def losses(runs, planners, ours):
    rows = []
    for (domain, number), records in runs.items():
        better = [f"{p} {records[p]['cpu_s']:.2f} s" for p in planners if p != ours and solved(records, p)]
        if better and not solved(records, ours):
            rows.append([domain, number, "not solved", ", ".join(better)])
        elif solved(records, ours):
            faster = [p for p in planners if solved(records, p) and records[p]["cpu_s"] < records[ours]["cpu_s"] - 0.02]
            if faster:
                rows.append([domain, number, f"{records[ours]['cpu_s']:.2f} s",
                             ", ".join(f"{p} {records[p]['cpu_s']:.2f} s" for p in faster)])
    return table(["domain", "instance", ours, "better"], rows)


def domains(runs, planners):
    rows = []
    for domain in dict.fromkeys(key[0] for key in runs):
        own = [records for key, records in runs.items() if key[0] == domain]
        rows.append([domain, len(own)] + [sum(solved(records, planner) for records in own) for planner in planners])
    return table(["domain", "instances"] + planners, rows)


def table(head, rows):
    lines = [head, ["---"] * len(head)] + rows
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ours")
    parser.add_argument("records", nargs="+", type=pathlib.Path)
    parser.add_argument("--plots", type=pathlib.Path, help="folder for the scatter plots (SVG)")
    arguments = parser.parse_args()
    runs, planners = by_instance(arguments.records)
    print("## Losses\n\n" + losses(runs, planners, arguments.ours))
    print("## Totals\n\n" + totals(runs, planners, arguments.ours))
    print("## Pair by pair\n\n" + pairs(runs, planners, arguments.ours))
    print("## Solved by domain\n\n" + domains(runs, planners))
    if arguments.plots:
        arguments.plots.mkdir(parents=True, exist_ok=True)
        peers = [planner for planner in planners if planner != arguments.ours]
        for name, value, tick, title in PLOTS:
            picture = scatter.plot(runs, arguments.ours, peers, value, tick, title)
            (arguments.plots / f"{arguments.ours}-{name}.svg").write_text(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
