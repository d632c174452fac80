#!/usr/bin/env python3
"""One table by problem: time, memory and makespan of our first plans against recorded peers, as Markdown. Resumable.

  by_problem.py --root TREE --peers peers.csv --out all.jsonl > table.md

Runs every instance of the tree (--match, --per-domain as run.py has them) that does not stand in --out yet, then prints one
row for each of them: "no" is a run without a valid plan, an empty cell one that nobody made. Peers' records are CSV with
columns planner domain instance valid cpu_s peak_rss_kb makespan, or JSON lines of run.py. --no-runs prints what there is."""

import argparse
import pathlib
import subprocess
import sys

import compare

HERE = pathlib.Path(__file__).resolve().parent
COMMAND = "{bin}/roci-plan {{domain}} {{problem}} --stats {{stats}}"


def measure(arguments):
    command = [sys.executable, HERE / "run.py", "--root", arguments.root, "--planner", arguments.ours,
               "--command", COMMAND.format(bin=arguments.bin.resolve()), "--out", arguments.out,
               "--validate", arguments.bin / "roci-validate", "--limited", arguments.bin / "roci-bench-limited",
               "--seconds", str(arguments.seconds), "--megabytes", str(arguments.megabytes)]
    for name in ("match", "per_domain"):
        if getattr(arguments, name):
            command += ["--" + name.replace("_", "-"), str(getattr(arguments, name))]
    subprocess.run([str(word) for word in command], check=True, stdout=sys.stderr)


def cells(record):
    if record is None:
        return ["", "", ""]
    if not record["valid"]:
        return ["no", "", ""]
    return [f"{record['cpu_s']:.3f}", f"{record['peak_rss_kb'] / 1024:.0f}", f"{record['makespan']:.1f}"]


def rows_of(runs, planners, ours):
    for domain, number in sorted(key for key, records in runs.items() if ours in records):
        records = runs[domain, number]
        row = [domain, number]
        for planner in planners:
            row += cells(records.get(planner))
        yield row


def by_problem(paths, ours):
    """The table of all instances that we were run on, and a line of sums."""
    runs = {}
    for path in paths:
        for record in compare.read(path):
            runs.setdefault((record["domain"], record["instance"]), {})[record["planner"]] = record
    planners = [ours] + sorted({planner for records in runs.values() for planner in records} - {ours})
    head = ["domain", "instance"] + [f"{planner} {what}" for planner in planners for what in ("s", "MB", "makespan")]
    mine = [records[ours] for records in runs.values() if ours in records]
    solved = [record for record in mine if record["valid"]]
    most = max((record["peak_rss_kb"] / 1024 for record in solved), default=0)
    return (compare.table(head, list(rows_of(runs, planners, ours))) +
            f"\n{len(solved)} of {len(mine)} solved; at most {most:.0f} MB.\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", required=True, type=pathlib.Path, help="the tree of instances")
    parser.add_argument("--out", required=True, type=pathlib.Path, help="our records, JSON lines")
    parser.add_argument("--peers", nargs="*", default=[], type=pathlib.Path, help="records of others")
    parser.add_argument("--ours", default="roci", help="our name in the records")
    parser.add_argument("--bin", default=pathlib.Path("build/release/bin"), type=pathlib.Path)
    parser.add_argument("--seconds", type=int, default=5, help="CPU time of a run")
    parser.add_argument("--megabytes", type=int, default=256, help="memory of a run")
    parser.add_argument("--match")
    parser.add_argument("--per-domain", type=int)
    parser.add_argument("--no-runs", action="store_true", help="print what there is")
    arguments = parser.parse_args()
    if not arguments.no_runs:
        measure(arguments)
    print(by_problem([arguments.out, *arguments.peers], arguments.ours))
    return 0


if __name__ == "__main__":
    sys.exit(main())
