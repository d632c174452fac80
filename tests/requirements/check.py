#!/usr/bin/env python3
"""Holds docs/requirements.md and mutations.yaml against the tree: every row is there, every file and every test that a row
names exists, every built row has a mutation whose line is found once, and every test that any page names exists, in whatever form
the pages of promises name them. Builds nothing.

    check.py            lists what is wrong; exit code 0 if nothing is
    check.py --mend     first writes what has moved, where it is clear: a test that stands elsewhere or under another suite, a
                        file that stands in another folder or holds the line of the row's mutation
"""
import argparse
import re
import subprocess
import sys

from rows import (MUTATIONS, NUMBER_BEYOND, NUMBER_OF_READINGS, NUMBER_OF_ROWS, ROOT, STATES, TABLE, find_place, read_mutations,
                  read_rows)


def tracked_files():
    """All files of the project: what git knows, or, in an exported tree, all but the build folders."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            capture_output=True, text=True)
    if listed.returncode == 0:
        return [line for line in listed.stdout.splitlines() if (ROOT / line).is_file()]
    return [str(path.relative_to(ROOT)) for path in ROOT.rglob("*") if path.is_file() and "build" not in path.parts]


def declares(text, name):
    """Does a file declare the test? 'Suite.Name' in C++, else a name that CMake or Python gives."""
    if "." in name:
        suite, _, test = name.partition(".")
        return re.search(rf"^TEST(_F|_P)?\(\s*{re.escape(suite)},\s*{re.escape(test)}\)", text, re.M) is not None
    return re.search(rf"(NAME {re.escape(name)}\b|def {re.escape(name)}\()", text) is not None


def names_of(text):
    """All tests of a C++ file, as Suite.Name."""
    return [f"{suite}.{test}" for suite, test in re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)", text, re.M)]


class Tree:
    def __init__(self):
        self.files = tracked_files()
        self.texts = {}
        self.tests = {}
        for file in self.files:
            if not re.match(r"(tests|bench)/.*(\.cpp|\.py|CMakeLists\.txt)$", file):
                continue
            self.texts[file] = (ROOT / file).read_text()
            for name in names_of(self.texts[file]):
                self.tests.setdefault(name, []).append(file)

    def has_path(self, path):
        return path in self.files or any(file.startswith(path.rstrip("/") + "/") for file in self.files)

    def fault_of_file(self, path):
        """Nothing, or what is wrong, and where the file stands now if that is clear."""
        if self.has_path(path):
            return "", None
        same = [file for file in self.files if file.rsplit("/", 1)[-1] == path.rsplit("/", 1)[-1]]
        return f"{path} does not exist", same[0] if len(same) == 1 else None

    def names_program(self, program):
        lists = [file for file in self.files if file.endswith("CMakeLists.txt")]
        return any(re.search(rf"roci_program\(\s*NAME {re.escape(program)}\s", (ROOT / file).read_text()) for file in lists)

    def fault_of_test(self, file, name):
        if file in self.texts and declares(self.texts[file], name):
            return "", None
        what = f"{file} has no test {name}" if file in self.files else f"{file} does not exist (test {name})"
        return what, self.successor_of(name)

    def successor_of(self, name):
        """Where a test stands now, as 'file: Suite.Name': under its name, or under another suite if that is the only one
        with a test so called; None if that is not clear."""
        wanted = [known for known in self.tests if known == name] or [
            known for known in self.tests if known.partition(".")[2] == name.partition(".")[2]]
        places = [f"{file}: {known}" for known in wanted for file in self.tests[known]]
        return places[0] if len(places) == 1 else None

    def runs(self, gtest_filter):
        """Does one part of a filter name a test of the tree? Instances and parameters (around slashes) are left out."""
        match = re.fullmatch(r"(?:[^/.]*/)?([^/.]+\.[^/]+?)(?:/.*)?", gtest_filter)
        wanted = re.escape(match[1]).replace(r"\*", ".*") if match else "-"
        return any(re.fullmatch(wanted, name) for name in self.tests)


def check_rows(rows, tree, moved, place_of_row):
    faults = []
    names = [row.name for row in rows]
    for wanted in [f"R{n}" for n in range(1, NUMBER_OF_ROWS + 1)] + [f"B{n}" for n in range(1, NUMBER_BEYOND + 1)] + [f"Z{n}" for n in range(1, NUMBER_OF_READINGS + 1)]:
        if names.count(wanted) != 1:
            faults.append(f"row {wanted} stands {names.count(wanted)} times")
    for row in rows:
        where = f"{TABLE.name}:{row.line_number}: {row.name}"
        if not row.name.startswith("Z"):
            if row.state not in STATES:
                faults.append(f"{where}: the state is '{row.state}'; expected one of {', '.join(STATES)}")
            if not row.section or not row.asks:
                faults.append(f"{where}: section or requirement is missing")
            if row.state == "built" and not row.tests:
                faults.append(f"{where}: is called built, but names no test")
            if row.state == "built" and not row.files:
                faults.append(f"{where}: is called built, but names no file of the code")
        for path in row.files:
            fault, now = tree.fault_of_file(path)
            if fault:
                only = place_of_row.get(row.name) if len(row.files) == 1 else None
                now = only or now
                faults.append(f"{where}: {fault}" + (f"; {now} does" if now else ""))
                moved.setdefault(path, now)
        for file, name in row.tests:
            fault, now = tree.fault_of_test(file, name)
            if fault:
                faults.append(f"{where}: {fault}" + (f"; perhaps it is {now}" if now else ""))
                moved.setdefault(f"{file}: {name}", now)
    return faults


def check_mutations(rows, entries, tree):
    faults = []
    by_name = {row.name: row for row in rows}
    targets = set(re.findall(r"NAME (\w[\w-]*)", "\n".join(text for file, text in tree.texts.items()
                                                            if file.endswith("CMakeLists.txt"))))
    for entry in entries:
        row = entry.get("row", "?")
        where = f"{MUTATIONS.name}:{entry['line']}: {row}"
        if row not in by_name:
            faults.append(f"{where}: {TABLE.name} has no such row")
        if "none" in entry:
            if set(entry) != {"line", "row", "none"} or not entry["none"]:
                faults.append(f"{where}: an entry with 'none' gives a reason and nothing else")
            continue
        given = set(entry) - {"line", "program"}
        if given not in ({"row", "file", key, "after", "target", "test"} for key in ("before", "match")):
            faults.append(f"{where}: an entry has row, file, before or match, after, target, test"
                          f" and perhaps program; it has {sorted(given)}")
            continue
        fault = find_place(entry)[1]
        if fault:
            faults.append(f"{where}: {fault}")
        if entry["target"] not in targets:
            faults.append(f"{where}: no CMakeLists.txt below tests/ names a target {entry['target']}")
        if "program" in entry and not tree.names_program(entry["program"]):
            faults.append(f"{where}: no CMakeLists.txt names a program {entry['program']}")
        for one in entry["test"].split(":"):
            if not tree.runs(one):
                faults.append(f"{where}: there is no test {one}")
    covered = {entry.get("row") for entry in entries}
    for row in rows:
        if row.state == "built" and not row.name.startswith("Z") and row.name not in covered:
            faults.append(f"{row.name} is called built, but {MUTATIONS.name} has no mutation of it and no reason for none")
    return faults


def check_pages(tree):
    """Every test that a page of the project names in backticks exists: `Suite.Name`, `Suite.*` or `some_test`."""
    faults = []
    basenames = {file.rsplit("/", 1)[-1].rsplit(".", 1)[0] for file in tree.files}
    suites = {name.split(".")[0] for name in tree.tests}
    for page in (file for file in tree.files if file.endswith(".md")):
        for number, line in enumerate((ROOT / page).read_text().splitlines(), 1):
            for name in re.findall(r"`([A-Z]\w+\.(?:[A-Z]\w+|\*)|[a-z][a-z_]*_test)`", line):
                suite = name.split(".")[0]
                known = name in tree.tests or name in basenames or (name.endswith(".*") and suite in suites)
                if not known:
                    faults.append(f"{page}:{number}: there is no test {name}")
    return faults


PROMISES = ("docs/resilience.md", "docs/threats.md", "docs/dds.md")


def programs_of(tree):
    """The names of CTest's tests, by the CMakeLists.txt that give them."""
    lists = "\n".join(text for file, text in tree.texts.items() if file.endswith("CMakeLists.txt"))
    lists += (ROOT / "cmake/Parts.cmake").read_text()
    return set(re.findall(r"(?:roci_test|add_test)\(\s*NAME\s+([\w-]+)", lists))


