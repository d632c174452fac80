#!/usr/bin/env python3
"""Tries mutations of mutations.yaml: each changes one line of the code, and a test that passes without it must fail with it.

    mutate.py --rows R5,R22        these rows
    mutate.py --all                every row
    mutate.py --rotate 5           five mutations that change with each commit; the seed is printed
    mutate.py --rotate 5 --seed 7  the five of that seed again

Nothing is changed in the tree. Of a build that stands (--build, build/release if not given) the mutated source alone is
compiled, from a copy and with the command that compiled the original, and the test's program is linked once more with that
object before the libraries; so a mutation costs one compilation and one link. Where a test starts programs, one of these is
linked so, and the test finds it by ROCI_BIN among the others. Mutants lie in BUILD/mutants.

Exit code: 0 if the test of every mutation tried fails with it; 1 if one does not, or if a test fails without a mutation; 2 if
a mutation cannot be tried (its line is not found once, it does not compile, there is no such test).
"""
import argparse
import concurrent.futures
import datetime
import json
import os
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from rows import MUTATIONS, ROOT, find_place, read_mutations

TEST_SECONDS = 300  # as for CTest; a test that has not ended by then has failed
MUTANT_BYTES = 6 << 30  # a mutant that asks for more memory has failed


class Untried(Exception):
    """Why a mutation could not be tried."""


class Build:
    """A build folder of Ninja: how it compiles a source and links a test."""

    def __init__(self, folder):
        self.folder = folder.resolve()
        commands = self.folder / "compile_commands.json"
        if not commands.exists():
            raise SystemExit(f"mutate: {commands} is missing; build first: cmake/setup.sh release all")
        self.compile_of = {}
        self.unity_of = {}  # the source that compiles several others in one go
        for entry in json.loads(commands.read_text()):
            self.compile_of.setdefault(str(Path(entry["file"]).resolve()), []).append(shlex.split(entry["command"]))
            if "/Unity/unity_" in entry["file"]:
                for source in re.findall(r'^#include "(.*)"$', Path(entry["file"]).read_text(), re.M):
                    self.unity_of[str(Path(source).resolve())] = entry["file"]
        cache = (self.folder / "CMakeCache.txt").read_text()
        self.sanitized = re.search(r"^ROCI_SANITIZE:\w+=\S", cache, re.M) is not None
        self.links = {}

    def bring_up_to_date(self, targets):
        subprocess.run(["ninja", "-C", str(self.folder), *targets], check=True, stdout=subprocess.DEVNULL)

    def link_of(self, target, place):
        """The words of the command that links a program; place: tests/ or bin/."""
        if target not in self.links:
            listed = subprocess.run(["ninja", "-C", str(self.folder), "-t", "commands", target], capture_output=True,
                                    text=True, check=True)
            made = [line for line in listed.stdout.splitlines() if f" -o {place}{target} " in line]
            if len(made) != 1:
                raise Untried(f"{target} is not made in {self.folder / place}")
            words = shlex.split(made[0])
            self.links[target] = [word for word in words if word not in (":", "&&")]
        return list(self.links[target])


