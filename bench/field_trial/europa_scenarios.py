"""Seeds become scenarios of missions/europa: which of the 16 uncertainties of MEXEC (section IV.C.3; R117) befall a flight, how strongly and when.
The same seed gives the same file on every machine."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field

from drawn import DrawnScenario

DURATION_S = 1903000  # 22 days, and a little for what ends them
GOAL_S = 10
BATTERY_J = 180_000_000
# As in missions/europa/mission.yaml.
SITES = ["0", "1", "2"]
COMPONENTS = ["arm", "laboratory", "camera", "radio", "seismometer"]
RATE_BYTE_S = 6500
COMMANDS = {"arm": ["prepare", "excavate", "collect", "transport", "discard"], "laboratory": ["analyze"],
            "camera": ["find_sites", "find_targets", "panorama"], "radio": ["prepare", "send", "receive"],
            "seismometer": ["start", "park"]}
VIEWS = [[from_s, from_s + 147600] for from_s in range(0, 1814401, 302400)]  # of Earth
# Joules that bring no zone out of its range by themselves: between its range and the temperature that its heater keeps.
SHOCKS_J = {"arm": (-8000, 15000), "vault": (-24000, 30000), "antenna": (-4000, 8000)}
LATEST_S = 1_200_000  # of what happens in flight: afterwards there is little that it could disturb


@dataclass
class Scenario(DrawnScenario):
    seed: int
    drawn: dict[str, str] = field(default_factory=dict)  # uncertainty → how
    world: list[str] = field(default_factory=list)
    windows: list[list[int]] = field(default_factory=list)  # true views of Earth, where they are not the predicted ones
    stimuli: list[tuple[int, str]] = field(default_factory=list)
    use_factor: float = 1
    loss_factor: float = 1
    surroundings_k: float = 100
    rates: list[tuple[int, float]] = field(default_factory=list)  # from when, bytes per second
    told: list[tuple[int, str]] = field(default_factory=list)  # what the ground tells of it: stimuli of the flight that knows

    def yaml(self) -> str:
        how = "; ".join(f"{name}: {text}" for name, text in self.drawn.items()) or "all as foreseen"
        lines = [f'description: "Field trial, seed {self.seed}. {how}"', f"duration_s: {DURATION_S}", f"start: {{battery: {BATTERY_J}}}"]
        if self.world:
            lines.append(f"world: {{{', '.join(self.world)}}}")
        if self.windows:
            lines.append(f"windows: [{{timeline: earth.window, open: {self.windows}}}]")
        goal = (GOAL_S, "goal: {issuer: ground, id: mission, kind: mission, importance: hard}")
        everything = sorted([goal, *self.told, *self.stimuli], key=lambda item: item[0])
        return "\n".join(lines + ["stimuli:"] + [f"  - {{at_s: {at}, {text}}}" for at, text in everything]) + "\n"


class _Draw:
    """One scenario while it is drawn."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.out = Scenario(seed)

    def between(self, low: float, high: float) -> float:
        return round(self.random.uniform(low, high), 2)

    def moment(self) -> int:
        return self.random.randint(2000, LATEST_S)

    def site(self) -> str:
        return self.random.choice(SITES)

    def consumption(self) -> str:
        self.out.use_factor = self.between(0.85, 1.25)
        self.out.world.append(f"use_factor: {self.out.use_factor}")
        return f"× {self.out.use_factor}"

    def level_drop(self) -> str:
        at, joules = self.moment(), self.random.randint(5, 50) * 1_000_000
        self.out.stimuli.append((at, f"battery_loss_j: {joules}"))
        return f"{joules // 1_000_000} MJ at {at} s"

    def level_at_the_end(self) -> str:
        below, factor = self.random.randint(10, 60) * 1_000_000, self.between(0.7, 1.3)
        self.out.world.append(f"gauge: {{below_j: {below}, factor: {factor}}}")
        return f"× {factor} below {below // 1_000_000} MJ"

    def hard_ice(self) -> str:
        hardness = self.between(0.7, 1.8)
        self.out.world.append(f"hardness: {hardness}")
        return f"hardness {hardness}"

    def one_site_not_deeper(self) -> str:
        site, depth = self.site(), self.between(0.03, 0.09)
        self.out.world.append(f'sites: {{"{site}": {{deepest_m: {depth}}}}}')
        return f"site {site} at {depth} m"

    def no_site_deeper(self) -> str:
        depth = self.between(0.03, 0.09)
        self.out.world.append(f"deepest_m: {depth}")
        return f"at {depth} m"

    def collapse(self) -> str:
        at, site, share = self.moment(), self.site(), self.between(0.2, 0.9)
        self.out.stimuli.append((at, f'trench_collapses: {{site: "{site}", share: {share}}}'))
        return f"site {site} at {at} s"

    def waste_heat(self) -> str:
        factor = self.between(0.5, 1.8)
        self.out.world.append(f"waste_factor: {factor}")
        return f"× {factor}"

    def cooling(self) -> str:
        if self.random.random() < 0.5:
            self.out.loss_factor = self.between(0.7, 1.5)
            self.out.world.append(f"loss_factor: {self.out.loss_factor}")
            return f"× {self.out.loss_factor}"
        self.out.surroundings_k = self.random.randint(80, 115)
        self.out.world.append(f"surroundings_k: {self.out.surroundings_k}")
        return f"{self.out.surroundings_k} K"

    def sudden_heat(self) -> str:
        at = self.moment()
        if self.random.random() < 0.5:
            kelvin = self.random.randint(80, 115)
            self.out.stimuli.append((at, f"surroundings: {{kelvin: {kelvin}}}"))
            return f"{kelvin} K from {at} s"
        zone = self.random.choice(list(SHOCKS_J))
        joules = self.random.randint(*SHOCKS_J[zone])
        self.out.stimuli.append((at, f"heat: {{zone: {zone}, joules: {joules}}}"))
        return f"{joules} J in {zone} at {at} s"

    def rate(self) -> str:
        factor = self.between(0.2, 1.6)
        if self.random.random() < 0.5:
            at = self.moment()
            self.out.stimuli.append((at, f"rate: {{component: radio, factor: {factor}}}"))
        else:
            at = 0
            self.out.world.append(f"rate_byte_s: {round(factor * RATE_BYTE_S)}")
        self.out.rates.append((at, factor * RATE_BYTE_S))
        return f"× {factor} from {at} s"

    def buffers(self) -> str:
        capacity = self.random.randint(40, 200) * 1_000_000
        self.out.world.append(f"data_capacity_bytes: {capacity}")
        return f"{capacity // 1_000_000} MB"

    def earth(self) -> str:
        if self.random.random() < 0.5:
            view = self.random.choice(VIEWS[:5])
            at, lasts = self.random.randint(view[0] + 1, view[1]), self.random.randint(3600, 80000)
            self.out.stimuli.append((at, f"blocked_view: {{window: earth.window, for_s: {lasts}}}"))
            return f"hidden for {lasts} s at {at} s"
        rises, sets = self.random.randint(-20000, 20000), self.random.randint(-20000, 20000)
        self.out.windows = [[max(0, begin + rises), end + sets] for begin, end in VIEWS]
        return f"rises {rises} s, sets {sets} s later"

    def failure(self) -> str:
        at, component, lasts = self.moment(), self.random.choice(COMPONENTS), self.random.randint(600, 60000)
        self.out.stimuli.append((at, f"fault: {{component: {component}, for_s: {lasts}}}"))
        return f"{component} for {lasts} s at {at} s"

    def hollow(self) -> str:
        at, component = self.random.randint(20, 700_000), self.random.choice(COMPONENTS)
        command = self.random.choice(COMMANDS[component])
        self.out.stimuli.append((at, f"hollow: {{component: {component}, command: {command}}}"))
        return f"{component} {command} after {at} s"

    def durations(self) -> str:
        if self.random.random() < 0.5:
            factor = self.between(0.8, 1.3)
            self.out.world.append(f"duration_factor: {factor}")
            return f"× {factor}"
        # A radio has nothing that a fault could make slower: that is what its rate is for.
        at, component, lasts = self.moment(), self.random.choice(["arm", "laboratory", "camera", "seismometer"]), self.random.randint(600, 60000)
        slow = self.between(1.5, 4)
        self.out.stimuli.append((at, f"fault: {{component: {component}, for_s: {lasts}, slow: {slow}}}"))
        return f"{component} × {slow} for {lasts} s at {at} s"


