#!/usr/bin/env python3
"""Writes elevation.pgm and rocks.pgm of the yard: 30 x 30 m at 0.25 m, by the shapes below. All numbers in metres.
With --check it writes nothing, and ends with 1 where a file is another one."""
import math
import pathlib
import sys

CELLS, SIDE = 120, 0.25
HIGHEST = 2.0  # elevation of the largest pixel value
TALLEST = 1.0  # rock of a black pixel

# Rocks as (x, y, radius, height). The first two leave the middle of the straight way open; the big one stands behind it.
ROCKS = [
    (11.0, 17.2, 0.6, 0.7), (11.0, 12.8, 0.6, 0.7),
    (16.5, 15.2, 1.0, 1.0),
    (18.0, 20.5, 0.5, 0.6), (19.5, 9.5, 0.5, 0.6), (6.5, 22.0, 0.4, 0.5), (7.5, 7.0, 0.4, 0.4), (23.5, 17.5, 0.4, 0.4),
]


def ramp(value, foot, top):
    return min(max((value - foot) / (top - foot), 0.0), 1.0)


def elevation(x, y):
    north = 1.2 * ramp(y, 22.0, 28.0)  # 11 degrees, for both rovers
    corner = 1.6 * ramp(x - y, 17.0, 22.0)  # 24 degrees, for the scout alone
    return max(north, corner)


def rock_height(x, y):
    return max((height for cx, cy, radius, height in ROCKS if math.hypot(x - cx, y - cy) <= radius), default=0.0)


def image(largest, value):
    lines = [f"P2\n{CELLS} {CELLS}\n{largest}"]
    for row in reversed(range(CELLS)):  # north at the top
        lines.append(" ".join(str(value((column + 0.5) * SIDE, (row + 0.5) * SIDE)) for column in range(CELLS)))
    return "\n".join(lines) + "\n"


def main():
    images = {
        "elevation.pgm": image(65535, lambda x, y: round(elevation(x, y) / HIGHEST * 65535)),
        "rocks.pgm": image(255, lambda x, y: 255 - round(rock_height(x, y) / TALLEST * 255)),
    }
    others = []
    for name, text in images.items():
        file = pathlib.Path(__file__).parent / name
        if "--check" not in sys.argv:
            file.write_text(text)
        elif file.read_text() != text:
            others.append(name)
    if others:
        sys.exit(f"not what make_yard.py writes: {', '.join(others)}; run it without --check")


if __name__ == "__main__":
    main()
