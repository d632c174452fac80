"""Flies scenarios with roci-rehearse and reads from the run folder what happened."""

from __future__ import annotations

import json
import re
import shutil
import sqlite3
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import problem

CLASSES = ["hard", "optional", "opportunistic"]  # exec_svc/goals/goal_set.hpp
STATES = ["rejected", "pending", "planned", "achieved", "dropped", "failed", "recalled"]
FINAL = {"rejected", "achieved", "dropped", "failed", "recalled"}
FLIGHT_LIMIT_S = 3000  # of wall time; only for a flight that hangs


@dataclass
class Programs:
    """The programs of a build, and the mission as it stands in the repository."""

    bin: Path
    mission: Path
    schedule: Callable  # the reference scheduler of the mission: problem, values → Schedule
    constants: problem.Table = field(default_factory=dict)  # exact values of functions that hold in every flight

    @property
    def rehearse(self) -> Path:
        return self.bin / "roci-rehearse"

    @property
    def plan(self) -> Path:
        return self.bin / "roci-plan"

    @property
    def validate(self) -> Path:
        return self.bin / "roci-validate"


@dataclass
class GoalEnd:
    key: str
    id: str
    importance: str
    utility: float
    state: str
    reason: str
    arguments: dict[str, str] = field(default_factory=dict)
    arrived_s: float = 0
    ended_s: float = 0
    cause: str = ""  # of one given up: why planning was under way when it left

    @property
    def place(self) -> tuple[str, str]:
        """x and y, of one that has them."""
        return self.arguments.get("x", ""), self.arguments.get("y", "")

    def spent_budget(self) -> bool:
        """Whether it left since the planner's budget was spent, which proves nothing."""
        return self.reason.partition("\ndetails: ")[2].startswith(("timeout", "out_of_memory"))


@dataclass
class Call:
    number: int
    at_s: float
    problem: Path
    values: Path
    verdict: str
    reason: str
    wall_s: float
    evaluated: int


@dataclass
class Flight:
    seed: int
    folder: Path
    result: str = "crashed"
    error: str = ""
    sim_s: float = 0
    wall_s: float = 0
    replans: int = 0
    trace: str = ""
    goals: list[GoalEnd] = field(default_factory=list)
    calls: list[Call] = field(default_factory=list)
    events: list[tuple[float, str, str]] = field(default_factory=list)  # seconds, code, text
    branches: dict[str, int] = field(default_factory=dict)  # R49
    first_plan_s: float | None = None  # makespan of the first plan, as adopted
    faults: list[str] = field(default_factory=list)  # invariants that do not hold


def mission_work(mission: Path) -> int:
    """Evaluations of a planner call, as mission.yaml has them."""
    return int(re.search(r"\bwork: (\d+)", (mission / "mission.yaml").read_text()).group(1))


def lay_out_mission(mission: Path, folder: Path, changes: dict[str, str] | None = None) -> Path:
    """A mission folder of links to `mission`, with scenarios of its own; `changes` replace texts of mission.yaml."""
    folder.mkdir(parents=True, exist_ok=True)
    for item in mission.iterdir():
        link = folder / item.name
        if item.name == "scenarios":
            continue
        if link.is_symlink() or link.is_file():  # of an earlier trial
            link.unlink()
        link.symlink_to(item.resolve())
    (folder / "scenarios").mkdir(exist_ok=True)
    if changes:
        text = (mission / "mission.yaml").read_text()
        for old, new in changes.items():
            if old not in text:
                raise ValueError(f"{mission}/mission.yaml has no '{old}' any more; correct the field trial")
            text = text.replace(old, new)
        (folder / "mission.yaml").unlink()
        (folder / "mission.yaml").write_text(text)
    return folder


def rehearse(
    programs: Programs, mission: Path, scenario: str, seed: int, folder: Path, flown: bool = False
) -> tuple[dict, str]:
    """The summary of one flight, and what the program said if there is none. `flown`: one that lies there is taken."""
    printed = folder / "flight.json"
    if flown and printed.exists():
        return json.loads(printed.read_text()), ""
    shutil.rmtree(folder, ignore_errors=True)
    command = [programs.rehearse, mission, "--scenario", scenario, "--seed", str(seed), "--run-folder", folder, "--json"]
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=FLIGHT_LIMIT_S)
    except subprocess.TimeoutExpired:
        return {}, f"not ended after {FLIGHT_LIMIT_S} s of wall time"
    try:
        summary = json.loads(done.stdout.strip().splitlines()[-1])
        printed.write_text(json.dumps(summary))
        return summary, done.stderr.strip()
    except (ValueError, IndexError):
        return {}, f"exit code {done.returncode}: {done.stderr.strip()[-400:]}"


def fly(programs: Programs, mission: Path, scenario: str, seed: int, folder: Path, flown: bool = False) -> Flight:
    summary, error = rehearse(programs, mission, scenario, seed, folder, flown)
    flight = Flight(seed=seed, folder=folder)
    if not summary:
        flight.error = error
        flight.faults.append(f"no summary: {error}")
        return flight
    flight.result = summary["result"]
    flight.sim_s = summary["sim_s"]
    flight.wall_s = summary["wall_s"]
    flight.replans = summary["replans"]
    flight.trace = summary["trace_sha256"]
    read_journal(flight)
    return flight


