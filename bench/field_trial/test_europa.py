#!/usr/bin/env python3
"""Draw, rules, losses and the flight that knows of the Europa lander's field trial, on records made by hand; and that their constants are the mission's."""

import json
import re
import sqlite3
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import europa_flights as flights
from europa_kills import draw_kills, products_lost, samples_missing
from europa_knowing import DURATIONS, POWERS_W, knowing, too_hard
from europa_scenarios import RATE_BYTE_S, SHOCKS_J, UNCERTAINTIES, Scenario, draw
from europa_schedules import schedules_of

MISSION = Path(__file__).resolve().parents[2] / "missions/europa"
S = 1_000_000


class Folder:
    """A run folder by hand."""

    def __init__(self, goal=("mission", 3, "observed")):
        self.path = Path(tempfile.mkdtemp())
        self.trace, self.effects, self.products, self.events, self.goal = [], [], [], [], goal
        for zone, kelvin in (("arm", 120), ("vault", 250), ("antenna", 130)):
            self.observe(0, f"lander.heat.{zone}", kelvin)

    def observe(self, at, timeline, value):
        self.trace.append((at, f"{at * S} observation {timeline} {value} sampled {at * S}"))

    def deed(self, at, kind, what, activity="", attempt=1):
        self.effects.append({"time_us": at * S, "kind": kind, "object": what, "activity": activity or f"{kind}_{what}#{at}", "attempt": attempt})

    def product(self, name, tier, fate, kind=""):
        self.products.append({"id": name, "kind": kind or name, "tier": tier, "fate": fate, "source": "", "bytes": 1})

    def fail(self, at, activity, code):
        self.trace.append((at, f"{at * S} ack {activity} 1 stage=3 sim_svc {code} words"))

    def flight(self, result="achieved", scenario=None):
        for name, some in (("effects", self.effects), ("products", self.products), ("events", self.events)):
            (self.path / f"{name}.jsonl").write_text("".join(json.dumps(one) + "\n" for one in some))
        with sqlite3.connect(self.path / "journal.sqlite") as database:
            database.execute("CREATE TABLE record(seq INTEGER PRIMARY KEY, time_us INTEGER, kind TEXT, text TEXT)")
            database.execute("CREATE TABLE goal(id TEXT, state INTEGER, reason TEXT)")
            database.executemany("INSERT INTO record(time_us, kind, text) VALUES (?, 'trace', ?)", [(at * S, text) for at, text in self.trace])
            database.execute("INSERT INTO goal VALUES (?, ?, ?)", self.goal)
        out = flights.Flight(1, self.path, result)
        flights.read(out, scenario or Scenario(1))
        out.losses = flights.losses_of(out)
        return out


    def flight_again(self, scenario=None):
        (self.path / "journal.sqlite").unlink()
        return self.flight(scenario=scenario)


class Draw(unittest.TestCase):
    def test_a_seed_is_one_scenario(self):
        self.assertEqual(draw(7).yaml(), draw(7).yaml())
        self.assertNotEqual(draw(7).yaml(), draw(8).yaml())

    def test_each_uncertainty_is_drawn_about_as_often_as_it_says(self):
        some = [draw(seed) for seed in range(1000)]
        for name, (probability, _) in UNCERTAINTIES.items():
            self.assertAlmostEqual(sum(name in one.drawn for one in some) / 1000, probability, delta=0.05, msg=name)
        self.assertEqual(len(UNCERTAINTIES), 16)

    def test_kills_are_of_one_to_three_services(self):
        for seed in range(100):
            self.assertIn(len(draw_kills(seed).at), (1, 2, 3))
        self.assertEqual(draw_kills(5).text(), draw_kills(5).text())


