"""What came of a flight of missions/faster over hidden traps: read from its run folder."""

from __future__ import annotations

import json
import math
import re
import shutil
import sqlite3
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from flights import Programs, rehearse

STEP_M = 0.05  # between two observed places the primary is taken to drive straight
FINAL = (0, 3, 4, 5, 6)  # of exec_svc/goals: rejected, achieved, dropped, failed, recalled
ACHIEVED = 3


@dataclass
class Repair:
    cause: str
    at_s: float
    used_s: float | None  # from the No-Go to the next drive on new paths; nothing: there was none
    allowed_s: float  # that the decision had left
    ended_well: bool  # the step that it was for was carried out
    paths_s: float | None = None  # from the No-Go to both new paths; nothing: there were none in its time, or nothing says when


@dataclass
class Flight:
    seed: int
    folder: str
    way_m: float | None = None  # length of a way for the primary on the true map; nothing: there is none
    result: str = "crashed"
    sim_s: float = 0
    wall_s: float = 0
    arrived: bool = False
    reason: str = ""  # why it did not
    bogged: bool = False
    marks: int = 0  # No-Go circles
    repairs: list[Repair] = field(default_factory=list)
    replans: list[str] = field(default_factory=list)  # by cause
    entries: int = 0  # of the primary into circles that its map had
    told: bool | None = None  # the last communication went out; nothing: not read, by an earlier version of this file
    felt: int = 0  # times that the primary's own wheels found soil that does not bear it
    faults: list[str] = field(default_factory=list)


def cause_of(text: str) -> str:
    """"plan 2 is broken: p2.9-scout_path.planning(w3, w4): failed [path-invalid]: …" is scout_path.planning: path-invalid."""
    found = re.search(r"is broken: p[\d.]+-([\w.]+)(?:\([^)]*\))?: \w+ \[([\w-]+)\]", text)
    return f"{found[1]}: {found[2]}" if found else text.split(" is broken: ")[-1][:80]


