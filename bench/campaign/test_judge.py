#!/usr/bin/env python3
"""What the campaign's judge calls lost, on records made by hand."""

import unittest

from judge import HELD_BY_BOTH, lost_goals, lost_recalls

PENDING, ACHIEVED, RECALLED = (1, ""), (3, ""), (6, "recalled by ground")


def answer(verb: str, state: str, acknowledged: str) -> dict:
    return {"verb": verb, "goal": "ground/a", "state": state, "acknowledged": acknowledged}


class Goals(unittest.TestCase):
    def test_what_both_hold_must_be_in_the_final_journal(self):
        added = [answer("add", "pending", HELD_BY_BOTH)]
        self.assertEqual(len(lost_goals(added, [], {}, [{"ground/a": PENDING}])), 1)
        self.assertEqual(lost_goals(added, [], {"ground/a": PENDING}, []), [])

    def test_what_one_has_journaled_may_be_on_its_disk_alone(self):
        added = [answer("add", "pending", "journaled")]
        self.assertEqual(lost_goals(added, [], {}, [{"ground/a": PENDING}]), [])
        self.assertEqual(len(lost_goals(added, [], {}, [{}])), 1)
        self.assertEqual(len(lost_goals(added, [], {}, [])), 1, "an executive without a partner")

    def test_the_scenarios_goals_are_always_there(self):
        self.assertEqual(len(lost_goals([], ["scenario/ridge"], {}, [{"scenario/ridge": PENDING}])), 1)

    def test_what_was_refused_is_no_goal(self):
        self.assertEqual(lost_goals([answer("add", "rejected", "journaled")], [], {}, []), [])


class Recalls(unittest.TestCase):
    def test_what_both_hold_stands(self):
        recalled = [answer("recall", "recalled", HELD_BY_BOTH)]
        self.assertEqual(len(lost_recalls(recalled, {"ground/a": ACHIEVED}, [{"ground/a": RECALLED}])), 1)
        self.assertEqual(lost_recalls(recalled, {"ground/a": RECALLED}, []), [])

    def test_what_one_has_journaled_may_be_on_its_disk_alone(self):
        recalled = [answer("recall", "recalled", "journaled")]
        self.assertEqual(lost_recalls(recalled, {"ground/a": ACHIEVED}, [{"ground/a": RECALLED}]), [])
        self.assertEqual(len(lost_recalls(recalled, {"ground/a": ACHIEVED}, [])), 1)

    def test_who_was_told_that_it_was_too_late_has_lost_nothing(self):
        self.assertEqual(lost_recalls([answer("recall", "achieved", HELD_BY_BOTH)], {"ground/a": ACHIEVED}, []), [])


if __name__ == "__main__":
    unittest.main()
