#!/usr/bin/env python3
"""tutorial.py PAGE[#HEADING] … [--install BUILD | --bin FOLDER] [--least FILES BLOCKS]: writes and runs every block of the pages (of a page's
section, down to the next heading of its level), one after the other, in a folder of its own; with the programs of BUILD, installed there, or of
FOLDER, else with those of $PREFIX. Home and runtime folders are its own, too.

A block that begins with a comment that names a file is written to that file; a block of `sh` is run by bash, which ends with the
first command that fails. A block of `text` is what the block before it prints: each of its lines comes in its output, where … stands
for anything. Variables and the current folder are those of the block before. Exit code 0: everything ran, and at least so many files were written
and blocks run (8 of each unless said otherwise).
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)
FILE = re.compile(r"(?:#|;|//) (\w[\w./-]*/[\w.-]+)\n")
STATE = "declare -p PREFIX PATH > .state 2>/dev/null; pwd > .folder"


def blocks_of(page):
    """File, line, language and text of each block."""
    name, _, heading = page.partition("#")
    text = pathlib.Path(name).read_text(encoding="utf-8")
    begin, end = 0, len(text)
    if heading:
        found = re.search(rf"^(#+) {re.escape(heading)}$", text, re.M)
        if not found:
            sys.exit(f"{name} has no heading '{heading}'")
        begin = found.end()
        following = re.search(rf"^{found[1]} ", text[begin:], re.M)
        end = begin + following.start() if following else end
    return [(name, text.count("\n", 0, found.start()) + 1, *found.groups()) for found in BLOCK.finditer(text) if begin <= found.start() < end]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("pages", nargs="+", metavar="PAGE[#HEADING]")
    parser.add_argument("--install", metavar="BUILD")
    parser.add_argument("--bin", metavar="FOLDER")
    parser.add_argument("--least", type=int, nargs=2, default=(8, 8), metavar=("FILES", "BLOCKS"))
    options = parser.parse_args()
    blocks = [block for page in options.pages for block in blocks_of(page)]
    ran = written = 0
    with tempfile.TemporaryDirectory(prefix="roci_tutorial_") as folder:
        root = pathlib.Path(folder)
        environment = dict(os.environ, HOME=f"{folder}/home", XDG_RUNTIME_DIR=f"{folder}/runtime", CMAKE_BUILD_PARALLEL_LEVEL="2")
        for own in ("home", "runtime"):
            (root / own).mkdir(mode=0o700)
        if options.install:
            environment["PREFIX"] = f"{folder}/prefix"
            subprocess.run(["cmake", "--install", options.install, "--prefix", environment["PREFIX"]], check=True, stdout=subprocess.DEVNULL)
        if options.bin:
            environment.update(PATH=f"{options.bin}:{environment['PATH']}", PREFIX=str(pathlib.Path(options.bin).parent))
        before = "set -euo pipefail"
        printed = ""
        for page, line, language, body in blocks:
            named = FILE.match(body)
            if named:
                file = root / named[1]
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(body, encoding="utf-8")
                written += 1
            elif language == "sh":
                kept = "source .state" if (root / ".state").exists() else ":"
                done = subprocess.run(["bash", "-c", f"{before}\n{kept}\n{body}\n[[ $PWD == {folder} ]]\n{STATE}"], cwd=root, text=True, env=environment,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
                if done.returncode != 0:
                    print(f"{page}:{line}: ended with {done.returncode}\n{body}\n{done.stdout}")
                    return 1
                ran += 1
                printed = done.stdout
            elif language == "text":
                for wanted in body.splitlines():
                    if not re.search("^" + ".*".join(map(re.escape, wanted.split("…"))) + "$", printed, re.M):
                        print(f"{page}:{line}: this line was not printed: {wanted}\n{printed}")
                        return 1
            else:
                print(f"{page}:{line}: a block of {language} is neither a file nor to be run")
                return 1
    print(f"{written} files written, {ran} blocks run")
    return 0 if written >= options.least[0] and ran >= options.least[1] else 1


if __name__ == "__main__":
    sys.exit(main())
