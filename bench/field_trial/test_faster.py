#!/usr/bin/env python3
"""What the field trial of the two rovers reads from a flight, on records made by hand."""

import json
import tempfile
import unittest
from pathlib import Path

import faster_report
from faster import Record, loaded
from faster_flights import Flight, cause_of, circles_of, entries_into, repairs_of, without_repairs, without_soil_sensing
from faster_kills import KilledFlight
from report import HAND

ROOT = Path(__file__).resolve().parents[2]
STEP = "p1.9-scout_locomotion.traversing_with_ss(w0, w1)"


def places(*spots: tuple[float, float, float]) -> list[tuple[float, str]]:
    return [(at, f"observation primary.{axis} {value} sampled 0") for at, x, y in spots for axis, value in (("x", x), ("y", y))]


class ReadsAFlight(unittest.TestCase):
    def test_causes(self):
        self.assertEqual(cause_of("plan.broken plan 2 is broken: p2.18-primary_path.planning(w3, w4): failed [path-invalid]: way: no"),
                         "primary_path.planning: path-invalid")

    def test_entries_count_only_after_the_map_had_the_circle(self):
        way = places((0, 0, 0), (10, 1, 0), (20, 0, 0), (30, 1, 0))
        self.assertEqual(entries_into([(0.5, 0, 0.2, 15)], way), 2, "back and again")
        self.assertEqual(entries_into([(0.5, 0, 0.2, 25)], way), 1)
        self.assertEqual(entries_into([(0.5, 0, 0.2, 40)], way), 0)
        self.assertEqual(entries_into([(0.5, 1, 0.2, 0)], way), 0, "beside it")

    def test_circles_since_the_primary_took_them(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            hazard = {"kind": "soil", "radius_m": 0.65, "x_m": 1.0, "y_m": 2.0, "found_s": 15.0}
            (folder / "primary.path.hazards").write_text(json.dumps([{**hazard, "id": "scout-soil-2"}, {**hazard, "id": "scout-soil-1", "x_m": 7.0, "found_s": 5.0}]))
            self.assertEqual(circles_of(folder), [(7.0, 2.0, 0.65, 5.0), (1.0, 2.0, 0.65, 15.0)], "nothing says when they came: since they were found")
            changed = [{"sender": "primary.path", "text": f"the map has version {n + 1} with {n} hazards", "time_us": n * 1e7} for n in (1, 2)]
            (folder / "events.jsonl").write_text("".join(json.dumps(one) + "\n" for one in changed))
            self.assertEqual(circles_of(folder), [(7.0, 2.0, 0.65, 10.0), (1.0, 2.0, 0.65, 20.0)])

    def test_a_circle_of_the_primarys_own_is_on_its_map_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            hazard = {"kind": "soil", "radius_m": 0.65, "y_m": 2.0}
            found = [("scout-soil-1", 1.0, 5), ("primary-soil-1", 2.0, 9), ("scout-soil-2", 3.0, 15)]
            (folder / "primary.path.hazards").write_text(json.dumps([{**hazard, "id": name, "x_m": x} for name, x, _ in found]))
            events = [{"sender": "sim_svc", "text": f"{name.split('-')[0]} says No-Go for primary ({name}, wheel)", "time_us": at * 1e6}
                      for name, _, at in found]
            events += [{"sender": "primary.path", "text": f"the map has version {n} with {n} hazards", "time_us": at * 1e6}
                       for n, at in ((1, 9), (3, 20))]
            (folder / "events.jsonl").write_text("".join(json.dumps(one) + "\n" for one in events))
            self.assertEqual([(x, since) for x, _, _, since in circles_of(folder)], [(2.0, 9), (1.0, 20), (3.0, 20)])

    def test_repairs_with_the_time_that_they_had(self):
        rows = [(5_000_000, "trace", f"5000000 command {STEP} 1 action=0 scout.locomotion scout_locomotion TraverseWithSS from=w0 to=w1"),
                (9_000_000, "trace", f"9000000 ack {STEP} 1 stage=0 scout.locomotion repairing drive: no-go, the wheel says No-Go")]
        motion = {"robot": "scout", "kind": "motion"}
        moved = [{**motion, "time_us": at * 1_000_000, "object": to} for at, to in ((6, "w1"), (10, "w0"), (12, "w1"))]
        told = [{"sender": who, "code": "map.told", "time_us": at * 1e6} for who, at in (("primary.path", 8), ("scout.path", 9), ("primary.path", 9.5), ("primary.path", 11))]
        (one,) = repairs_of(rows, moved, told)
        self.assertEqual((one.cause, one.at_s, one.used_s), ("no-go", 9, 3), "to the drive on, not to the one back")
        self.assertEqual(one.paths_s, 0.5, "to the map of both, which is told when both paths are there")
        self.assertAlmostEqual(one.allowed_s, 5 + 1.5 / 0.0125 + 240 - 9)  # of TraverseWithSS in domain.yaml
        (one,) = repairs_of(rows, moved, [])
        self.assertIsNone(one.paths_s)

    def test_another_range_stands_beside_this_one(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            repair = {"cause": "no-go", "at_s": 1.0, "used_s": None, "allowed_s": 9.0, "ended_well": False}
            others = [{"seed": seed, "folder": "", "way_m": 16.0, "arrived": seed != 8, "reason": "out of reach", "repairs": [repair]} for seed in (7, 8)]
            (folder / "results.json").write_text(json.dumps([{"flight": one} for one in others]))
            page = folder / "page.md"
            faster_report.write([Record(Flight(1, "", 16.0, arrived=True))], page, [[one.flight for one in loaded(folder)]])
            self.assertIn("| as it stands | 1 | 1 of 1 (100.0 %) |", page.read_text())
            self.assertIn("| seeds 7 to 8 | 2 | 1 of 2 (50.0 %) |", page.read_text())
            self.assertIn("Not arrived: seeds 8.\n\n- seed 8: out of reach", page.read_text())

    def test_an_earlier_state_is_told_as_such_and_what_is_written_by_hand_stays(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text("# Old\n" + HAND + "\nSaid by somebody.\n")
            now = Record(Flight(2, "", 16.0, arrived=False, reason="out of reach: no leg\ndetails", told=True))
            before = Record(Flight(2, "", 16.0, arrived=True), unrepaired=Flight(2, "", 16.0, replans=["drive: no-go"]))
            faster_report.write([now], page, [], [before])
            text = page.read_text()
            self.assertNotIn("# Old", text)
            self.assertIn("| as it stands | 1 | 0 of 1 (0.0 %) |", text)
            self.assertIn("| earlier state, seeds 2 to 2 | 1 | 1 of 1 (100.0 %) |", text)
            self.assertIn("With repair switched off (1 flights, of the earlier state):", text)
            self.assertIn("- seed 2: out of reach: no leg; the last communication went out\n", text)
            self.assertTrue(text.endswith(HAND + "\nSaid by somebody.\n"))

    def test_what_the_primarys_wheels_are_good_for(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            pair = Record(Flight(3, "", 16.0, arrived=True, felt=1), unfeeling=Flight(3, "", 16.0, bogged=True))
            faster_report.write([pair, Record(Flight(4, "", 16.0, arrived=True))], page)
            self.assertIn("found soil that does not bear it in 1 of the 2 flights", page.read_text())
            self.assertIn("without it were seeds 3. Of these arrive 1 with it, 0 without; primaries dug in: 0 with it, 1 without;", page.read_text())

    def test_of_killed_flights_the_page_says_what_was_not_measured(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            killed = [KilledFlight(seed, "nothing", "mixed", entries=entries) for seed, entries in ((5, 0), (6, 1), (7, None))]
            faster_report.write([Record(Flight(one.seed, "", 16.0), killed=one) for one in killed], page)
            self.assertIn("entries into marked soil: 1, not measured in 1 of them.", page.read_text())
            faster_report.write([Record(Flight(5, "", 16.0), killed=killed[2])], page)
            self.assertIn("entries into marked soil: not measured in 1 of them.", page.read_text())

    def test_only_the_primarys_wheels_feel_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            numb = without_soil_sensing(ROOT / "missions/faster", Path(folder) / "numb")
            before = (ROOT / "missions/faster/mission.yaml").read_text()
            after = (numb / "mission.yaml").read_text()
            self.assertEqual((before.count("soil_sensor:"), after.count("soil_sensor:")), (2, 1))
            self.assertNotIn("left front wheel", after)
            self.assertIn("penetrometer", after)
            self.assertIn("- {name: eye, type: marker_camera", after)

    def test_repairs_switched_off(self):
        with tempfile.TemporaryDirectory() as folder:
            bare = without_repairs(ROOT / "missions/faster", Path(folder) / "bare")
            for file in bare.glob("*.yaml"):
                self.assertNotIn("repairs:", [line.strip() for line in file.read_text().splitlines()], file.name)
            before = (ROOT / "missions/faster/scout_locomotion.yaml").read_text().splitlines()
            after = (bare / "scout_locomotion.yaml").read_text().splitlines()
            self.assertIn("    ComeBack:", after)
            self.assertTrue(set(after) <= set(before))


if __name__ == "__main__":
    unittest.main()
