"""Bars over time as SVG: one lane for each row, with words where they fit, lines of a value below, and stretches behind all."""

from __future__ import annotations

from dataclasses import dataclass, field

from chart import Line, text, ticks

WIDTH, LEFT, RIGHT, TOP, LANE = 1080, 190, 20, 46, 18


@dataclass
class Bar:
    start: float
    end: float
    colour: str
    words: str = ""
    edge: str = ""  # colour of its frame


@dataclass
class Row:
    name: str
    bars: list[Bar]
    lines: list[Line] = field(default_factory=list)  # of a value, instead of bars
    height: int = LANE


def stacked(name: str, bars: list[Bar]) -> Row:
    """A row with as many lanes as bars lie beside each other."""
    row = Row(name, sorted(bars, key=lambda bar: (bar.start, bar.end)))
    row.height = LANE * max(1, len(lanes(row.bars)))
    return row


def lanes(bars: list[Bar]) -> list[list[Bar]]:
    out: list[list[Bar]] = []
    for bar in bars:
        free = next((lane for lane in out if lane[-1].end <= bar.start), None)
        if free is None:
            out.append([bar])
        else:
            free.append(bar)
    return out


def gantt(title: str, across: str, rows: list[Row], first: float, last: float, legend: list[tuple[str, str]] = (),
          behind: list[tuple[float, float]] = ()) -> str:
    """Time runs from `first` to `last`, told from 0 on in the unit that `across` names; `behind` are stretches in grey."""
    bottom = TOP + sum(row.height + 8 for row in rows)
    height, right = bottom + 46 + (22 if legend else 0), WIDTH - RIGHT

    def x(time: float) -> float:
        return LEFT + (right - LEFT) * (min(max(time, first), last) - first) / (last - first)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" font-family="sans-serif" font-size="11">',
           f'<rect width="{WIDTH}" height="{height}" fill="white"/>', text(LEFT, 24, title, "start", ' font-size="15"')]
    for start, end in behind:
        out.append(f'<rect x="{x(start):.1f}" y="{TOP}" width="{x(end) - x(start):.1f}" height="{bottom - TOP}" fill="#eef4fb"/>')
    for mark in ticks(last):
        if first <= mark <= last:
            out += [f'<line x1="{x(mark):.1f}" y1="{TOP}" x2="{x(mark):.1f}" y2="{bottom}" stroke="#dddddd"/>',
                    text(x(mark), bottom + 16, f"{mark:g}")]
    top = TOP
    for row in rows:
        out.append(text(LEFT - 8, top + 13, row.name, "end"))
        for number, lane in enumerate(lanes(row.bars)):
            y = top + LANE * number
            for bar in lane:
                if bar.end < first or bar.start > last:
                    continue
                wide = max(x(bar.end) - x(bar.start), 1.0)
                frame = f' stroke="{bar.edge}" stroke-width="1.5"' if bar.edge else ""
                out.append(f'<rect x="{x(bar.start):.1f}" y="{y + 1}" width="{wide:.1f}" height="{LANE - 3}" fill="{bar.colour}"{frame}/>')
                if bar.words and wide > 6.2 * len(bar.words):
                    out.append(text(x(bar.start) + wide / 2, y + 13, bar.words, more=' fill="white"'))
        for line in row.lines:
            out += value_line(line, row, top, x)
        top += row.height + 8
    out += [f'<polyline points="{LEFT},{TOP} {LEFT},{bottom} {right},{bottom}" fill="none" stroke="#444"/>',
            text((LEFT + right) / 2, bottom + 34, across)]
    place = LEFT
    for name, colour in legend:
        out += [f'<rect x="{place}" y="{bottom + 44}" width="14" height="12" fill="{colour}"/>', text(place + 20, bottom + 54, name, "start")]
        place += 40 + 7 * len(name)
    return "\n".join([*out, "</svg>", ""])


def value_line(line: Line, row: Row, top: float, x) -> list[str]:
    highest = ticks(max(value for one in row.lines for _, value in one.points))[-1]
    points = " ".join(f"{x(time):.1f},{top + row.height - row.height * value / highest:.1f}" for time, value in line.points)
    dash = ' stroke-dasharray="5 4"' if line.dashed else ""
    return [f'<polyline points="{points}" fill="none" stroke="{line.colour}" stroke-width="1.6"{dash}/>',
            text(LEFT - 8, top + row.height, "0", "end"), text(LEFT - 8, top + 26, f"{highest:g}", "end")]
