"""Figures 4, 5, 7 and 8 of the paper from flights: what bench_europa --executions tells."""

from __future__ import annotations

import re

from chart import Line
from gantt import Bar, Row, gantt, stacked

HOUR, DAY = 3600.0, 86400.0
SITES = ["#1f6fb4", "#2c9a4b", "#c2571a"]
OTHER, FAILED, GROUND = "#8a8a8a", "#c81e1e", "#8e44ad"
# Rows of figure 8: a name, and how the tasks' ids begin.
KINDS = [("uplink", ("p_uplink", "uplink")), ("panorama", ("mono_panorama",)), ("seismometer", ("start_seismo", "seismometer_on", "stop_seismo")),
         ("survey, prepare arm", ("find_excavation", "prepare_arm")), ("excavate", ("excavate",)), ("find targets", ("find_collection",)),
         ("discard", ("discard", "give_up")), ("collect", ("collect",)), ("transport", ("transport",)), ("analyze", ("science",)),
         ("plan", ("mexec_plan",)), ("prepare antenna", ("prepare_hga",)), ("downlink", ("downlink",))]


def flight_of(document: dict, strategy: str) -> dict:
    return document["variants"][0][strategy][0]


def site_of(chain: str) -> int | None:
    found = re.match(r"(?:sample|site_block)_(\d+)", chain)
    return int(found[1]) if found else None


def colour_of(execution: dict) -> str:
    site = site_of(execution["chain"])
    return OTHER if site is None else SITES[site % len(SITES)]


def short(task: str) -> str:
    for name, prefixes in KINDS:
        if task.startswith(prefixes):
            return name
    return task


def left(flight: dict, budget: float, until: float) -> list[tuple[float, float]]:
    """What the battery held, as a line between all starts and ends: tasks draw evenly."""
    executions = [one for one in flight["executions"] if one["spent"] > 0]
    times = sorted({0.0, until, *(one[key] for one in executions for key in ("start_s", "end_s") if one[key] <= until)})

    def spent(one: dict, time: float) -> float:
        length = one["end_s"] - one["start_s"]
        return one["spent"] * (min(max((time - one["start_s"]) / length, 0), 1) if length > 0 else time >= one["start_s"])

    return [(time, budget - sum(spent(one, time) for one in executions)) for time in times]


def whole_mission(document: dict) -> str:
    flight = flight_of(document, "replan")
    done = flight["executions"]
    rows = [Row(name, [Bar(one["start_s"] / DAY, one["end_s"] / DAY, FAILED if one["result"] == "failed" else colour_of(one),
                           edge=GROUND if one["result"] == "by ground" else "")
                       for one in done if one["task"].startswith(prefixes)]) for name, prefixes in KINDS]
    battery = [(time / DAY, joules / 1e6) for time, joules in left(flight, document["budget"], flight["end_s"])]
    rows.append(Row("battery [MJ]", [], [Line("battery", "#333333", battery)], 90))
    views = [(one["start_s"] / DAY, one["end_s"] / DAY) for one in done if one["task"].startswith("earth_view")]
    samples = sum(point[2].startswith("sample") for point in flight["course"])
    opened = len({one["task"] for one in done if one["task"].startswith("excavate") and one["result"] != "failed"})
    title = f"Reference Surface Mission 1 as flown: {opened} sites excavated, {samples} samples, {len(done)} executions"
    legend = [(f"site {number}", colour) for number, colour in enumerate(SITES)]
    return gantt(title, "mission time [days]; Earth in view is shaded", rows, 0, flight["end_s"] / DAY,
                 [*legend, ("other", OTHER), ("failed", FAILED), ("resolved by the ground (frame)", GROUND)], views)


STORIES = [("replan none", "nothing fails"), ("static flexible", "Static: the mission ends"), ("ground flexible", "Ground: halted, done again"),
           ("fe flexible", "FE: tried again at once"), ("replan replanning", "Replan: chain replaced")]


