"""What a flight of missions/europa brought home, which rules it broke, and what was lost on the way: read from its run folder."""

from __future__ import annotations

import json
import sqlite3
from collections import Counter, defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from europa_scenarios import SITES, Scenario
from flights import Programs, rehearse

MISSION_S = 1_900_000  # of mission.over
# As in missions/europa/lander.yaml and rsm1.yaml: what data are worth, and at which rank.
RANKS = ["analysis", "post_excavation", "pre_excavation", "default"]
WORTH = {"summary": ("analysis", 0.1), "raw": ("analysis", 0.6), "compressed": ("analysis", 0.4), "trench": ("post_excavation", 0.3),
         "workspace": ("pre_excavation", 0.2), "panorama": ("default", 0.1), "quakes": ("default", 0.1)}
RESIDUAL = 0.2  # of raw data beside compressed ones
SITE_ORDER = ["1", "0", "2"]  # by value
MOST_SAMPLES = 3
# As in missions/europa/mission.yaml: range_k of each zone; telemetry has no more digits than these.
ZONES_K = {"arm": (110, 330), "vault": (240, 350), "antenna": (120, 400)}
TOLERANCE_K = 0.01
# Energy of communication by the network's own power: downlink_limit_j and sol_limit_j. They bind plans; how long sending takes varies by the
# rate's noise, which no plan knows, and a link that is slower than foreseen (uncertainty "data rate") makes it longer still.
DOWNLINK_W, SESSION_LIMIT_J, SOL_LIMIT_J, SOL_S = 120, 1_000_000, 1_500_000, 86_400
LIMIT_TOLERANCE = 1.05
EMPTY_J = 200_000  # as in the goal of mission.yaml


@dataclass
class Product:
    id: str
    kind: str
    tier: str
    fate: str
    source: str

    @property
    def sample(self) -> str:
        """Site and target, of data about one."""
        return self.kind.split("_", 1)[1] if self.kind.startswith(("summary_", "raw_", "compressed_")) else ""

    @property
    def worth(self) -> tuple[str, float]:
        rank, value = WORTH[self.kind.split("_")[0]]
        return rank, RESIDUAL if self.tier == "residual" else value


@dataclass
class Loss:
    cause: str
    what: str
    seed: int


@dataclass
class Flight:
    seed: int
    folder: Path
    result: str = "crashed"
    sim_s: float = 0
    wall_s: float = 0
    trace: str = ""
    products: list[Product] = field(default_factory=list)
    deeds: list[dict] = field(default_factory=list)
    failures: list[tuple[float, str, str]] = field(default_factory=list)  # seconds, activity, code
    refused: list[str] = field(default_factory=list)  # plan versions, by the checker or the executive
    battery_s: float | None = None  # when it was empty
    durations: dict[str, float] = field(default_factory=dict)  # of the newest success of each task, by its name in the network
    long_sessions: list[str] = field(default_factory=list)  # of a slower link, and sols that such sessions overdraw
    faults: list[str] = field(default_factory=list)  # rules that were broken
    losses: list[Loss] = field(default_factory=list)

    @property
    def received(self) -> list[Product]:
        return [one for one in self.products if one.fate == "received"]

    def utility(self, rank: str = "") -> float:
        """Of all that was received on Earth, at one rank or over all of them."""
        return sum(value for name, value in (one.worth for one in self.received) if rank in ("", name))

    @property
    def samples_home(self) -> int:
        kinds = {one.kind for one in self.received}
        samples = {one.sample for one in self.received if one.sample}
        return sum(f"summary_{s}" in kinds and (f"raw_{s}" in kinds or f"compressed_{s}" in kinds) for s in samples)

    def did(self, kind: str) -> list[dict]:
        return [deed for deed in self.deeds if deed["kind"] == kind]


def fly(programs: Programs, mission: Path, scenario: Scenario, name: str, folder: Path, flown: bool) -> Flight:
    summary, error = rehearse(programs, mission, name, scenario.seed, folder, flown)
    flight = Flight(scenario.seed, folder)
    if not summary:
        flight.faults.append(f"no summary: {error}")
        return flight
    flight.result, flight.sim_s, flight.wall_s = summary["result"], summary["sim_s"], summary["wall_s"]
    flight.trace = summary["trace_sha256"]
    read(flight, scenario)
    flight.losses = losses_of(flight)
    return flight


def lines(file: Path) -> list[dict]:
    return [json.loads(line) for line in file.read_text().splitlines()]


