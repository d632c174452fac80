#!/usr/bin/env python3
"""Measures science_svc's detector on rendered images with known odd targets; prints a table."""

import argparse
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]


def png(ppm: bytes) -> bytes:
    """A binary PPM as a PNG."""
    _, size, _, pixels = ppm.split(b"\n", 3)
    width, height = map(int, size.split())
    rows = b"".join(b"\0" + pixels[3 * width * y : 3 * width * (y + 1)] for y in range(height))

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def table(counts: dict) -> str:
    lines = [
        f"{counts['images']} images, seeds from {counts['first_seed']} on, {counts['targets']} targets to be found within {counts['reach_m']:g} m.",
        "",
        "| threshold | goals | precision | recall | random: precision | recall |",
        "|---|---|---|---|---|---|",
    ]
    for row in counts["rows"]:
        lines.append(
            f"| {row['threshold']:g} | {row['goals']} | {row['precision']:.2f} | {row['recall']:.2f} "
            f"| {row['random_precision']:.2f} | {row['random_recall']:.2f} |"
        )
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release", help="build folder (default: build/release)")
    parser.add_argument("--seed", type=int, default=1001, help="of the first world (default: 1001)")
    parser.add_argument("--worlds", type=int, default=30)
    parser.add_argument("--images", type=int, default=10, help="of each world")
    parser.add_argument("--threshold", type=float, default=0.85, help="of the sheet")
    parser.add_argument("--sheet", type=pathlib.Path, help="writes images with the finds framed, as PNG")
    args = parser.parse_args()
    program = args.bin / "bench/bench_science"
    if not program.exists():
        print(f"run.py: there is no {program}; build it: ninja -C {args.bin} bench_science", file=sys.stderr)
        return 2
    command = [program, "--seed", str(args.seed), "--worlds", str(args.worlds), "--images", str(args.images)]
    with tempfile.TemporaryDirectory() as folder:
        ppm = pathlib.Path(folder) / "sheet.ppm"
        if args.sheet:
            command += ["--threshold", str(args.threshold), "--sheet", str(ppm)]
        print(table(json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)))
        if args.sheet:
            args.sheet.write_bytes(png(ppm.read_bytes()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