def pattern_of(name):
    """A name in which … and * stand for anything, as a regular expression."""
    return re.escape(name).replace("…", r"\w*").replace(r"\*", r"\w*")


def check_promises(tree):
    """Every test that the pages of promises name exists: programs of CTest (`unit_services`, `scenario_cut_*`), and what stands
    in parentheses behind one: suites (`CrashTest`), tests with or without their suite (`Lease.*`, `ATestWith…`), or files. A test
    that stands alone in a cell is named with its suite (`Hostile.SocketsAreBound…`)."""
    faults = []
    programs = programs_of(tree)
    suites = {name.split(".")[0] for name in tree.tests}
    short = {name.split(".")[1] for name in tree.tests}
    bases = {file.rsplit("/", 1)[-1].rsplit(".", 1)[0] for file in tree.files}
    known = suites | short | set(tree.tests) | bases

    def exists(name, among):
        pattern = re.compile(pattern_of(name))
        return any(pattern.fullmatch(one) for one in among)

    for page in PROMISES:
        text = (ROOT / page).read_text()

        def fault(place, name):
            faults.append(f"{page}:{text.count(chr(10), 0, place) + 1}: there is no test {name}")

        for match in re.finditer(r"`((?:unit|contract|scenario|fuzz|architecture|requirements)_[\w*]+)`(?:[ \n]\(([^)]*)\))?", text):
            if not exists(match[1], programs | bases):
                fault(match.start(), match[1])
            for name in re.findall(r"`(…?[A-Z][\w.*…]+)`", match[2] or ""):
                if not exists(name, known):
                    fault(match.start(), name)
        for match in re.finditer(r"`([A-Z]\w+\.[A-Z][\w*…]*|…[A-Z]\w+…?)`", text):
            of_a_suite = match[1].split(".")[0] in suites
            if (of_a_suite or match[1].startswith("…")) and not exists(match[1], set(tree.tests) | short):
                fault(match.start(), match[1])
    return faults