def read(flight: Flight, scenario: Scenario) -> None:
    last: dict[str, Product] = {}
    for one in lines(flight.folder / "products.jsonl"):
        last[one["id"]] = Product(one["id"], one["kind"], one["tier"], one["fate"], one["source"])
    flight.products = list(last.values())
    flight.deeds = lines(flight.folder / "effects.jsonl")
    with sqlite3.connect(f"file:{flight.folder / 'journal.sqlite'}?mode=ro", uri=True) as database:
        rows = list(database.execute("SELECT time_us, kind, text FROM record WHERE kind IN ('trace', 'event') ORDER BY seq"))
        goals = list(database.execute("SELECT id, state, reason FROM goal"))
    trace = [(us / 1e6, text.split(" ")[1:]) for us, kind, text in rows if kind == "trace"]
    flight.refused = [text for _, kind, text in rows if kind == "event" and text.startswith("plan.refused")]
    events = flight.folder / "events.jsonl"  # of rehearsals
    if events.exists():
        flight.refused += [one["text"] for one in lines(events) if one["code"] == "planner.defect"]
    read_commands(flight, trace)
    observed = observations(trace)
    levels = observed["lander.battery"]
    flight.battery_s = next((at for at, value in levels if float(value) <= EMPTY_J and at < MISSION_S), None)
    flight.faults += broken_ends(flight, goals) + broken_zones(observed) + broken_map(flight, observed) + broken_deeds(flight)
    (flight.long_sessions if scenario.rates else flight.faults).extend(long_sessions(observed))


def observations(trace: list[tuple[float, list[str]]]) -> dict[str, list[tuple[float, str]]]:
    out: dict[str, list[tuple[float, str]]] = defaultdict(list)
    for at, words in trace:
        if words[0] == "observation":
            out[words[1]].append((at, words[2]))
    return out


def read_commands(flight: Flight, trace: list[tuple[float, list[str]]]) -> None:
    begun: dict[str, float] = {}
    for at, words in trace:
        if words[0] == "command" and words[3] == "action=0":
            begun[words[1]] = at
        if words[0] != "ack":
            continue
        if words[3] == "stage=3":
            flight.failures.append((at, words[1], words[5]))
        if words[3] == "stage=2" and words[1] in begun:
            flight.durations[words[1].split("#")[0]] = at - begun[words[1]]


def broken_ends(flight: Flight, goals: list[tuple[str, int, str]]) -> list[str]:
    """A defined end: the mission is over or the battery empty, the run has ended by that, every goal is in a final state with a reason."""
    out = [f"goal {name} ends in state {state}: '{reason}'" for name, state, reason in goals if state in (1, 2) or not reason]
    if flight.result not in ("achieved", "partial"):
        out.append(f"no defined end: result '{flight.result}' at {flight.sim_s:.0f} s")
    return out


def broken_zones(observed: dict[str, list[tuple[float, str]]]) -> list[str]:
    out = []
    for zone, (low, high) in ZONES_K.items():
        values = [float(value) for _, value in observed[f"lander.heat.{zone}"]]
        if not values or min(values) < low - TOLERANCE_K or max(values) > high + TOLERANCE_K:
            out.append(f"zone {zone} is out of its range: {min(values, default=0):.2f} to {max(values, default=0):.2f} K")
    return out


def closed_again(observed: dict[str, list[tuple[float, str]]], site: str, at: float) -> bool:
    """The trench has collapsed: to sample there means to dig anew."""
    states = [value for since, value in observed.get(f"lander.site.{site}", []) if since < at]
    return "excavated" in states and states[-1] != "excavated"


def broken_map(flight: Flight, observed: dict[str, list[tuple[float, str]]]) -> list[str]:
    """The subway map (R112), by what was known when each collection began."""
    out = []
    known = {}  # sample → when, sign
    for name, values in observed.items():
        if name.startswith("lander.signature."):
            told = [(at, value) for at, value in values if value != "unknown"]
            if told:
                known[name.rsplit(".", 1)[1]] = told[0]
    analyses = {deed["object"] for deed in flight.did("analyze")}  # one that found no room for its data is made again
    analyzed = Counter(sample.split("_")[0] for sample in analyses)
    out += [f"{count} samples of site {site} were analyzed" for site, count in analyzed.items() if count > MOST_SAMPLES]
    troubled = {site for _, activity, _ in flight.failures for site in SITES if f"_site_{site}" in activity or f"_sample_{site}" in activity}
    for deed in flight.did("collect"):
        site, target = deed["object"].split(" ")
        at = deed["time_us"] / 1e6
        if any(sign == "negative" and since < at for sample, (since, sign) in known.items() if sample.startswith(f"{site}_")):
            out.append(f"sample {site} {target} was collected at {at:.0f} s although one of its site was known as negative")
        for other in SITES:
            told = [(since, sign) for sample, (since, sign) in known.items() if sample.startswith(f"{other}_") and since < at]
            lost = [one for one in flight.did("collect")
                    if one["object"].startswith(f"{other} ") and one["object"].replace(" ", "_") not in analyses]
            # A sample whose analysis had no effect has no signature, and is one of the site's all the same.
            collected = {one["object"] for one in flight.did("collect") if one["object"].startswith(f"{other} ") and one["time_us"] / 1e6 < at}
            closed = bool(lost) or other in troubled or closed_again(observed, other, at) or len(collected) >= MOST_SAMPLES
            if other != site and told and not closed and all(sign == "positive" for _, sign in told):
                out.append(f"sample {site} {target} was collected at {at:.0f} s although site {other} was open")
    return out