# In the order of sim_svc/README.md: name, probability, draw. That no site can be dug deeper leaves no sample, so it is drawn rarely.
UNCERTAINTIES: dict[str, tuple[float, Callable[[_Draw], str]]] = {
    "energy use": (0.25, _Draw.consumption),
    "battery drop": (0.25, _Draw.level_drop),
    "gauge at the end": (0.25, _Draw.level_at_the_end),
    "slow excavation": (0.25, _Draw.hard_ice),
    "one site too hard": (0.25, _Draw.one_site_not_deeper),
    "no site deeper": (0.05, _Draw.no_site_deeper),
    "trench collapses": (0.25, _Draw.collapse),
    "waste heat": (0.25, _Draw.waste_heat),
    "cooling": (0.25, _Draw.cooling),
    "sudden heat or cold": (0.25, _Draw.sudden_heat),
    "data rate": (0.25, _Draw.rate),
    "full buffers": (0.25, _Draw.buffers),
    "Earth rises otherwise": (0.25, _Draw.earth),
    "a task fails": (0.25, _Draw.failure),
    "hollow success": (0.25, _Draw.hollow),
    "durations": (0.25, _Draw.durations),
}


def draw(seed: int) -> Scenario:
    d = _Draw(seed)
    for name, (probability, word) in UNCERTAINTIES.items():
        if d.random.random() < probability:
            d.out.drawn[name] = word(d)
    return d.out