def read_journal(flight: Flight) -> None:
    database = sqlite3.connect(f"file:{flight.folder / 'journal.sqlite'}?mode=ro", uri=True)
    rows = database.execute("SELECT time_us, kind, text FROM record ORDER BY seq")
    records = [(us / 1e6, kind, text) for us, kind, text in rows]
    goals = list(database.execute("SELECT issuer, id, request, state, reason FROM goal ORDER BY arrival"))
    database.close()
    for time_s, kind, text in records:
        if kind == "event":
            code, _, words = text.partition(" ")
            flight.events.append((time_s, code, words))
    for issuer, name, request, state, reason in goals:
        wish = json.loads(request)
        flight.goals.append(
            GoalEnd(
                f"{issuer}/{name}", name, CLASSES[wish["class"]], wish["utility"], STATES[state], reason, dict(wish["arguments"])
            )
        )
    trace_ends(flight)
    # Of kind call are also the cancels, without a problem.
    read_calls(flight, [(time_s, text) for time_s, kind, text in records if kind == "call" and text.startswith("(")])
    flight.branches = branches(records, flight.events)
    flight.first_plan_s = first_makespan(records)
    flight.faults += broken_invariants(flight, records)


def trace_ends(flight: Flight) -> None:
    """When each goal arrived, and what had made planning necessary when it was given up."""
    by_key = {goal.key: goal for goal in flight.goals}
    wanted = ""
    for time_s, code, words in flight.events:
        if code == "plan.broken" or (code == "plan.wanted" and not words.endswith("is broken")):
            wanted = words
        key = re.match(r"(?:hard )?(?:goal )?(\S+)", words.removeprefix("hard goal ").removeprefix("goal "))
        goal = by_key.get(key.group(1)) if key else None
        if goal and code == "goal.accepted":
            goal.arrived_s = time_s
        if goal and code in ("goal.dropped", "goal.failed"):
            goal.cause = wanted
        if goal and code in ("goal.dropped", "goal.failed", "goal.recalled"):
            goal.ended_s = time_s


def read_calls(flight: Flight, calls: list[tuple[float, str]]) -> None:
    folder = flight.folder / "planner_calls"
    for number, (time_s, problem) in enumerate(calls, 1):
        path = folder / f"{number}.pddl"
        if not path.exists():
            flight.faults.append(f"planner call {number} has no record")
            continue
        if path.read_text() != problem:
            flight.faults.append(f"planner call {number} in the journal is another than in {path}")
        end = json.loads(path.with_suffix(".json").read_text())
        flight.calls.append(
            Call(
                number,
                time_s,
                path,
                path.with_suffix(".values"),
                end["verdict"],
                end["reason"],
                end["wall_s"],
                end["evaluated"],
            )
        )


def first_makespan(records: list[tuple[float, str, str]]) -> float | None:
    """From the plan's origin to its last end, if all goes as planned."""
    plan = next((text for _, kind, text in records if kind == "trace" and text.split(" ")[1] == "plan"), None)
    if plan is None:
        return None
    origin = int(re.search(r"origin (\d+)", plan)[1])
    durations = {activity: int(low) for activity, low in re.findall(r"(p\d+\.\d+-[\w-]+) \[(\d+),", plan)}
    ends = []
    for _, kind, text in records:
        if kind == "step":
            activity, _, window, *_ = text.split(" ")
            if activity in durations:  # the first that is told of it
                ends.append(int(window.strip("[]").split(",")[0]) + durations.pop(activity))
    return (max(ends) - origin) / 1e6 if ends else None


def branches(records: list[tuple[float, str, str]], events: list[tuple[float, str, str]]) -> dict[str, int]:
    """R49, against the windows of the plan as it was adopted: [lb, ub] of each start, in microseconds."""
    out = {"at lb": 0, "inside": 0, "after ub": 0}
    windows: dict[str, tuple[int, int]] = {}
    for time_s, kind, text in records:
        if kind == "step":
            activity, state, window, *_ = text.split(" ")
            if state == "0":
                low, high = window.strip("[]").split(",")
                windows.setdefault(activity, (int(low), int(high)))
        elif kind == "trace":
            _, what, activity, *rest = text.split(" ")
            if what == "command" and activity in windows and rest[0] == "1" and rest[1] == "action=0":
                out["at lb" if round(time_s * 1e6) <= windows[activity][0] else "inside"] += 1
    out["after ub"] = sum(code == "plan.broken" and "latest start" in words for _, code, words in events)
    return out


def broken_invariants(flight: Flight, records: list[tuple[float, str, str]]) -> list[str]:
    faults = []
    safe = any(code == "robot.safe" for _, code, _ in flight.events)
    for goal in flight.goals:
        if goal.state not in FINAL and not safe:
            faults.append(f"goal {goal.key} ends {goal.state}: {goal.reason}")
        if goal.importance == "hard" and goal.state == "dropped":
            faults.append(f"hard goal {goal.key} was dropped: {goal.reason}")
        if goal.state in FINAL and not goal.reason:
            faults.append(f"goal {goal.key} is {goal.state} without a reason")
    planned: set[str] = set()
    for time_s, kind, text in records:
        if kind != "trace":
            continue
        words = text.split(" ")
        if words[1] == "plan":
            planned = set(re.findall(r"p\d+\.\d+-[\w-]+", text))
        elif words[1] == "command" and words[4] == "action=0":
            if words[2] not in planned and not words[2].startswith("fallback."):
                faults.append(f"command {words[2]} at {time_s} s is in no running plan")
    return faults
