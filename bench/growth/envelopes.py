"""Problems for envelopes.pddl: furnaces, each with jobs of its own that just fit into one burning, one after the other."""

import random


def problem(furnaces, jobs, seed):
    """`jobs`: of each furnace."""
    rng = random.Random(seed * 1_000_003 + furnaces * 1009 + jobs)
    init, goal, names = [], [], []
    for f in range(furnaces):
        times = [rng.randint(3, 12) for _ in range(jobs)]
        init.append(f"(cold f{f}) (hands-free f{f}) (= (burns f{f}) {sum(times) + 1})")
        for j, time in enumerate(times):
            name = f"j{f}-{j}"
            names.append(name)
            init.append(f"(raw {name}) (belongs {name} f{f}) (= (takes {name}) {time})")
            goal.append(f"(done {name})")
    return (f"(define (problem envelopes) (:domain growth-envelopes)\n  (:objects "
            f"{' '.join(f'f{f}' for f in range(furnaces))} - furnace {' '.join(names)} - job)\n  (:init\n    "
            + "\n    ".join(init) + f")\n  (:goal (and {' '.join(goal)})))\n")
