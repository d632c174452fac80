#!/usr/bin/env python3
"""tutorial.py PAGE [--install BUILD]: writes and runs every block of docs/tutorial.md, in a folder of its own; with the programs of
BUILD, installed there, else with those of $PREFIX. Home and runtime folders are its own, too.

A block that begins with a comment that names a file is written to that file; a block of `sh` is run by bash, which ends with the
first command that fails. A block of `text` is what the block before it prints: each of its lines comes in its output, where … stands
for anything. Variables and the current folder are those of the block before. Exit code 0: everything ran.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)
FILE = re.compile(r"(?:#|;|//) (\w[\w./-]*/[\w.-]+)\n")
STATE = "declare -p PREFIX PATH > .state 2>/dev/null; pwd > .folder"


def main():
    text = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
    blocks = [(text.count("\n", 0, found.start()) + 1, *found.groups()) for found in BLOCK.finditer(text)]
    ran = written = 0
    with tempfile.TemporaryDirectory(prefix="roci_tutorial_") as folder:
        root = pathlib.Path(folder)
        environment = dict(os.environ, HOME=f"{folder}/home", XDG_RUNTIME_DIR=f"{folder}/runtime", CMAKE_BUILD_PARALLEL_LEVEL="2")
        for own in ("home", "runtime"):
            (root / own).mkdir(mode=0o700)
        if "--install" in sys.argv:
            environment["PREFIX"] = f"{folder}/prefix"
            subprocess.run(["cmake", "--install", sys.argv[sys.argv.index("--install") + 1], "--prefix", environment["PREFIX"]],
                           check=True, stdout=subprocess.DEVNULL)
        before = "set -euo pipefail"
        printed = ""
        for line, language, body in blocks:
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
                    print(f"{sys.argv[1]}:{line}: ended with {done.returncode}\n{body}\n{done.stdout}")
                    return 1
                ran += 1
                printed = done.stdout
            elif language == "text":
                for wanted in body.splitlines():
                    if not re.search("^" + ".*".join(map(re.escape, wanted.split("…"))) + "$", printed, re.M):
                        print(f"{sys.argv[1]}:{line}: this line was not printed: {wanted}\n{printed}")
                        return 1
            else:
                print(f"{sys.argv[1]}:{line}: a block of {language} is neither a file nor to be run")
                return 1
    print(f"{written} files written, {ran} blocks run")
    return 0 if written >= 8 and ran >= 8 else 1


if __name__ == "__main__":
    sys.exit(main())
