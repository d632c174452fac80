"""The launcher of one host in a flight: started, killed, gone on with, and what it said at its end."""

import json
import os
import signal
import subprocess
from pathlib import Path
from threading import Lock

FAKETIME = next(iter(sorted(Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))), None)


def children(parent: int) -> list[int]:
    found = []
    for task in Path(f"/proc/{parent}/task").glob("*/children"):
        try:
            found += [int(pid) for pid in task.read_text().split()]
        except OSError:
            pass
    return found


def words_of(pid: int) -> list[str]:
    try:
        return Path(f"/proc/{pid}/cmdline").read_text().split("\0")
    except OSError:
        return []


def send(pid: int | None, number: int) -> bool:
    try:
        if pid:
            os.kill(pid, number)
        return bool(pid)
    except ProcessLookupError:
        return False


class Launcher:
    def __init__(self, host: str, run_folder: Path, command: list[str], resume: list[str], log: Path):
        self.host, self.run_folder, self.command, self.resume, self.log = host, run_folder, command, resume, log
        self.process: subprocess.Popen | None = None
        self.lock = Lock()
        self.starting = False  # it was killed and is to be started again

    def start(self, command: list[str] | None = None) -> None:
        with open(self.log, "a") as log, open(self.log.with_suffix(".out"), "a") as out:
            self.process = subprocess.Popen(command or self.command, stdin=subprocess.DEVNULL, stdout=out, stderr=log)

    def ended(self) -> bool:
        with self.lock:
            return not self.starting and self.process.poll() is not None

    def kill(self) -> bool:
        """By kill -9, and its services with it; go_on() is to follow."""
        with self.lock:
            if self.starting or self.process.poll() is not None:
                return False
            self.starting = True
            self.process.kill()
            self.process.wait()
            return True

    def go_on(self) -> None:
        with self.lock:
            self.start(self.resume)
            self.starting = False

    def service(self, name: str) -> int | None:
        """The process of a service, or of the second one of a pair (NAME.standby)."""
        program, _, second = name.partition(".")
        for pid in children(self.process.pid):
            words = words_of(pid)
            if not words or Path(words[0]).name != program:
                continue
            member = words[words.index("--pair") + 1] if "--pair" in words else "first"
            if member == ("second" if second else "first"):
                return pid
        return None

    def end(self, patience_s: float) -> None:
        """Asks it to end; whoever does not is killed, and has no exit code of its own then."""
        try:
            if self.process.poll() is None:
                self.process.send_signal(signal.SIGTERM)
            self.process.wait(patience_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def exit_code(self) -> int:
        return self.process.returncode

    def summary(self) -> dict:
        try:
            return json.loads(self.log.with_suffix(".out").read_text().strip().splitlines()[-1])
        except (OSError, ValueError, IndexError):
            return {}
