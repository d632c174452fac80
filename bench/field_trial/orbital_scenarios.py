"""Seeds become scenarios of the orbital mission: the same seed gives the same file on every machine."""

from __future__ import annotations

import random
from dataclasses import dataclass, field

from drawn import DrawnGoal, DrawnScenario

DURATION_S = 37000  # a flight ends with its last goal; this is for one that never ends
UPLOAD_S = 10
# As in missions/orbital/mission.yaml: where each module is at the start, and what it is for.
MODULES = {"power-1": "s0", "power-2": "s1", "power-3": "s8", "thermal-1": "s2", "thermal-2": "s9", "camera-1": "s4", "camera-2": "s10",
           "radar-1": "s11", "radio-1": "s5"}
SEATED = ["power-1", "power-2", "thermal-1", "camera-1", "radio-1"]
SPARED = ["power-1", "power-2", "thermal-1", "camera-1"]  # there is another one with its role
SLOTS = [f"s{i}" for i in range(12)]
FREE = [slot for slot in SLOTS if slot not in MODULES.values()]
BALLAST = "{{slot: {slot}, mass_kg: 100, size_m: [0.36, 0.5, 0.5]}}"
COMPONENTS = ["arm", "grapple"]
JOINTS = ["rail", "azimuth", "shoulder", "elbow", "wrist_pitch"]


@dataclass(frozen=True)
class Goal(DrawnGoal):
    id: str
    issuer: str
    kind: str
    importance: str
    utility: int
    arguments: tuple[tuple[str, str], ...]
    opens_s: int = 0
    closes_s: int = 0

    def arguments_yaml(self) -> str:
        return ", ".join(f"{name}: {value}" for name, value in self.arguments)


@dataclass
class Scenario(DrawnScenario):
    seed: int
    battery_j: int
    blocked: list[str]  # nobody knows
    masses: dict[str, int]  # true ones
    tries: dict[str, int]  # of latches
    ballast: list[str]  # slots
    stimuli: list[tuple[int, Goal | str]]  # seconds; a goal, or another stimulus as YAML
    dark: bool = False  # the arrays give nothing
    failing: dict[str, int] = field(default_factory=dict)  # modules that fail in flight, with the time
    faults: list[tuple[str, int, int]] = field(default_factory=list)  # component, from, to

    def yaml(self) -> str:
        modules = {name: [f"true_mass_kg: {mass}"] for name, mass in self.masses.items()}
        for name, tries in self.tries.items():
            modules.setdefault(name, []).append(f"latch_tries: {tries}")
        told = [f"{name}: {{{', '.join(parts)}}}" for name, parts in modules.items()]
        told += [f"ballast-{i}: {BALLAST.format(slot=slot)}" for i, slot in enumerate(self.ballast, 1)]
        lines = [
            f"description: Field trial, seed {self.seed}.",
            f"duration_s: {DURATION_S}",
            f"start: {{battery: {self.battery_j}, {'array: jammed, ' if self.dark else ''}grapple: {{blocked: [{', '.join(self.blocked)}], modules: {{{', '.join(told)}}}}}}}",
        ]
        return "\n".join(lines + self.stimuli_yaml()) + "\n"


class _Draw:
    """One scenario while it is drawn."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.count = 0
        self.asked: set[str] = set()  # modules and slots that a goal names: no two goals contradict each other by that

    def chance(self, probability: float) -> bool:
        return self.random.random() < probability

    def goal(self, importance: str, issuer: str, known_s: int) -> Goal | None:
        self.count += 1
        prefix = {"hard": "h", "optional": "o", "opportunistic": "n"}[importance]
        kind = self.random.choices(["install", "replace", "configure"], [0.7, 0.15, 0.15])[0]
        opens = closes = 0
        if kind == "install":
            modules = [module for module in MODULES if module not in self.asked]
            slots = [slot for slot in SLOTS if slot not in self.asked]
            if not modules or not slots:
                return None
            module, slot = self.random.choice(modules), self.random.choice(slots)
            self.asked |= {module, slot}
            arguments = (("module", module), ("slot", slot))
            if self.chance(0.15 if importance == "hard" else 0.5):
                opens = known_s + self.random.randint(0, 3000)
                closes = opens + (self.random.randint(900, 2500) if importance != "hard" else self.random.randint(4000, 9000))
        else:
            value = self.random.choice(SPARED) if kind == "replace" else self.random.choice(["mapping", "survey"])
            seat = {"mapping": "s4", "survey": "s4"}.get(value) or MODULES[value]
            if value in self.asked or seat in self.asked or (kind == "configure" and "s0" in self.asked):
                return None
            self.asked |= {value, seat} | ({"s0", "power-1", "camera-1", "camera-2", "radar-1"} if kind == "configure" else set())
            arguments = (("module" if kind == "replace" else "mode", value),)
        return Goal(f"{prefix}{self.count}", issuer, kind, importance, self.random.randint(1, 9), arguments, opens, closes)


def draw(seed: int) -> Scenario:
    d = _Draw(seed)
    stimuli: list[tuple[int, Goal | str]] = []

    def ask(importance: str, issuer: str, at: int) -> None:
        goal = d.goal(importance, issuer, at)
        if goal:
            stimuli.append((at, goal))

    for _ in range(d.random.randint(1, 2)):
        ask("hard", "ground", UPLOAD_S)
    for _ in range(d.random.randint(0, 2)):
        ask("optional", "ground", UPLOAD_S)
    for _ in range(d.random.choice([0, 1, 1, 2])):
        ask("opportunistic", "orbiter", d.random.randint(30, 2500))
    if not stimuli:
        stimuli.append((UPLOAD_S, Goal("h0", "ground", "install", "hard", 1, (("module", "radar-1"), ("slot", "s3")))))
    failing = {}
    if d.chance(0.3):
        module = d.random.choice(SEATED)
        failing[module] = d.random.randint(30, 1500)
        stimuli.append((failing[module], f"module_fails: {{module: {module}}}"))
    if d.chance(0.25):
        joint, friction = d.random.choice(JOINTS), round(d.random.uniform(0.3, 0.9), 2)
        stimuli.append((d.random.randint(30, 1500), f"slow_joint: {{joint: {joint}, friction: {friction}, growth: 0.0}}"))
    faults = []
    if d.chance(0.2):
        component = d.random.choice(COMPONENTS)
        at, lasts = d.random.randint(30, 2000), d.random.randint(20, 300)
        stimuli.append((at, f"fault: {{component: {component}, for_s: {lasts}}}"))
        faults.append((component, at, at + lasts))
    dark = d.chance(0.12)
    if dark:
        stimuli.append((1, f"eclipse: {{generation: 0.0, for_s: {DURATION_S}}}"))
    free = d.random.sample(FREE, len(FREE))
    ballast = free[:2] if d.chance(0.2) else []
    blocked = [free[-1]] if not ballast and d.chance(0.2) else []
    return Scenario(
        seed=seed,
        battery_j=d.random.randint(200000, 320000) if dark or d.chance(0.2) else 600000,
        blocked=blocked,
        masses={name: d.random.randint(50, 150) for name in d.random.sample(list(MODULES), 2)} if d.chance(0.4) else {},
        tries={d.random.choice(list(MODULES)): d.random.randint(2, 4)} if d.chance(0.3) else {},
        ballast=ballast,
        stimuli=sorted(stimuli, key=lambda item: item[0]),
        dark=dark,
        failing=failing,
        faults=faults,
    )
