"""What the paper expects of the experiments (section V.A; R122, R123), each as an assertion over results.

A trend holds where the 95 % interval of what it compares says so; that nothing is seen is not enough."""

from __future__ import annotations

from dataclasses import dataclass

from estimate import Estimate, difference, mean, ratio
from flights import Results, utility_at


@dataclass(frozen=True)
class Trend:
    name: str  # by which a cause is given
    expected: str
    holds: bool
    seen: str


def told(estimate: Estimate) -> str:
    return f"{estimate.mean:.3g} ± {estimate.half:.2g}"


def above(results: Results, name: str, bias: float, more: str, less: str) -> Trend:
    gap = difference(results.utilities(bias, more), results.utilities(bias, less))
    return Trend(name, f"{more} brings home more than {less}", gap.low > 0, f"difference {told(gap)}")


def far_below(results: Results) -> Trend:
    """Far below is less than half."""
    share = ratio(results.utilities(0, "static"), results.utilities(0, "ground"))
    return Trend("static-far-below-ground", "static brings home less than half of ground", share.high < 0.5, f"share {told(share)}")


def jumps(results: Results) -> Trend:
    flights = results.flights(0, "replan")
    rises = [float(len(flight["course"])) for flight in flights]
    largest = mean([max((b[1] - a[1] for a, b in zip([[0, 0, ""], *flight["course"]], flight["course"])), default=0.0)
                    / (flight["utility"] or 1) for flight in flights])
    return Trend("jumps", "utility jumps: its largest single rise is over 5 % of a flight's utility", largest.low > 0.05,
                 f"largest rise {told(largest)} of the utility, {told(mean(rises))} rises")


def beside_model(results: Results, strategy: str) -> list[Trend]:
    """Where the mean of the flights lies above and below the model's line, each by its interval at some energy. Beyond what an average
    flight spends there is nothing to compare: it has ended."""
    spent = mean([flight["spent"] for flight in results.flights(0, strategy)]).mean
    curve = [point for point in results.variants[0]["expected"]["curve"] if 0 < point["spent"] <= spent]
    if not curve:
        return [Trend(f"{strategy}-{side}-model", f"{strategy} lies {side} the model somewhere", False, "hardly any energy was spent")
                for side in ("above", "below")]
    gaps = [(point["spent"], mean([utility_at(flight, point["spent"]) - point[strategy]
                                   for flight in results.flights(0, strategy)])) for point in curve]
    over = max(gaps, key=lambda gap: gap[1].low)
    under = min(gaps, key=lambda gap: gap[1].high)
    return [Trend(f"{strategy}-above-model", f"{strategy} lies above the model while an open site is sampled", over[1].low > 0,
                  f"most at {over[0] / 1e6:.0f} MJ: {told(over[1])}"),
            Trend(f"{strategy}-below-model", f"{strategy} lies below the model where energy goes into a first excavation",
                  under[1].high < 0, f"most at {under[0] / 1e6:.0f} MJ: {told(under[1])}")]


def discovery(results: Results) -> Trend:
    gap = mean([results.expected(0, "replan") - utility for utility in results.utilities(0, "replan")])
    return Trend("model-overestimates-discovery", "the model expects more of replanning than it brings home", gap.low > 0,
                 f"difference {told(gap)}")


def changes(results: Results, bias: float, strategy: str) -> list[float]:
    """Seed by seed: what the bias changes, as a share of the base's mean."""
    base = results.utilities(0, strategy)
    return [(a - b) / (mean(base).mean or 1) for a, b in zip(results.utilities(bias, strategy), base)]


def dearer(results: Results) -> list[Trend]:
    ground, replan = changes(results, 0.1, "ground"), changes(results, 0.1, "replan")
    change, more = mean(ground), difference(ground, replan)
    samples = difference(results.counts(0.1, "replan", "sample"), results.counts(0, "replan", "sample"))
    return [Trend("dear-ground-unaffected", "+10 %: ground loses less than 5 %", change.low > -0.05, f"change {told(change)}"),
            Trend("dear-replan-hit", "+10 %: replan loses a larger share than ground", more.low > 0, f"difference {told(more)}"),
            Trend("dear-fewer-samples", "+10 %: replan takes fewer samples", samples.high < 0, f"difference {told(samples)}")]


def cheaper(results: Results) -> list[Trend]:
    ground, fe, replan = (changes(results, -0.1, strategy) for strategy in ("ground", "fe", "replan"))
    gain, lead, own = mean(ground), difference(ground, fe), mean(replan)
    samples = difference(results.counts(-0.1, "replan", "sample"), results.counts(0, "replan", "sample"))
    return [Trend("cheap-ground-gains", "−10 %: ground gains over 5 %", gain.low > 0.05, f"change {told(gain)}"),
            Trend("cheap-fe-gains-less", "−10 %: FE gains less than ground", lead.low > 0, f"difference {told(lead)}"),
            Trend("cheap-replan-gains", "−10 %: replan gains", own.low > 0, f"change {told(own)}"),
            Trend("cheap-more-samples", "−10 %: replan takes more samples", samples.low > 0, f"difference {told(samples)}")]


def trends(results: Results) -> list[Trend]:
    return [far_below(results), above(results, "fe-above-ground", 0, "fe", "ground"),
            above(results, "replan-above-fe", 0, "replan", "fe"), jumps(results), *beside_model(results, "ground"),
            *beside_model(results, "fe"), discovery(results), *dearer(results), *cheaper(results)]
