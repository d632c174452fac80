"""Function tables as flights write them, and the orbital reference scheduler: by hand, and against itself without its bound."""

import itertools
import random
import tempfile
import unittest
from pathlib import Path

import orbital_reference
import problem
from drop_order import broken_drop_order
from flights import Flight, GoalEnd
from orbital_bound import Bound, clauses
from orbital_hindsight import close, condition, failure_of
from orbital_reference import Scheduler
from orbital_scenarios import Goal, Scenario
from trials import TRIALS

MISSION = Path(__file__).resolve().parents[2] / "missions" / "orbital" / "mission.yaml"
SLOTS = ["s0", "s1", "s2", "s3"]
LOCALIZE, GRASP, PLACE, MOVE, CARRY = 30, 45, 60, 10, 20


def values() -> problem.Table:
    pairs = list(itertools.permutations(["home", *SLOTS], 2))
    return {
        "ra_move_dur": {pair: MOVE for pair in pairs},
        "ra_carry_dur": {pair: CARRY for pair in pairs},
        "ra_move_energy": {(slot,): 100.0 for slot in SLOTS},
        "ra_carry_energy": {(slot,): 200.0 for slot in SLOTS},
    }


def made(lies: dict[str, str], goals: list[str], facts: str = "", free: list[str] | None = None, sun: str = "(sunlit)") -> problem.Problem:
    free = [slot for slot in SLOTS if slot not in lies.values()] if free is None else free
    lines = [f"(at-slot {m} {s})\n(installed {m} {s})\n(lay-first {m} {s})\n(works {m})" for m, s in lies.items()]
    lines += [f"(free {slot})\n(free-first {slot})" for slot in free]
    lines += ["(arm-at home)", sun, facts, "(= (battery) 600000)", "(= (reserve) 0)"]
    init = "\n".join(f"    {line}" for some in lines for line in some.splitlines() if line)
    objects = " ".join(lies) + " - module\n " + " ".join(SLOTS) + " - socket\n home - slot\n power - role"
    return problem.parse(
        f"(define (problem p)\n (:objects\n {objects})\n (:init\n{init})\n (:goal (and {' '.join(goals)}))\n (:metric minimize (total-time)))"
    )


def wanted(module: str, slot: str) -> str:
    return f"(wanted {module} {slot})\n(allowed {module} {slot})"


class FunctionTables(unittest.TestCase):
    TEXT = "(f a b) 12.5\n(f a b) >= 10\n(f a c) >= 7.25\n(f a d) unreachable\n(f a d) >= 1\n(g a) unknown\n(g b) 3\n"

    def setUp(self):
        self.file = Path(tempfile.mkdtemp()) / "1.values"
        self.file.write_text(self.TEXT)

    def test_exact_values_and_bounds_are_told_apart(self):
        read = problem.read_values(self.file)
        self.assertEqual(read.exact, {"f": {("a", "b"): 12.5}, "g": {("b",): 3.0}})
        self.assertEqual(read.bounds["f"], {("a", "b"): 10.0, ("a", "c"): 7.25, ("a", "d"): 1.0})
        self.assertEqual(read.closed, {("f", "a", "d"), ("g", "a")})

    def test_a_bound_counts_where_there_is_no_exact_value_and_the_way_is_not_closed(self):
        self.assertEqual(problem.read_values(self.file).cheapest()["f"], {("a", "b"): 12.5, ("a", "c"): 7.25})

    def test_values_of_another_flight_open_nothing_that_is_closed(self):
        full = problem.read_values(self.file).completed({"f": {("a", "b"): 1.0, ("a", "c"): 8.0, ("a", "d"): 9.0}})
        self.assertEqual(full.exact["f"], {("a", "b"): 12.5, ("a", "c"): 8.0})
        self.file.write_text(full.text())
        again = problem.read_values(self.file)
        self.assertEqual((again.exact, again.bounds, again.closed), (full.exact, full.bounds, full.closed))


