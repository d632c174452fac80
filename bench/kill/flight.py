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
# Under the simulated clock sim_svc is the clock of the run and the world itself: with it the run ends, on purpose.
LIVE_KILLABLE = ["sim_svc"]
KILLABLE = ["exec_svc", "planner_svc", "pathplan_svc", "arm_svc", "science_svc"]
# With a standby the victims are roles: who leads, who stands by, both; a stopped leader goes on after STOPPED_S.
PAIR_VICTIMS = ["leader", "leader", "leader", "leader stopped", "standby", "both"]
STOPPED_S = 4.0
CRASH_POINTS = ["after-goal", "after-ack", "after-answer", "before-write-ahead", "after-write-ahead", "after-copy",
                "during-send", "after-send"]
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
    take_overs_s: list[float] = field(default_factory=list)  # from the leader's death to its successor's first step
    goals: dict[str, tuple[int, str]] = field(default_factory=dict)  # state, reason
    requested: set[str] = field(default_factory=set)
    effects: list[dict] = field(default_factory=list)  # what the robot's components really did, over every start of sim_svc
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


def members(launcher: int) -> dict[str, int]:
    """The processes of the pair: "first", "second"."""
    found = {}
    for task in Path(f"/proc/{launcher}/task").glob("*/children"):
        for pid in task.read_text().split():
            try:
                words = Path(f"/proc/{pid}/cmdline").read_text().split("\0")
                if "--pair" in words:
                    found[words[words.index("--pair") + 1]] = int(pid)
            except OSError:
                pass
    return found


def newest_epoch(folder: Path) -> int:
    newest = 0
    for file in (folder / "standing", folder / "standby/standing"):
        try:
            newest = max(newest, int(file.read_text().split()[0]))
        except (OSError, ValueError, IndexError):
            pass
    return newest


def ask(journal: Path, question: str) -> float:
    try:
        with sqlite3.connect(f"file:{journal}?mode=ro", uri=True, timeout=1) as database:
            return (database.execute(question).fetchone() or [0])[0] or 0
    except sqlite3.Error:
        return 0


def journals(folder: Path) -> list[Path]:
    return [file for file in (folder / "journal.sqlite", folder / "standby/journal.sqlite") if file.exists()]


def mission_time(folder: Path) -> float:
    """Of the newest thing that a journal knows; it is written ahead of everything that happens."""
    newest = "SELECT time_us FROM record ORDER BY seq DESC LIMIT 1"
    return max((ask(file, newest) / 1e6 for file in journals(folder)), default=0.0)


def resumed(folder: Path) -> float:
    count = "SELECT COUNT(*) FROM record WHERE kind='event' AND text LIKE 'executive.resumed%'"
    return max((ask(file, count) for file in journals(folder)), default=0)


def send(pid: int | None, number: int) -> bool:
    try:
        if pid:
            os.kill(pid, number)
        return bool(pid)
    except ProcessLookupError:
        return False


def leader_of(folder: Path) -> str:
    return "first" if newest_epoch(folder) % 2 == 1 else "second"


def kill_member(launcher: subprocess.Popen, flight: Flight, victim: str) -> None:
    leader, processes = leader_of(flight.folder), members(launcher.pid)
    names = {"standby": {"first", "second"} - {leader}, "both": {"first", "second"}}.get(victim, {leader})
    before, start = resumed(flight.folder), time.monotonic()
    stopped = victim == "leader stopped"
    flight.killed += sum(send(processes.get(name), signal.SIGSTOP if stopped else signal.SIGKILL) for name in names)
    if victim not in ("leader", "leader stopped"):
        return
    limit = start + (STOPPED_S if stopped else 30)
    while launcher.poll() is None and resumed(flight.folder) == before and time.monotonic() < limit:
        time.sleep(0.005)
    if resumed(flight.folder) > before and leader_of(flight.folder) != leader:
        flight.take_overs_s.append(time.monotonic() - start)
    if stopped:
        time.sleep(max(0.0, limit - time.monotonic()))
        send(processes.get(leader), signal.SIGCONT)


def kill_in_flight(launcher: subprocess.Popen, flight: Flight, kills: Kills, sim_s: float) -> None:
    for share, victim in kills.at:
        while launcher.poll() is None and mission_time(flight.folder) < share * sim_s:
            time.sleep(0.002)
        if launcher.poll() is not None:
            return
        if victim in PAIR_VICTIMS:
            kill_member(launcher, flight, victim)
        else:
            flight.killed += send(children(launcher.pid).get(victim), signal.SIGKILL)


def fly(options, folder: Path, dds: str, scenario: str, seed: int, kills: Kills, sim_s: float = 0.0) -> Flight:
    flight = Flight(folder)
    environment = dict(os.environ, ROCI_CRASH=kills.crash)
    command = [options.bin / "roci-launch", options.mission, "--dds", dds, "--scenario", scenario, "--seed", str(seed),
               "--clock", options.clock, "--speed", options.speed, "--headless", "--json", "--run-folder", folder]
    command += ["--standby"] if options.standby else []
    launcher = subprocess.Popen([str(word) for word in command], env=environment, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)
    kill_in_flight(launcher, flight, kills, sim_s)
    journal = "journal.sqlite"
    try:
        output, flight.error = launcher.communicate(timeout=LONGEST_S)
        flight.exit_code = launcher.returncode
        summary = json.loads(output.strip().splitlines()[-1])
        flight.result, flight.sim_s = summary["result"], summary.get("sim_s", 0.0)
        journal = summary.get("journal", journal)
    except subprocess.TimeoutExpired:
        launcher.terminate()
        launcher.communicate()
    except (ValueError, IndexError):
        pass
    read(flight, flight.folder / journal, scenario, options.mission)
    return flight


def read(flight: Flight, journal: Path, scenario: str, mission: Path) -> None:
    try:
        with sqlite3.connect(f"file:{journal}?mode=ro", uri=True) as database:
            for issuer, name, state, reason in database.execute("SELECT issuer, id, state, reason FROM goal"):
                flight.goals[f"{issuer}/{name}"] = (state, reason)
            flight.events = [row[0] for row in database.execute("SELECT text FROM record WHERE kind='event' ORDER BY seq")]
        flight.effects = [json.loads(line) for line in (flight.folder / "effects.jsonl").read_text().splitlines()]
    except (OSError, ValueError, sqlite3.Error) as error:
        flight.error += f" {error}"
    if not flight.killed:
        flight.killed = sum(event.startswith("executive.resumed") for event in flight.events)
    text = (mission / "scenarios" / f"{scenario}.yaml").read_text()
    pairs = re.findall(r"goal: *\{ *issuer: *([\w-]+), *id: *([\w-]+)", text)
    flight.requested = {f"{issuer}/{name}" for issuer, name in pairs}
