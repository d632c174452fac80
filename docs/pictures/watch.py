#!/usr/bin/env python3
"""Flies a mission live and draws `roci watch` at a moment of it, as SVG.

    docs/pictures/watch.py docs/pictures/planetary.svg --mission planetary --scenario opportunistic --at 00:25:00

Needs a build (build/release/bin). Exit code 0: drawn; 1: the view never showed that moment."""

from __future__ import annotations

import argparse
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import tempfile
import termios
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COLUMNS, ROWS = 150, 44
CELL_WIDTH, CELL_HEIGHT, MARGIN = 9.0, 18, 18
COLOURS = {"31": "#ff7b72", "32": "#7ee787", "33": "#e3b341", "36": "#79c0ff"}  # on dark, as the terminal's red, green, yellow, cyan
PLAIN, DIM, TITLE, GROUND = "#d6dde6", "#8b949e", "#ffffff", "#10151b"


def frames(program: Path, launcher: int):
    """What the view draws, one text with its colours after another."""
    child, terminal = pty.fork()
    if child == 0:
        os.environ["TERM"] = "xterm-256color"
        os.execv(program, [str(program), "watch", "--launcher", str(launcher)])
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", ROWS + 1, COLUMNS, 0, 0))
    read = b""
    try:
        while select.select([terminal], [], [], 30)[0]:
            read += os.read(terminal, 65536)
            *whole, read = read.split(b"\x1b[J")
            for frame in whole:
                yield frame.decode(errors="replace").split("\x1b[H")[-1].replace("\x1b[K", "").replace("\r", "")
    except OSError:  # the view has ended
        return
    finally:
        os.kill(child, signal.SIGTERM)
        os.waitpid(child, 0)


def runs_of(line: str):
    """(column, text, colour, bold) of what stands in a line."""
    column, colour, bold = 0, PLAIN, False
    for part in re.split(r"(\x1b\[[0-9;]*m)", line):
        if part.startswith("\x1b["):
            codes = part[2:-1].split(";")
            bold = "1" in codes
            colour = next((COLOURS[code] for code in codes if code in COLOURS), DIM if "2" in codes else TITLE if bold else PLAIN)
            continue
        for words in re.finditer(r"\S+(?: \S+)*", part):
            yield column + words.start(), words.group(), colour, bold
        column += len(part)


def svg_of(frame: str) -> str:
    width, height = COLUMNS * CELL_WIDTH + 2 * MARGIN, ROWS * CELL_HEIGHT + 2 * MARGIN
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height}" font-family="DejaVu Sans Mono, monospace" font-size="15">',
        f'<rect width="100%" height="100%" rx="8" fill="{GROUND}"/>',
    ]
    for row, line in enumerate(frame.split("\n")[:ROWS]):
        for column, text, colour, bold in runs_of(line):
            weight = ' font-weight="bold"' if bold else ""
            out.append(
                f'<text x="{MARGIN + column * CELL_WIDTH:g}" y="{MARGIN + (row + 0.8) * CELL_HEIGHT:g}" fill="{colour}"{weight} '
                f'textLength="{len(text) * CELL_WIDTH:g}" lengthAdjust="spacingAndGlyphs" xml:space="preserve">{escape(text)}</text>'
            )
    return "\n".join([*out, "</svg>"]) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description="Draws roci watch at a moment of a flight.")
    parser.add_argument("picture", type=Path, help="SVG file to write")
    parser.add_argument("--mission", default="planetary", help="folder in missions/ (planetary)")
    parser.add_argument("--scenario", default="nominal", help="(nominal)")
    parser.add_argument("--at", default="00:10:00", help="first picture of this mission time or later (00:10:00)")
    parser.add_argument("--speed", default="60", help="seconds of the mission in one of ours (60)")
    arguments = parser.parse_args()
    programs = ROOT / "build/release/bin"
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.Popen(
            [programs / "roci-launch", ROOT / "missions" / arguments.mission, "--scenario", arguments.scenario, "--speed", arguments.speed,
             "--headless", "--run-folder", f"{folder}/run"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        try:
            for frame in frames(programs / "roci", run.pid):
                moment = re.search(r"\d\d:\d\d:\d\d", frame)
                if moment and moment.group() >= arguments.at:
                    arguments.picture.write_text(svg_of(frame))
                    return 0
        finally:
            run.terminate()
            run.wait()
    print(f"{arguments.picture}: the view never showed {arguments.at}", file=sys.stderr)
    return 1


if __name__ == "__main__":
    sys.exit(main())
