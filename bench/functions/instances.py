"""Problems with values of their external functions in two accuracies, as roci-plan --functions reads them."""

import math
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "growth"))
import orbital  # noqa: E402

GOALS = 4
SIDE_M = 400
SPEED_M_S = 0.5
WATTS = 40
DETOUR = (1.05, 1.8)  # a path is so many times as long as the straight line, which is its lower bound
NO_WAY = 0.03  # of the pairs; a bound does not know of them


def rover(sites, seed):
    """Way-points in a field, GOALS of them to be pictured; problem and values."""
    rng = random.Random(seed * 1_000_003 + sites)
    points = [(rng.uniform(0, SIDE_M), rng.uniform(0, SIDE_M)) for _ in range(sites)]
    lines = []
    for a, (ax, ay) in enumerate(points):
        for b, (bx, by) in enumerate(points):
            straight = max(math.hypot(ax - bx, ay - by), 1) / SPEED_M_S
            told = (("traverse_time", straight), ("traverse_energy", straight * WATTS))
            there = a != b and rng.random() >= NO_WAY
            detour = rng.uniform(*DETOUR)
            for function, bound in told:
                tuple_ = f"({function} s{a} s{b})"
                lines.append(f"{tuple_} >= {bound:.3f}")
                lines.append(f"{tuple_} {bound * detour:.3f}" if there else f"{tuple_} unreachable")
    wanted = rng.sample(range(1, sites), GOALS)
    problem = (f"(define (problem functions) (:domain functions-rover)\n  (:objects {' '.join(f's{i}' for i in range(sites))} - site)\n"
               f"  (:init (at s0) (idle) (= (battery) {SIDE_M / SPEED_M_S * WATTS * 3 * GOALS:.0f}))\n"
               f"  (:goal (and {' '.join(f'(sent s{site})' for site in wanted)})))\n")
    return problem, "\n".join(lines) + "\n"


def satellite(modules, seed):
    """The satellite of bench/growth, four of whose modules change places; an arm that goes round things takes longer than the
    straight way of its joints, which is its lower bound."""
    problem, exact = orbital.reconfiguration(modules, GOALS, seed)
    rng = random.Random(seed * 1_000_003 + modules)
    lines = []
    for line in exact.splitlines():
        tuple_, number = line.rsplit(" ", 1)
        lines += [f"{tuple_} >= {float(number):.3f}", f"{tuple_} {float(number) * rng.uniform(*DETOUR):.3f}"]
    return problem, "\n".join(lines) + "\n"