class Rules(unittest.TestCase):
    def assert_broken(self, folder, words, result="achieved"):
        self.assertRegex("\n".join(folder.flight(result).faults), words)

    def test_a_quiet_flight_breaks_none(self):
        self.assertEqual(Folder().flight().faults, [])

    def test_an_end_is_defined(self):
        self.assert_broken(Folder(), "no defined end", "failed")
        self.assert_broken(Folder(("mission", 2, "planned")), "goal mission ends in state 2")
        self.assert_broken(Folder(("mission", 3, "")), "goal mission")

    def test_zones_stay_in_their_range(self):
        for kelvin in (100, 410):
            folder = Folder()
            folder.observe(5, "lander.heat.antenna", kelvin)
            self.assert_broken(folder, "zone antenna is out of its range")

    def test_no_sample_after_a_negative_one(self):
        folder = Folder()
        folder.observe(10, "lander.signature.1_0", "negative")
        folder.deed(11, "collect", "1 1")
        self.assert_broken(folder, "although one of its site was known as negative")

    def test_a_site_is_finished_first(self):
        folder = Folder()
        folder.deed(5, "collect", "1 0")
        folder.deed(8, "analyze", "1_0")
        folder.observe(10, "lander.signature.1_0", "positive")
        folder.deed(11, "collect", "0 2")
        self.assert_broken(folder, "although site 1 was open")
        folder.fail(10, "collect_sample_1_1#9.1", "broken")
        (folder.path / "journal.sqlite").unlink()
        self.assertEqual(folder.flight().faults, [], "its rest could not be had")

    def test_a_site_whose_trench_has_collapsed_is_not_open(self):
        folder = Folder()
        folder.observe(4, "lander.site.1", "excavated")
        folder.deed(5, "collect", "1 0")
        folder.deed(8, "analyze", "1_0")
        folder.observe(10, "lander.signature.1_0", "positive")
        folder.deed(12, "collect", "0 2")
        self.assert_broken(folder, "although site 1 was open")
        folder.observe(11, "lander.site.1", "untouched")
        (folder.path / "journal.sqlite").unlink()
        self.assertEqual(folder.flight().faults, [])

    def test_three_samples_at_most(self):
        folder = Folder()
        for target in range(4):
            folder.deed(target, "analyze", f"1_{target}")
        self.assert_broken(folder, "4 samples of site 1")

    def test_an_analysis_that_is_made_again_is_of_the_same_sample(self):
        folder = Folder()
        for target in range(3):
            folder.deed(target, "analyze", f"1_{target}")
        folder.deed(5, "analyze", "1_2", attempt=2)
        self.assertEqual(folder.flight().faults, [])

    def test_sessions_have_a_limit(self):
        folder = Folder()
        folder.observe(10, "lander.radio", "sending")
        folder.observe(10 + 10000, "lander.radio", "idle")
        self.assert_broken(folder, "a session of 1.20 MJ")
        (folder.path / "journal.sqlite").unlink()
        slower = folder.flight(scenario=Scenario(1, rates=[(0, 3000)]))
        self.assertEqual((slower.faults, len(slower.long_sessions)), ([], 1), "no plan knew that")

    def test_sols_have_a_limit(self):
        folder = Folder()
        for at in (100, 30_000, 60_000, 90_000):  # the last one in the next sol
            folder.observe(at, "lander.radio", "sending")
            folder.observe(at + 4500, "lander.radio", "idle")
        self.assert_broken(folder, "the sessions of sol 0 take 1.62 MJ")
        self.assertEqual(len(folder.flight_again().faults), 1)
        self.assertEqual(folder.flight_again(Scenario(1, rates=[(0, 3000)])).faults, [], "no plan knew that")

    def test_nothing_is_done_or_sent_twice(self):
        folder = Folder()
        folder.deed(5, "collect", "1 0", "collect_sample_1_0#3.1")
        folder.deed(6, "collect", "1 0", "collect_sample_1_0#3.1")
        self.assert_broken(folder, "collect 1 0 2 times")
        folder = Folder()
        folder.deed(5, "downlink", "panorama", "a#1")
        folder.deed(6, "downlink", "panorama", "b#2")
        self.assert_broken(folder, "panorama was sent 2 times")

    def test_what_a_checker_refused_is_counted(self):
        folder = Folder()
        folder.events.append({"code": "planner.defect", "text": "refused by its checker"})
        self.assertEqual(folder.flight().refused, ["refused by its checker"])


class Utility(unittest.TestCase):
    def test_counts_what_was_received(self):
        folder = Folder()
        folder.product("summary_1_0", "decisional", "received")
        folder.product("compressed_1_0", "mandatory", "received")
        folder.product("raw_1_0", "residual", "stored")
        folder.product("panorama-2", "mandatory", "received", "panorama")
        folder.product("quakes", "mandatory", "sent")
        flight = folder.flight()
        self.assertAlmostEqual(flight.utility(), 0.1 + 0.4 + 0.1)
        self.assertAlmostEqual(flight.utility("analysis"), 0.5)
        self.assertEqual(flight.samples_home, 1)

    def test_losses_have_their_cause(self):
        folder = Folder()
        folder.deed(5, "collect", "1 0")
        folder.fail(9, "science_analyze_raw_1_0#4.3", "no-sample")
        folder.fail(9, "excavate_site_0#5.1", "too-hard")
        folder.product("panorama", "mandatory", "left-behind")
        self.assertEqual({loss.cause for loss in folder.flight().losses},
                         {"sample lost before its analysis: no-sample", "site not opened: too-hard",
                          "site not reached: it waits for one that gives no sample", "mandatory data left-behind at the end"})

    def test_a_site_is_used_up_by_samples_whose_analysis_had_no_effect(self):
        folder = Folder()
        for target in range(3):
            folder.deed(5 + target, "collect", f"1 {target}")
            folder.deed(6 + target, "analyze", f"1_{target}")
        folder.observe(8, "lander.signature.1_1", "positive")
        folder.deed(20, "collect", "0 0")
        folder.deed(21, "analyze", "0_0")
        self.assertEqual([fault for fault in folder.flight().faults if "was open" in fault], [])

    def test_products_that_a_kill_lost(self):
        calm, killed = Folder(), Folder()
        calm.product("workspace", "decisional", "received")
        killed.product("workspace", "decisional", "stored")
        self.assertEqual(products_lost(killed.flight(), calm.flight()), ["workspace"])

    def test_samples_that_a_kill_cost(self):
        def home(samples):
            return SimpleNamespace(samples_home=samples)
        self.assertEqual(samples_missing(home(4), home(5)), [])
        self.assertEqual(samples_missing(home(2), home(5)), ["2 samples are home, 5 without the kills"])


