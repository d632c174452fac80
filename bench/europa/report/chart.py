"""Line charts as SVG: axes with units, a band of confidence around a line, a legend beside the plot."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 860, 470
LEFT, RIGHT, TOP, BOTTOM = 70, 190, 44, 56
COLOURS = {"static": "#888888", "ground": "#0066cc", "fe": "#d06000", "replan": "#00905a"}


@dataclass
class Line:
    name: str
    colour: str
    points: list[tuple[float, float]]
    dashed: bool = False
    half: list[float] = field(default_factory=list)  # of the band at each point


def ticks(highest: float) -> list[float]:
    """From 0 to at least `highest`, five to ten round steps."""
    if not (highest > 0 and math.isfinite(highest)):
        raise ValueError("an axis ends above 0")
    power = 10.0 ** math.floor(math.log10(highest / 5))
    step = next(power * factor for factor in (1, 2, 2.5, 5, 10) if highest / (power * factor) <= 8)
    return [step * i for i in range(math.ceil(highest / step - 1e-9) + 1)]


def text(x: float, y: float, words: str, anchor: str = "middle", more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(words)}</text>'


def chart(title: str, across: str, up: str, lines: list[Line]) -> str:
    marks_x = ticks(max(x for line in lines for x, _ in line.points))
    marks_y = ticks(max(y for line in lines for y in [point[1] for point in line.points] + tops(line)))
    right, bottom = WIDTH - RIGHT, HEIGHT - BOTTOM

    def at(x: float, y: float) -> str:
        y = min(max(y, 0), marks_y[-1])
        return f"{LEFT + (right - LEFT) * x / marks_x[-1]:.1f},{bottom - (bottom - TOP) * y / marks_y[-1]:.1f}"

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', text(LEFT, 24, title, "start", ' font-size="15"')]
    for mark in marks_x:
        x = float(at(mark, 0).split(",")[0])
        out += [f'<line x1="{x}" y1="{TOP}" x2="{x}" y2="{bottom}" stroke="#e6e6e6"/>', text(x, bottom + 18, f"{mark:g}")]
    for mark in marks_y:
        y = float(at(0, mark).split(",")[1])
        out += [f'<line x1="{LEFT}" y1="{y}" x2="{right}" y2="{y}" stroke="#e6e6e6"/>', text(LEFT - 8, y + 4, f"{mark:g}", "end")]
    for line in lines:
        if line.half:
            upper = [at(x, y + h) for (x, y), h in zip(line.points, line.half)]
            lower = [at(x, y - h) for (x, y), h in zip(line.points, line.half)]
            out.append(f'<polygon points="{" ".join(upper + lower[::-1])}" fill="{line.colour}" fill-opacity="0.13"/>')
    for line in lines:
        dash = ' stroke-dasharray="6 4"' if line.dashed else ""
        out.append(f'<polyline points="{" ".join(at(x, y) for x, y in line.points)}" fill="none" stroke="{line.colour}" '
                   f'stroke-width="1.8"{dash}/>')
    out.append(f'<polyline points="{LEFT},{TOP} {LEFT},{bottom} {right},{bottom}" fill="none" stroke="#444"/>')
    for i, line in enumerate(lines):
        y, dash = TOP + 10 + 20 * i, ' stroke-dasharray="6 4"' if line.dashed else ""
        out += [f'<line x1="{right + 14}" y1="{y}" x2="{right + 44}" y2="{y}" stroke="{line.colour}" stroke-width="2"{dash}/>',
                text(right + 50, y + 4, line.name, "start")]
    out += [text((LEFT + right) / 2, HEIGHT - 14, across),
            text(20, (TOP + bottom) / 2, up, more=f' transform="rotate(-90 20 {(TOP + bottom) / 2})"'), "</svg>", ""]
    return "\n".join(out)


def tops(line: Line) -> list[float]:
    return [y + h for (_, y), h in zip(line.points, line.half) if math.isfinite(h)]
