"""A scatter plot of two planners on logarithmic axes, as SVG. Unsolved instances lie on the outer edge."""

import math

SIZE, MARGIN = 480, 60


def plot(runs, ours, peer, field, unit):
    values = [max(records[planner][field], 0.01) for records in runs.values() for planner in (ours, peer)]
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))

    def place(record):
        if not record["valid"]:
            return SIZE + 15
        return SIZE * (math.log10(max(record[field], 0.01)) - low) / (high - low)

    def x(position):
        return MARGIN + position

    def y(position):
        return MARGIN + SIZE - position

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE + 2 * MARGIN} {SIZE + 2 * MARGIN}" '
             'font-family="sans-serif" font-size="12">',
             f'<rect x="{MARGIN}" y="{MARGIN}" width="{SIZE}" height="{SIZE}" fill="none" stroke="#888"/>',
             f'<line x1="{x(0)}" y1="{y(0)}" x2="{x(SIZE)}" y2="{y(SIZE)}" stroke="#bbb"/>']
    for power in range(low, high + 1):
        at = SIZE * (power - low) / (high - low)
        parts.append(f'<text x="{x(at)}" y="{y(-18)}" text-anchor="middle">1e{power}</text>')
        parts.append(f'<text x="{x(-8)}" y="{y(at) + 4}" text-anchor="end">1e{power}</text>')
    for (domain, number), records in runs.items():
        if not records[ours]["valid"] and not records[peer]["valid"]:
            continue
        parts.append(f'<circle cx="{x(place(records[peer])):.1f}" cy="{y(place(records[ours])):.1f}" r="4" '
                     f'fill="#06c" fill-opacity="0.6"><title>{domain} {number}</title></circle>')
    middle = MARGIN + SIZE / 2
    parts.append(f'<text x="{middle}" y="{y(-42)}" text-anchor="middle">{peer}, {unit}</text>')
    parts.append(f'<text x="15" y="{middle}" text-anchor="middle" transform="rotate(-90 15 {middle})">{ours}, {unit}</text>')
    return "\n".join(parts + ["</svg>", ""])
