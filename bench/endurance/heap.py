#!/usr/bin/env python3
"""Says what a process of a flight with `run.py --heaptrack` kept more of at the end of one day than of another: live
memory by the topic that was written, or else by the innermost function of ours."""

import argparse
import json
import re
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

INTERPRET = "/usr/lib/heaptrack/libexec/heaptrack_interpret"
WRITTEN = re.compile(r"TypedEndpoints<>::write\([^;]*roci::v1::(\w+)")


def kept_by(stack: str) -> str:
    written = WRITTEN.findall(stack)
    if written:
        return f"written: {written[-1]}" + (" (keys)" if "tkmap" in stack else "")
    frames = [frame for frame in stack.split(";") if frame]
    ours = [frame for frame in frames if frame.startswith("roci::")]
    return (ours or frames or ["?"])[-1][:110]


def live_memory(raw: Path, size: int) -> Counter:
    """By who keeps it, in bytes, when the record of allocations had that size."""
    with tempfile.TemporaryDirectory() as work:
        profile, stacks = Path(work) / "profile.gz", Path(work) / "stacks"
        subprocess.run(["bash", "-c", f'head -c {size} "$0" | {INTERPRET} 2>/dev/null | gzip -1 > "$1"', raw, profile], check=True)
        subprocess.run(["heaptrack_print", "-f", profile, "-F", stacks, "--flamegraph-cost-type", "leaked", "-p", "0", "-a", "0",
                        "-T", "0", "-l", "0"], check=True, stdout=subprocess.DEVNULL)
        out: Counter = Counter()
        for line in stacks.read_text().splitlines():
            stack, _, size_text = line.rpartition(" ")
            out[kept_by(stack)] += int(size_text)
        return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("flight", type=Path, help="what run.py wrote to --out")
    parser.add_argument("service")
    parser.add_argument("days", type=int, nargs=2, metavar="DAY")
    options = parser.parse_args()
    lines = [json.loads(line) for line in options.flight.read_text().splitlines()]
    sizes = {int(line["day"]): line["heap_bytes"][options.service] for line in lines if "heap_bytes" in line}
    raw = Path(f"{options.flight}.{options.service}.heap")
    first, last = (live_memory(raw, sizes[day]) for day in options.days)
    days = options.days[1] - options.days[0]
    print(f"| live memory | day {options.days[0]} | day {options.days[1]} | bytes a day |\n|---|---|---|---|")
    print(f"| all | {first.total()} | {last.total()} | {(last.total() - first.total()) / days:.0f} |")
    for name in sorted(first | last, key=lambda name: first[name] - last[name])[:25]:
        print(f"| {name} | {first[name]} | {last[name]} | {(last[name] - first[name]) / days:.0f} |")


if __name__ == "__main__":
    main()