def lines(file: Path) -> list[dict]:
    return [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []


def fly(programs: Programs, mission: Path, seed: int, folder: Path, way_m: float | None, flown: bool) -> Flight:
    summary, error = rehearse(programs, mission, "hidden", seed, folder, flown)
    flight = Flight(seed, str(folder), way_m)
    if not summary:
        flight.faults.append(f"no summary: {error}")
        return flight
    flight.result, flight.sim_s, flight.wall_s = summary["result"], summary["sim_s"], summary["wall_s"]
    read(flight, Path(folder))
    return flight


def read(flight: Flight, folder: Path, journal: str = "journal.sqlite") -> None:
    with sqlite3.connect(f"file:{folder / journal}?mode=ro", uri=True) as database:
        rows = list(database.execute("SELECT time_us, kind, text FROM record WHERE kind IN ('trace', 'event', 'step') ORDER BY seq"))
        goals = {name: (state, reason) for name, state, reason in database.execute("SELECT id, state, reason FROM goal")}
    events = [(us / 1e6, text) for us, kind, text in rows if kind == "event"]
    trace = [(us / 1e6, text.split(" ", 1)[1]) for us, kind, text in rows if kind == "trace"]
    state, flight.reason = goals.get("long_traverse", (-1, "the goal is lost"))
    flight.arrived = state == ACHIEVED
    flight.told = goals.get("last_communication", (-1, ""))[0] == ACHIEVED
    flight.felt = sum("primary says No-Go" in one["text"] for one in lines(folder / "events.jsonl"))
    flight.bogged = any("primary" in text and "bogged-down" in text for _, text in trace if text.startswith("ack"))
    flight.replans = [cause_of(text) for _, text in events if text.startswith("plan.broken")]
    flight.repairs = repairs_of(rows, lines(folder / "effects.jsonl"), lines(folder / "events.jsonl"))
    circles = circles_of(folder)
    flight.marks = len(circles)
    flight.entries = entries_into(circles, trace)
    for name in ("long_traverse", "last_communication"):
        state, reason = goals.get(name, (-1, ""))
        if state not in FINAL and not reason.startswith("waiting for the ground"):
            flight.faults.append(f"goal {name} has no end")
    if flight.result not in ("achieved", "partial"):
        flight.faults.append(f"no defined end: result '{flight.result}' at {flight.sim_s:.0f} s")
    if flight.entries:
        flight.faults.append(f"the primary was {flight.entries} times in soil that its map had as No-Go")
    doubled = Counter((one["commander"], one["epoch"], one["activity"], one["attempt"]) for one in lines(folder / "effects.jsonl"))
    flight.faults += [f"command {' '.join(map(str, key))} has its effect {count} times" for key, count in doubled.items() if count > 1]


def repairs_of(rows: list[tuple[int, str, str]], effects: list[dict], events: list[dict]) -> list[Repair]:
    # The repair tells the primary's map to the scout as soon as both paths are worked out (TraverseWithSS of scout_locomotion.yaml).
    told = [one["time_us"] / 1e6 for one in events if one["sender"] == "primary.path" and one.get("code") == "map.told"]
    drives = [(one["time_us"] / 1e6, one["object"]) for one in effects if one["robot"] == "scout" and one["kind"] == "motion"]
    metres, (speed, room) = leg_metres(), longest_drive()
    well = {found[1] for _, kind, text in rows if kind == "trace" and (found := re.search(r"ack (\S+?-\S+?(?:\([^)]*\))?) \d+ stage=2 ", text))}
    begun, out = {}, []
    for us, kind, text in rows:
        words = text.split(" ")
        if kind != "trace":
            continue
        if words[1] == "command" and "action=0" in text:
            begun[text.split(" action=")[0].split("command ", 1)[1].rsplit(" ", 1)[0]] = us / 1e6
        found = re.search(r"ack (\S+?-\S+?(?:\([^)]*\))?) \d+ stage=0 (\S+) repairing (\S+?): (\S+?)[,;: ]", text + " ")
        if not found:
            continue
        activity, _, _, error = found.groups()
        at = us / 1e6
        leg = re.search(r"traversing_with_ss\((\w+), (\w+)\)", activity)
        limit = metres.get((leg[1], leg[2]), 0) / speed + room if leg else 0
        after = [since for since, to in drives if since >= at and to == leg[2]] if leg else []  # and not back first
        end = begun.get(activity, at) + limit
        error = error if "-" in error else "path-invalid"  # which is told by its reason alone
        both = [since for since in told if at <= since <= (min(after) if after else end)] if leg else []
        out.append(Repair(error, at, min(after) - at if after and min(after) <= end else None, end - at if leg else 0, activity in well,
                          min(both) - at if both else None))
    return out


def longest_drive() -> tuple[float, float]:
    """How long the scout's drive may take at most, as the domain says: m/s for the metres of its leg, and the seconds beside."""
    text = (Path(__file__).resolve().parents[2] / "missions/faster/domain.yaml").read_text()
    found = re.search(r'duration_s: \["[^"]*", "metres\(from, to\) / ([\d.]+) \+ ([\d.]+)"\]', text[text.index("traversing_with_ss:"):])
    return float(found[1]), float(found[2])


def leg_metres() -> dict[tuple[str, str], float]:
    text = (Path(__file__).resolve().parents[2] / "missions/faster/yard.yaml").read_text()
    out = {}
    for a, b, value in re.findall(r"\[(\w+), (\w+), ([\d.]+)\]", text):
        out[a, b] = out[b, a] = float(value)
    return out


def circles_of(folder: Path) -> list[tuple[float, float, float, float]]:
    """x, y, radius, and since when the primary's map has it. Where nothing says when it came there, as of processes, it counts from when it was found:
    never later than the map had it."""
    file = folder / "primary.path.hazards"
    if not file.exists():
        return []
    waiting = [one for one in json.loads(file.read_text()) if one.get("kind") == "soil"]
    if not (folder / "events.jsonl").exists():  # which rehearsals alone leave
        return sorted(((one["x_m"], one["y_m"], one["radius_m"], one["found_s"]) for one in waiting), key=lambda one: one[3])
    found_at, versions = {}, []  # since when the map had how many hazards
    for one in lines(folder / "events.jsonl"):
        found = re.search(r"the map has version \d+ with (\d+) hazards", one["text"])
        if one["sender"] == "primary.path" and found:
            versions.append((one["time_us"] / 1e6, int(found[1])))
        if found := re.search(r"says No-Go for \S+ \(([\w-]+),", one["text"]):
            found_at[found[1]] = one["time_us"] / 1e6

    def when(one: dict) -> tuple[float, int]:
        return found_at.get(one["id"], 0.0), int(re.sub(r"\D", "", one["id"]) or 0)

    out = []
    for at, count in versions:
        while len(out) < count and waiting:
            # What the primary has found itself is on its map at once, what the scout has found when it is told.
            known = [one for one in waiting if when(one)[0] <= at] or waiting
            one = min(known, key=lambda one: (not one["id"].startswith("primary"), when(one)))
            waiting.remove(one)
            out.append((one["x_m"], one["y_m"], one["radius_m"], at))
    return out + [(one["x_m"], one["y_m"], one["radius_m"], 0.0) for one in sorted(waiting, key=when)]


def entries_into(circles: list[tuple[float, float, float, float]], trace: list[tuple[float, str]]) -> int:
    place, driven = {}, []
    for at, text in trace:
        found = re.match(r"observation primary\.([xy]) (\S+)", text)
        if found:
            place[found[1]] = float(found[2])
        if found and len(place) == 2 and found[1] == "y":
            driven.append((at, place["x"], place["y"]))
    out = 0
    for x, y, radius, since in circles:
        was_in = False
        for (_, ax, ay), (bt, bx, by) in zip(driven, driven[1:]):
            if bt <= since:
                continue
            steps = max(1, math.ceil(math.hypot(bx - ax, by - ay) / STEP_M))
            for i in range(1, steps + 1):
                inside = math.hypot(ax + (bx - ax) * i / steps - x, ay + (by - ay) * i / steps - y) < radius
                out += inside and not was_in
                was_in = inside
    return out


def without_blocks(mission: Path, folder: Path, begins: Callable[[Path, list[str], str], bool]) -> Path:
    """A copy of the mission without the lines that `begins` is true of (file, lines before, line), and without what is indented below them."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(mission, folder)
    for file in folder.glob("*.yaml"):
        kept, depth = [], None
        for line in file.read_text().splitlines():
            indent = len(line) - len(line.lstrip())
            if depth is not None and line.strip() and indent <= depth:
                depth = None
            if depth is None and begins(file, kept, line):
                depth = indent
            if depth is None:
                kept.append(line)
        file.write_text("\n".join(kept) + "\n")
    return folder


def without_repairs(mission: Path, folder: Path) -> Path:
    """A copy of the mission in which the dedicated executives know no repair."""
    return without_blocks(mission, folder, lambda file, before, line: line.strip() == "repairs:")


def without_soil_sensing(mission: Path, folder: Path) -> Path:
    """A copy of the mission in which the primary's own wheels feel nothing; the scout's instruments are as they were."""

    def begins(file: Path, before: list[str], line: str) -> bool:
        robots = [one.split("name: ")[1] for one in before if re.fullmatch(r" {4}- name: \w+", one)]
        return file.name == "mission.yaml" and line.strip() == "soil_sensor:" and robots[-1:] == ["primary"]

    return without_blocks(mission, folder, begins)
