"""./run takes every mission that is shipped by its name: it sets up, roci-check finds nothing that stops it, and the launcher is started with
what was asked for. The orbital mission is flown.

run_missions_test.py SOURCE_FOLDER BIN_FOLDER: ./run is run from a copy of its place, with the programs of that build and a set-up that only
says that it was called. But for the flight a stand-in for the launcher says what it was asked.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from run_tree import RunTree

SOURCE, BIN = Path(sys.argv[1]), Path(sys.argv[2])
MISSIONS = sorted(file.parent.name for file in (SOURCE / "missions").glob("*/mission.yaml"))


class RunMissions(unittest.TestCase):
    def setUp(self) -> None:
        self.tree = RunTree(self, SOURCE, BIN)

    def run_with(self, *words: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [self.tree.run, *words], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
            env=self.tree.environment,
        )  # fmt: skip

    def with_stand_in(self) -> None:
        self.tree.stand_in("roci-launch", "echo launched $*")

    def test_each_shipped_mission_passes_the_check_and_is_launched(self) -> None:
        self.assertIn("orbital", MISSIONS)
        self.with_stand_in()
        for mission in MISSIONS:
            with self.subTest(mission):
                done = self.run_with(mission, "--headless", "--speed", "max")
                self.assertEqual((done.returncode, done.stdout), (0, f"launched {mission} --headless --speed max\n"), done.stderr)
                self.assertNotIn(": error: ", done.stderr)

    def test_a_mission_with_a_mistake_is_not_launched(self) -> None:
        self.with_stand_in()
        wrong = self.tree.root / "wrong"
        shutil.copytree(SOURCE / "missions/orbital", wrong)
        text = (wrong / "mission.yaml").read_text()
        (wrong / "mission.yaml").write_text(text.replace("(seat power-1 s0)", "(saet power-1 s0)"))
        done = self.run_with(str(wrong), "--headless")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("saet", done.stderr)

    def test_orbital_is_flown(self) -> None:
        done = self.run_with("orbital", "--headless", "--json", "--speed", "max", "--dds", "inproc")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout.splitlines()[-1])["result"], "achieved")
        self.assertIn("set-up release programs", self.tree.called.read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
