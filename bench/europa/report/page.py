"""The page and pictures of the experiments, from what bench_europa says of its flights."""

from __future__ import annotations

import math

from chart import COLOURS, Line, chart
from estimate import Estimate, mean, ratio
from flights import STRATEGIES, Results, utility_at
from trends import trends

POINTS = 90


def shown(estimate: Estimate) -> str:
    return f"{estimate.mean:.2f}" + (f" ± {estimate.half:.2f}" if math.isfinite(estimate.half) else "")


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def percent(bias: float) -> str:
    return "as modelled" if bias == 0 else f"{100 * bias:+.0f} %".replace("-", "−")


def means(results: Results) -> str:
    rows = []
    for bias in results.biases():
        for key, name in STRATEGIES.items():
            flights = results.flights(bias, key)
            rows.append([percent(bias), name, shown(mean(results.utilities(bias, key))), f"{results.expected(bias, key):.2f}",
                         *(f"{sum(flight[what] for flight in flights) / len(flights):.1f}"
                           for what in ("failures", "retried", "replanned", "by_ground")),
                         f"{sum(flight['spent'] for flight in flights) / len(flights) / 1e6:.0f}"])
    return table(["energy", "strategy", "utility, 95 % interval", "equations 2–5", "failures", "retried", "planned anew",
                  "to the ground", "MJ spent"], rows)


def upper_bound(results: Results) -> str:
    rows = []
    for bias in results.biases():
        prescient, expected = results.variants[bias]["prescient"], results.variants[bias]["expected"]
        rows.append([percent(bias), f"{expected['u_avg_per_mj']:.4f}", f"{expected['tasks']:.0f}", f"{prescient['utility']:.2f}",
                     f"{prescient['spent'] * (1 + bias) / 1e6:.0f}"])
    out = table(["energy", "u_avg per MJ", "n", "utility without failures", "MJ spent"], rows)
    spare = results.budget - max(results.variants[bias]["prescient"]["spent"] * (1 + bias) for bias in results.biases())
    if spare > 0.05 * results.budget:
        out += (f"\nWithout failures the battery still holds {spare / 1e6:.0f} MJ when nothing is left to do. The equations take "
                "u_avg · b for a plan that fills b, so they expect more than there is to be had; the flight without failures is "
                "the bound that can be reached.\n")
    return out


def shares(results: Results, swept: list[tuple[str, float, Results]], forecast: float) -> str:
    """Replan against what no planner exceeds, for each variant and each swept cost."""
    cases = [(percent(bias), results, bias) for bias in results.biases()]
    cases += [(f"{name} = {value:g}", one, 0.0) for name, value, one in swept]
    rows = []
    for name, one, bias in cases:
        share = ratio(one.utilities(bias, "replan"), one.bounds(bias))
        verdict = "kept" if share.low >= forecast else "missed" if share.high < forecast else "not decided"
        rows.append([name, f"{mean(one.bounds(bias)).mean:.2f}", f"{100 * share.mean:.1f} ± {100 * share.half:.1f} %", verdict])
    return (table(["case", "bound, mean", "Replan's share", f"forecast {100 * forecast:.0f} %"], rows)
            + "\nThe bound is the flight without failures and everything that a seed's analyses can show. A prescient planner that pays "
            "for failures as Replan does brings home no more than that, so Replan's share of what it brings home is at least the one "
            "shown; a forecast that is missed here may be kept against it.\n")


def curve(results: Results, bias: float, strategy: str) -> Line:
    most = max(flight["spent"] for key in STRATEGIES for flight in results.flights(bias, key))
    energies = [most * i / POINTS for i in range(POINTS + 1)]
    here = [mean([utility_at(flight, energy) for flight in results.flights(bias, strategy)]) for energy in energies]
    return Line(STRATEGIES[strategy], COLOURS[strategy], [(e / 1e6, m.mean) for e, m in zip(energies, here)],
                half=[m.half if math.isfinite(m.half) else 0.0 for m in here])


def model(results: Results, bias: float, strategy: str, most: float) -> Line:
    points = [(point["spent"] / 1e6, point[strategy]) for point in results.variants[bias]["expected"]["curve"]]
    return Line(STRATEGIES[strategy] + ", equation", COLOURS[strategy], [point for point in points if point[0] <= most], dashed=True)


def pictures(results: Results) -> dict[str, str]:
    """Figures 10, 11a and 11b: the name of each picture and its text."""
    across, up = "energy spent [MJ]", "utility brought home, mean"
    flown = [curve(results, 0, key) for key in STRATEGIES]
    most = max(x for line in flown for x, _ in line.points)
    out = {"figure-10": chart(f"Utility against energy, {results.runs} flights each, 95 % bands", across, up,
                              flown + [model(results, 0, key, most) for key in STRATEGIES])}
    for name, bias in (("figure-11a", 0.1), ("figure-11b", -0.1)):
        if bias not in results.variants:
            continue
        base = [curve(results, 0, key) for key in STRATEGIES]
        for line in base:
            line.name, line.dashed, line.half = line.name + ", as modelled", True, []
        out[name] = chart(f"Tasks that take {percent(bias)} energy on average, 95 % bands", across, up,
                          [curve(results, bias, key) for key in STRATEGIES] + base)
    return out


def verdicts(results: Results, causes: dict[str, str]) -> str:
    rows = []
    for trend in trends(results):
        cause = causes.get(trend.name, "the cause was not looked for yet")
        rows.append([trend.expected, "holds" if trend.holds else f"fails, because {cause}", trend.seen])
    return table(["expected", "", "seen"], rows)


def sweep(rows: list[tuple[str, float, Results]]) -> str:
    """One parameter after the other, the others as they are."""
    lines = [[name, f"{value:g}", *(shown(mean(results.utilities(0, key))) for key in ("ground", "fe", "replan")),
              *(f"{results.expected(0, key):.2f}" for key in ("ground", "fe", "replan"))] for name, value, results in rows]
    return table(["parameter", "value", "Ground", "FE", "Replan", "eq. 3", "eq. 4", "eq. 5"], lines)


def page(results: Results, swept: list[tuple[str, float, Results]], causes: dict[str, str], command: str,
         forecast: float) -> str:
    faults = results.faults()
    out = ["# Four strategies on Europa\n",
           "The experiments of MEXEC, section V.A (R103–R106, R121–R123), made by one command; nothing here is written by hand but the "
           f"causes of trends that fail.\n\n```sh\n{command}\n```\n",
           f"The network is `{results.network}`, {results.budget / 1e6:.0f} MJ; {results.runs} flights of each strategy and variant, "
           f"seeds from {results.first_seed}. What the paper's text does not tell stands in `bench/europa/experiments.yaml` and "
           "`missions/europa/model.yaml`, so trends can be compared with it and figures cannot. Versions of plans that the executive "
           f"or the checker refused: {faults}.\n",
           "## Means\n", means(results), "## The model's figures, and flights in which nothing fails\n", upper_bound(results),
           "## Replan against what no planner exceeds\n", shares(results, swept, forecast),
           "## Utility against energy\n",
           "\n".join(f"![{name}](pictures/europa-{name}.svg)" for name in pictures(results)) + "\n",
           "## What the paper expects\n", verdicts(results, causes)]
    if swept:
        out += ["## Costs and discoveries swept\n", sweep(swept)]
    return "\n".join(out)