class DropOrder(unittest.TestCase):
    """A proof names a condition that stands for no fact by its formula, as mission.yaml has it."""

    def flown(self, proved: str) -> Flight:
        reason = f"out of reach: no plan brings it about\ndetails: no sequence of actions reaches: {proved}"
        goals = [
            GoalEnd("watch/radio", "radio", "optional", 5, "dropped", reason, {"module": "radio-1"}),
            GoalEnd("ground/mode", "mode", "optional", 5, "dropped", reason, {"mode": "survey"}),
            GoalEnd("ground/camera", "camera", "optional", 5, "dropped", reason, {"module": "camera-1", "slot": "s8"}),
            GoalEnd("orbiter/n", "n", "opportunistic", 1, "achieved", "seen", {"module": "power-3", "slot": "s2"}),
        ]
        return Flight(1, Path(), goals=goals, events=[(1, "goal.accepted", f"goal {goal.key} accepted") for goal in goals])

    def faults_when(self, goal: str, proved: str) -> list[str]:
        flight = self.flown(proved)
        flight.events.append((2, "goal.dropped", f"goal {goal} dropped: out of reach"))
        return broken_drop_order(flight, TRIALS["orbital"].goal_fact)

    def test_what_a_proof_names_goes_whatever_else_is_open(self):
        replaced = "(exists (?b - module ?s - socket) (and (seat radio-1 ?s) (installed ?b ?s)))"
        moded = "(forall (?r - role ?s - socket) (imply (needs survey ?r ?s) (exists (?m - module) (installed ?m ?s))))"
        self.assertEqual(self.faults_when("watch/radio", replaced), [])
        self.assertEqual(self.faults_when("ground/mode", moded), [])
        self.assertEqual(self.faults_when("ground/camera", "(works camera-1)"), [])

    def test_what_no_proof_names_waits_for_its_turn(self):
        self.assertEqual(len(self.faults_when("ground/mode", "(installed power-3 s2)")), 1)
        self.assertEqual(len(self.faults_when("watch/radio", "(seat radio-2 ?s)")), 1)


class Hindsight(unittest.TestCase):
    """Until when a module that fails can work where it is wanted."""

    def test_a_module_that_fails_is_in_its_slot_before_or_never(self):
        goal = Goal("h1", "ground", "install", "hard", 1, (("module", "radar-1"), ("slot", "s3")))
        scenario = Scenario(1, 600000, [], {}, {}, [], [], failing={"radar-1": 210})
        self.assertEqual(failure_of(goal, scenario), (200.0, ("allowed", "radar-1", "s3")))
        self.assertIsNone(failure_of(goal, Scenario(1, 600000, [], {}, {}, [], [])))

    def test_a_window_that_opens_after_the_failure_does_not_open(self):
        opening = "(wanted m s2)\n(at 300 (allowed m s2))\n(at 900 (not (allowed m s2)))"
        task = made({"m": "s0"}, ["(installed m s2)"], opening)
        self.assertTrue(orbital_reference.schedule(task, values()).solvable)
        close(task, 200.0, ("allowed", "m", "s2"))
        self.assertIs(orbital_reference.schedule(task, values()).solvable, False)


