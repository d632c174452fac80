#!/usr/bin/env python3
"""names.py ROOT: the mission of docs/tutorial.md is flown by the same binaries as ours (scenario_tutorial), and no line of them knows
it: the names that its domain and its mission file declare stand as words in no source file. Exit code 0: so it is."""
import pathlib
import re
import sys

BLOCK = re.compile(r"^```\w+\n(?:#|;) (\w[\w./-]*/[\w.-]+)\n(.*?)^```$", re.M | re.S)
SOURCES = [".cpp", ".hpp", ".idl", ".sh", ".cmake"]
PARTS = ["core", "services", "planner_svc", "exec_svc", "pathplan_svc", "dedicated_svc", "arm_svc", "science_svc", "sim_svc", "ground_console",
         "rehearsal", "idl", "cmake", "example_service"]


def names_of(text):
    """What the first blocks that declare a domain and a mission name; later ones add parts that ours have, too."""
    files = {}
    for name, body in BLOCK.findall(text):
        files.setdefault(pathlib.Path(name).name, body)
    domain, mission = files["domain.pddl"], files["mission.yaml"]
    out = set(re.findall(r"\(domain ([\w-]+)\)", domain)) | set(re.findall(r"\(:durative-action ([\w-]+)", domain))
    predicates = domain[domain.index("(:predicates"):domain.index("(:durative-action")]
    out |= set(re.findall(r"\(([\w-]+)", predicates))
    out |= set(re.search(r"\(:types ([^)]*)\)", domain)[1].split()) - {"-", "object"}
    out |= set(re.findall(r"robots: \[([\w-]+)", mission)) | set(re.findall(r"^name: ([\w-]+)", mission, re.M))
    out |= set(re.findall(r"^  - name: ([\w-]+)", mission, re.M))
    return out


def main():
    root = pathlib.Path(sys.argv[1])
    names = names_of((root / "docs" / "tutorial.md").read_text(encoding="utf-8"))
    if len(names) < 6:
        print(f"only these names were found in docs/tutorial.md: {sorted(names)}; correct names.py")
        return 1
    faults = 0
    word = re.compile(r"(?<![\w-])(" + "|".join(sorted(map(re.escape, names), key=len, reverse=True)) + r")(?![\w-])")
    for part in PARTS:
        for file in sorted((root / part).rglob("*")):
            if file.suffix not in SOURCES or not file.is_file():
                continue
            for number, line in enumerate(file.read_text(encoding="utf-8", errors="replace").splitlines(), 1):
                if found := word.search(line):
                    print(f"{file}:{number}: '{found[1]}' is a name of the tutorial's mission; choose another one")
                    faults += 1
    print(f"{len(names)} names ({', '.join(sorted(names))}), {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
