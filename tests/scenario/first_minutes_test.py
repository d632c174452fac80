"""What a newcomer meets first: ./run on terminals of 80 and 150 columns, its help, its question before sudo, what it says of a
mission with a slip; what the build and the planner show on a terminal.

first_minutes_test.py SOURCE_FOLDER BIN_FOLDER [TEST…]: the scripts are run from a copy of their places, with the programs of that
build and a set-up that only says that it was called, or a set-up with stand-ins for what it calls.
"""

from __future__ import annotations

import codecs
import fcntl
import os
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest
from pathlib import Path

from run_tree import RunTree, write_program

SOURCE, BIN = Path(sys.argv[1]), Path(sys.argv[2])
LIMIT_S = 120  # of a whole flight, on a machine that does other things, too
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


NOBODY = 65534


class Terminal:
    """A command on a terminal of that size; as_nobody: with no rights, if this test has those of root."""

    def __init__(
        self, command: list[str], columns: int, rows: int, environment: dict[str, str], *, as_nobody: bool = False
    ) -> None:
        self.text = ""
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            if as_nobody and os.geteuid() == 0:
                os.setgroups([])
                os.setgid(NOBODY)
                os.setuid(NOBODY)
            os.execvpe(command[0], command, environment)
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def read_until(self, seen) -> bool:
        end = time.monotonic() + LIMIT_S
        while not seen(self.text):
            ready, _, _ = select.select([self.fd], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                return False
            try:
                self.text += self.decoder.decode(os.read(self.fd, 65536))
            except OSError:  # the other end is closed
                return seen(self.text)
        return True

    def finish(self) -> int:
        self.read_until(lambda _: False)
        code = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        os.close(self.fd)
        return code


class Place(unittest.TestCase):
    def setUp(self) -> None:
        self.tree = RunTree(self, SOURCE, BIN)
        self.environment = {**self.tree.environment, "TERM": "xterm", "ROCI_DDS": "cyclonedds"}

    def terminal(self, columns: int, rows: int, *words: str) -> Terminal:
        return Terminal([str(self.tree.run), str(SOURCE / "missions/planetary"), *words], columns, rows, self.environment)


class Run(Place):
    def test_help_answers_at_once(self) -> None:
        for word in ("-h", "--help"):
            done = subprocess.run([self.tree.run, word], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0)
            self.assertIn("--scenario", done.stdout)
        self.assertFalse(self.tree.called.exists(), "nothing is installed or built for it")

    def test_a_terminal_sees_the_view_with_its_map_and_then_the_outcome(self) -> None:
        for columns, rows in ((80, 24), (150, 40)):
            terminal = self.terminal(columns, rows, "--speed", "max")
            self.assertTrue(terminal.read_until(lambda text: "\x1b[?1049h" in text), terminal.text)
            self.assertEqual(terminal.finish(), 0, terminal.text[-2000:])
            view, after = terminal.text.split("\x1b[?1049l", 1)
            self.assertIn("planetary", view)
            self.assertIn("Way", view)
            self.assertIn("▲", view)
            self.assertIn("achieved", after)
            for frame in view.split("\x1b[H"):
                for line in CONTROL.sub("", frame).split("\r\n"):
                    self.assertLessEqual(len(line.rstrip("\r\n")), columns)

    def test_q_ends_the_view_and_the_mission_goes_on_until_it_is_stopped(self) -> None:
        terminal = self.terminal(100, 30, "--speed", "60")
        self.assertTrue(terminal.read_until(lambda text: "executing" in text), terminal.text)
        os.write(terminal.fd, b"q")
        self.assertTrue(terminal.read_until(lambda text: "the mission goes on" in text), terminal.text)
        os.write(terminal.fd, b"\x03")
        self.assertEqual(terminal.finish(), 1, terminal.text[-2000:])

    def test_plain_lines_fit_the_terminal(self) -> None:
        terminal = self.terminal(80, 24, "--speed", "max", "--plain")
        self.assertEqual(terminal.finish(), 0, terminal.text[-2000:])
        self.assertNotIn("\x1b[?1049h", terminal.text)
        drawn = [part for part in re.split(r"[\r\n]+", CONTROL.sub("", terminal.text)) if "goals:" in part]
        self.assertTrue(drawn)
        for line in drawn:
            self.assertLess(len(line), 80, line)


class BadMission(Place):
    """A mission with a slip: it is told, and nothing starts."""

    def test_its_findings_are_told_and_nothing_starts(self) -> None:
        mission = self.tree.root / "slipped"
        shutil.copytree(SOURCE / "missions/planetary", mission)
        file = mission / "mission.yaml"
        text = file.read_text()
        file.write_text(text.replace("fallback: stop", "fallback: sotp", 1))
        line = text[: text.index("fallback: stop")].count("\n") + 1
        done = subprocess.run(
            [self.tree.run, mission, "--headless", "--json"], capture_output=True, text=True, check=False,
            env=self.environment, stdin=subprocess.DEVNULL, timeout=LIMIT_S,
        )  # fmt: skip
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, rf"mission\.yaml:{line}:\d+: error: .*'sotp'")
        self.assertEqual(done.stdout, "", "no launcher has spoken")
        self.assertFalse(self.tree.state.exists(), "there is no run folder")