def sessions(observed: dict[str, list[tuple[float, str]]]) -> list[tuple[float, float]]:
    """Beginning and energy of each, by the power that the network foresees: a session is what is sent without another state between."""
    out, since = [], None
    for at, value in observed["lander.radio"]:
        if value == "sending":
            since = at if since is None else since
        elif since is not None:
            out.append((since, (at - since) * DOWNLINK_W))
            since = None
    return out


def long_sessions(observed: dict[str, list[tuple[float, str]]]) -> list[str]:
    """downlink_limit_j of each session, and sol_limit_j of those that begin within one sol."""
    out, sols = [], defaultdict(float)
    for since, joules in sessions(observed):
        sols[int(since // SOL_S)] += joules
        if joules > LIMIT_TOLERANCE * SESSION_LIMIT_J:
            out.append(f"a session of {joules / 1e6:.2f} MJ begins at {since:.0f} s")
    return out + [f"the sessions of sol {sol} take {joules / 1e6:.2f} MJ" for sol, joules in sols.items() if joules > LIMIT_TOLERANCE * SOL_LIMIT_J]


def broken_deeds(flight: Flight) -> list[str]:
    """Nothing is done twice: no command has its effect two times, and no product is sent again."""
    begun = Counter((deed["activity"], deed["attempt"], deed["kind"], deed["object"]) for deed in flight.deeds)
    sent = Counter(deed["object"] for deed in flight.did("downlink"))
    out = [f"{activity}, attempt {attempt}: {kind} {what} {count} times" for (activity, attempt, kind, what), count in begun.items() if count > 1]
    return out + [f"{product} was sent {count} times" for product, count in sent.items() if count > 1]


def losses_of(flight: Flight) -> list[Loss]:
    """What this flight began and did not bring home, and the sites that it never opened, each with the cause in its own record."""
    out = []

    def lose(cause: str, what: str) -> None:
        out.append(Loss(cause, what, flight.seed))

    def codes(part: str) -> list[str]:
        return [code for _, activity, code in flight.failures if part in activity]

    analyzed = Counter(deed["object"] for deed in flight.did("analyze"))
    collected = Counter(deed["object"].replace(" ", "_") for deed in flight.did("collect"))
    home = {one.sample for one in flight.received if one.sample and one.tier != "decisional"}
    for sample in collected:
        if sample in home:
            continue
        made = [one for one in flight.products if one.sample == sample]
        if not analyzed[sample]:
            # A hollow transport leaves a sample that nothing can be made of; the laboratory says so.
            told = codes(f"science_analyze_raw_{sample}#") + codes(f"science_analyze_compressed_{sample}#") + codes(f"collect_sample_{sample}#")
            lose(f"sample lost before its analysis: {told[-1]}" if told else "sample collected and not analyzed", sample)
        elif not any(one.tier == "mandatory" for one in made):
            lose("no room on board for its data" if "data-full" in codes(f"_{sample}#") else "analyzed without its effect", sample)
        else:
            lose("battery empty before its data were sent" if flight.battery_s else "its data were not sent before the end", sample)
    for place, site in enumerate(SITE_ORDER):
        if any(sample.startswith(f"{site}_") for sample in collected):
            continue
        told = codes(f"excavate_site_{site}#")
        before = [other for other in SITE_ORDER[:place] if not any(sample.startswith(f"{other}_") for sample in collected)]
        if told:
            lose(f"site not opened: {Counter(told).most_common(1)[0][0]}", f"site {site}")
        elif before:
            lose("site not reached: it waits for one that gives no sample", f"site {site}")
        else:
            lose("site not reached: energy or time", f"site {site}")
    for one in flight.products:
        if not one.sample and one.fate not in ("received", "sent"):
            lose(f"{one.tier} data {one.fate} at the end", one.id)
    return out