class Knowing(unittest.TestCase):
    def test_is_told_what_was_measured_and_drawn(self):
        folder = Folder()
        for at, word in ((100, "command excavate_site_1#3.1 1 action=0 sim_svc arm excavate site=1"),
                         (50100, "ack excavate_site_1#3.1 1 stage=2 sim_svc done ")):
            folder.trace.append((at, f"{at * S} {word}"))
        seed = next(s for s in range(1000) if {"energy use", "one site too hard"} <= draw(s).drawn.keys() and "no site deeper" not in draw(s).drawn)
        scenario = draw(seed)
        told = " ".join(text for _, text in knowing(scenario, folder.flight()).told)
        self.assertIn("name: excavate_s_1, value: 50000", told)
        self.assertIn(f"name: excavate_s_0, value: {round(50000 / 0.92 * 1.06, 2)}", told)
        self.assertIn(f"name: value_{too_hard(scenario)[0]}, value: 0", told)
        self.assertIn(f"name: analyze_w, value: {round(90 * scenario.use_factor, 2)}", told)

    def test_knows_which_sites_are_too_hard(self):
        for seed in range(300):
            scenario = draw(seed)
            wanted = 3 if "no site deeper" in scenario.drawn else int("one site too hard" in scenario.drawn)
            self.assertEqual(len(too_hard(scenario)), wanted, scenario.world)


class Constants(unittest.TestCase):
    """What stands in the mission's files stands here as well."""

    def test_data_are_worth_what_the_network_says(self):
        text = (MISSION / "lander.yaml").read_text() + (MISSION / "targets.yaml").read_text()
        found = re.findall(r"(\w+?)(?:_\{site\}(?:_\{target\})?\"?)?: \{tier: (\w+), bytes: \w+, utility: \{\"?\S+?\"?: ([\d.]+)\}", text)
        self.assertEqual({kind for kind, _, _ in found}, set(flights.WORTH))
        for kind, tier, value in found:
            wanted = flights.RESIDUAL if tier == "residual" else flights.WORTH[kind][1]
            self.assertEqual(float(value), wanted, kind)

    def test_zones_have_their_ranges(self):
        text = (MISSION / "mission.yaml").read_text()
        found = re.findall(r"(\w+): \{capacity_j_k.*?keep_k: (\d+),.*?range_k: \[(\d+), (\d+)\]", text)
        self.assertEqual({zone for zone, *_ in found}, set(flights.ZONES_K))
        for zone, keep, low, high in found:
            self.assertEqual(flights.ZONES_K[zone], (float(low), float(high)))
            capacity = float(re.search(rf"{zone}: \{{capacity_j_k: (\d+)", text)[1])
            self.assertGreater(float(keep) + SHOCKS_J[zone][0] / capacity, float(low), "no shock breaks the range by itself")
        self.assertIn(f"rate_byte_s: {RATE_BYTE_S} ", text)

    def test_communication_has_the_limits_of_the_network(self):
        text = (MISSION / "rsm1.yaml").read_text() + (MISSION / "model.yaml").read_text()
        for name, value in (("sol_limit_j", flights.SOL_LIMIT_J), ("downlink_limit_j", flights.SESSION_LIMIT_J), ("downlink_w", flights.DOWNLINK_W)):
            self.assertIn(f"  {name}: {{value: {value},", text)

    def test_parameters_exist(self):
        text = (MISSION / "model.yaml").read_text()
        for name in [parameter for parameter, _, _ in DURATIONS.values()] + [re.sub(r"_\d$", "_{site}", name) for name in POWERS_W]:
            self.assertIn(f"  {name}:", text, name)


class ScheduleTest(unittest.TestCase):
    def test_each_record_counts_and_faults_are_told(self):
        folder = Path(tempfile.mkdtemp())
        (folder / "planner_steps").mkdir()
        for name, text, code in (("1", "9 cycles; 40 schedules of downlinks: no fault", 0),
                                 ("2", "cycle 3, at 9 s\n  downlinks: 'x' is no downlink of the plan\n9 cycles; 2 schedules of downlinks: faults in 1 cycles", 1),
                                 ("3", "", 1)):
            (folder / "planner_steps" / f"{name}.steps").write_text(f"{code}\n{text}")
        program = folder / "roci-network"
        program.write_text("#!/bin/sh\ntail -n +2 $2\nexit $(head -n 1 $2)\n")
        program.chmod(0o755)
        found = schedules_of(folder, folder)
        self.assertEqual(found.checked, 42)
        self.assertEqual(found.faults, ["2.steps: downlinks: 'x' is no downlink of the plan", "3.steps: no summary"])


if __name__ == "__main__":
    unittest.main()
