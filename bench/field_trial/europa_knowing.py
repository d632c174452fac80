"""The same flight with a planner that knows: what the first one measured, and what was drawn, is told to it as values of the network's parameters.

Told are durations of all tasks, energy use, the hotel load, the data rate (when it changes), and which sites cannot be dug; a site's duration that nobody
measured follows from the others'. Not told are failures, hollow successes, collapses, drops of the battery's level and when Earth is hidden: the network
has no parameter for them."""

from __future__ import annotations

import math
import re
import statistics
from dataclasses import replace

from europa_flights import Flight
from europa_scenarios import RATE_BYTE_S, SITES, Scenario

TOLD_S = 2  # before the goal
# As in missions/europa/model.yaml: the parameter of each task's duration, its prior, and its range.
DURATIONS = {
    "collect_sample_{site}_": ("collect_s_{site}", 1800, 86400),
    "excavate_site_{site}": ("excavate_s_{site}", 3600, 259200),
    "find_excavation_sites": ("find_sites_s", 600, 28800),
    "find_collection_targets_": ("find_targets_s", 600, 14400),
    "prepare_arm": ("prepare_arm_s", 600, 21600),
    "discard_sample": ("discard_s", 300, 7200),
    "transport_sample": ("transport_s", 600, 14400),
    "science_analyze_": ("analyze_s", 1800, 43200),
    "prepare_hga_comm": ("prepare_hga_s", 300, 14400),
    "mono_panorama": ("panorama_s", 300, 14400),
    "start_seismometer": ("seismometer_switch_s", 10, 3600),
}
POWERS_W = {"vision_w": (60, 200), "prepare_arm_w": (150, 400), "discard_w": (80, 300), "transport_w": (100, 300), "analyze_w": (90, 300),
            "prepare_hga_w": (80, 300), "downlink_w": (120, 400), "uplink_w": (40, 200), "panorama_w": (40, 200), "plan_w": (20, 100),
            **{f"excavate_w_{site}": (350, 1000) for site in SITES}, **{f"collect_w_{site}": (250, 800) for site in SITES}}
# As in missions/europa/mission.yaml: what is always on, and each zone's loss in W/K with the temperature that its heater keeps.
IDLE_W = 9
LOSSES = [(0.2, 120), (0.03, 250), (0.1, 130)]
HARDNESS = {"0": 1.06, "1": 0.92, "2": 1.1}
DEPTH_M = 0.1
DOWNLINK_BYTES = {"downlink_raw_s": 31e6, "downlink_compressed_s": 9e6, "downlink_survey_s": 6e6}


def bounded(value: float, low: float, high: float) -> float:
    return round(min(max(value, low), high), 2)


def durations(flight: Flight) -> dict[str, float]:
    out = {}
    for pattern, (parameter, low, high) in DURATIONS.items():
        for site in SITES if "{site}" in pattern else [""]:
            some = [s for task, s in flight.durations.items() if task.startswith(pattern.format(site=site))]
            if some:
                out[parameter.format(site=site)] = bounded(statistics.fmean(some), low, high)
    for name, low, high in (("excavate_s", 3600, 259200), ("collect_s", 1800, 86400)):
        known = {site: out[f"{name}_{site}"] / HARDNESS[site] for site in SITES if f"{name}_{site}" in out}
        for site in SITES:
            if known and site not in known:
                out[f"{name}_{site}"] = bounded(statistics.fmean(known.values()) * HARDNESS[site], low, high)
    return out


def too_hard(scenario: Scenario) -> list[str]:
    words = " ".join(scenario.world)
    if re.search(r"(?<![{] )\bdeepest_m: [\d.]+", re.sub(r"sites: \{.*?\}\}", "", words)):
        return SITES
    return re.findall(r'sites: \{"(\d)": \{deepest_m', words)


def knowing(scenario: Scenario, flight: Flight) -> Scenario:
    """The scenario in which the ground tells all this; `flight` is the one of a planner that did not know it."""
    values = durations(flight)
    values.update({name: bounded(prior * scenario.use_factor, 5, high) for name, (prior, high) in POWERS_W.items()})
    cold = sum(loss * (keeps - scenario.surroundings_k) for loss, keeps in LOSSES) * scenario.loss_factor
    values["hotel_w"] = bounded((IDLE_W + cold) * scenario.use_factor, 5, 60)
    values.update({f"value_{site}": 0 for site in too_hard(scenario)})
    told = [(TOLD_S, name, value) for name, value in values.items()]
    for at, rate in scenario.rates or [(0, RATE_BYTE_S)]:
        told.append((max(at, TOLD_S), "rate_bytes_per_s", bounded(rate, 125, 100000)))
        # Whole seconds, upwards: a downlink that is too short by a byte has no room for its own data.
        told += [(max(at, TOLD_S), name, bounded(math.ceil(count / rate), 600, 600000)) for name, count in DOWNLINK_BYTES.items()]
    orders = [(at, f"parameter: {{issuer: ground, id: told-{i}, name: {name}, value: {value}}}") for i, (at, name, value) in enumerate(told, 1)]
    return replace(scenario, told=orders)
