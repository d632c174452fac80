"""Tests of the report: intervals against known numbers, trends that can fail, pictures that a reader of XML takes, equal results equal pages."""

from __future__ import annotations

import math
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from chart import Line, chart, ticks
from estimate import difference, mean, ratio, student
from flights import Results, utility_at
from gantt import Bar, Row, gantt, lanes
from missions import left, missions
from page import Told, costs, page, pictures, slopes
from run import flown
from trends import trends

BENCH = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
BUDGET = 100.0


def flight(utility: float, samples: int) -> dict:
    course = [[20.0 + 10 * i, utility * (i + 1) / samples, f"sample_0_{i}"] for i in range(samples)]
    return {"utility": utility, "spent": 90.0, "course": course, "faults": [], "failures": 3, "retried": 1, "replanned": 1,
            "by_ground": 1, "ladder": [10.0, 9.5]}


def execution(task: str, chain: str, start: float, end: float, spent: float = 0.0, result: str = "done") -> dict:
    return {"task": task, "chain": chain, "block": 1, "start_s": start, "end_s": end, "spent": spent, "result": result}


def mission(strategy: str, result: str) -> dict:
    """Two samples of one site; the first transport goes so."""
    hour = 3600.0
    done = [execution("hotel_load", "hotel_load", 0, 90 * hour, 9.0), execution("earth_view_0", "earth_view_0", 0, 41 * hour),
            execution("excavate_site_0", "sample_0_0/first/raw", 10 * hour, 24 * hour, 14.0),
            execution("collect_sample_0_0", "sample_0_0/first/raw", 24 * hour, 30 * hour, 6.0),
            execution("transport_sample", "sample_0_0/first/raw", 30 * hour, 31 * hour, 1.0, result),
            execution("collect_sample_0_1", "sample_0_1/next/raw", 31 * hour, 37 * hour, 6.0)]
    flown = {**flight(1.0, 2), "executions": done, "end_s": 90 * hour,
             "seen": {"now_s": 30 * hour, "projection": [[30 * hour, 70.0], [90 * hour, 50.0]], "valid": {"downlink": [[31 * hour, 40 * hour]]}}}
    return {"budget": BUDGET, "variants": [{"bias": 0, strategy: [flown]}]}


def measured(sites: int, factor: float) -> dict:
    spread = {"count": 10, "p50_ms": 0.01 * factor, "p99_ms": 1.0 * factor, "max_ms": 2.0 * factor, "sum_ms": 5.0 * factor}
    return {"sites": sites, "targets": 3, "end_s": 86400.0, "cycles": spread, "searching": spread, "nothing_changed": spread, "executive": spread,
            "worst_times_1500_s": 3.0 * factor, "interval_s": 300.0, "explored": 100, "peak_mib": 27.0}


def variant(bias: float, utilities: dict[str, float], samples: int) -> dict:
    point = {"static": 1.0, "ground": 4.0, "fe": 5.0, "replan": 9.5}
    curve = [{"spent": BUDGET * i / 10, **{key: value * i / 10 for key, value in point.items()}} for i in range(11)]
    known = {"utility": 10.5, "discovered": 0.5, "recovery": 3e6, "proven": True}
    out: dict = {"bias": bias, "prescient": [known] * 4, "without_failures": flight(10, 5), "expected": {**point, "tasks": 40, "u_avg_per_mj": 0.1, "curve": curve}}
    for key, utility in utilities.items():
        out[key] = [flight(utility + 0.01 * seed, samples) for seed in range(4)]
    return out


def expected_world() -> dict:
    """All that the paper expects, in small numbers."""
    return {"network": "n", "runs": 4, "first_seed": 1, "budget": BUDGET, "variants": [
        variant(0, {"static": 1, "ground": 4.2, "fe": 6, "replan": 9}, 5),
        variant(0.1, {"static": 1, "ground": 4.15, "fe": 5, "replan": 7}, 4),
        variant(-0.1, {"static": 1, "ground": 5.5, "fe": 6.3, "replan": 9.6}, 6)]}


def reversed_world() -> dict:
    """Nothing of what the paper expects."""
    out = expected_world()
    out["variants"] = [variant(0, {"static": 9, "ground": 8, "fe": 7, "replan": 6}, 40),
                       variant(0.1, {"static": 9, "ground": 4, "fe": 7, "replan": 6}, 41),
                       variant(-0.1, {"static": 9, "ground": 7, "fe": 8, "replan": 5}, 39)]
    for one in out["variants"]:
        one["expected"]["replan"] = 1.0
    return out


