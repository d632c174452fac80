"""The page and pictures of the experiments, from what bench_europa says of its flights."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from chart import COLOURS, Line, chart
from estimate import Estimate, difference, mean, ratio
from flights import STRATEGIES, Results, utility_at
from missions import missions
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


@dataclass
class Told:
    """All that the page is made of."""
    results: Results
    swept: list[tuple[str, float, Results]] = field(default_factory=list)
    others: list[tuple[str, float, Results]] = field(default_factory=list)  # planned otherwise, at a bias
    cycles: list[dict] = field(default_factory=list)
    figures: dict[str, dict] = field(default_factory=dict)
    causes: dict[str, str] = field(default_factory=dict)
    command: str = ""
    forecast: float = 0.95


def upper_bound(results: Results) -> str:
    rows = []
    for bias in results.biases():
        variant, known = results.variants[bias], results.variants[bias]["prescient"]
        free, expected = variant["without_failures"], variant["expected"]
        rows.append([percent(bias), shown(mean(results.prescient(bias))), shown(mean([one["recovery"] / 1e6 for one in known])),
                     f"{sum(one['proven'] for one in known)} of {len(known)}", f"{expected['u_avg_per_mj']:.4f}",
                     f"{expected['tasks']:.0f}", f"{free['utility']:.2f}", f"{free['spent'] * (1 + bias) / 1e6:.0f}"])
    out = table(["energy", "prescient utility", "its MJ for failures", "proven best", "u_avg per MJ", "n", "utility without failures",
                 "MJ of that"], rows)
    spare = results.budget - max(results.variants[bias]["without_failures"]["spent"] * (1 + bias) for bias in results.biases())
    out += ("\nThe prescient planner knows every energy and every failure of a seed's flight beforehand, and pays for each failure what the "
            "flight pays: nothing for a retry but the attempt, c_r, or c_g. It chooses among all sets of chains; it keeps the budget and "
            "the time of each instrument, and places nothing in time, so no flight in the same world exceeds it. u_avg is its utility "
            "without discoveries over the energy of what succeeds; n counts the tasks that can fail and that b pays for.\n")
    if spare > 0.05 * results.budget:
        out += (f"\nWithout failures the battery still holds {spare / 1e6:.0f} MJ when nothing is left to do. The equations take "
                "u_avg · b for a plan that fills b, so they expect more than there is to be had.\n")
    return out


def shares(results: Results, swept: list[tuple[str, float, Results]], forecast: float) -> str:
    """Replan against the prescient planner, for each variant and each swept cost."""
    cases = [(percent(bias), results, bias) for bias in results.biases()]
    cases += [(f"{name} = {value:g}", one, 0.0) for name, value, one in swept]
    rows = []
    for name, one, bias in cases:
        share = ratio(one.utilities(bias, "replan"), one.prescient(bias))
        verdict = "kept" if share.low >= forecast else "missed" if share.high < forecast else "not decided"
        rows.append([name, f"{mean(one.prescient(bias)).mean:.2f}", f"{100 * share.mean:.1f} ± {100 * share.half:.1f} %", verdict])
    return table(["case", "prescient, mean", "Replan's share", f"forecast {100 * forecast:.0f} %"], rows)


def rest(results: Results) -> str:
    biases = results.biases()
    rows = [[part, *(shown(mean(results.losses(bias)[part])) for bias in biases)] for part in results.losses(biases[0])]
    return ("What the rest is made of, in utility: what the same prescient planner would bring home less without the energy that Replan put "
            "into chains which it did not complete, then without the energy that it had left at the end; and what remains.\n\n"
            + table(["lost by", *(percent(bias) for bias in biases)], rows))


def otherwise(told: Told) -> str:
    rows = []
    for name, bias, one in told.others:
        utilities = one.utilities(bias, "replan")
        base = told.results.utilities(bias, "replan")[:len(utilities)]
        gap = difference(utilities, base)
        verdict = "less" if gap.high < 0 else "more" if gap.low > 0 else "no difference shown"
        rows.append([name, percent(bias), str(len(utilities)), shown(mean(base)), shown(mean(utilities)), shown(gap), verdict])
    return table(["Replan with", "energy", "flights", "as it is", "so", "difference", ""], rows)


def costs(cycles: list[dict]) -> str:
    """What planning takes of the processor."""
    rows = []
    for one in cycles:
        every, search, quiet, events = (one[key] for key in ("cycles", "searching", "nothing_changed", "executive"))
        rows.append([f"{one['sites']} × {one['targets']}", f"{one['end_s'] / 86400:.0f}", f"{every['count']}", f"{search['count']}",
                     *(f"{every[key]:.2g}" for key in ("p50_ms", "p99_ms", "max_ms")), f"{search['p99_ms']:.3g}",
                     f"{one['worst_times_1500_s']:.0f}", f"{quiet['p50_ms']:.2g}", f"{events['p50_ms']:.2g}", f"{events['max_ms']:.2g}",
                     f"{events['count']}", f"{one['explored']}", f"{one['peak_mib']:.0f}"])
    mission = [one for one in cycles if one["sites"] == 3 and one["end_s"] > 10 * 86400]
    out = table(["sites × targets", "days", "cycles", "that search", "p50 ms", "p99 ms", "max ms", "p99 of searches", "max × 1,500 s",
                 "nothing changed, p50", "executive's event, p50", "max", "events", "entries", "MiB at most"], rows)
    out += slopes([one for one in cycles if one["end_s"] <= 10 * 86400])
    if mission:
        worst = max(one["cycles"]["max_ms"] for one in mission)
        late = max(one["cycles"]["p99_ms"] for one in mission)
        most = max(one["peak_mib"] for one in mission)
        beside = (sum(one["cycles"]["sum_ms"] for one in mission) / sum(one["executive"]["sum_ms"] for one in mission))
        out += (f"\nAims on RSM-1 (3 × 3, whole flights): 99 % of cycles under 100 ms ({'kept' if late < 100 else 'missed'}: {late:.2g} ms); the "
                f"worst × 1,500 under the interval of {mission[0]['interval_s']:.0f} s "
                f"({'kept' if 1.5 * worst < mission[0]['interval_s'] else 'missed'}: {1.5 * worst:.0f} s); memory under 64 MiB "
                f"({'kept' if most < 64 else 'missed'}: {most:.0f} MiB with executive, world and the reader of the network). Planning takes "
                f"{beside:.0f} times the processor time of flexible execution, which acts at each event and searches nothing.\n")
    return out


def slopes(sizes: list[dict]) -> str:
    """How the time of searches grows with sites × targets: the slope of its logarithm between the smallest and the largest mission."""
    sizes = sorted(sizes, key=lambda one: one["sites"] * one["targets"])
    if len(sizes) < 2 or sizes[0]["sites"] * sizes[0]["targets"] == sizes[-1]["sites"] * sizes[-1]["targets"]:
        return ""
    grown = math.log(sizes[-1]["sites"] * sizes[-1]["targets"] / (sizes[0]["sites"] * sizes[0]["targets"]))
    told = {what: math.log(sizes[-1][key][part] / sizes[0][key][part]) / grown
            for what, key, part in (("the longest cycle", "cycles", "max_ms"), ("a cycle in which nothing changed", "nothing_changed", "p50_ms"),
                                    ("an event of the executive", "executive", "p50_ms"))}
    memory = math.log(sizes[-1]["peak_mib"] / sizes[0]["peak_mib"]) / grown
    return ("\nFrom the smallest to the largest, as a power of sites × targets: " + ", ".join(f"{what} {slope:.2f}" for what, slope in told.items())
            + f", memory {memory:.2f}.\n")


def curve(results: Results, bias: float, strategy: str) -> Line:
    most = max(flight["spent"] for key in STRATEGIES for flight in results.flights(bias, key))
    energies = [most * i / POINTS for i in range(POINTS + 1)]
    here = [mean([utility_at(flight, energy) for flight in results.flights(bias, strategy)]) for energy in energies]
    return Line(STRATEGIES[strategy], COLOURS[strategy], [(e / 1e6, m.mean) for e, m in zip(energies, here)],
                half=[m.half if math.isfinite(m.half) else 0.0 for m in here])


def model(results: Results, bias: float, strategy: str, most: float) -> Line:
    points = [(point["spent"] / 1e6, point[strategy]) for point in results.variants[bias]["expected"]["curve"]]
    return Line(STRATEGIES[strategy] + ", equation", COLOURS[strategy], [point for point in points if point[0] <= most], dashed=True)


def curves(results: Results) -> dict[str, str]:
    """Figures 10, 11a and 11b."""
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


def pictures(told: Told) -> dict[str, str]:
    """The name of each picture and its text."""
    return {**missions(told.figures), **curves(told.results)}


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


def page(told: Told) -> str:
    results = told.results
    names = list(pictures(told))

    def shown_pictures(*prefixes: str) -> str:
        return "\n".join(f"![{name}](pictures/europa-{name}.svg)" for name in names if name.startswith(prefixes)) + "\n"

    out = ["# Four strategies on Europa\n",
           "The experiments of MEXEC, section V.A (R100, R103–R106, R121–R123), made by one command; nothing here is written by hand but the "
           f"causes of trends that fail.\n\n```sh\n{told.command}\n```\n",
           f"The network is `{results.network}`, {results.budget / 1e6:.0f} MJ; {results.runs} flights of each strategy and variant, "
           f"seeds from {results.first_seed}. What the paper's text does not tell stands in `bench/europa/experiments.yaml` and "
           "`missions/europa/model.yaml`, so trends can be compared with it and figures cannot. Versions of plans that the executive "
           f"or the checker refused: {results.faults()}.\n",
           "## Means\n", means(results), "## What a planner brings home that knows everything beforehand\n", upper_bound(results),
           "## Replan against it\n", shares(results, told.swept, told.forecast), rest(results),
           "## Utility against energy\n", shown_pictures("figure-10", "figure-11"),
           "## What the paper expects\n", verdicts(results, told.causes)]
    if told.others:
        out += ["## Planned otherwise\n", otherwise(told)]
    if told.swept:
        out += ["## Costs and discoveries swept\n", sweep(told.swept)]
    if told.cycles:
        out += ["## What planning costs\n", costs(told.cycles)]
    if told.figures:
        out += ["## Figures 4, 5, 7 and 8 of the paper, from flights\n",
                shown_pictures("figure-4", "figure-5", "figure-7", "figure-8")]
    return "\n".join(out)
