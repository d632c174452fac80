"""./run in a tree of its own, for tests that look at what it does: the programs of a build, and in the place of the set-up a stand-in
that only notes that it was called.
"""

from __future__ import annotations

import os
import shutil
import tempfile
import unittest
from pathlib import Path


class RunTree:
    """Lays the tree out and removes it after the test. What ./run keeps of its runs stays in it, too."""

    def __init__(self, test: unittest.TestCase, source: Path, programs: Path) -> None:
        self.root = Path(tempfile.mkdtemp())
        test.addCleanup(shutil.rmtree, self.root)
        self.run = self.root / "run"
        shutil.copy(source / "run", self.run)
        self.called = self.root / "called"  # a line for each call of the set-up; missing: there was none
        (self.root / "cmake").mkdir()
        write_program(self.root / "cmake/setup.sh", f"echo set-up $* >>{self.called}")
        self.bin = self.root / "build/release/bin"
        self.bin.mkdir(parents=True)
        for program in programs.iterdir():
            (self.bin / program.name).symlink_to(program)
        self.state = self.root / "state"
        self.environment = {**os.environ, "XDG_STATE_HOME": str(self.state), "XDG_RUNTIME_DIR": str(self.root)}

    def stand_in(self, program: str, does: str) -> None:
        """Puts a shell script in the place of one of the programs."""
        (self.bin / program).unlink()
        write_program(self.bin / program, does)


def write_program(file: Path, does: str) -> None:
    file.write_text(f"#!/bin/sh\n{does}\n")
    file.chmod(0o755)
