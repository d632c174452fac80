#!/usr/bin/env python3
"""Problems for deliveries.pddl: on so many places a tenth as many drivers and trucks, and a fifth as many parcels:

  deliveries.py PLACES [SEED]      prints one
"""

import random
import sys


def problem(places, seed):
    rng = random.Random(seed * 1_000_003 + places)
    names = [f"l{i}" for i in range(places)]
    drivers = [f"d{i}" for i in range(max(1, places // 10))]
    trucks = [f"t{i}" for i in range(max(1, places // 10))]
    parcels = [f"p{i}" for i in range(max(1, places // 5))]
    init = []

    def link(kind, cost, a, b, time):
        for one, other in ((a, b), (b, a)):
            init.append(f"({kind} {one} {other}) (= ({cost} {one} {other}) {time})")

    for i in range(1, places):  # each place is joined to one before it, so that there is a way everywhere
        link("road", "drive-time", names[i], names[rng.randrange(i)], rng.randint(5, 30))
        link("path", "walk-time", names[i], names[rng.randrange(i)], rng.randint(20, 90))
    for kind, things in (("driver-at", drivers), ("truck-at", trucks), ("parcel-at", parcels)):
        init.extend(f"({kind} {thing} {rng.choice(names)})" for thing in things)
    init.extend(f"(cab-empty {truck})" for truck in trucks)
    goal = " ".join(f"(parcel-at {parcel} {rng.choice(names)})" for parcel in parcels)
    return (f"(define (problem deliveries) (:domain growth-deliveries)\n  (:objects {' '.join(names)} - place "
            f"{' '.join(drivers)} - driver {' '.join(trucks)} - truck {' '.join(parcels)} - parcel)\n  (:init\n    "
            + "\n    ".join(init) + f")\n  (:goal (and {goal})))\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.stdout.write(problem(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) == 3 else 0))
