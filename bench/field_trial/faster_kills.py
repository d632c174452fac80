"""The same flight over DDS with every service as a process of its own, some of which die by kill -9 on the way."""

from __future__ import annotations

import json
import random
import shutil
import sqlite3
import sys
from argparse import Namespace
from dataclasses import dataclass, field
from pathlib import Path

from faster_flights import Flight, read

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "kill"))
import flight as processes  # noqa: E402

# On the simulated clock sim_svc is the clock and the world: with it the run ends, on purpose.
KILLABLE = ["exec_svc", "planner_svc", "primary.path", "scout.path", "communications", "primary.path_planning", "primary.locomotion",
            "scout.path_planning", "scout.locomotion"]
GOALS = ("long_traverse", "last_communication")
LONGEST_S = 300  # of wall time; only for a flight that hangs


@dataclass
class KilledFlight:
    seed: int
    kills: str
    dds: str
    killed: int = 0
    result: str = "crashed"
    arrived: bool = False
    goals_lost: list[str] = field(default_factory=list)
    doubled: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    entries: int | None = None  # of the primary into circles that its map had; nothing: not read, by an earlier version of this file


def by_name(parent: int) -> dict[str, int]:
    """The processes of a launcher by the names of their services: five of them run one program."""
    found = {}
    for task in Path(f"/proc/{parent}/task").glob("*/children"):
        for pid in task.read_text().split():
            try:
                words = Path(f"/proc/{pid}/cmdline").read_text().split("\0")
                found[words[words.index("--name") + 1]] = int(pid)
            except (OSError, ValueError, IndexError):
                pass
    return found


def draw_kills(seed: int) -> processes.Kills:
    """One to three; most is done in the first fifth of the mission's time, the traverse."""
    rng = random.Random(f"kills of {seed}")
    return processes.Kills(at=sorted((round(rng.random() * 0.2, 3), rng.choice(KILLABLE)) for _ in range(rng.randint(1, 3))))


def fly_killing(bin_folder: Path, mission: Path, seed: int, folder: Path, calm_s: float, flown: bool) -> KilledFlight:
    kills, dds = draw_kills(seed), processes.VENDORS[seed % len(processes.VENDORS)]
    out = KilledFlight(seed, kills.text(), dds)
    printed = folder / "killed.json"
    if not (flown and printed.exists()):
        shutil.rmtree(folder, ignore_errors=True)
        processes.LONGEST_S, processes.children = LONGEST_S, by_name
        options = Namespace(bin=bin_folder, mission=mission, clock="simulated", speed="max", standby=False)
        ended = processes.fly(options, folder, dds, "hidden", seed, kills, calm_s)
        folder.mkdir(parents=True, exist_ok=True)
        printed.write_text(json.dumps({"killed": ended.killed, "result": ended.result, "sim_s": ended.sim_s, "error": ended.error[-400:]}))
    told = json.loads(printed.read_text())
    out.killed, out.result = told["killed"], told["result"] or "crashed"
    flight = Flight(seed, str(folder), None, out.result, told["sim_s"])
    try:
        read(flight, folder)
        with sqlite3.connect(f"file:{folder / 'journal.sqlite'}?mode=ro", uri=True) as database:
            known = {row[0] for row in database.execute("SELECT id FROM goal")}
    except (OSError, ValueError, sqlite3.Error) as error:
        out.faults.append(f"no record: {error}; {told['error']}")
        return out
    out.arrived, out.entries = flight.arrived, flight.entries
    out.goals_lost = [goal for goal in GOALS if goal not in known]
    out.doubled = [fault for fault in flight.faults if fault.startswith("command ")]
    out.faults = flight.faults + [f"goal {goal} is lost" for goal in out.goals_lost]
    return out
