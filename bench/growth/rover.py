"""Problems for rover.pddl: sites on a ring with shortcuts, some of them goals, each lit in some windows."""

import random


def problem(sites, goals, windows, seed):
    """The text of a solvable problem. windows: how often each goal is lit before it is lit for good; 0: it always is."""
    rng = random.Random(seed * 1_000_003 + sites * 1009 + goals * 31 + windows)
    roads = {(i, (i + 1) % sites): rng.randint(4, 12) for i in range(sites)}
    for i in range(sites):
        j = rng.randrange(sites)
        if j != i and (j, i) not in roads:
            roads.setdefault((i, j), rng.randint(8, 24))
    wanted = rng.sample(range(sites), goals)
    init = ["(at s0)", "(idle)", "(= (battery) 60)"]
    init += [f"(sunny s{i})" for i in range(sites) if i % 3 == 0]
    for (a, b), far in roads.items():
        init += [f"(road s{a} s{b}) (road s{b} s{a})", f"(= (far s{a} s{b}) {far}) (= (far s{b} s{a}) {far})"]
    for site in wanted:
        init += lighting(site, windows, rng)
    objects = " ".join(f"s{i}" for i in range(sites))
    goal = " ".join(f"(sent s{site})" for site in wanted)
    return (f"(define (problem growth) (:domain growth-rover)\n  (:objects {objects} - site)\n  (:init\n    "
            + "\n    ".join(init) + f")\n  (:goal (and {goal})))\n")


def lighting(site, windows, rng):
    if windows == 0:
        return [f"(lit s{site})"]
    lines, time = [], 0
    for _ in range(windows):
        time += rng.randint(5, 60)
        lines.append(f"(at {time} (lit s{site}))")
        time += rng.randint(4, 20)
        lines.append(f"(at {time} (not (lit s{site})))")
    lines.append(f"(at {time + rng.randint(5, 60)} (lit s{site}))")
    return lines