def places_of(entries):
    """By row, the file in which its mutation is found."""
    found = {entry["row"]: find_place(entry)[0] for entry in entries if "file" in entry}
    return {row: str(place.file.relative_to(ROOT)) for row, place in found.items() if place}


def mend(moved):
    """Writes what has moved into the table, and suites with another name into the mutations' filters."""
    table, mutations = TABLE.read_text(), MUTATIONS.read_text()
    for old, new in moved.items():
        if not new:
            continue
        table = table.replace(f"`{old}`", f"`{new}`")
        if ": " in old:
            before, after = (name.split(": ")[1].split(".")[0] for name in (old, new))
            mutations = re.sub(rf"(?m)^(  test: .*?)(?<!\w){before}\.", rf"\g<1>{after}.", mutations)
    TABLE.write_text(table)
    MUTATIONS.write_text(mutations)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mend", action="store_true", help="write new paths of what has moved")
    arguments = parser.parse_args()
    tree = Tree()
    entries = read_mutations(MUTATIONS.read_text())
    moved = {}
    faults = check_rows(read_rows(TABLE.read_text()), tree, moved, places_of(entries))
    if arguments.mend:
        mend(moved)
        entries = read_mutations(MUTATIONS.read_text())
        faults = check_rows(read_rows(TABLE.read_text()), tree, {}, {})
    rows = read_rows(TABLE.read_text())
    faults += check_mutations(rows, entries, tree)
    faults += check_pages(tree)
    faults += check_promises(tree)
    for fault in faults:
        print(fault)
    count = {state: sum(row.state == state and row.name.startswith("R") for row in rows) for state in STATES}
    mutants = sum("none" not in entry for entry in entries)
    print(f"{count['built']} rows built, {count['partly']} partly, {count['open']} open; {mutants} mutations; "
          f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
