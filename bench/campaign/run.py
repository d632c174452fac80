#!/usr/bin/env python3
"""Flies live missions in which everything goes wrong that one seed draws, slice by slice; counts what was lost or doubled.

run.py --slice 1-200 --out FILE.jsonl   flies the seeds that do not stand in FILE, one line each; again to go on
run.py --report FILE.jsonl …            the table of what stands in them"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

from draw import draw
from flight import GRACE_S, LONGEST_S
from report import report

ROOT = Path(__file__).resolve().parents[2]
# Of its own: what it mounts, its network, its processes, which end with it.
APART = ["unshare", "--mount", "--net", "--pid", "--fork", "--kill-child", "--mount-proc"]


def seeds_of(text: str) -> range:
    first, _, last = text.partition("-")
    return range(int(first), int(last or first) + 1)


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--slice", type=seeds_of, metavar="A-B", help="seeds, or one; each is one mission")
    parser.add_argument("--jobs", type=int, default=2, help="flights at a time (%(default)s)")
    parser.add_argument("--out", type=Path, default=Path("campaign.jsonl"), help="one line for each seed is appended here (%(default)s)")
    parser.add_argument("--anew", action="store_true", help="forget what stands in --out first")
    parser.add_argument("--speed", type=float, default=40, help="mission seconds per second (%(default)g)")
    parser.add_argument("--mission", type=Path, default=ROOT / "missions/planetary",
                        help="copied for each flight, with longer waits (default: missions/planetary)")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin",
                        help="the programs; beside it, ../tests has intruder and contract-hostile (default: build/release/bin)")
    parser.add_argument("--keep", type=Path, help="folders of flights with a violation, or not over in time, go here (default: violations/ beside --out)")
    parser.add_argument("--keep-all", action="store_true", help="folders of all flights go there")
    parser.add_argument("--draw", action="store_true", help="print what the slice would fly, and end")
    parser.add_argument("--report", type=Path, nargs="+", metavar="FILE", help="print the table of these and end")
    return parser.parse_args()


def flown(file: Path) -> set[int]:
    if not file.exists():
        return set()
    return {json.loads(line)["seed"] for line in file.read_text().splitlines() if line.strip()}


def can_fly_apart() -> bool:
    return subprocess.run([*APART, "true"], capture_output=True).returncode == 0


def knows_secure(options: argparse.Namespace) -> bool:
    """Where the launcher does not know secured runs, the seeds that draw one fly plainly, and say so."""
    known = subprocess.run([options.bin / "roci-launch", "--help"], text=True, capture_output=True).stdout
    return "--secure" in known and (options.bin / "roci-keys").exists()


def fly(options: argparse.Namespace, seed: int, secure: bool) -> dict:
    folder = Path(tempfile.mkdtemp(prefix=f"roci_campaign_{seed}_"))
    command = [*APART, sys.executable, Path(__file__).parent / "flight.py", str(seed), options.bin.resolve(),
               options.mission.resolve(), folder, str(options.speed), "secure" if secure else "plain"]
    begun = time.monotonic()
    with open(folder / "flight.log", "w") as log:
        flying = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=log, text=True)
        try:
            output = flying.communicate(timeout=LONGEST_S + 3 * GRACE_S)[0]
            record = json.loads(output.strip().splitlines()[-1])
        except (subprocess.TimeoutExpired, ValueError, IndexError) as error:
            flying.kill()
            flying.wait()
            record = {"seed": seed, "draw": draw(seed).as_json(), "harness_failed": f"{type(error).__name__}: {error}",
                      "violations": [], "log": (folder / "flight.log").read_text()[-2000:]}
    record["wall_s"] = round(time.monotonic() - begun, 1)
    record["speed"] = options.speed
    if record["violations"] or record.get("time_up") or "harness_failed" in record or options.keep_all:
        kept = options.keep / str(seed)
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(folder, kept, symlinks=True, ignore=shutil.ignore_patterns("mission", "*.runtime"))
        record["kept"] = str(kept)
    shutil.rmtree(folder, ignore_errors=True)
    return record


def tell(record: dict, options: argparse.Namespace) -> None:
    drawn = record["draw"]
    what = ", ".join(f"{fault['kind']} {fault['what']}" for fault in drawn["faults"])
    print(f"seed {record['seed']} {drawn['dds']} {'pair' if drawn['standby'] else 'alone'} {drawn['hosts']} hosts, {what}: "
          f"{record.get('result', record.get('harness_failed', ''))}, {record['wall_s']:.0f} s", file=sys.stderr)
    for violation in record["violations"]:
        print(f"  VIOLATION {violation}", file=sys.stderr)
    if "kept" in record:
        print(f"  kept in {record['kept']}; again: {sys.argv[0]} --slice {record['seed']}-{record['seed']} --speed "
              f"{options.speed:g} --bin {options.bin} --out again.jsonl", file=sys.stderr)


def main() -> int:
    options = parse()
    if options.report:
        records = [json.loads(line) for file in options.report for line in file.read_text().splitlines() if line.strip()]
        print(report(records))
        return 1 if any(record["violations"] for record in records) else 0
    if not options.slice:
        print("run.py: name a --slice A-B, or a --report FILE", file=sys.stderr)
        return 2
    if options.draw:
        for seed in options.slice:
            print(json.dumps(draw(seed).as_json()))
        return 0
    missing = [name for name in ("bin/roci-launch", "tests/intruder", "tests/contract-hostile") if not (options.bin.parent / name).exists()]
    if missing:
        print(f"run.py: beside {options.bin} there is no {', '.join(missing)}; build the targets programs, intruder and contract-hostile",
              file=sys.stderr)
        return 2
    if not can_fly_apart():
        print(f"run.py: SKIPPED: this user cannot make what keeps a flight apart ({' '.join(APART)})", file=sys.stderr)
        return 77
    if options.anew:
        options.out.unlink(missing_ok=True)
    options.keep = options.keep or options.out.parent / "violations"
    if options.keep_all:
        os.environ["ROCI_CAMPAIGN_KEEP"] = "1"
    secure = knows_secure(options)
    lock = Lock()
    faulty = 0

    def one(seed: int) -> dict:
        record = fly(options, seed, secure)
        with lock, open(options.out, "a") as out:
            if "harness_failed" not in record:
                out.write(json.dumps(record) + "\n")
        return record

    with ThreadPoolExecutor(options.jobs) as pool:
        for record in pool.map(one, [seed for seed in options.slice if seed not in flown(options.out)]):
            tell(record, options)
            faulty += bool(record["violations"]) or "harness_failed" in record
    return 1 if faulty else 0


if __name__ == "__main__":
    sys.exit(main())
