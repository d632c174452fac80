#!/usr/bin/env python3
"""Puts slices of roci-bench-dds together: merge.py FILE… prints median, 99th percentile and maximum of each variant in µs."""

import json
import sys
from pathlib import Path


def main() -> int:
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    times: dict[tuple[str, int], list[float]] = {}
    for file in sys.argv[1:]:
        for line in Path(file).read_text().splitlines():
            slice_ = json.loads(line)
            times.setdefault((slice_["variant"], slice_["load_threads"]), []).extend(slice_["microseconds"])
    print("| variant | load | count | median | p99 | p99.9 | maximum | over 100 ms | over 1 s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for (variant, load), all_of in sorted(times.items()):
        all_of.sort()
        at = [all_of[int(share * (len(all_of) - 1))] for share in (0.5, 0.99, 0.999, 1.0)]
        late = [sum(time > limit for time in all_of) for limit in (1e5, 1e6)]
        print(f"| {variant} | {load} | {len(all_of)} | " + " | ".join(f"{time:.0f}" for time in at) + f" | {late[0]} | {late[1]} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