class Estimates(unittest.TestCase):
    def test_quantiles_are_those_of_the_tables(self):
        for freedom, value in ((1, 12.706), (2, 4.303), (9, 2.262), (49, 2.010), (1000, 1.962)):
            self.assertAlmostEqual(student(freedom), value, places=3)

    def test_interval_of_known_numbers(self):
        here = mean([1.0, 2.0, 3.0, 4.0, 5.0])
        self.assertAlmostEqual(here.mean, 3)
        self.assertAlmostEqual(here.half, 2.7764 * math.sqrt(2.5 / 5), places=3)

    def test_what_is_common_to_pairs_widens_nothing(self):
        self.assertAlmostEqual(difference([11.0, 22.0, 33.0], [10.0, 21.0, 32.0]).half, 0)
        self.assertAlmostEqual(ratio([5.0, 10.0, 20.0], [10.0, 20.0, 40.0]).half, 0)
        self.assertAlmostEqual(ratio([5.0, 10.0, 20.0], [10.0, 20.0, 40.0]).mean, 0.5)

    def test_ratio_against_a_bound_is_that_of_the_mean(self):
        here, plain = ratio([1.0, 2.0, 3.0], [4.0, 4.0, 4.0]), mean([1.0, 2.0, 3.0])
        self.assertAlmostEqual(here.half, plain.half / 4)

    def test_one_run_has_no_interval(self):
        self.assertEqual(mean([1.0]).half, math.inf)
        self.assertRaises(ValueError, mean, [])
        self.assertRaises(ValueError, difference, [1.0], [1.0, 2.0])


class Trends(unittest.TestCase):
    def test_what_the_paper_expects_holds_where_it_is_so(self):
        for trend in trends(Results(expected_world())):
            if not trend.name.endswith("-model"):
                self.assertTrue(trend.holds, trend)

    def test_each_trend_can_fail(self):
        for trend in trends(Results(reversed_world())):
            if not trend.name.endswith("-model"):
                self.assertFalse(trend.holds, trend)

    def test_above_and_below_the_model(self):
        document = expected_world()
        for strategy in ("ground", "fe"):
            for one in document["variants"][0][strategy]:
                one["course"] = [[50.0, 100.0, "sample_0_0"]]
        held = {trend.name: trend.holds for trend in trends(Results(document))}
        for strategy in ("ground", "fe"):
            self.assertTrue(held[f"{strategy}-above-model"])
            self.assertTrue(held[f"{strategy}-below-model"])
            for one in document["variants"][0][strategy]:
                one["course"] = [[0.0, 100.0, "sample_0_0"]]
        held = {trend.name: trend.holds for trend in trends(Results(document))}
        self.assertFalse(held["ground-below-model"])
        for strategy in ("ground", "fe"):
            for one in document["variants"][0][strategy]:
                one["course"] = []
        held = {trend.name: trend.holds for trend in trends(Results(document))}
        self.assertFalse(held["ground-above-model"])
        self.assertFalse(held["fe-above-model"])


