"""The schedules of downlinks that a flight told, computed anew by the independent checker from the records of its planners."""

from __future__ import annotations

import re
import subprocess
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Schedules:
    checked: int = 0
    faults: list[str] = field(default_factory=list)


def schedules_of(bin_folder: Path, run_folder: Path) -> Schedules:
    """One record of each process of the planner, the newest twenty. A cycle that comes out otherwise than it was flown is a fault, too."""
    out = Schedules()
    for record in sorted(run_folder.glob("planner_steps/*.steps")):
        ended = subprocess.run([bin_folder / "roci-network", "cycle", record], capture_output=True, text=True, check=False)
        lines = ended.stdout.splitlines()
        summary = re.search(r"(\d+) schedules of downlinks", lines[-1]) if lines else None
        if summary is None:
            out.faults.append(f"{record.name}: {ended.stderr.strip() or 'no summary'}")
            continue
        out.checked += int(summary[1])
        if ended.returncode != 0:
            out.faults.append(f"{record.name}: {next((line.strip() for line in lines if 'downlinks: ' in line[:14] or 'differs' in line), lines[-1])}")
    return out
