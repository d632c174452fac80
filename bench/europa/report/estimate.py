"""Means and ratios of means with 95 % confidence intervals, by Student's t."""

from __future__ import annotations

import math
import statistics
from dataclasses import dataclass
from functools import cache


@dataclass(frozen=True)
class Estimate:
    mean: float
    half: float  # of the interval
    runs: int

    @property
    def low(self) -> float:
        return self.mean - self.half

    @property
    def high(self) -> float:
        return self.mean + self.half


def share_below(t: float, freedom: int) -> float:
    """Student's distribution function for t >= 0: Simpson's rule over the density, put on a finite range by x = sqrt(f) tan(a)."""
    scale = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(math.pi)
    end, steps = math.atan(t / math.sqrt(freedom)), 400
    width = end / steps
    inner = sum((4 if i % 2 else 2) * math.cos(i * width) ** (freedom - 1) for i in range(1, steps))
    return 0.5 + scale * width / 3 * (1 + inner + math.cos(end) ** (freedom - 1))


@cache
def student(freedom: int) -> float:
    """The value that |t| stays below in 95 % of all cases."""
    if freedom < 1:
        raise ValueError("an interval needs two runs at least")
    low, high = 0.0, 20.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if share_below(middle, freedom) < 0.975 else (low, middle)
    return (low + high) / 2


def mean(values: list[float]) -> Estimate:
    """A single run has no interval: its half width is infinite."""
    if not values:
        raise ValueError("there are no runs")
    if len(values) == 1:
        return Estimate(values[0], math.inf, 1)
    half = student(len(values) - 1) * statistics.stdev(values) / math.sqrt(len(values))
    return Estimate(statistics.fmean(values), half, len(values))


def difference(first: list[float], second: list[float]) -> Estimate:
    """Of runs that met the same world: seed by seed."""
    if len(first) != len(second):
        raise ValueError("pairs need as many runs on both sides")
    return mean([a - b for a, b in zip(first, second)])


def ratio(part: list[float], whole: list[float]) -> Estimate:
    """The ratio of the means of paired runs; the interval is that of the linearised ratio (Cochran 1977, section 6.3)."""
    if len(part) != len(whole):
        raise ValueError("pairs need as many runs on both sides")
    below = statistics.fmean(whole)
    if below == 0:
        raise ValueError("the ratio to a mean of 0 is not defined")
    share = statistics.fmean(part) / below
    rest = mean([a - share * b for a, b in zip(part, whole)])
    return Estimate(share, abs(rest.half / below), rest.runs)