def run(words, seconds, folder, limited=False, more=None):
    """Exit code and output; a program that does not end in time is ended, with all that it has started, as if it had failed."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MUTANT_BYTES, MUTANT_BYTES))
    process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True, env={**os.environ, **(more or {})},
                               preexec_fn=limit if limited else None)
    try:
        output = process.communicate(timeout=seconds)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return -1, f"not over after {seconds} s"
    return process.returncode, output.decode(errors="replace")


class Mutant:
    """One entry of mutations.yaml, tried in a build."""

    def __init__(self, entry, build, number):
        self.entry = entry
        self.build = build
        self.folder = build.folder / "mutants" / f"{entry['row']}-{number}"
        self.seconds = 0.0

    def try_it(self):
        """'killed', 'survived' or 'unsound' (the test fails without the mutation) with a line of explanation; or raises."""
        begun = time.monotonic()
        try:
            place, fault = find_place(self.entry)
            if fault:
                raise Untried(fault)
            self.folder.mkdir(parents=True, exist_ok=True)
            filter_word = "--gtest_filter=" + self.entry["test"]
            plain = self.build.folder / "tests" / self.entry["target"]
            code, output = run([str(plain), filter_word], TEST_SECONDS, self.folder)
            if code == -1 and output.startswith("not over"):
                raise Untried(f"{self.entry['test']} is {output} without the mutation; name fewer tests")
            if re.search(r"^\[==========\] 0 tests|did not match any test", output, re.M) or "[==========]" not in output:
                raise Untried(f"{self.entry['target']} has no test {self.entry['test']}: {output[-300:]}")
            if code != 0:
                return "unsound", "the test fails without the mutation"
            changed = self.compile(place)
            limited = not self.build.sanitized
            if "program" in self.entry:
                programs = self.programs_with(changed)
                code, output = run([str(plain), filter_word], TEST_SECONDS, self.folder, limited, {"ROCI_BIN": programs})
                shutil.rmtree(programs)
            else:
                mutated = self.link(self.entry["target"], "tests/", changed,
                                    self.folder.with_name(f"{self.folder.name}-{self.entry['target']}"))
                code, output = run([str(mutated), filter_word], TEST_SECONDS, self.folder, limited)
                mutated.unlink()
            at = f"{place.file.relative_to(ROOT)}:{place.number + 1}"
            if code == 0:
                return "survived", f"{at}: {place.mutated.strip()}"
            return "killed", at + ("" if code == 1 else f" ({output})" if code == -1 and len(output) < 60 else
                                   f" (exit code {code})")
        finally:
            self.seconds = time.monotonic() - begun

    def compile(self, place):
        source = self.folder / place.file.name
        source.write_text(place.text())
        unity = self.build.unity_of.get(str(place.file.resolve()))
        if unity:
            together = self.folder / "unity.cxx"
            together.write_text(Path(unity).read_text().replace(f'#include "{place.file.resolve()}"', f'#include "{source}"'))
            source = together
        known = self.build.compile_of.get(str(Path(unity or place.file).resolve()))
        if not known:
            raise Untried(f"{place.file.relative_to(ROOT)} is compiled by nothing; only sources can be mutated")
        words = list(known[0])
        self.original = words[words.index("-o") + 1]
        self.object = self.folder / (place.file.name + ".o")
        words[words.index("-o") + 1] = str(self.object)
        words[words.index("-c") + 1] = str(source)
        words[1:1] = ["-iquote", str(place.file.parent)]
        code, output = run(words + ["-w"], 600, self.build.folder)
        if code != 0:
            raise Untried("the mutated source does not compile: " + output.strip()[-400:])
        return self.object

    def link(self, target, place, changed, program):
        """Links a test or a program with the mutated object, as `program`."""
        words = self.build.link_of(target, place)
        at = words.index("-o")
        words[at + 1] = str(program)
        if self.original in words:
            words[words.index(self.original)] = str(changed)
        else:
            words.insert(at, str(changed))  # before the libraries: the original's place in its archive is not asked for
        code, output = run(words, 600, self.build.folder)
        if code != 0:
            raise Untried("the mutated program does not link: " + output.strip()[-400:])
        return program

    def programs_with(self, changed):
        """A folder with all programs of the build, of which one is mutated; beside it lie its plug-ins."""
        programs = self.folder / "bin"
        shutil.rmtree(programs, ignore_errors=True)
        programs.mkdir()
        for program in (self.build.folder / "bin").iterdir():
            if program.is_file() and program.name != self.entry["program"]:
                os.link(program, programs / program.name)  # a program looks for the others where it stands itself
        plugins = self.folder / "lib"
        if not plugins.is_symlink():
            plugins.symlink_to(self.build.folder / "lib")
        self.link(self.entry["program"], "bin/", changed, programs / self.entry["program"])
        return str(programs)


def commits():
    """How many commits lead here; without git, or in a shallow clone, the number of today."""
    shallow = subprocess.run(["git", "rev-parse", "--is-shallow-repository"], cwd=ROOT, capture_output=True, text=True)
    if shallow.stdout.strip() == "false":
        count = subprocess.run(["git", "rev-list", "--count", "HEAD"], cwd=ROOT, capture_output=True, text=True)
        if count.returncode == 0:
            return int(count.stdout)
    return datetime.date.today().toordinal()


def chosen(entries, arguments):
    if arguments.rows:
        wanted = arguments.rows.split(",")
        unknown = [row for row in wanted if all(entry["row"] != row for entry in entries)]
        if unknown:
            raise SystemExit(f"mutate: no mutation of {', '.join(unknown)}")
        return [entry for entry in entries if entry["row"] in wanted]
    if arguments.all:
        return entries
    seed = commits() if arguments.seed is None else arguments.seed
    print(f"{min(arguments.rotate, len(entries))} of {len(entries)} mutations, by seed {seed} "
          f"(again: tests/requirements/mutate.py --rotate {arguments.rotate} --seed {seed})", flush=True)
    first = seed * arguments.rotate
    return [entries[(first + i) % len(entries)] for i in range(min(arguments.rotate, len(entries)))]


def attempt(mutant):
    try:
        return mutant.try_it()
    except Untried as fault:
        return "untried", str(fault)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    which = parser.add_mutually_exclusive_group(required=True)
    which.add_argument("--rows", help="names of rows, separated by commas")
    which.add_argument("--all", action="store_true")
    which.add_argument("--rotate", type=int, metavar="N")
    parser.add_argument("--seed", type=int, help="of --rotate; the number of commits if not given")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "release")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--as-built", action="store_true", help="do not bring tests and programs up to date first")
    arguments = parser.parse_args()
    entries = [entry for entry in read_mutations(MUTATIONS.read_text()) if "none" not in entry]
    tried = chosen(entries, arguments)
    build = Build(arguments.build)
    begun = time.monotonic()
    if not arguments.as_built:
        build.bring_up_to_date(sorted({entry[key] for entry in tried for key in ("target", "program") if key in entry}))
    mutants = [Mutant(entry, build, number) for number, entry in enumerate(tried)]
    counts = {"killed": 0, "survived": 0, "unsound": 0, "untried": 0}
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for mutant, (verdict, words) in zip(mutants, pool.map(attempt, mutants)):
            counts[verdict] += 1
            row, test = mutant.entry["row"], mutant.entry["test"]
            print(f"{row:5} {verdict:9} {mutant.seconds:5.1f} s  {test}  {words}", flush=True)
    print(f"{counts['killed']} of {len(tried)} killed in {time.monotonic() - begun:.0f} s")
    return 2 if counts["untried"] else 1 if counts["survived"] or counts["unsound"] else 0


if __name__ == "__main__":
    sys.exit(main())
