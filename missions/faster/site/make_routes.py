#!/usr/bin/env python3
"""Writes yard.yaml: from each stand the shortest ways to the target over the graph of way-points.
With --check it writes nothing, and ends with 1 where the file is another one."""
import math
import pathlib
import re
import sys

FOLDER = pathlib.Path(__file__).resolve().parent.parent
FILE = FOLDER / "yard.yaml"
TARGET = "w9"
SHORTEST = 2
# Between the junctions w0, w3, w5, n5 and w9; names of routes are made of these.
STRETCHES = {
    "gate": "w0 w1 w2 w3",
    "south": "w0 v1 v2 v3 v4 v5 v6 w5",
    "north": "w0 u1 u2 u3 u4 u5 u6 n5",
    "right": "w3 w4 w5",
    "left": "w3 n4 n5",
    "right_on": "w5 w6 w7 w8 w9",
    "left_on": "n5 n6 n7 n8 w9",
    "edge": "w0 f1 f2 f3 f4 f5 f6 f7 f8 f9 f10 f11 w9",
}
HEAD = """\
# The global map of the yard as the ground sends it up: routes from the start to a target 15 m away in a straight line, over a graph of
# way-points at most 4 m apart (R140; footnote 4 of the paper). A way-point is a stand of the scout; the primary stands 1.25 m behind it on
# the way that the scout has driven, so it starts at (5, 15), and its target is (20, 15). Where the points lie stands in mission.yaml. Rocks are
# known, the sand trap is not; between the two rocks of the gate there is no stand, since neither rover can pass the other there.
#
#              u1 … u6 north of the gate        n4 … n8 north of the big rock
#   w0 w1 w2 | gate | w3                        big rock                          w9
#              v1 … v6 south of the gate        w4 … w8 south of the big rock
#   f1 … f11 along the south edge
#
# A route begins on one stretch between two junctions, in one direction, and passes no junction twice: the two shortest, and the shortest along
# the edge. So wherever a traverse ends early, there are ways on and ways back. Of routes that are open the first in the list is taken: the
# shortest. Written by site/make_routes.py.
format: 1
"""


def legs_of(way):
    return list(zip(way, way[1:]))


def ways_on(stretches, at, seen):
    """From a junction to the target: names of stretches, and the stands."""
    if at == TARGET:
        return [([], [at])]
    out = []
    for name, way in stretches:
        if way[0] == at and way[-1] not in seen:
            out += [([name, *names], way[:-1] + more) for names, more in ways_on(stretches, way[-1], seen | {way[-1]})]
    return out


def bare(name):
    return name.removeprefix("back_")


def text():
    places = re.findall(r"name: (\w+), type: place, properties: \{x: ([\d.]+), y: ([\d.]+)\}", (FOLDER / "mission.yaml").read_text())
    spots = {name: (float(x), float(y)) for name, x, y in places}
    there = [(name, way.split()) for name, way in STRETCHES.items()]
    stretches = there + [(f"back_{name}", way[::-1]) for name, way in there]
    metres = {leg: math.dist(spots[leg[0]], spots[leg[1]]) for _, way in stretches for leg in legs_of(way)}

    routes = []  # metres, name, stands, how many of them a traverse may begin at
    for name, way in stretches:
        some = []
        for names, more in ways_on(stretches, way[-1], {way[-1]}):
            if bare(name) in map(bare, names):
                continue
            # Who stands between two junctions may come back to the one behind on another way; from the target nobody sets out.
            begin = way[1:-1] if way[0] in more else way[:-1]
            length = sum(metres[leg] for leg in legs_of(begin + more))
            if begin:
                some.append((length, "_".join([name, *names]), begin + more, len(begin)))
        some.sort()
        along_edge = [one for one in some if "edge" in one[1]]
        routes += some[:SHORTEST] + [one for one in along_edge[:1] if one not in some[:SHORTEST]]
    routes.sort()

    def rows(lines, width=9):
        return "[\n" + "".join(f"{' ' * (width - 1)}{line},\n" for line in lines) + " " * (width - 3) + "]\n"

    out = HEAD + f"objects:\n  place: [{', '.join(spots)}]\n  route:\n    " + rows([name for _, name, _, _ in routes], 7)
    out += "relations:\n  leg:\n    rows:\n      "
    out += rows(", ".join(f"[{name}, {a}, {b}]" for a, b in legs_of(way)) for _, name, way, _ in routes)
    out += "  # A traverse may begin on the first stretch of a route.\n  starts_at:\n    rows:\n      "
    out += rows(", ".join(f"[{name}, {one}]" for one in way[:count]) for _, name, way, count in routes)
    out += "  passes:\n    rows:\n      "
    out += rows(", ".join(f"[{name}, {one}]" for one in way) for _, name, way, _ in routes)
    out += "numbers:\n  metres:\n    symmetric: true\n    rows:\n      "
    return out + rows(", ".join(f"[{a}, {b}, {metres[a, b]:.2f}]" for a, b in legs_of(way)) for _, way in there)


def main():
    if "--check" not in sys.argv:
        FILE.write_text(text())
    elif FILE.read_text() != text():
        sys.exit("yard.yaml is not what make_routes.py writes; run it without --check")


if __name__ == "__main__":
    main()
