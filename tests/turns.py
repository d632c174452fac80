#!/usr/bin/env python3
"""turns.py BUILD: holds tests/turns.txt to its word. Each row names tests that there are and that are not in ./check --full alone, none stands
twice, and all rounds take about as long. That no test is left out follows: ./check leaves out what stands there under another turn, and
./check --full does not read the file. No two tests have one name, since CTest would merge their labels."""
import json
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

ROUNDS = 27
UNEVEN = 1.25  # the longest round by the shortest


def main(build):
    listed = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True, text=True).stdout
    names, all_names = [], []
    for test in json.loads(listed)["tests"]:
        labels = next((p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"), [])
        all_names.append(test["name"])
        if "full" not in labels:
            names.append(test["name"])
    page = Path(__file__).with_name("turns.txt")
    seconds = [0.0] * ROUNDS
    twice = sorted(name for name, times in Counter(all_names).items() if times > 1)
    told = [f"two tests are named {name}, so that CTest takes the labels of both for each; name them apart" for name in twice]
    taken = {}
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        row = re.fullmatch(r"((\d+)/(3|9|27)) +(\d+) +(\S+)", line)
        if not row or int(row[2]) >= int(row[3]):
            told.append(f"{page}:{number}: no row of turn (0/3 to 2/3, 0/9 to 8/9 or 0/27 to 26/27), seconds, name: {line}")
            continue
        name = row[5]
        if "(" in name:
            told.append(f"{page}:{number}: CTest's expressions have room for nine groups, which ./check needs: write a row for each name")
            continue
        for of_round in range(int(row[2]), ROUNDS, int(row[3])):
            seconds[of_round] += float(row[4])
        # As ./check has it.
        whole = re.compile(rf"(^|/)({name})([/_](inproc|fastdds|cyclonedds|mixed))?( |$)")
        found = [test for test in names if whole.search(test)]
        if not found:
            told.append(f"{page}:{number}: there is no test {name} outside ./check --full; name it as ctest -N does, or take the row out")
        for test in found:
            if test in taken:
                told.append(f"{page}:{number}: {test} stands in line {taken[test]}, too")
            taken[test] = number
    if max(seconds) > UNEVEN * min(seconds):
        told.append(f"{page}: the rounds are uneven: {', '.join(f'{s:.0f} s' for s in seconds)}; move a row to a turn of the shortest")
    print("\n".join(told) or f"{len(taken)} tests take turns: {', '.join(f'{s:.0f} s' for s in seconds)}")
    return 1 if told else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
