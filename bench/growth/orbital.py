"""Problems for the domain of missions/orbital, as its executive writes them, with the values of its external functions:
modules of a satellite in slots along a rail, some of them to be elsewhere (R55)."""

import random

SPACING_M = 1.0  # from slot to slot along the rail
RAIL_M_S = 0.05  # speed of the arm's base
POSE_S = 20  # to fold, and to unfold above the next slot
POWER_W = 90
CARRY = 1.6  # how much longer a motion takes with a module in the tool
ORBIT_S, LIGHT_S = 5_400, 3_600
ROLES = ("power", "thermal", "instrument")


def reconfiguration(modules, moved, seed, free=2):
    """Problem and values. `moved` modules change places: two with each other, as a damaged one with its spare, the others
    in a circle, each to where the next one is. `free` slots are free."""
    rng = random.Random(seed * 1_000_003 + modules * 1009 + moved)
    slots = list(range(modules + free))
    taken = rng.sample(slots, modules)
    start = dict(enumerate(taken))
    goal = {}
    circle = rng.sample(range(modules), moved)
    ring, swapped = (circle[:-2], circle[-2:]) if moved >= 4 else (circle, [])
    for group in (ring, swapped):
        for module, successor in zip(group, group[1:] + group[:1]):
            goal[module] = start[successor]
    at = rng.choice(slots)
    init = ["(gripper-empty) (tool-ready)", f"(arm-at s{at}) (arm-first s{at})", f"(= (battery) {60_000 + 60_000 * modules})",
            "(= (reserve) 20000)", f"(= (capacity) {60_000 + 60_000 * modules})"]
    init += [f"(at-slot m{m} s{s}) (installed m{m} s{s}) (lay-first m{m} s{s}) (seat m{m} s{s}) (works m{m}) "
             f"(serves m{m} {ROLES[m % len(ROLES)]})" for m, s in start.items()]
    init += [f"(free s{s}) (free-first s{s})" for s in slots if s not in taken]
    init += [f"(wanted m{m} s{s}) (allowed m{m} s{s})" for m, s in goal.items()]
    init += ["(sunlit)"] + [f"(at {orbit * ORBIT_S + LIGHT_S} (not (sunlit))) (at {(orbit + 1) * ORBIT_S} (sunlit))"
                            for orbit in range(1 + 4 * moved * 150 // LIGHT_S)]
    wanted = [f"(installed m{m} s{s})" for m, s in goal.items()]
    problem = (f"(define (problem rearrangement) (:domain orbital)\n  (:objects {' '.join(f's{s}' for s in slots)} - socket\n"
               f"            {' '.join(f'm{m}' for m in start)} - module {' '.join(ROLES)} - role)\n  (:init\n    "
               + "\n    ".join(init) + ")\n  (:goal (and\n    " + "\n    ".join(wanted)
               + "))\n  (:metric minimize (total-time)))\n")
    return problem, values(slots)


def values(slots):
    """Times and energies of motions along the rail; what is not found in them does not exist."""
    lines = []
    for a in slots:
        lines.append(f"(ra_move_energy s{a}) {POWER_W * POSE_S}\n(ra_carry_energy s{a}) {POWER_W * POSE_S * CARRY:.0f}")
        for b in slots:
            time = POSE_S + SPACING_M * abs(a // 2 - b // 2) / RAIL_M_S
            lines.append(f"(ra_move_dur s{a} s{b}) {time:.1f}\n(ra_carry_dur s{a} s{b}) {CARRY * time:.1f}")
    return "\n".join(lines) + "\n"
