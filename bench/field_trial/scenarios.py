"""Seeds become scenarios of the planetary mission: the same seed gives the same file on every machine."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, field
from pathlib import Path

from drawn import DrawnGoal, DrawnScenario

DURATION_S = 30000  # a flight ends with its last goal; this is for one that never ends
UPLOAD_S = 10
PREDICTED_WINDOWS = [[1500, 2700], [5400, 6600], [9300, 10500], [13200, 14400]]  # as in mission.yaml
Rock = tuple[float, float, float]  # x, y, radius in metres
COMPONENTS = ["nav", "arm", "camera", "gripper", "radio"]
# Closed regions of missions/planetary/site/README.md: x, y, radius in metres.
CLOSED = [(190.0, 60.0, 20.0), (50.0, 180.0, 10.0)]


def read_pgm(path: Path) -> tuple[int, int, int, bytes]:
    """Width, height, offset of the first pixel, and the file's bytes (P5, as roci-site writes it)."""
    data = path.read_bytes()
    fields: list[bytes] = []
    position = 0
    while len(fields) < 4:
        end = data.index(b"\n", position)
        line = data[position:end]
        position = end + 1
        if not line.startswith(b"#"):
            fields += line.split()
    if fields[0] != b"P5":
        raise ValueError(f"{path}: not a binary PGM; write it with roci-site")
    return int(fields[1]), int(fields[2]), position, data


class Site:
    """What the ground knows of the site: where the terrain is easy. One metre per cell, row 0 in the north."""

    def __init__(self, folder: Path, low_m: float = -12.378, high_m: float = 4.113):
        self.width, self.height, offset, data = read_pgm(folder / "rocks.pgm")
        self._rocks = data[offset:]
        _, _, offset, data = read_pgm(folder / "elevation.pgm")
        self._heights = data[offset:]
        self._scale = (high_m - low_m) / 65535

    def _cell(self, x: float, y: float) -> int:
        return (self.height - 1 - int(y)) * self.width + int(x)

    def _elevation(self, x: float, y: float) -> float:
        cell = 2 * self._cell(x, y)
        return self._scale * int.from_bytes(self._heights[cell : cell + 2], "big")

    def is_easy(self, x: float, y: float) -> bool:
        """No rock within 4 m, no slope over 12 degrees within 4 m, not in a closed region."""
        if not (8 < x < self.width - 8 and 8 < y < self.height - 8):
            return False
        if any(math.hypot(x - cx, y - cy) < radius for cx, cy, radius in CLOSED):
            return False
        for dx in range(-4, 5):
            for dy in range(-4, 5):
                if self._rocks[self._cell(x + dx, y + dy)] < 192:
                    return False
        steepest = max(
            abs(self._elevation(x + dx, y + dy) - self._elevation(x + dx + sx, y + dy + sy))
            for dx in (-3, 0, 3)
            for dy in (-3, 0, 3)
            for sx, sy in ((1, 0), (0, 1))
        )
        return steepest < math.tan(math.radians(12))


@dataclass(frozen=True)
class Goal(DrawnGoal):
    id: str
    issuer: str
    kind: str
    importance: str
    utility: int
    x: int
    y: int
    sample: str = ""  # of drop_sample: the id of the goal that picks it
    opens_s: int = 0
    closes_s: int = 0

    def arguments_yaml(self) -> str:
        sample = f", sample: {self.sample}" if self.sample else ""
        return f"x: {self.x}, y: {self.y}{sample}"


@dataclass
class Scenario(DrawnScenario):
    seed: int
    x: int
    y: int
    heading: float
    battery_j: int
    slip: float
    rocks: list[Rock]  # on no map
    fallen: list[Rock]  # likewise, of those that come down in flight
    windows: list[list[int]]  # the true ones of comm.window
    science: bool
    stimuli: list[tuple[int, Goal | str]]  # seconds; a goal, or another stimulus as YAML
    losses_j: int = 0
    faults: list[tuple[str, int, int]] = field(default_factory=list)  # component, from, to
    recalled: frozenset[str] = frozenset()  # ids

    def yaml(self) -> str:
        rocks = ", ".join(f"{{x: {x}, y: {y}, radius: {r}}}" for x, y, r in self.rocks)
        lines = [
            f"description: Field trial, seed {self.seed}.",
            f"duration_s: {DURATION_S}",
            f"start: {{x: {self.x}, y: {self.y}, heading: {self.heading}, arm: stow, battery: {self.battery_j}}}",
            f"world: {{slip: {self.slip}, image_noise: 0.02, rocks: [{rocks}]}}",
        ]
        if self.windows != PREDICTED_WINDOWS:
            lines.append(f"windows: [{{timeline: comm.window, open: {self.windows}}}]")
        lines.append(f"science: {{enabled: {str(self.science).lower()}}}")
        return "\n".join(lines + self.stimuli_yaml()) + "\n"


