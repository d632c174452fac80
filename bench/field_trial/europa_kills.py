"""The same flight over DDS with every service as a process of its own, some of which die by kill -9 on the way: what was lost by that, and done twice."""

from __future__ import annotations

import json
import random
import shutil
import sqlite3
import sys
from argparse import Namespace
from dataclasses import dataclass, field
from pathlib import Path

from europa_flights import Flight, losses_of, read
from europa_scenarios import Scenario

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "kill"))
import flight as processes  # noqa: E402

# On the simulated clock sim_svc is the clock and the world: with it the run ends, on purpose.
KILLABLE = ["exec_svc", "planner_svc"]
LONGEST_S = 900  # of wall time; only for a flight that hangs


@dataclass
class KilledFlight:
    flight: Flight
    kills: str
    dds: str
    killed: int
    goals_lost: int = 0
    products_lost: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


def draw_kills(seed: int) -> processes.Kills:
    """One to three, more often early, where most is done."""
    rng = random.Random(f"kills of {seed}")
    return processes.Kills(at=sorted((round(rng.random() ** 2 * 0.95, 3), rng.choice(KILLABLE)) for _ in range(rng.randint(1, 3))))


def fly_killing(bin_folder: Path, mission: Path, scenario: Scenario, folder: Path, calm: Flight, flown: bool) -> KilledFlight:
    kills, dds = draw_kills(scenario.seed), processes.VENDORS[scenario.seed % len(processes.VENDORS)]
    printed = folder / "killed.json"
    if not (flown and printed.exists()):
        shutil.rmtree(folder, ignore_errors=True)
        processes.LONGEST_S = LONGEST_S
        options = Namespace(bin=bin_folder, mission=mission, clock="simulated", speed="max", standby=False)
        ended = processes.fly(options, folder, dds, scenario.name, scenario.seed, kills, calm.sim_s)
        folder.mkdir(parents=True, exist_ok=True)
        printed.write_text(json.dumps({"killed": ended.killed, "result": ended.result, "sim_s": ended.sim_s, "error": ended.error[-400:]}))
    told = json.loads(printed.read_text())
    flight = Flight(scenario.seed, folder, told["result"] or "crashed", told["sim_s"])
    out = KilledFlight(flight, kills.text(), dds, told["killed"])
    try:
        read(flight, scenario)
        flight.losses = losses_of(flight)
    except (OSError, ValueError, sqlite3.Error) as error:
        out.faults.append(f"no record: {error}; {told['error']}")
        return out
    out.goals_lost = goals_lost(folder)
    out.products_lost = products_lost(flight, calm)
    out.faults += flight.faults + (["the goal is lost"] if out.goals_lost else [])
    out.faults += [f"{name} is lost" for name in out.products_lost] + samples_missing(flight, calm)
    return out


def goals_lost(folder: Path) -> int:
    with sqlite3.connect(f"file:{folder / 'journal.sqlite'}?mode=ro", uri=True) as database:
        return int(not list(database.execute("SELECT id FROM goal WHERE id = 'mission'")))


def samples_missing(flight: Flight, calm: Flight) -> list[str]:
    """A kill costs minutes, which may decide about one sample at the end; not about more."""
    missing = calm.samples_home - flight.samples_home
    return [f"{flight.samples_home} samples are home, {calm.samples_home} without the kills"] if missing > 1 else []


def products_lost(flight: Flight, calm: Flight) -> list[str]:
    """What must go home and never went, although the same was sent in the flight without kills."""
    sent = {one.id for one in calm.received}
    return [one.id for one in flight.products if one.tier != "residual" and one.fate in ("stored", "lost") and one.id in sent]
