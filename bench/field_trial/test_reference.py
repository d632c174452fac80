"""The reference scheduler against cases computed by hand, and against exhaustive search over orders."""

import itertools
import random
import unittest

import problem
from reference import DROP, GAP_S, IMAGE, PICK, SEND, schedule

ARM = {(a, b): 0.0 if a == b else 10.0 for a in ("stow", "sampling", "deposit") for b in ("stow", "sampling", "deposit")}


def made(init: str, goals: list[str], battery: float = 900000) -> problem.Problem:
    lines = ["(at here)", "(arm-at stow)", *init.splitlines(), f"(= (battery) {battery})", "(= (reserve) 0)"]
    text = "(:init\n" + "\n".join(f"  {line}" for line in lines) + "\n )\n (:goal (and\n"
    return problem.parse(text + "\n".join(f"  {goal}" for goal in goals) + "\n ))\n (:metric minimize (total-time))")


def values(drives: dict[tuple[str, str], float], energy: float = 1000) -> dict:
    both = drives | {(b, a): seconds for (a, b), seconds in drives.items()}
    cost = {pair: energy for pair in both}
    return {"traverse_time": both, "traverse_energy": cost, "arm_move_time": ARM, "arm_move_energy": ARM}


class ByHand(unittest.TestCase):
    def test_an_image_waits_for_its_window_and_for_the_orbiter(self):
        task = made(
            "(target i p)\n(at 100.0 (available i))\n(at 200.0 (not (available i)))\n"
            "(at 500.0 (comm-window))\n(at 700.0 (not (comm-window)))",
            ["(sent i)"],
        )
        found = schedule(task, values({("here", "p"): 50}))
        self.assertTrue(found.solvable)
        self.assertAlmostEqual(found.makespan_s, 500 + SEND[0], places=1)
        late = schedule(task, values({("here", "p"): 170}))
        self.assertIs(late.solvable, False)  # 170 + 40 s is after the window

    def test_a_sample_is_picked_and_set_down_over_the_faster_way(self):
        task = made("(sample-at s p)", ["(picked s)", "(dropped s q)"])
        drives = values({("here", "p"): 30, ("p", "q"): 200, ("p", "here"): 30, ("here", "q"): 40})
        found = schedule(task, drives)
        expected = 30 + 10 + PICK[0] + 10 + 70 + 10 + DROP[0]  # back over `here`
        self.assertAlmostEqual(found.makespan_s, expected, delta=20 * GAP_S)

    def test_the_gripper_is_emptied_for_another_sample(self):
        task = made("(sample-at s p)\n(sample-at t p)", ["(picked s)", "(picked t)"])
        found = schedule(task, values({("here", "p"): 30}))
        expected = 30 + 10 + PICK[0] + 10 + DROP[0] + 10 + PICK[0]
        self.assertAlmostEqual(found.makespan_s, expected, delta=20 * GAP_S)

    def test_energy_is_counted(self):
        task = made("(target i p)\n(available i)\n(comm-window)", ["(sent i)"], battery=1000 + IMAGE[1] + SEND[1])
        self.assertTrue(schedule(task, values({("here", "p"): 50})).solvable)
        self.assertIs(schedule(task, values({("here", "p"): 50}, energy=1001)).solvable, False)
        self.assertIs(schedule(task, values({("here", "p"): 50}), idle_w=1).solvable, False)


    def test_a_drive_stands_while_the_wheels_are_out_of_order_and_an_image_waits_for_the_camera(self):
        task = made("(target i p)\n(available i)\n(comm-window)", ["(sent i)"])
        outages = {"nav": [(20, 70)], "camera": [(110, 300)], "radio": [(0, 5)]}
        found = schedule(task, values({("here", "p"): 50}), outages=outages)  # arrives at 100; 40 s do not fit before 110
        self.assertAlmostEqual(found.makespan_s, 300 + IMAGE[0] + SEND[0], delta=1)

    def test_idling_is_counted_once(self):
        task = made("(sample-at s p)", ["(picked s)"], battery=1010 + PICK[1] + 0.1)
        self.assertTrue(schedule(task, values({("here", "p"): 50}), idle_w=14).solvable)  # no wait, nothing on top


class AgainstExhaustiveSearch(unittest.TestCase):
    """Images in windows, the orbiter always in view: the first order that meets every window proves it."""

    def earliest(self, order, drives, windows):
        place, time, radio = "here", 0.0, 0.0
        for target in order:
            time = max(time + drives[place, target], windows[target][0]) + IMAGE[0]
            if time > windows[target][1]:
                return None
            radio = max(time, radio) + SEND[0]
            place = target
        return max(time, radio)

    def test_random_instances(self):
        draw = random.Random(7)
        outcomes = set()
        for _ in range(300):
            places = ["a", "b", "c", "d"]
            points = {name: (draw.uniform(0, 300), draw.uniform(0, 300)) for name in ["here", *places]}
            distance = lambda p, q: abs(points[p][0] - points[q][0]) + abs(points[p][1] - points[q][1])
            drives = {(p, q): distance(p, q) for p in points for q in points if p < q}
            windows = {}
            for name in places:
                opens = draw.randint(0, 600)
                windows[name] = (opens, opens + draw.randint(100, 900))
            init = "(comm-window)\n" + "\n".join(
                f"(target i{name} {name})\n(at {low}.0 (available i{name}))\n(at {high}.0 (not (available i{name})))"
                for name, (low, high) in windows.items()
            )
            found = schedule(made(init, [f"(sent i{name})" for name in places]), values(drives))
            both = values(drives)["traverse_time"]
            ends = [self.earliest(order, both, windows) for order in itertools.permutations(places)]
            possible = [end for end in ends if end is not None]
            self.assertEqual(found.solvable, bool(possible))
            if possible:
                self.assertAlmostEqual(found.makespan_s, min(possible), delta=0.1)
            outcomes.add(bool(possible))
        self.assertEqual(outcomes, {True, False})


if __name__ == "__main__":
    unittest.main()
