#!/usr/bin/env python3
"""What parsing and grounding cost, by domain, as a Markdown table; from records of run.py with --evaluations 1:

  run.py --root TREE --planner grounding --command 'roci-plan {domain} {problem} --evaluations 1 --stats {stats}' --out g.jsonl
  grounding.py g.jsonl

Grounded is what reached the search; refused, what the planner does not take. Facts are those of the task that has the most ground
actions: another one may have more facts and fewer actions."""

import collections
import json
import statistics
import sys

REFUSED = ("unsupported", "invalid_input")


def row(domain, records):
    stats = [record.get("stats", {}) for record in records]
    grounded = sum(entry.get("evaluated", 0) > 0 or entry.get("verdict") in ("solved", "unsolvable") for entry in stats)
    refused = sum(entry.get("verdict") in REFUSED for entry in stats)
    cpu = [record["cpu_s"] for record in records]
    most = max(stats, key=lambda entry: entry.get("ground_actions", 0))
    return (f"| {domain} | {len(records)} | {grounded} | {refused} | {statistics.median(cpu):.2f} | {max(cpu):.2f} | "
            f"{max(record['peak_rss_kb'] for record in records) / 1024:.0f} | {most.get('ground_actions', 0)} | "
            f"{most.get('facts', 0)} |")


def main():
    by_domain = collections.defaultdict(list)
    for path in sys.argv[1:]:
        with open(path) as file:
            for record in map(json.loads, file):
                by_domain[record["domain"]].append(record)
    print("| domain | instances | grounded | refused | median CPU s | most CPU s | most MB | most ground actions | facts of that task |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for domain in sorted(by_domain):
        print(row(domain, by_domain[domain]))
    print(row("all", [record for records in by_domain.values() for record in records]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