class _Draw:
    """One scenario while it is drawn."""

    def __init__(self, seed: int, site: Site):
        self.random = random.Random(seed)
        self.site = site
        self.count = 0
        self.samples: list[str] = []
        self.x, self.y = (40, 40) if self.chance(0.5) else self.easy_place(40, 200)
        self.reach_m = self.random.choice([40, 70, 110])

    def chance(self, probability: float) -> bool:
        return self.random.random() < probability

    def easy_place(self, low: int, high: int) -> tuple[int, int]:
        while True:
            x, y = self.random.randint(low, high), self.random.randint(low, high)
            if self.site.is_easy(x, y):
                return x, y

    def place(self, hard_terrain: float) -> tuple[int, int]:
        """Within reach of the start; with the given probability anywhere there, however hard the terrain."""
        anywhere = self.chance(hard_terrain)
        while True:
            angle = self.random.uniform(0, 2 * math.pi)
            distance = self.reach_m * math.sqrt(self.random.random())
            x = round(self.x + distance * math.cos(angle))
            y = round(self.y + distance * math.sin(angle))
            if not (6 < x < self.site.width - 6 and 6 < y < self.site.height - 6):
                continue
            if anywhere or self.site.is_easy(x, y):
                return x, y

    def window(self, known_s: int, narrow: bool) -> tuple[int, int]:
        opens = known_s + self.random.randint(100, 5000)
        return opens, opens + (self.random.randint(90, 500) if narrow else self.random.randint(2000, 6000))

    def goals(self, importance: str, issuer: str, known_s: int) -> list[Goal]:
        """One goal; for a sample that is also to be set down somewhere, two."""
        self.count += 1
        kind = self.random.choices(["photo", "pick_sample", "both"], [0.6, 0.2, 0.2])[0]
        hard_terrain = 0.02 if importance == "hard" else 0.15
        prefix = {"hard": "h", "optional": "o", "opportunistic": "n"}[importance]
        x, y = self.place(hard_terrain)
        utility = self.random.randint(1, 9)
        opens = closes = 0
        if kind == "photo" and self.chance(0.15 if importance == "hard" else 0.5):
            opens, closes = self.window(known_s, narrow=importance != "hard")
        first = Goal(
            f"{prefix}{self.count}",
            issuer,
            "photo" if kind == "photo" else "pick_sample",
            importance,
            utility,
            x,
            y,
            opens_s=opens,
            closes_s=closes,
        )
        if kind != "both":
            return [first]
        x, y = self.place(hard_terrain)
        drop = Goal(f"{first.id}-drop", issuer, "drop_sample", importance, utility, x, y, sample=first.id)
        return [first, drop]

    def barrier(self, targets: list[Goal]) -> list[Rock]:
        """A row of rocks across the straight way to some goal."""
        target = self.random.choice(targets)
        dx, dy = target.x - self.x, target.y - self.y
        length = math.hypot(dx, dy)
        if length < 15:
            return []
        share = self.random.uniform(0.35, 0.75)
        gap = self.random.uniform(2.5, 5)
        half = self.random.randint(0, 4)
        radius = round(self.random.uniform(0.4, 2), 1)
        rocks = []
        for i in range(-half, half + 1):
            x = self.x + share * dx - i * gap * dy / length
            y = self.y + share * dy + i * gap * dx / length
            if 3 < x < self.site.width - 3 and 3 < y < self.site.height - 3:
                rocks.append((round(x, 1), round(y, 1), radius))
        return [r for r in rocks if math.hypot(r[0] - self.x, r[1] - self.y) > 5]


def draw(seed: int, site: Site) -> Scenario:
    d = _Draw(seed, site)
    stimuli: list[tuple[int, Goal | str]] = []
    for _ in range(d.random.randint(1, 2)):
        stimuli += [(UPLOAD_S, goal) for goal in d.goals("hard", "ground", UPLOAD_S)]
    for _ in range(d.random.randint(0, 2)):
        stimuli += [(UPLOAD_S, goal) for goal in d.goals("optional", "ground", UPLOAD_S)]
    for _ in range(d.random.choice([0, 1, 1, 2])):  # bursts in flight
        at = d.random.randint(30, 4000)
        for _ in range(d.random.randint(1, 2)):
            stimuli += [(at, goal) for goal in d.goals("opportunistic", "orbiter", at)]
    goals = [what for _, what in stimuli if isinstance(what, Goal)]
    recalled: set[str] = set()
    optional = [goal for goal in goals if goal.importance == "optional"]
    if optional and d.chance(0.15):
        goal = d.random.choice(optional)
        recalled = {other.id for other in goals if goal.id in (other.id, other.sample)}
        for name in sorted(recalled, reverse=True):
            stimuli.append((d.random.randint(20, 3000), f"recall: {{issuer: ground, id: {name}}}"))
    rocks = [rock for _ in range(d.random.choice([0, 0, 1, 2])) for rock in d.barrier(goals)]
    fallen = d.barrier(goals) if d.chance(0.1) else []
    for x, y, radius in fallen:
        stimuli.append((d.random.randint(50, 600), f"rock: {{x: {x}, y: {y}, radius: {radius}}}"))
    faults: list[tuple[str, int, int]] = []
    if d.chance(0.3):
        for _ in range(d.random.randint(1, 2)):
            component = d.random.choice(COMPONENTS)
            at, lasts = d.random.randint(30, 3000), d.random.randint(20, 400)
            stimuli.append((at, f"fault: {{component: {component}, for_s: {lasts}}}"))
            faults.append((component, at, at + lasts))
    loss = d.random.randint(100000, 600000) if d.chance(0.12) else 0
    if loss:
        stimuli.append((d.random.randint(50, 3000), f"battery_loss_j: {loss}"))
    windows = PREDICTED_WINDOWS
    if d.chance(0.2):
        lost = d.random.sample(range(len(windows)), d.random.randint(1, 2))
        windows = [window for i, window in enumerate(windows) if i not in lost]
    return Scenario(
        seed=seed,
        x=d.x,
        y=d.y,
        heading=round(d.random.uniform(-3.1, 3.1), 2),
        battery_j=d.random.randint(80000, 350000) if d.chance(0.2) else 900000,
        slip=round(d.random.uniform(0, 0.15), 3),
        rocks=rocks,
        fallen=fallen,
        windows=windows,
        science=d.chance(0.2),
        stimuli=sorted(stimuli, key=lambda item: item[0]),
        losses_j=loss,
        faults=faults,
        recalled=frozenset(recalled),
    )
