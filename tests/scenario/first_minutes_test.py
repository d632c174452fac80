"""What a newcomer meets first: ./run on terminals of 80 and 150 columns, its help, its question before sudo.

first_minutes_test.py SOURCE_FOLDER BIN_FOLDER: the scripts are run from a copy of their places, with the programs of that build
and a set-up that only says that it was called.
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

SOURCE, BIN = Path(sys.argv[1]), Path(sys.argv[2])
LIMIT_S = 120  # of a whole flight, on a machine that does other things, too
CONTROL = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")


class Terminal:
    """A command on a terminal of that size."""

    def __init__(self, command: list[str], columns: int, rows: int, environment: dict[str, str]) -> None:
        self.text = ""
        self.decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
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
        self.root = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.root)
        shutil.copy(SOURCE / "run", self.root)
        (self.root / "cmake").mkdir()
        (self.root / "cmake/setup.sh").write_text(f"#!/bin/sh\necho set-up $* >>{self.root}/called\n")
        (self.root / "cmake/setup.sh").chmod(0o755)
        (self.root / "build/release").mkdir(parents=True)
        (self.root / "build/release/bin").symlink_to(BIN)
        self.environment = {
            **os.environ, "TERM": "xterm", "XDG_STATE_HOME": str(self.root / "state"),
            "XDG_RUNTIME_DIR": str(self.root), "ROCI_DDS": "cyclonedds",
        }  # fmt: skip

    def terminal(self, columns: int, rows: int, *words: str) -> Terminal:
        return Terminal([str(self.root / "run"), str(SOURCE / "missions/planetary"), *words], columns, rows, self.environment)


class Run(Place):
    def test_help_answers_at_once(self) -> None:
        for word in ("-h", "--help"):
            done = subprocess.run([self.root / "run", word], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0)
            self.assertIn("--scenario", done.stdout)
        self.assertFalse((self.root / "called").exists(), "nothing is installed or built for it")

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


class SetUp(unittest.TestCase):
    """Packages that are missing, and nobody who is root."""

    def set_up(self, *words: str) -> tuple[int, str, bool]:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            folder.chmod(0o777)
            for program, does in {"dpkg-query": "exit 1", "sudo": f"touch {folder}/sudo_was_called; exit 1"}.items():
                (folder / program).write_text(f"#!/bin/sh\n{does}\n")
                (folder / program).chmod(0o755)
            script = folder / "cmake/setup.sh"
            script.parent.mkdir()
            shutil.copy(SOURCE / "cmake/setup.sh", script)
            done = subprocess.run(
                ["bash", script, *words, "release", "programs"], capture_output=True, text=True, check=False,
                stdin=subprocess.DEVNULL, user=65534 if os.geteuid() == 0 else None,
                env={**os.environ, "PATH": f"{folder}:/usr/bin:/bin", "ROCI_YES": ""},
            )  # fmt: skip
            return done.returncode, done.stderr, (folder / "sudo_was_called").exists()

    def test_it_never_uses_sudo_unasked(self) -> None:
        code, said, called = self.set_up()
        self.assertEqual(code, 3)
        self.assertIn("--yes", said)
        self.assertFalse(called)

    def test_yes_is_the_answer(self) -> None:
        self.assertTrue(self.set_up("--yes")[2])

    def test_the_build_is_told_while_it_goes_on(self) -> None:
        """The stand-in for ninja builds on only when its first line was read."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            builder = f"echo '[1/9] begun'\nuntil [ -e {folder}/seen ]; do sleep 0.01; done\necho 'FAILED: of itself'\nexit 1"
            for program, does in {"dpkg-query": "echo ok installed", "ninja": builder}.items():
                (folder / program).write_text(f"#!/bin/sh\n{does}\n")
                (folder / program).chmod(0o755)
            script = folder / "cmake/setup.sh"
            script.parent.mkdir()
            shutil.copy(SOURCE / "cmake/setup.sh", script)
            (folder / "build/release").mkdir(parents=True)
            (folder / "build/release/build.ninja").touch()
            with subprocess.Popen(
                ["bash", script, "release"], stderr=subprocess.PIPE, text=True,
                env={**os.environ, "PATH": f"{folder}:/usr/bin:/bin"},
            ) as build:  # fmt: skip
                assert build.stderr is not None
                first = build.stderr.readline() if select.select([build.stderr], [], [], LIMIT_S)[0] else ""
                (folder / "seen").touch()
                self.assertEqual(first, "[1/9] begun\n")
                self.assertIn("FAILED: of itself", build.stderr.read())
                self.assertEqual(build.wait(), 1)


if __name__ == "__main__":
    signal.alarm(8 * LIMIT_S)
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
