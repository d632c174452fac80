#!/usr/bin/env python3
"""messages.py ROOT: each message that docs/troubleshooting.md has as a heading stands in the code.

An ellipsis in the heading stands for any text; what is between two of them must stand, in that order, in the literals of one
statement. Adjacent literals of C++ count as one. Exit code 0: all are found.
"""
import pathlib
import re
import sys

HEADING = re.compile(r"^### `(.+)`$", re.M)
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
TAIL = 700  # characters of source in which a message is put together


def code_of(root):
    """The literals of each file as one text; what stands between them is one blank line, or nothing between adjacent ones."""
    texts = []
    for folder in ("core", "services", "planner_svc", "exec_svc", "pathplan_svc", "dedicated_svc", "arm_svc", "science_svc", "sim_svc",
                   "ground_console", "rehearsal", "cmake"):
        for file in sorted((root / folder).rglob("*")):
            if file.suffix == ".sh":
                texts.append(file.read_text(encoding="utf-8"))
            elif file.suffix in (".cpp", ".hpp"):
                source = "\n".join(re.sub(r"^\s*(//.*|#include.*)$", "", line) for line in file.read_text(encoding="utf-8").split("\n"))
                text, end = "", None
                for found in LITERAL.finditer(source):
                    between = "" if end is None else source[end:found.start()]
                    text += ("" if between.strip() == "" else "\n\n") + found[1].replace('\\"', '"')
                    end = found.end()
                texts.append(text)
    return texts


def found(message, texts):
    parts = [part.strip() for part in message.split("…") if part.strip(" .,;:")]
    for text in texts:
        begin = text.find(parts[0])
        while begin >= 0:
            at = begin
            for part in parts:
                at = text.find(part, at)
                if at < 0 or at - begin > TAIL:
                    break
                at += len(part)
            else:
                return True
            begin = text.find(parts[0], begin + 1)
    return False


def main():
    root = pathlib.Path(sys.argv[1])
    page = root / "docs/troubleshooting.md"
    messages = HEADING.findall(page.read_text(encoding="utf-8"))
    texts = code_of(root)
    missing = [message for message in messages if not found(message, texts)]
    if found("a message that … nobody prints", texts) or len(messages) < 20:
        missing.append("(this test finds whatever it is asked for, or too little is asked)")
    for message in missing:
        print(f"{page}: the code has no such message: {message}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
