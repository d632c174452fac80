"""Problems for orbital.pddl with the values of its external functions: modules in slots along a rail, some to be elsewhere."""

import random

SPACING_M = 0.8  # from slot to slot; the slots stand in two rows on both sides of the rail
SPEED_M_S = 0.02  # of a walking arm
STEP_S = 12  # to let go with one foot and take hold with it again
REACH_M = 1.6  # of one step
POSE_S = 18  # from above one slot to above its neighbour
POWER_W = 60


def reconfiguration(modules, moved, seed):
    """Problem and values. `moved` modules change places: two with each other, as a damaged one with its spare, the others
    in a circle, each to where the next one is. Two slots are free."""
    rng = random.Random(seed * 1_000_003 + modules * 1009 + moved)
    slots = list(range(modules + 2))
    taken = rng.sample(slots, modules)
    start = dict(enumerate(taken))
    goal = dict(start)
    circle = rng.sample(range(modules), moved)
    ring, swapped = (circle[:-2], circle[-2:]) if moved >= 4 else (circle, [])
    for group in (ring, swapped):
        for module, successor in zip(group, group[1:] + group[:1]):
            goal[module] = start[successor]
    init = ["(gripper-empty)", f"(arm-at s{rng.choice(slots)})", f"(= (energy) {40_000 * modules})"]
    init += [f"(in m{m} s{s}) (latched m{m})" for m, s in start.items()]
    init += [f"(free s{s})" for s in slots if s not in taken]
    wanted = [f"(in m{m} s{s}) (latched m{m})" for m, s in goal.items()]
    problem = (f"(define (problem orbital) (:domain orbital-arm)\n  (:objects {' '.join(f's{s}' for s in slots)} - slot\n"
               f"            {' '.join(f'm{m}' for m in start)} - module)\n  (:init\n    " + "\n    ".join(init)
               + ")\n  (:goal (and\n    " + "\n    ".join(wanted) + ")))\n")
    return problem, values(slots)


def values(slots):
    """Times and energies of a walk along the rail; what is not found in them does not exist."""
    lines = []
    for a in slots:
        lines.append(f"(ra_move_energy s{a}) {POWER_W * (POSE_S + STEP_S)}")
        for b in slots:
            way = SPACING_M * abs(a // 2 - b // 2)
            time = 0 if a == b else POSE_S + way / SPEED_M_S + STEP_S * -(-way // REACH_M)
            lines.append(f"(ra_move_dur s{a} s{b}) {max(time, 1):.1f}")
    return "\n".join(lines) + "\n"