class SetUpPlace(unittest.TestCase):
    """The set-up with stand-ins for the programs that it calls."""

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.folder.chmod(0o777)
        self.script = self.folder / "cmake/setup.sh"
        self.script.parent.mkdir()
        shutil.copy(SOURCE / "cmake/setup.sh", self.script)
        self.environment = {**os.environ, "PATH": f"{self.folder}:/usr/bin:/bin", "ROCI_YES": "", "TERM": "xterm"}

    def stand_in(self, program: str, does: str) -> None:
        write_program(self.folder / program, does)


class MissingPackages(SetUpPlace):
    """Packages are missing, and the user is not root."""

    def setUp(self) -> None:
        super().setUp()
        self.stand_in("dpkg-query", "exit 1")
        self.stand_in("sudo", f'echo "$*" >>{self.folder}/sudo_was_called; exit 1')

    def called(self) -> str:
        file = self.folder / "sudo_was_called"
        return file.read_text() if file.exists() else ""

    def set_up(self, *words: str) -> tuple[int, str]:
        done = subprocess.run(
            ["bash", self.script, *words, "release", "programs"], capture_output=True, text=True, check=False,
            stdin=subprocess.DEVNULL, user=NOBODY if os.geteuid() == 0 else None, env=self.environment,
        )  # fmt: skip
        return done.returncode, done.stderr

    def answered(self, answer: str) -> tuple[int, str]:
        """The set-up on a terminal, where that is typed when it asks."""
        terminal = Terminal(
            ["bash", str(self.script), "release", "programs"], 100, 30, self.environment, as_nobody=True
        )
        self.assertTrue(terminal.read_until(lambda text: "[y/N]" in text), terminal.text)
        self.assertEqual(self.called(), "", "nothing before the answer")
        os.write(terminal.fd, answer.encode() + b"\n")
        return terminal.finish(), terminal.text

    def test_it_never_uses_sudo_unasked(self) -> None:
        code, said = self.set_up()
        self.assertEqual(code, 3)
        self.assertIn("--yes", said)
        self.assertEqual(self.called(), "")

    def test_yes_is_the_answer(self) -> None:
        self.set_up("--yes")
        self.assertIn("apt-get update", self.called())

    def test_on_a_terminal_it_asks_and_takes_anything_but_yes_for_no(self) -> None:
        for answer in ("n", "", "maybe"):
            code, said = self.answered(answer)
            self.assertEqual(code, 3, said)
            self.assertIn("these Debian packages are missing: g++ ", said)
            self.assertIn("nothing was installed", said)
            self.assertEqual(self.called(), "")

    def test_on_a_terminal_yes_lets_sudo_install(self) -> None:
        code, said = self.answered("y")
        self.assertEqual(code, 3, said)  # this sudo installs nothing
        self.assertIn("apt-get failed", said)
        self.assertEqual(self.called(), "apt-get update\n")


