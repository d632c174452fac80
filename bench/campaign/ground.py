"""The ground of a flight: sends goals, takes some back, and notes what it was answered and when."""

import json
import subprocess
import time

from draw import Wish

ANSWER_LIMIT_S = 45


class Ground:
    def __init__(self, command: list[str], over, mission_time):
        """`command` is roci with its connection; `mission_time` tells what time it is there, in s."""
        self.command, self.over, self.mission_time = command, over, mission_time
        self.answers: list[dict] = []

    def ask(self, words: list[str]) -> tuple[int | None, dict]:
        try:
            done = subprocess.run([*self.command, *words, "--json"], text=True, capture_output=True, timeout=ANSWER_LIMIT_S)
            return done.returncode, json.loads(done.stdout.strip().splitlines()[-1])
        except (subprocess.TimeoutExpired, ValueError, IndexError):
            return None, {}

    def until_answered(self, verb: str, words: list[str], goal: str, states: tuple[str, ...]) -> bool:
        """The same words until one of these states is the answer, or the flight is over; only that counts as acknowledged."""
        while not self.over.is_set():
            asked = self.mission_time()
            code, answer = self.ask(words)
            state = answer.get("state", "")
            if code is not None and state:
                self.answers.append({"verb": verb, "goal": goal, "state": state, "acknowledged": answer.get("acknowledged", ""),
                                     "asked_s": asked, "answered_s": self.mission_time()})
            if state in states:
                return True
            self.over.wait(0.5)
        return False

    def run(self, wish: Wish, start: float) -> None:
        if self.over.wait(max(0.0, start + wish.at_s - time.monotonic())):
            return
        goal = f"ground/{wish.id}"
        words = ["goal", "add", wish.id, "photo", f"x={wish.x:.2f}", f"y={wish.y:.2f}", "--class", "optional", "--utility", "1"]
        added = self.until_answered("add", words, goal, ("pending", "planned", "achieved", "dropped", "failed", "rejected"))
        if wish.recall_after_s is None or not added:
            return
        self.over.wait(wish.recall_after_s)
        self.until_answered("recall", ["goal", "cancel", wish.id], goal, ("recalled", "achieved", "dropped", "failed"))
