"""One flight with real processes in which services are killed, and what its folder tells afterwards."""

import json
import os
import re
import signal
import sqlite3
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

VENDORS = ["fastdds", "cyclonedds", "mixed"]
# sim_svc is the clock of the run and the world itself: with it the run ends, on purpose.
KILLABLE = ["exec_svc", "planner_svc", "pathplan_svc", "arm_svc", "science_svc"]
CRASH_POINTS = ["after-goal", "after-ack", "after-answer", "before-write-ahead", "after-write-ahead", "during-send",
                "after-send"]
LONGEST_S = 120


@dataclass
class Kills:
    crash: str = ""  # ROCI_CRASH
    at: list[tuple[float, str]] = field(default_factory=list)  # share of the mission time, service

    def text(self) -> str:
        return self.crash or ", ".join(f"{victim} at {share:.2f}" for share, victim in self.at) or "nothing"


@dataclass
class Flight:
    folder: Path
    exit_code: int | None = None  # none: it had no end
    result: str = ""
    sim_s: float = 0.0
    killed: int = 0
    goals: dict[str, tuple[int, str]] = field(default_factory=dict)  # state, reason
    requested: set[str] = field(default_factory=set)
    begun: list[dict] = field(default_factory=list)
    events: list[str] = field(default_factory=list)
    error: str = ""


def children(parent: int) -> dict[str, int]:
    found = {}
    for task in Path(f"/proc/{parent}/task").glob("*/children"):
        for pid in task.read_text().split():
            try:
                found[Path(f"/proc/{pid}/comm").read_text().strip()] = int(pid)
            except OSError:
                pass
    return found


def mission_time(log: Path) -> float:
    """Of the newest thing that the journal knows; it is written ahead of everything that happens."""
    try:
        with sqlite3.connect(f"file:{log}?mode=ro", uri=True, timeout=1) as database:
            return (database.execute("SELECT time_us FROM record ORDER BY seq DESC LIMIT 1").fetchone() or [0])[0] / 1e6
    except sqlite3.Error:
        return 0.0


def kill_in_flight(launcher: subprocess.Popen, flight: Flight, kills: Kills, sim_s: float) -> None:
    for share, victim in kills.at:
        while launcher.poll() is None and mission_time(flight.folder / "journal.sqlite") < share * sim_s:
            time.sleep(0.002)
        pid = children(launcher.pid).get(victim)
        if launcher.poll() is None and pid:
            try:
                os.kill(pid, signal.SIGKILL)
                flight.killed += 1
            except ProcessLookupError:
                pass


def fly(options, folder: Path, dds: str, scenario: str, seed: int, kills: Kills, sim_s: float = 0.0) -> Flight:
    flight = Flight(folder)
    environment = dict(os.environ, ROCI_CRASH=kills.crash)
    command = [options.bin / "roci-launch", options.mission, "--dds", dds, "--scenario", scenario, "--seed", str(seed),
               "--clock", options.clock, "--speed", options.speed, "--headless", "--json", "--run-folder", folder]
    launcher = subprocess.Popen([str(word) for word in command], env=environment, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)
    kill_in_flight(launcher, flight, kills, sim_s)
    try:
        output, flight.error = launcher.communicate(timeout=LONGEST_S)
        flight.exit_code = launcher.returncode
        summary = json.loads(output.strip().splitlines()[-1])
        flight.result, flight.sim_s = summary["result"], summary.get("sim_s", 0.0)
    except subprocess.TimeoutExpired:
        launcher.terminate()
        launcher.communicate()
    except (ValueError, IndexError):
        pass
    read(flight, scenario, options.mission)
    return flight


def read(flight: Flight, scenario: str, mission: Path) -> None:
    try:
        with sqlite3.connect(f"file:{flight.folder / 'journal.sqlite'}?mode=ro", uri=True) as database:
            for issuer, name, state, reason in database.execute("SELECT issuer, id, state, reason FROM goal"):
                flight.goals[f"{issuer}/{name}"] = (state, reason)
            flight.events = [row[0] for row in database.execute("SELECT text FROM record WHERE kind='event' ORDER BY seq")]
        flight.begun = json.loads((flight.folder / "begun.json").read_text())
    except (OSError, ValueError, sqlite3.Error) as error:
        flight.error += f" {error}"
    if not flight.killed:
        flight.killed = sum(event.startswith("executive.resumed") for event in flight.events)
    text = (mission / "scenarios" / f"{scenario}.yaml").read_text()
    pairs = re.findall(r"goal: *\{ *issuer: *([\w-]+), *id: *([\w-]+)", text)
    flight.requested = {f"{issuer}/{name}" for issuer, name in pairs}
