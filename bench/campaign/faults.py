"""What goes wrong in a flight, each in a thread of its own; whatever lasts ends with the flight."""

import errno
import os
import signal
import subprocess
import time
from pathlib import Path

from draw import Draw, Fault, host_of
from launcher import send

# What the docs say changes nothing: queries and commands in a far epoch, heartbeats in a far incarnation, repetition.
INTRUDER = """send query sim_svc nav drive x 1000000 1000000
send execute sim_svc nav drive y 1000000 1000000
beat sim_svc 4000000000 1
repeat 1.5
"""


class Faults:
    def __init__(self, draw: Draw, hosts, launchers: dict, over, tests: Path, vendor: str, run: str):
        self.draw, self.hosts, self.launchers, self.over = draw, hosts, launchers, over
        self.tests, self.vendor, self.run_name = tests, vendor, run
        self.done: list[dict] = []

    def run(self, fault: Fault, start: float) -> None:
        if self.over.wait(max(0.0, start + fault.at_s - time.monotonic())):
            return
        entry = {"kind": fault.kind, "text": fault.text(), "done": False}
        self.done.append(entry)
        try:
            entry["done"] = bool(getattr(self, fault.kind)(fault))
        except (OSError, subprocess.SubprocessError) as error:
            entry["error"] = str(error)

    def kill(self, fault: Fault) -> bool:
        return send(self.launchers[host_of(self.draw, fault.what)].service(fault.what), signal.SIGKILL)

    def hang(self, fault: Fault) -> bool:
        pid = self.launchers[host_of(self.draw, fault.what)].service(fault.what)
        if not send(pid, signal.SIGSTOP):
            return False
        self.over.wait(fault.for_s)
        send(pid, signal.SIGCONT)
        return True

    def launcher(self, fault: Fault) -> bool:
        killed = self.launchers[fault.what]
        if not killed.kill():
            return False
        time.sleep(fault.for_s)
        killed.go_on()
        return True

    def cut(self, fault: Fault) -> bool:
        self.hosts.part(fault.what, True)
        self.over.wait(fault.for_s)
        self.hosts.part(fault.what, False)
        return True

    def cable(self, fault: Fault) -> bool:
        self.hosts.unplug(fault.what, True)
        self.over.wait(fault.for_s)
        self.hosts.unplug(fault.what, False)
        return True

    def disk(self, fault: Fault) -> bool:
        full = self.launchers[fault.what].run_folder / "fill"
        end = time.monotonic() + fault.for_s
        descriptor = os.open(full, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
        try:
            while time.monotonic() < end and not self.over.is_set():
                for size in (1 << 20, 4096, 1):
                    try:
                        while os.write(descriptor, bytes(size)) == size:
                            pass
                    except OSError as error:
                        if error.errno != errno.ENOSPC:
                            raise
                self.over.wait(0.05)
        finally:
            os.close(descriptor)
            full.unlink()
        return True

    def clock(self, fault: Fault) -> bool:
        file = self.launchers[fault.what].run_folder.parent / f"{fault.what}.clock"
        new = file.with_suffix(".new")
        new.write_text(f"{fault.for_s:+.3f}\n")
        new.rename(file)
        return True

    def hostile(self, fault: Fault) -> bool:
        if fault.what == "intruder":
            words, lines = [self.tests / "intruder", self.vendor, "7", self.run_name], INTRUDER
        elif fault.what == "inject":
            words, lines = [self.tests / "contract-hostile", "inject", "7", str(self.draw.seed), "1000000"], None
        else:
            words, lines = [self.tests / "contract-hostile", "writers", "7"], None
        hostile = subprocess.Popen([str(word) for word in words], text=True, stdin=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if lines:
            hostile.stdin.write(lines)
            hostile.stdin.close()
        self.over.wait(fault.for_s)
        early = hostile.poll()
        hostile.kill()
        hostile.wait()
        return early in (None, 0)
