#!/usr/bin/env python3
"""The harness on instances made by hand and on planners that are shell scripts: limits, verdicts, resuming (R63), and what the
comparison makes of records (R64).

  test_harness.py BIN      the folder with roci-bench-limited and roci-validate"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import compare

HERE = pathlib.Path(__file__).resolve().parent
BIN = pathlib.Path("build/release/bin").resolve()

DOMAIN = """(define (domain d) (:requirements :durative-actions) (:predicates (done))
  (:durative-action do :parameters () :duration (= ?duration 2) :condition () :effect (at end (done))))"""
PROBLEM = "(define (problem p) (:domain d) (:init) (:goal (done)))"


def made(folder, domains=("ipc-1999/one",), problems=(1,)):
    """A tree of instances."""
    for domain in domains:
        instances = folder / domain / "instances"
        instances.mkdir(parents=True)
        (folder / domain / "domain.pddl").write_text(DOMAIN)
        for number in problems:
            (instances / f"instance-{number}.pddl").write_text(PROBLEM)
    return folder


class Harness(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory(prefix="roci-ipc-")
        self.folder = pathlib.Path(self.kept.name)
        self.tree = made(self.folder / "tree")
        self.out = self.folder / "records.jsonl"

    def tearDown(self):
        self.kept.cleanup()

    def run_it(self, script, *more, files=""):
        """Runs the harness with a planner that is a shell script; {domain} is its $1."""
        planner = self.folder / "planner"
        planner.write_text("#!/bin/sh\n" + script + "\n")
        planner.chmod(0o755)
        told = subprocess.run(
            [sys.executable, HERE / "run.py", "--root", self.tree, "--planner", "stub", "--out", self.out,
             "--command", f"{planner} {{domain}} {{problem}}{files}", "--limited", BIN / "roci-bench-limited",
             "--validate", BIN / "roci-validate", *more], capture_output=True, text=True)
        self.assertEqual(told.returncode, 0, told.stderr)
        return [json.loads(line) for line in self.out.read_text().splitlines()]

    def test_a_valid_plan_is_solved_and_measured(self):
        [record] = self.run_it('echo "0.000: (do) [2.000]"')
        self.assertEqual((record["status"], record["valid"], record["makespan"], record["actions"]), ("ok", True, 2.0, 1))
        self.assertGreater(record["peak_rss_kb"], 0)
        self.assertEqual((record["domain"], record["instance"]), ("ipc-1999/one", 1))

    def test_a_record_names_limits_and_processor(self):
        [record] = self.run_it("exit 1")
        self.assertEqual((record["seconds"], record["megabytes"]), (30, 4096))
        self.assertNotEqual(record["processor"], "")
        [_, record] = self.run_it("exit 1", "--seconds", "1800", "--planner", "patient")
        self.assertEqual((record["planner"], record["seconds"]), ("patient", 1800))

    def test_the_planner_is_told_the_limits_by_the_system(self):
        [record] = self.run_it('echo "cpu $(ulimit -t) memory $(ulimit -v)" >&2; exit 1', "--seconds", "1800", "--megabytes", "256")
        self.assertEqual(record["message"], f"cpu 1800 memory {256 * 1024}")

    def test_a_plan_that_does_not_reach_the_goal_counts_for_nothing(self):
        [record] = self.run_it('echo "0.000: (do) [3.000]"')
        self.assertEqual((record["status"], record["valid"]), ("invalid plan", False))

    def test_a_plan_that_nobody_can_read_counts_for_nothing(self):
        [record] = self.run_it('echo "0.000: (undo) [2.000]"')
        self.assertFalse(record["valid"])

    def test_who_spends_the_processor_is_ended(self):
        [record] = self.run_it("while :; do :; done", "--seconds", "1")
        self.assertEqual((record["status"], record["valid"]), ("timeout", False))

    def test_who_takes_more_memory_is_refused_it(self):
        greedy = f'exec {sys.executable} -c "import sys; kept = bytearray(400 << 20); print(\'0.000: (do) [2.000]\')"'
        [record] = self.run_it(greedy, "--megabytes", "256")
        self.assertFalse(record["valid"])
        self.assertIn("MemoryError", record["message"])
        [_, record] = self.run_it(greedy, "--megabytes", "1024", "--planner", "roomy")
        self.assertTrue(record["valid"], record)

    def test_a_plan_may_come_as_a_file(self):
        [record] = self.run_it('echo "noise"; echo "0.000: (do) [2.000]" > $3', files=" {plan}")
        self.assertTrue(record["valid"])

    def test_what_was_run_is_not_run_again(self):
        made(self.folder / "tree", domains=("ipc-1999/two",))
        count = f"echo run >> {self.folder}/runs; exit 1"
        self.run_it(count, "--match", "one")
        self.assertEqual(len(self.run_it(count)), 2)
        self.assertEqual(len((self.folder / "runs").read_text().split()), 2)

    def test_a_file_of_instances_chooses_those_alone(self):
        made(self.folder / "tree", domains=("ipc-1999/two",), problems=(1, 2))
        only = self.folder / "only.csv"
        only.write_text("domain,instance\nipc-1999/two,2\n")
        [record] = self.run_it("exit 1", "--only", only)
        self.assertEqual((record["domain"], record["instance"]), ("ipc-1999/two", 2))


def record(planner, number, valid, cpu_s, megabytes, makespan=10.0):
    return {"planner": planner, "domain": "ipc-1999/one", "instance": number, "valid": valid, "cpu_s": cpu_s,
            "peak_rss_kb": megabytes * 1024, "makespan": makespan}


class Comparison(unittest.TestCase):
    def setUp(self):
        records = [record("ours", 1, True, 0.1, 10), record("peer", 1, True, 1.0, 120, 5.0),    # ten times as fast, a twelfth
                   record("ours", 2, True, 1.0, 10), record("peer", 2, True, 0.1, 20, 20.0),    # the peer is faster
                   record("ours", 3, False, 30.0, 10), record("peer", 3, True, 2.0, 20),        # the peer alone
                   record("ours", 4, True, 1.0, 10), record("peer", 4, False, 30.0, 4000)]      # ours alone
        self.runs = {}
        for one in records:
            self.runs.setdefault((one["domain"], one["instance"]), {})[one["planner"]] = one

    def test_each_loss_is_named(self):
        text = compare.losses(self.runs, ["ours", "peer"], "ours")
        self.assertIn("| ipc-1999/one | 2 | 1.00 s | peer 0.10 s |", text)
        self.assertIn("| ipc-1999/one | 3 | not solved | peer 2.00 s |", text)
        self.assertEqual(len(text.splitlines()), 4)

    def test_memory_counts_where_the_peer_needs_much(self):
        [_, _, row] = compare.pairs(self.runs, ["ours", "peer"], "ours").splitlines()
        self.assertEqual(row, "| peer | 2 | 50 % | 1.0 | 12.0 (1) | 1 | 1 |")

    def test_quality_is_that_of_the_competitions(self):
        self.assertAlmostEqual(compare.ipc_score(self.runs, ["ours", "peer"], "ours"), 0.5 + 1 + 1)
        self.assertAlmostEqual(compare.ipc_score(self.runs, ["ours", "peer"], "peer"), 1 + 0.5 + 1)


if __name__ == "__main__":
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        BIN = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