def strategies(figures: dict[str, dict]) -> str:
    """Figure 5: the same task fails under each strategy."""
    flights = [(words, flight_of(figures[name], name.split()[0])) for name, words in STORIES if name in figures]
    hit = [one for _, flight in flights for one in flight["executions"] if one["result"] in ("failed", "by ground")]
    if not hit:
        return ""
    first = min(one["start_s"] for one in hit) - 8 * HOUR
    last = first + 44 * HOUR
    rows = []
    for words, flight in flights:
        bars = [Bar((one["start_s"] - first) / HOUR, (one["end_s"] - first) / HOUR,
                    FAILED if one["result"] == "failed" else GROUND if one["result"] == "by ground" else colour_of(one), short(one["task"]))
                for one in flight["executions"]
                if site_of(one["chain"]) is not None and one["end_s"] > first and one["start_s"] < last]
        bars += [Bar((one["start_s"] - first) / HOUR, (one["end_s"] - first) / HOUR, OTHER, "give up sample")
                 for one in flight["executions"] if one["task"] == "give_up_sample"]
        rows.append(stacked(words, bars))
    return gantt(f"One failure of {short(hit[0]['task'])} under each strategy: chains of samples", "hours", rows, 0, (last - first) / HOUR,
                 [("site 0", SITES[0]), ("site 1", SITES[1]), ("site 2", SITES[2]), ("failed", FAILED),
                  ("with the ground's wait and second try", GROUND)])


def decompositions(document: dict) -> str:
    """Figure 4: a site's first sample and its next, with the state that chooses between the two."""
    done = flight_of(document, "replan")["executions"]
    chain = next((one["chain"] for one in done if "/first/" in one["chain"]), None)
    if chain is None:
        return ""
    site = site_of(chain)
    mine = [one for one in done if site_of(one["chain"]) == site]
    following = next((one["chain"] for one in mine if "/next/" in one["chain"]), "")
    first = min(one["start_s"] for one in mine) - 3 * HOUR
    last = max(one["end_s"] for one in mine if one["chain"] in (chain, following)) + HOUR
    opened = next(one["end_s"] for one in mine if one["task"].startswith("excavate"))
    collected = next(one["end_s"] for one in mine if one["task"].startswith("collect"))

    def of(name: str) -> list[Bar]:
        return [Bar((one["start_s"] - first) / HOUR, (one["end_s"] - first) / HOUR, colour_of(one), short(one["task"]))
                for one in mine if one["chain"] == name]

    def states(change: float, before: str, after: str) -> list[Bar]:
        return [Bar(0, (change - first) / HOUR, "#b0b0b0", before), Bar((change - first) / HOUR, (last - first) / HOUR, "#555555", after)]

    rows = [Row(f"site {site}", states(opened, "untouched", "excavated")), Row(f"samples there", states(collected, "none", "one or more")),
            stacked(chain, of(chain)), stacked(following, of(following))]
    return gantt("Two decompositions of sampling; the state of the site says which can be chosen", "hours", rows, 0, (last - first) / HOUR)


def timeline(document: dict) -> str:
    """Figure 7: what the battery held, what is projected, and where a task could be placed."""
    flight = flight_of(document, "replan")
    seen = flight["seen"]
    now, end = seen["now_s"], seen["projection"][-1][0]
    past = [(time / DAY, joules / 1e6) for time, joules in left(flight, document["budget"], now)]
    future = [(time / DAY, joules / 1e6) for time, joules in seen["projection"]]
    rows = [Row("battery [MJ]", [], [Line("past", "#333333", past), Line("projection", SITES[0], future, True)], 150),
            Row("past", [Bar(0, now / DAY, "#333333", "measured")]), Row("projection", [Bar(now / DAY, end / DAY, SITES[0], "as planned")])]
    for name, valid in seen["valid"].items():
        rows.append(Row(f"valid starts: {short(name)}", [Bar(a / DAY, b / DAY, SITES[1]) for a, b in valid]))
    return gantt(f"The battery at day {now / DAY:.1f}: past, projection, and when tasks could start", "mission time [days]", rows, 0, end / DAY)


def missions(figures: dict[str, dict]) -> dict[str, str]:
    """The name of each picture and its text, of the flights that are there."""
    out = {}
    if "replan none" in figures:
        out["figure-4"] = decompositions(figures["replan none"])
    out["figure-5"] = strategies(figures) if figures else ""
    if "mission" in figures:
        if "seen" in flight_of(figures["mission"], "replan"):
            out["figure-7"] = timeline(figures["mission"])
        out["figure-8"] = whole_mission(figures["mission"])
    return {name: picture for name, picture in out.items() if picture}
