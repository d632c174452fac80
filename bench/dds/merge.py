#!/usr/bin/env python3
"""Puts slices of roci-bench-dds together: merge.py FILE… prints median, 99th percentile and maximum of each variant in µs,
and of the five that took longest what they waited for: the server's disk, and processors (threads that wait side by side
count one by one)."""

import json
import sys
from pathlib import Path


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    times: dict[tuple[str, int], list[float]] = {}
    waited: dict[tuple[str, int], list[tuple[float, float, float, float]]] = {}
    waits = ("disk_us", "server_processor_us", "client_processor_us")
    for file in sys.argv[1:]:
        for line in Path(file).read_text().splitlines():
            slice_ = json.loads(line)
            variant = slice_["variant"], slice_["load_threads"]
            times.setdefault(variant, []).extend(slice_["microseconds"])
            if all(wait in slice_ for wait in waits):
                waited.setdefault(variant, []).extend(zip(slice_["microseconds"], *(slice_[wait] for wait in waits)))
    print("| variant | load | count | median | p99 | p99.9 | maximum | over 100 ms | over 1 s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for (variant, load), all_of in sorted(times.items()):
        all_of.sort()
        at = [all_of[int(share * (len(all_of) - 1))] for share in (0.5, 0.99, 0.999, 1.0)]
        late = [sum(time > limit for time in all_of) for limit in (1e5, 1e6)]
        print(f"| {variant} | {load} | {len(all_of)} | " + " | ".join(f"{time:.0f}" for time in at) + f" | {late[0]} | {late[1]} |")
    if waited:
        print("\n| variant | load | took | disk of the server | processor, server | processor, client |")
        print("|---|---|---|---|---|---|")
    for (variant, load), all_of in sorted(waited.items()):
        for one in sorted(all_of, reverse=True)[:5]:
            print(f"| {variant} | {load} | " + " | ".join(f"{time:.0f}" for time in one) + " |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