class ByHand(unittest.TestCase):
    def test_one_module_is_moved(self):
        found = orbital_reference.schedule(made({"m": "s0"}, ["(installed m s2)"], wanted("m", "s2")), values())
        self.assertTrue(found.solvable)
        self.assertAlmostEqual(found.makespan_s, MOVE + LOCALIZE + GRASP + CARRY + LOCALIZE + PLACE, delta=0.1)

    def test_two_modules_change_places_over_a_free_slot(self):
        task = ({"m": "s0", "n": "s1"}, ["(installed m s1)", "(installed n s0)"], wanted("m", "s1") + "\n" + wanted("n", "s0"))
        found = orbital_reference.schedule(made(*task), values())
        self.assertTrue(found.solvable)
        # Three modules are carried; after each but the last the arm goes to the next, localized where it has placed one.
        self.assertAlmostEqual(found.makespan_s, 3 * (MOVE + LOCALIZE + GRASP + CARRY + LOCALIZE + PLACE), delta=0.1)
        self.assertIs(orbital_reference.schedule(made(*task, free=[]), values()).solvable, False)

    def test_nothing_is_placed_after_the_window(self):
        closing = "(wanted m s2)\n(allowed m s2)\n(at {at} (not (allowed m s2)))"
        self.assertTrue(orbital_reference.schedule(made({"m": "s0"}, ["(installed m s2)"], closing.format(at=200)), values()).solvable)
        self.assertIs(orbital_reference.schedule(made({"m": "s0"}, ["(installed m s2)"], closing.format(at=190)), values()).solvable, False)

    def test_the_arm_waits_for_light(self):
        task = made({"m": "s0"}, ["(installed m s2)"], wanted("m", "s2"), sun="(at 500.0 (sunlit))\n(at 900.0 (not (sunlit)))")
        found = orbital_reference.schedule(task, values())
        self.assertAlmostEqual(found.makespan_s, 500 + LOCALIZE + GRASP + CARRY + LOCALIZE + PLACE, delta=0.1)


class NoBound:
    def __init__(self, goal, scheduler):
        pass

    def __call__(self, state, installed, time):
        return 0.0


class AgainstPlainSearch(unittest.TestCase):
    """The bound changes no answer: it is never above what the rest takes."""

    def solve(self, task):
        scheduler = Scheduler(task, values(), None)
        return scheduler, scheduler.run()

    def test_random_instances(self):
        draw = random.Random(5)
        outcomes = set()
        for _ in range(60):
            names = ["a", "b", "c"][: draw.randint(1, 3)]
            lies = dict(zip(names, draw.sample(SLOTS, len(names))))
            facts, goals = [], []
            for name, slot in zip(names, draw.sample(SLOTS, len(names))):
                if draw.random() < 0.7:
                    facts.append(f"(wanted {name} {slot})\n(allowed {name} {slot})")
                    if draw.random() < 0.5:
                        facts[-1] += f"\n(at {draw.randint(150, 700)}.0 (not (allowed {name} {slot})))"
                    goals.append(f"(installed {name} {slot})")
            goals = goals or [f"(installed {names[0]} s3)"]
            free = [slot for slot in SLOTS if slot not in lies.values()]
            task = made(lies, goals, "\n".join(facts), free=draw.sample(free, max(0, len(free) - draw.randint(0, 1))))
            scheduler, found = self.solve(task)
            self.assertEqual(len(clauses(scheduler)), len(goals))
            orbital_reference.Bound = NoBound
            _, plain = self.solve(task)
            orbital_reference.Bound = Bound
            self.assertEqual(found.solvable, plain.solvable)
            if found.solvable:
                self.assertAlmostEqual(found.makespan_s, plain.makespan_s, delta=0.001)
            outcomes.add(found.solvable)
        self.assertEqual(outcomes, {True, False})


class GoalConditions(unittest.TestCase):
    def test_they_are_those_of_the_mission(self):
        mission = MISSION.read_text()
        install = Goal("g", "ground", "install", "hard", 1, (("module", "radar-1"), ("slot", "s3")))
        self.assertEqual(condition(mission, install), ["and", ["installed", "radar-1", "s3"], ["works", "radar-1"]])
        self.assertEqual(condition(mission, Goal("g", "ground", "replace", "hard", 1, (("module", "camera-1"),)))[1][0], "exists")
        self.assertIn("survey", str(condition(mission, Goal("g", "ground", "configure", "hard", 1, (("mode", "survey"),)))))


if __name__ == "__main__":
    unittest.main()
