"""What one seed of the campaign flies: network, pair, hosts, what the ground asks, and what goes wrong when."""

import math
import random
from dataclasses import asdict, dataclass, field

VENDORS = ["fastdds", "cyclonedds", "mixed"]
HOSTS = ["robot", "first", "second"]
# Where services stand when there are three hosts; with a pair the second executive is on the third one.
ALONE = {"robot": ["sim_svc", "arm_svc", "pathplan_svc", "science_svc"], "first": ["exec_svc"], "second": ["planner_svc"]}
PAIR = {"robot": ["sim_svc", "arm_svc", "pathplan_svc", "science_svc", "planner_svc"], "first": ["exec_svc"],
        "second": ["exec_svc.standby"]}
# Places that the rover reaches from where it starts, each within some minutes of mission time.
PLACES = [(60, 44), (52, 56), (60, 60), (60, 45), (48, 48), (54, 50)]
LINKS = [("robot", "first"), ("robot", "second"), ("first", "second")]
FAULT_WINDOW_S = (0.5, 18.0)  # of wall time, from the first thing that the robot does


@dataclass
class Fault:
    kind: str  # kill, launcher, hang, cut, cable, disk, clock, hostile
    at_s: float
    what: str = ""  # a service, a host, a link "a-b", or how hostile
    for_s: float = 0.0  # how long; of clock: by how much the system clock is set

    def text(self) -> str:
        return f"{self.kind} {self.what} at {self.at_s:.1f} for {self.for_s:.2f}"


@dataclass
class Wish:
    """A goal that the ground sends in flight, and takes back perhaps."""
    id: str
    at_s: float
    x: float
    y: float
    recall_after_s: float | None = None


@dataclass
class Draw:
    seed: int
    dds: str
    secured: bool
    standby: bool
    hosts: int
    ground: str  # the host from which the ground speaks
    samples: bool  # a sample is to be picked and set down
    faults: list[Fault] = field(default_factory=list)
    wishes: list[Wish] = field(default_factory=list)

    def placed(self) -> dict[str, list[str]]:
        """Services by host; on one host the launcher starts them all."""
        return {"robot": []} if self.hosts == 1 else (PAIR if self.standby else ALONE)

    def causes(self) -> set[str]:
        return {fault.kind for fault in self.faults}

    def as_json(self) -> dict:
        return asdict(self)


def log_uniform(rng: random.Random, least: float, most: float) -> float:
    return math.exp(rng.uniform(math.log(least), math.log(most)))


def host_of(draw: Draw, service: str) -> str:
    return next((host for host, services in draw.placed().items() if service in services), "robot")


def draw_fault(rng: random.Random, draw: Draw) -> Fault:
    kinds = ["kill"] * 4 + ["launcher"] * 2 + ["hang"] * 3 + ["disk", "clock"]
    kinds += ["cut"] * 4 + ["cable"] if draw.hosts == 3 else ["hostile"] * 2
    kind = rng.choice(kinds)
    fault = Fault(kind, rng.uniform(*FAULT_WINDOW_S))
    hosts = list(draw.placed())
    # The robot and the executive as often as all others together.
    services = ["sim_svc", "exec_svc"] * 2 + ["planner_svc", "pathplan_svc", "arm_svc", "science_svc"]
    services += ["exec_svc.standby"] * 2 if draw.standby else []
    if kind == "kill":
        fault.what = rng.choice(services)
    elif kind == "hang":
        fault.what, fault.for_s = rng.choice(services), log_uniform(rng, 0.1, 20)
    elif kind == "launcher":
        fault.what, fault.for_s = rng.choice(hosts), rng.uniform(0, 4)  # until it is started again
    elif kind == "cut":
        fault.what, fault.for_s = "-".join(rng.choice(LINKS)), log_uniform(rng, 0.2, 60)
    elif kind == "cable":
        fault.what, fault.for_s = rng.choice(hosts), log_uniform(rng, 0.2, 60)
    elif kind == "disk":
        fault.what, fault.for_s = rng.choice(hosts), log_uniform(rng, 0.5, 15)
    elif kind == "clock":
        fault.what, fault.for_s = rng.choice(hosts), rng.choice([-1, 1]) * log_uniform(rng, 1, 3600)
    else:
        fault.what, fault.for_s = rng.choice(["inject", "writers", "intruder"]), rng.uniform(1, 6)
    return fault


def draw(seed: int) -> Draw:
    rng = random.Random(f"campaign {seed}")
    standby = rng.random() < 0.5
    out = Draw(seed, rng.choice(VENDORS), rng.random() < 0.3, standby, rng.choice([1, 3]), "robot", rng.random() < 0.3)
    if out.hosts == 3:
        out.ground = rng.choice(HOSTS)
    out.faults = sorted((draw_fault(rng, out) for _ in range(rng.randint(1, 4))), key=lambda fault: fault.at_s)
    for number in range(rng.randint(1, 3)):
        x, y = rng.choice(PLACES)
        wish = Wish(f"more-{number}", rng.uniform(0, 15), x + rng.uniform(-2, 2), y + rng.uniform(-2, 2))
        if rng.random() < 0.5:
            wish.recall_after_s = log_uniform(rng, 0.1, 10)
        out.wishes.append(wish)
    return out
