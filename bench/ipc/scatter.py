"""A scatter plot of one planner against others on logarithmic axes, as SVG. What is not solved lies in the outer strip."""

import math

SIZE, MARGIN, STRIP = 400, 70, 34
COLOURS = ["#0a6", "#06c", "#d60", "#a3c", "#888"]


def seconds(power):
    return f"{10 ** (power + 3)} ms" if power < 0 else f"{10 ** power} s"


def megabytes(power):
    return f"{10 ** power} MB" if power < 3 else f"{10 ** (power - 3)} GB"


class Axis:
    """Values to positions along a side of the square, whole powers of ten at its ends."""

    def __init__(self, values):
        self.low = math.floor(math.log10(min(values)))
        self.high = math.ceil(math.log10(max(values)))

    def of(self, value):
        return SIZE if self.high == self.low else SIZE * (math.log10(value) - self.low) / (self.high - self.low)

    def powers(self):
        return range(self.low, self.high + 1)


def text(x, y, words, anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{words}</text>'


def plot(runs, ours, peers, value, tick, title):
    """`value` takes a record to what is drawn, always above 0; `tick` names a power of ten."""
    solved = [records[planner] for records in runs.values() for planner in (ours, *peers) if records[planner]["valid"]]
    axis = Axis([value(record) for record in solved])
    bottom = MARGIN + STRIP + SIZE
    width, height = SIZE + STRIP + 2 * MARGIN, SIZE + STRIP + 2 * MARGIN

    def place(record):
        return axis.of(value(record)) if record["valid"] else SIZE + STRIP / 2

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="12">',
             f'<rect width="{width}" height="{height}" fill="white"/>',
             f'<rect x="{MARGIN + SIZE}" y="{MARGIN}" width="{STRIP}" height="{SIZE + STRIP}" fill="#f0f0f0"/>',
             f'<rect x="{MARGIN}" y="{MARGIN}" width="{SIZE + STRIP}" height="{STRIP}" fill="#f0f0f0"/>',
             f'<rect x="{MARGIN}" y="{MARGIN + STRIP}" width="{SIZE}" height="{SIZE}" fill="none" stroke="#888"/>']
    for power in axis.powers():
        at = axis.of(10.0 ** power)
        parts += [text(MARGIN + at, bottom + 18, tick(power)), text(MARGIN - 8, bottom - at + 4, tick(power), "end")]
    for factor, dash in ((1, ""), (10, ' stroke-dasharray="4 4"')):  # alike; the peer ten times worse
        shift = axis.of(10.0 ** axis.low * factor)
        parts.append(f'<line x1="{MARGIN + shift:.1f}" y1="{bottom}" x2="{MARGIN + SIZE}" '
                     f'y2="{bottom - SIZE + shift:.1f}" stroke="#aaa"{dash}/>')
    for colour, peer in zip(COLOURS, peers):
        for (domain, number), records in runs.items():
            if records[ours]["valid"] or records[peer]["valid"]:
                parts.append(f'<circle cx="{MARGIN + place(records[peer]):.1f}" cy="{bottom - place(records[ours]):.1f}" r="4" '
                             f'fill="{colour}" fill-opacity="0.6"><title>{domain} {number}: {peer}</title></circle>')
    for i, (colour, peer) in enumerate(zip(COLOURS, peers)):
        at = MARGIN + 14 + 90 * i
        parts += [f'<circle cx="{at}" cy="{MARGIN - 14}" r="5" fill="{colour}"/>', text(at + 10, MARGIN - 10, peer, "start")]
    strip = MARGIN + SIZE + STRIP / 2
    parts += [text(MARGIN, 24, title, "start", ' font-size="15"'),
              text(strip, bottom + 34, "none", more=' fill="#666"'),
              text(MARGIN - 8, MARGIN + STRIP / 2 + 4, "none", "end", ' fill="#666"'),
              text(MARGIN + SIZE / 2, bottom + 44, "peer"),
              text(18, bottom - SIZE / 2, ours, more=f' transform="rotate(-90 18 {bottom - SIZE / 2})"')]
    return "\n".join(parts + ["</svg>", ""])
