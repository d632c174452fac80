#!/usr/bin/env python3
"""Flies a month (or so) of mission time with real processes, and looks each day at the memory of every process and at
every file of the run: what grows, by how much a day, within which bound."""

import argparse
import json
import math
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DAY_S = 86400
HEAPTRACK = "/usr/lib/heaptrack/libheaptrack_preload.so"
SETTLED = 0.2  # this share of the days is left out of the fit: tables and caches fill up
PLACES = [(60, 44), (52, 56), (60, 60), (60, 45), (48, 48), (54, 50), (110, 60), (70, 70)]
# Communication windows of each day, s of the day.
WINDOWS = [(6000, 12000), (50000, 56000)]


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--days", type=float, default=30)
    parser.add_argument("--goals-per-day", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--dds", default="cyclonedds")
    parser.add_argument("--standby", action="store_true")
    parser.add_argument("--keep-records", type=int, default=5000, help="kept_records of the executive; 0: as the product has it")
    parser.add_argument("--mission", type=Path, default=ROOT / "missions/planetary")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--out", type=Path, default=Path("endurance.jsonl"), help="one line for each day is appended here")
    parser.add_argument("--heaptrack", default="", metavar="SERVICE,…",
                        help="record what these allocate, in OUT.SERVICE.heap and OUT.programs, for heap.py")
    parser.add_argument("--report", type=Path, metavar="FILE", help="print the table of an earlier flight and end")
    return parser.parse_args()


def make_mission(options: argparse.Namespace, folder: Path) -> None:
    shutil.copytree(options.mission, folder)
    file = folder / "mission.yaml"
    text = file.read_text()
    days = math.ceil(options.days)
    windows = [[day * DAY_S + opens, day * DAY_S + closes] for day in range(days) for opens, closes in WINDOWS]
    text = re.sub(r"open: \[\[.*\]\]", f"open: {json.dumps(windows)}", text, count=1)
    text = re.sub(r"replan_limit: *\d+", "replan_limit: 1000000", text)
    kept = f"  kept_records: {options.keep_records}\n" if options.keep_records else ""
    text = text.replace("executive:\n", f"executive:\n  keep_inputs: false\n{kept}", 1)
    text = text.replace("power: {capacity_j: 1000000, idle_w: 14}",
                        f"power: {{capacity_j: 1000000, idle_w: 14, solar_peak_w: 90, day_s: {DAY_S}}}", 1)
    text = text.replace("telemetry: {moving_s: 10, idle_s: 60}", "telemetry: {moving_s: 30, idle_s: 300}", 1)
    file.write_text(text)
    rng = random.Random(f"endurance {options.seed}")
    stimuli = []
    for number in range(int(options.days * options.goals_per_day)):
        at = rng.uniform(number, number + 1) * DAY_S / options.goals_per_day
        x, y = rng.choice(PLACES)
        goal = (f"issuer: ground, id: photo-{number}, kind: photo, importance: optional, utility: {rng.randint(1, 5)}, "
                f"arguments: {{x: {x + rng.uniform(-2, 2):.2f}, y: {y + rng.uniform(-2, 2):.2f}}}")
        stimuli.append((at, f"goal: {{{goal}}}"))
        if rng.random() < 0.1:
            stimuli.append((at + rng.uniform(1, 3600), f"recall: {{issuer: ground, id: photo-{number}}}"))
    lines = [f"  - {{at_s: {at:.1f}, {what}}}" for at, what in sorted(stimuli) if at < options.days * DAY_S - 1]
    (folder / "scenarios/endurance.yaml").write_text(
        f"description: Goals drip in for {days} days.\nduration_s: {options.days * DAY_S:.0f}\n"
        "start: {x: 40, y: 40, heading: 0, arm: stow, battery: 900000}\nworld: {slip: 0.04, image_noise: 0.02}\n"
        "stimuli:\n" + "\n".join(lines) + "\n")


def with_heaptrack(options: argparse.Namespace, services: list[str], folder: Path) -> Path:
    """Returns a folder of programs, of which `services` record what they allocate. heap.py looks there for names."""
    shutil.rmtree(folder.parent, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder.parent / "lib").symlink_to((options.bin / "../lib").resolve())
    for program in options.bin.iterdir():
        shutil.copy2(program, folder / (f"{program.name}-recorded" if program.name in services else program.name))
    for name in services:
        script = folder / name
        script.write_text(f'#!/bin/bash\nexport DUMP_HEAPTRACK_OUTPUT="{heap_of(options, name).resolve()}"\n'
                          f'export LD_PRELOAD={HEAPTRACK}\nexec -a "{script}" "{script}-recorded" "$@"\n')
        script.chmod(0o755)
    return folder


def heap_of(options: argparse.Namespace, service: str) -> Path:
    return Path(f"{options.out}.{service}.heap")


def processes(launcher: int) -> dict[str, int]:
    found = {"roci-launch": launcher}
    for task in Path(f"/proc/{launcher}/task").glob("*/children"):
        for pid in task.read_text().split():
            try:
                words = Path(f"/proc/{pid}/cmdline").read_text().split("\0")
                name = Path(words[0]).name
                if "--pair" in words:
                    name += f" ({words[words.index('--pair') + 1]})"
                found[name] = int(pid)
            except OSError:
                pass
    return found


def memory_kb(pid: int) -> int:
    """What the process itself has taken: anonymous memory that is resident, not the pages of programs and files."""
    for line in Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("RssAnon:"):
            return int(line.split()[1])
    return 0


def mission_time(journal: Path) -> float:
    try:
        with sqlite3.connect(f"file:{journal}?mode=ro", uri=True, timeout=1) as database:
            row = database.execute("SELECT time_us FROM record ORDER BY seq DESC LIMIT 1").fetchone()
            return row[0] / 1e6 if row else 0.0
    except sqlite3.Error:
        return 0.0


def look(launcher: int, run: Path, day: float, begun: float) -> dict:
    sizes: dict[str, float] = {}
    for file in run.rglob("*"):
        name = str(file.relative_to(run))
        if "/" in name:  # what has many files is one line, but for a standby's journal
            name = name if name.startswith("standby/") else name.split("/")[0] + "/"
        try:
            if file.is_file() and not file.name.endswith("-shm"):
                sizes[name] = sizes.get(name, 0) + file.stat().st_size / 1024
        except OSError:
            pass  # gone meanwhile
    out = {"day": round(day, 3), "wall_s": round(time.monotonic() - begun, 1), "memory_kb": {}, "files_kb": sizes}
    for name, pid in processes(launcher).items():
        try:
            out["memory_kb"][name] = memory_kb(pid)
        except OSError:
            pass
    return out


def slope(points: list[tuple[float, float]]) -> tuple[float, float]:
    """Least squares: growth a day, and the half width of its 95 % interval (1.96 standard errors; the days are many)."""
    n = len(points)
    if n < 3:
        return float("nan"), float("nan")
    mean_x, mean_y = sum(x for x, _ in points) / n, sum(y for _, y in points) / n
    sxx = sum((x - mean_x) ** 2 for x, _ in points)
    b = sum((x - mean_x) * (y - mean_y) for x, y in points) / sxx
    rest = sum((y - mean_y - b * (x - mean_x)) ** 2 for x, y in points)
    return b, 1.96 * math.sqrt(rest / (n - 2) / sxx)


def report(days: list[dict]) -> str:
    settled = [day for day in days if day["day"] >= SETTLED * days[-1]["day"]]
    lines = [f"| kB | day {settled[0]['day']:.0f} | day {settled[-1]['day']:.0f} | a day | ± |", "|---|---|---|---|---|"]
    for kind in ("memory_kb", "files_kb"):
        for name in sorted({name for day in settled for name in day[kind]}):
            points = [(day["day"], day[kind][name]) for day in settled if name in day[kind]]
            growth, width = slope(points)
            lines.append(f"| {name} | {points[0][1]:.0f} | {points[-1][1]:.0f} | {growth:.2f} | {width:.2f} |")
    return "\n".join(lines)


def main() -> int:
    options = parse()
    if options.report:
        print(report([json.loads(line) for line in options.report.read_text().splitlines() if "memory_kb" in line]))
        return 0
    work = Path(tempfile.mkdtemp(prefix="roci_endurance_"))
    make_mission(options, work / "mission")
    run = work / "run"
    recorded = [name for name in options.heaptrack.split(",") if name]
    programs = with_heaptrack(options, recorded, Path(f"{options.out}.programs/bin").resolve()) if recorded else options.bin
    command = [programs / "roci-launch", work / "mission", "--scenario", "endurance", "--dds", options.dds, "--seed", options.seed,
               "--speed", "max", "--headless", "--json", "--run-folder", run, *(["--standby"] if options.standby else [])]
    days: list[dict] = []
    begun = time.monotonic()
    with open(work / "out", "w") as output:
        launcher = subprocess.Popen([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT)
        try:
            while launcher.poll() is None:
                day = mission_time(run / "journal.sqlite") / DAY_S
                if day >= len(days) + 1:
                    days.append(look(launcher.pid, run, day, begun))
                    if recorded:
                        days[-1]["heap_bytes"] = {name: heap_of(options, name).stat().st_size for name in recorded}
                    with open(options.out, "a") as out:
                        out.write(json.dumps(days[-1]) + "\n")
                    print(f"day {day:.2f} after {days[-1]['wall_s']:.0f} s", file=sys.stderr)
                time.sleep(0.1)
        except KeyboardInterrupt:
            launcher.send_signal(signal.SIGTERM)
            launcher.wait()
    last = (work / "out").read_text().strip().splitlines()[-1:]
    print("\n".join(last))
    with open(options.out, "a") as out:
        out.write(json.dumps({"exit": launcher.returncode, "summary": last}) + "\n")
    if days:
        print(report(days))
    shutil.rmtree(work, ignore_errors=True)
    return 0 if launcher.returncode in (0, 1) else 1


if __name__ == "__main__":
    sys.exit(main())