class Pages(unittest.TestCase):
    def test_equal_results_give_equal_pages(self):
        one, two = (page(Told(Results(expected_world()))) for _ in range(2))
        self.assertEqual(one, two)
        self.assertEqual(one.count("| as modelled | "), 7)
        self.assertIn("equations 2–5", one)

    def test_the_forecast_is_held_against_the_prescient_planner(self):
        document = expected_world()  # 9 to 9.03 of 10.5
        self.assertEqual(Results(document).prescient(0), [10.5] * 4)
        for forecast, verdict in ((0.8, "kept"), (0.95, "missed"), (9.015 / 10.5, "not decided")):
            text = page(Told(Results(document), forecast=forecast))
            line = next(line for line in text.splitlines() if line.startswith("| as modelled | 10.50 |"))
            self.assertTrue(line.endswith(f"| {verdict} |"), line)

    def test_a_trend_that_fails_is_published_with_its_cause(self):
        text = page(Told(Results(reversed_world()), causes={"fe-above-ground": "of this."}))
        self.assertIn("fails, because of this.", text)
        self.assertIn("the cause was not looked for yet", text)

    def test_pictures_are_xml_with_axes_and_legend(self):
        drawn = pictures(Told(Results(expected_world())))
        self.assertEqual(sorted(drawn), ["figure-10", "figure-11a", "figure-11b"])
        for picture in drawn.values():
            words = [element.text for element in ElementTree.fromstring(picture).iter("{http://www.w3.org/2000/svg}text")]
            for word in ("energy spent [MJ]", "utility brought home, mean", "Static", "Replan"):
                self.assertIn(word, words)

    def test_what_lies_between_adds_up(self):
        results = Results(expected_world())
        flights = results.flights(0, "replan")
        for known, one, *parts in zip(results.prescient(0), flights, *results.losses(0).values()):
            self.assertAlmostEqual(known - one["utility"], sum(parts))

    def test_planned_otherwise_is_compared_seed_by_seed(self):
        less = expected_world()
        for one in less["variants"][0]["replan"]:
            one["utility"] -= 1
        less["variants"] = less["variants"][:1]
        text = page(Told(Results(expected_world()), others=[("no repair", 0.0, Results(less)), ("robust", 0.0, Results(expected_world()))]))
        self.assertIn("| no repair | as modelled | 4 | 9.02 ± 0.02 | 8.02 ± 0.02 | -1.00 ± 0.00 | less |", text)
        self.assertIn("no difference shown", text)

    def test_slopes_are_those_of_the_logarithms(self):
        self.assertIn("the longest cycle 2.00", slopes([measured(3, 1.0), measured(12, 16.0)]))
        self.assertEqual(slopes([measured(3, 1.0)]), "")
        whole = {**measured(3, 1.0), "end_s": 22 * 86400.0}
        self.assertIn("kept: 3 s", costs([whole]))
        whole["cycles"] = {**whole["cycles"], "max_ms": 300.0}
        self.assertIn("missed: 450 s", costs([whole]))

    def test_bars_beside_each_other_lie_in_lanes_of_their_own(self):
        bars = [Bar(0, 2, "red"), Bar(1, 3, "red"), Bar(2, 4, "red")]
        self.assertEqual([len(lane) for lane in lanes(bars)], [2, 1])
        drawn = ElementTree.fromstring(gantt("a & b", "days", [Row("row", bars)], 0, 4))
        self.assertEqual(len([one for one in drawn.iter("{http://www.w3.org/2000/svg}rect")]), 4)

    def test_missions_are_drawn_from_flights(self):
        figures = {"mission": mission("replan", "done"), "replan none": mission("replan", "done"),
                   "ground flexible": mission("ground", "by ground"), "replan replanning": mission("replan", "failed")}
        drawn = missions(figures)
        self.assertEqual(sorted(drawn), ["figure-4", "figure-5", "figure-7", "figure-8"])
        for picture in drawn.values():
            ElementTree.fromstring(picture)
        self.assertIn("1 sites excavated, 2 samples", drawn["figure-8"])
        self.assertIn("sample_0_1/next/raw", drawn["figure-4"])
        self.assertIn("valid starts: downlink", drawn["figure-7"])

    def test_the_battery_falls_by_what_tasks_spend(self):
        flown = mission("replan", "done")["variants"][0]["replan"][0]
        course = dict(left(flown, BUDGET, 90 * 3600.0))
        self.assertAlmostEqual(course[90 * 3600.0], BUDGET - 36)
        self.assertAlmostEqual(course[24 * 3600.0], BUDGET - 14 - 9 * 24 / 90)

    def test_an_axis_reaches_what_it_shows(self):
        for highest in (0.003, 0.7, 1, 8.55, 180):
            marks = ticks(highest)
            self.assertGreaterEqual(marks[-1], highest * 0.999)
            self.assertTrue(5 <= len(marks) <= 12, marks)
        self.assertRaises(ValueError, chart, "", "", "", [Line("a", "red", [(0.0, 0.0)])])

    def test_utility_is_that_of_the_last_jump(self):
        self.assertEqual(utility_at({"course": [[5.0, 1.0, "a"], [9.0, 2.0, "b"]]}, 8.9), 1.0)

    def test_results_of_other_seeds_do_not_belong_together(self):
        other = {**expected_world(), "first_seed": 2}
        self.assertRaisesRegex(ValueError, "first_seed", Results, expected_world(), other)


class Parts(unittest.TestCase):
    def test_what_was_told_once_is_not_flown_again(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program"
            program.write_text(f"#!/bin/sh\necho once >> {folder}/flights\necho '{{\"option\": \"'$1'\"}}'\n")
            program.chmod(0o755)
            parts = Path(folder)
            for option in ("a", "b", "a"):
                self.assertEqual(flown(program, [option], parts), {"option": option})
            self.assertEqual((parts / "flights").read_text().count("once"), 2)


@unittest.skipUnless(BENCH, "needs bench_europa as its argument")
class Flights(unittest.TestCase):
    def flown(self, *options: str) -> str:
        return subprocess.run([BENCH, "--runs", "1", "--bias=0", *options], check=True, capture_output=True, text=True).stdout

    def test_a_seed_gives_the_same_flights(self):
        self.assertEqual(self.flown("--seed", "3"), self.flown("--seed", "3"))
        self.assertNotEqual(self.flown("--seed", "3"), self.flown("--seed", "4"))


if __name__ == "__main__":
    unittest.main()