class Build(SetUpPlace):
    """All packages are there, and a stand-in for ninja builds."""

    def setUp(self) -> None:
        super().setUp()
        self.stand_in("dpkg-query", "echo ok installed")
        (self.folder / "build/release").mkdir(parents=True)
        (self.folder / "build/release/build.ninja").touch()

    def on_a_terminal(self, ninja: str) -> tuple[int, str]:
        self.stand_in("ninja", ninja)
        terminal = Terminal(["bash", str(self.script), "release"], 80, 24, self.environment)
        return terminal.finish(), terminal.text

    def test_where_little_or_nothing_is_to_be_done_it_says_nothing(self) -> None:
        for ninja in (
            "echo \"ninja: Entering directory 'build/release'\"; echo 'ninja: no work to do.'",
            "echo '[1/2] Re-checking'; echo '[2/2] Linking'",
        ):
            self.assertEqual(self.on_a_terminal(ninja), (0, ""))

    def test_a_long_build_is_one_line_that_changes(self) -> None:
        code, said = self.on_a_terminal("for i in 1 2 3 4 5; do echo \"[$i/5] Building $(printf %0200d $i)\"; done")
        self.assertEqual(code, 0)
        self.assertEqual(said.count("\n"), 1, "the end of the line")
        drawn = [part for part in re.split(r"\r\x1b\[K|\r\n", said) if part]
        self.assertEqual([part[:5] for part in drawn], [f"[{i}/5]" for i in range(1, 6)])
        for part in drawn:
            self.assertLess(len(part), 80)

    def test_an_error_stands_on_a_line_of_its_own(self) -> None:
        code, said = self.on_a_terminal("echo '[1/9] begun'; echo 'FAILED: of itself'; exit 1")
        self.assertEqual(code, 1)
        self.assertIn("[1/9] begun\r\nFAILED: of itself\r\n", said)

    def test_the_build_is_told_while_it_goes_on(self) -> None:
        """The stand-in for ninja builds on only when its first line was read."""
        self.stand_in(
            "ninja",
            f"echo '[1/9] begun'\nuntil [ -e {self.folder}/seen ]; do sleep 0.01; done\necho 'FAILED: of itself'\nexit 1",
        )
        with subprocess.Popen(
            ["bash", self.script, "release"], stderr=subprocess.PIPE, text=True, env=self.environment
        ) as build:
            assert build.stderr is not None
            first = build.stderr.readline() if select.select([build.stderr], [], [], LIMIT_S)[0] else ""
            (self.folder / "seen").touch()
            self.assertEqual(first, "[1/9] begun\n")
            self.assertIn("FAILED: of itself", build.stderr.read())
            self.assertEqual(build.wait(), 1)


ENDLESS = """(define (domain endless) (:requirements :durative-actions :numeric-fluents) (:functions (even) (odd))
  (:durative-action one :parameters () :duration (= ?duration 1) :condition () :effect (at end (increase (even) 2)))
  (:durative-action two :parameters () :duration (= ?duration 1) :condition () :effect (at end (increase (odd) 2))))
"""
NEVER = """(define (problem never) (:domain endless) (:init (= (even) 0) (= (odd) 1)) (:goal (= (even) (odd))))
"""


class Planner(unittest.TestCase):
    """roci-plan on a search that does not end by itself."""

    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "domain.pddl").write_text(ENDLESS)
        (self.folder / "problem.pddl").write_text(NEVER)
        files = [str(self.folder / "domain.pddl"), str(self.folder / "problem.pddl")]
        self.command = [str(BIN / "roci-plan"), *files, "--evaluations"]

    def test_a_terminal_sees_what_it_is_doing_on_one_line(self) -> None:
        """The line is drawn every quarter of a second, so the search has to take longer than that."""
        terminal = Terminal([*self.command, "15000"], 100, 24, {**os.environ, "TERM": "xterm"})
        self.assertEqual(terminal.finish(), 4, terminal.text)
        drawn = [part for part in re.split(r"\r\x1b\[K", terminal.text)[1:-1] if part]
        self.assertTrue(drawn, terminal.text)
        self.assertTrue(any(re.search(r"^\d+ s  searching.*  \d+ evaluated  \d+ MB$", part) for part in drawn), drawn)
        for part in drawn:
            self.assertLess(len(part), 100)
        self.assertIn("timeout", terminal.text.rsplit("\x1b[K", 1)[1], "the line is gone before the verdict")

    def test_a_pipe_sees_none_of_it(self) -> None:
        done = subprocess.run([*self.command, "3000"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 4)
        self.assertNotIn("\x1b", done.stdout + done.stderr)


if __name__ == "__main__":
    signal.alarm(8 * LIMIT_S)
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
