#!/usr/bin/env python3
"""Problems for workshop.pddl: two kilns, and a quarter of the pieces are to be in glazed pairs:

  workshop.py PIECES [SEED]      prints one
"""

import random
import sys


def problem(pieces, seed):
    rng = random.Random(seed * 1_000_003 + pieces)
    names = [f"p{i}" for i in range(pieces)]
    wanted = rng.sample(names, max(2, pieces // 4 // 2 * 2))
    goal = " ".join(f"(glazed {a} {b})" for a, b in zip(wanted[::2], wanted[1::2], strict=True))
    return (f"(define (problem workshop) (:domain growth-workshop)\n  (:objects k0 k1 - kiln {' '.join(names)} - piece)\n"
            f"  (:init (cold k0) (cold k1) {' '.join(f'(raw {name})' for name in names)})\n  (:goal (and {goal})))\n")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    sys.stdout.write(problem(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) == 3 else 0))
