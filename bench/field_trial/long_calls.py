"""The longest planner calls again, one after the other: processor time, which other load of the machine does not count in.

Wall times of a flight are those of a machine on which two flights and their second looks run at the same time."""

from __future__ import annotations

import json
import resource
import subprocess
from dataclasses import dataclass

import problem
from flights import Call, Programs

MOST = 60  # calls that are repeated
LONG_S = 2.0  # R61
IMPROVE = 400  # evaluations for better plans, as in planner_svc/temporal_pddl/adapter/planning_call.cpp


@dataclass
class LongCall:
    seed: int
    call: Call
    verdict: str  # of the repetition
    cpu_s: float
    evaluated: int


def processor_time() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def repeat(programs: Programs, seed: int, call: Call, work: int) -> LongCall:
    command = [programs.plan, programs.mission / "domain.pddl", call.problem, "--functions", call.values]
    command += ["--functions-mode", "two-accuracy"] if problem.read_values(call.values).bounds else []
    command += ["--evaluations", work, "--improve", IMPROVE, "--memory", 256, "--json"]
    before = processor_time()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    told = json.loads(done.stdout)
    return LongCall(seed, call, told["verdict"], processor_time() - before, told["evaluated"])


def repeat_longest(programs: Programs, calls: list[tuple[int, Call]], work: int) -> list[LongCall]:
    """Of (seed, call): those over the limit of wall time, and at least the ten longest."""
    longest = sorted(calls, key=lambda item: -item[1].wall_s)
    over = sum(call.wall_s > LONG_S for _, call in longest)
    return [repeat(programs, seed, call, work) for seed, call in longest[: min(MOST, max(10, over))]]
