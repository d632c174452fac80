#!/usr/bin/env python3
"""Two builds of one planner over instances, turn by turn: are speed and memory the same? Resumable.

  pair.py --root TREE --before 'old/roci-plan {domain} {problem}' --after 'build/release/bin/roci-plan {domain} {problem}' \
          --out pair.jsonl --seconds 5

Each instance is run as before, after, after, before; the lesser CPU time of two counts, and the peak of memory. Both outcomes
and both plans are compared byte by byte. The summary gives medians of the ratios after / before, of instances that both solve.
With --instructions each is run once, under `perf stat`, and instructions are compared instead of CPU time: a loaded machine
does not change them."""

import argparse
import json
import math
import pathlib
import re
import shlex
import statistics
import sys
import tempfile

import instances
from run import measured, values_of

FLOOR_S = 0.002  # shorter runs say nothing of speed


def once(arguments, command, instance):
    with tempfile.TemporaryDirectory() as folder:
        names = {"domain": instance.domain_file, "problem": instance.problem_file, "values": values_of(instance)}
        words = [part.format(**names) for part in shlex.split(command)]
        words[0] = str(pathlib.Path(words[0]).resolve())
        counted = pathlib.Path(folder) / "counted"
        counter = ["perf", "stat", "-x", ",", "-e", "instructions:u", "-o", str(counted)] if arguments.instructions else []
        with open(pathlib.Path(folder) / "out", "w+b") as out, open(pathlib.Path(folder) / "err", "w+b") as err:
            code, cpu, peak = measured(arguments, words, folder, out, err, counter)
            out.seek(0)
            record = {"exit": code, "cpu_s": cpu, "peak_rss_kb": peak, "plan": out.read().decode(errors="replace")}
            if arguments.instructions:
                found = re.search(r"^(\d+),,instructions", counted.read_text(), re.M)
                if not found:
                    sys.exit(f"perf stat counted nothing: {counted.read_text()}")
                record["instructions"] = int(found[1])
            return record


def pair(arguments, instance):
    runs = {"before": [], "after": []}
    for which in ["before", "after"] if arguments.instructions else ["before", "after", "after", "before"]:
        runs[which].append(once(arguments, getattr(arguments, which), instance))
    best = {which: min(both, key=lambda one: one["cpu_s"]) for which, both in runs.items()}
    record = {"domain": instance.domain, "instance": instance.number,
              "same_plan": runs["before"][0]["plan"] == runs["after"][0]["plan"]}
    for which, one in best.items():
        record[which] = {key: one[key] for key in ("exit", *measures(arguments))}
    return record


def measures(arguments):
    return ("instructions" if arguments.instructions else "cpu_s", "peak_rss_kb")


def summary(records, keys):
    solved = {which: sum(record[which]["exit"] == 0 for record in records) for which in ("before", "after")}
    both = [record for record in records if record["before"]["exit"] == 0 == record["after"]["exit"]]
    ratio = {key: [record["after"][key] / record["before"][key] for record in both if record["before"].get("cpu_s", FLOOR_S) >= FLOOR_S]
             for key in keys}
    lines = [f"{len(records)} instances, solved {solved['before']} before, {solved['after']} after, "
             f"{sum(record['same_plan'] for record in both)} of {len(both)} plans byte for byte the same"]
    for key, values in ratio.items():
        if values:
            mean = math.exp(statistics.fmean(map(math.log, values)))
            lines.append(f"{key}: median ratio {statistics.median(values):.3f}, geometric mean {mean:.3f}, "
                         f"greatest {max(values):.2f}, of {len(values)}")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--root", required=True, help="the benchmark tree")
    parser.add_argument("--before", required=True, help="command with {domain} {problem}, and {values} of external functions")
    parser.add_argument("--after", required=True, help="the same of the other build")
    parser.add_argument("--out", required=True, type=pathlib.Path, help="JSON lines; what stands there is not run again")
    parser.add_argument("--limited", default="build/release/bin/roci-bench-limited", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--instructions", action="store_true", help="compare instructions, counted by perf stat")
    parser.add_argument("--seconds", type=int, default=5, help="of CPU time")
    parser.add_argument("--megabytes", type=int, default=4096, help="of address space")
    parser.add_argument("--match", help="domains whose name contains this")
    parser.add_argument("--per-domain", type=int, default=0, help="at most so many of each domain; 0: all")
    arguments = parser.parse_args()
    found = [one for one in instances.find(arguments.root) if not arguments.match or arguments.match in one.domain]
    records = [json.loads(line) for line in arguments.out.read_text().splitlines()] if arguments.out.exists() else []
    known = {(record["domain"], record["instance"]) for record in records}
    for instance in instances.sample(found, arguments.per_domain):
        if instance.key in known:
            continue
        records.append(pair(arguments, instance))
        with open(arguments.out, "a") as file:
            file.write(json.dumps(records[-1]) + "\n")
        print(f"{len(records)} of {len(found)} {instance.domain} {instance.number}", file=sys.stderr, flush=True)
    print(summary(records, measures(arguments)))


if __name__ == "__main__":
    main()
