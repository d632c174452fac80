"""Flies one seed, in mount, network and process namespaces of its own (run.py makes them); prints one JSON record.

flight.py SEED BIN MISSION FOLDER SPEED secure|plain: FOLDER is empty; what is in it afterwards is all that the flight left.
With `plain` a seed that draws a secured flight flies plainly."""

import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from threading import Event, Thread

from draw import Draw, draw
from faults import Faults
from ground import Ground
from hosts import Hosts
from judge import judge, read_effects
from launcher import FAKETIME, Launcher, children
from mission import make_mission

LONGEST_S = 240.0  # of wall time until the scenario's time is up
GRACE_S = 90.0  # then the campaign ends it, and that is a fault
DISK = "24m"
PROMPT_S = 40.0  # a launcher that is asked to end


def vendor_of(draw: Draw, host: str) -> str:
    """Of a launcher; in a mixed run over three hosts the second one is on the other vendor."""
    if draw.dds != "mixed" or draw.hosts == 1:
        return draw.dds
    return "cyclonedds" if host == "second" else "fastdds"


class Flight:
    def __init__(self, draw: Draw, bin: Path, mission: Path, folder: Path, speed: float, secure: bool):
        self.draw, self.bin, self.folder, self.speed = draw, bin, folder, speed
        self.scenario_goals = make_mission(mission, folder / "mission", draw.samples, speed, LONGEST_S)
        self.secure = self.make_keys() if secure and draw.secured else []
        subprocess.run(["mount", "-t", "tmpfs", "tmpfs", "/dev/shm"], check=True)  # libfaketime names things by process ids
        self.hosts = Hosts(list(draw.placed()))
        self.over = Event()
        self.run_name = f"campaign-{draw.seed}"
        self.effects = folder / "effects.jsonl"
        self.effects.touch()
        self.launchers = {host: self.launcher(host, services) for host, services in draw.placed().items()}

    def make_keys(self) -> list[str]:
        """Of this flight alone; all hosts share the folder."""
        keys = self.folder / "keys"
        subprocess.run([self.bin / "roci-keys", "make", self.folder / "mission", "--keys", keys], check=True,
                       stdout=subprocess.DEVNULL)
        return [f"--secure={keys}"]

    def launcher(self, host: str, services: list[str]) -> Launcher:
        run_folder = self.folder / host
        run_folder.mkdir(mode=0o700)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK},mode=700", "tmpfs", run_folder], check=True)
        if host == "robot":
            # What really happens is written beside the disk that fills up.
            (run_folder / "effects.jsonl").symlink_to(self.effects)
        (self.folder / f"{host}.clock").write_text("+0\n")
        (self.folder / f"{host}.runtime").mkdir(mode=0o700)
        program = self.environment(host) + [str(self.bin / "roci-launch")]
        words = [str(self.folder / "mission"), "--scenario", "campaign", "--dds", vendor_of(self.draw, host), "--run", self.run_name,
                 "--seed", str(self.draw.seed), "--clock", "live", "--speed", f"{self.speed:g}", "--run-folder", str(run_folder),
                 *self.hosts.network(host), *self.secure]
        words += ["--services", ",".join(services)] if services else []
        words += ["--standby"] if self.draw.standby else []
        common = ["--headless", "--json"]
        return Launcher(host, run_folder, self.hosts.on(host, [*program, *words, *common]),
                        self.hosts.on(host, [*program, "--resume", str(run_folder), *common]), self.folder / f"{host}.log")

    def environment(self, host: str) -> list[str]:
        out = ["env", f"XDG_RUNTIME_DIR={self.folder / f'{host}.runtime'}"]
        if any(fault.kind == "clock" and fault.what == host for fault in self.draw.faults) and FAKETIME:
            out += [f"LD_PRELOAD={FAKETIME}", f"FAKETIME_TIMESTAMP_FILE={self.folder / f'{host}.clock'}", "FAKETIME_NO_CACHE=1",
                    "FAKETIME_DONT_FAKE_MONOTONIC=1", "DONT_FAKE_MONOTONIC=1"]
        return out

    def mission_time(self) -> float:
        """As the robot counts it: its launcher has anchored mission time 0."""
        if not hasattr(self, "epoch_s"):
            self.epoch_s = json.loads((self.folder / "robot/launch.json").read_text())["epoch_unix_us"] / 1e6
        return (time.time() - self.epoch_s) * self.speed

    def wait_for_first_effect(self) -> float:
        end = time.monotonic() + 40
        while time.monotonic() < end and not self.launchers["robot"].ended() and self.effects.stat().st_size == 0:
            time.sleep(0.05)
        return time.monotonic()

    def fly(self) -> dict:
        begun = time.monotonic()
        for launcher in self.launchers.values():
            launcher.start()
        start = self.wait_for_first_effect()
        vendor = "fastdds" if self.draw.dds == "fastdds" else "cyclonedds"
        tests = self.bin.parent / "tests"
        faults = Faults(self.draw, self.hosts, self.launchers, self.over, tests, vendor, self.run_name)
        roci = self.hosts.on(self.draw.ground, ["env", f"XDG_RUNTIME_DIR={self.folder / f'{self.draw.ground}.runtime'}",
                                                str(self.bin / "roci"), "--dds", vendor, *self.hosts.network(self.draw.ground),
                                                *self.secure])
        ground = Ground(roci, self.over, self.mission_time)
        threads = [Thread(target=faults.run, args=(fault, start)) for fault in self.draw.faults]
        threads += [Thread(target=ground.run, args=(wish, start)) for wish in self.draw.wishes]
        for thread in threads:
            thread.start()
        robot = self.launchers["robot"]
        while not robot.ended() and time.monotonic() < begun + LONGEST_S + GRACE_S:
            time.sleep(0.1)
        watchdog = not robot.ended()
        if watchdog:
            self.note_who_hangs()
        flown_s = time.monotonic() - begun
        self.over.set()
        for thread in threads:
            thread.join()
        for launcher in self.launchers.values():
            launcher.end(PROMPT_S if not watchdog else 10)
        return self.record(faults, ground, watchdog, flown_s)

    def note_who_hangs(self) -> None:
        with open(self.folder / "hanging", "w") as out:
            for launcher in self.launchers.values():
                for pid in [launcher.process.pid, *children(launcher.process.pid)]:
                    for name in ("comm", "wchan", "status"):
                        try:
                            out.write(f"{launcher.host} {pid} {name}: {Path(f'/proc/{pid}/{name}').read_text()}\n")
                        except OSError:
                            pass

    def keep(self) -> None:
        """Run folders end with the mounts of this process; what is to be looked at is copied out of them."""
        for host in self.launchers:
            shutil.copytree(self.folder / host, self.folder / "kept" / host, symlinks=True)

    def record(self, faults: Faults, ground: Ground, watchdog: bool, flown_s: float) -> dict:
        summaries = {host: launcher.summary() for host, launcher in self.launchers.items()}
        flight = {"exits": {host: launcher.exit_code() for host, launcher in self.launchers.items()}, "summaries": summaries,
                  "answers": ground.answers, "scenario_goals": sorted(self.scenario_goals), "watchdog": watchdog,
                  "time_up": flown_s >= LONGEST_S}
        led = [(summary.get("epoch", 0), host) for host, summary in summaries.items() if "journal" in summary]
        final = None
        if led:
            host = max(led)[1]
            final = self.folder / host / summaries[host]["journal"]
        journals = [file for host in self.launchers for file in (self.folder / host).glob("**/journal.sqlite")]
        verdict = judge(flight, read_effects(self.effects), final, journals, self.speed)
        result = summaries[max(led)[1]]["result"] if led else ""
        return {"seed": self.draw.seed, "draw": self.draw.as_json(), "secured": bool(self.secure), "result": result,
                "flown_s": round(flown_s, 1), "faults": faults.done, "time_up": flight["time_up"], "exits": flight["exits"],
                "answers": ground.answers, **verdict}


def main() -> None:
    seed, bin, mission, folder, speed, secure = sys.argv[1:]
    os.chdir(folder)
    flight = Flight(draw(int(seed)), Path(bin), Path(mission), Path(folder), float(speed), secure == "secure")
    record = flight.fly()
    if record["violations"] or record["time_up"] or "ROCI_CAMPAIGN_KEEP" in os.environ:
        flight.keep()
    print(json.dumps(record))


if __name__ == "__main__":
    main()
