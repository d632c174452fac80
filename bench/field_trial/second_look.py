"""Planner calls that ended without a plan, looked at again: was there a plan? (R61)"""

from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import problem
import reference
from flights import Call, Programs


@dataclass
class SecondLook:
    seed: int
    call: Call
    reference: bool | None  # whether the reference scheduler finds a schedule that is valid; None: undecided
    longer: str = ""  # roci-plan's verdict with a longer budget; empty: not asked
    longer_s: float = 0

    @property
    def solvable(self) -> bool | None:
        """A plan in hand decides; so does a proof."""
        if self.reference or self.longer == "solved":
            return True
        if self.reference is False or self.longer == "unsolvable":
            return False
        return None

    @property
    def contradiction(self) -> bool:
        return self.reference is False and self.longer == "solved"


def complete(programs: Programs, call: Call) -> tuple[problem.Values, Path]:
    """All that is known of the functions' values, and a file that says so."""
    values = problem.read_values(call.values).completed(programs.constants)
    file = call.problem.with_suffix(".complete")
    file.write_text(values.text())
    return values, file


def plan_again(programs: Programs, call: Call, limit_s: float, plain: bool) -> dict:
    """Statistics of roci-plan on the same problem and values, without the evaluations' budget of the flight."""
    values, file = complete(programs, call)
    command = [programs.plan, programs.mission / "domain.pddl", call.problem, "--functions", file]
    command += ["--functions-mode", "two-accuracy"] if values.bounds else []
    command += ["--time", limit_s, "--memory", 1024, "--json"] + (["--plain-search"] if plain else [])
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=10 * limit_s + 60)
    return json.loads(done.stdout)


def decide(programs: Programs, call: Call) -> reference.Schedule:
    """A schedule counts only if the validator accepts it, on exact values. That there is none counts also on lower bounds."""
    values, file = complete(programs, call)
    task = problem.parse(call.problem.read_text())
    cheapest = values.cheapest()
    out = programs.schedule(task, cheapest)
    if out.solvable and cheapest != values.exact:
        out = programs.schedule(task, values.exact)
        if not out.solvable:
            return reference.Schedule(None)
    if out.solvable:
        plan = call.problem.with_suffix(".reference")
        plan.write_text(out.plan)
        command = [programs.validate, programs.mission / "domain.pddl", call.problem, plan, "--functions", file]
        done = subprocess.run([str(word) for word in command], capture_output=True)
        if done.returncode != 0:
            return reference.Schedule(None)
    return out


def look_again(programs: Programs, seed: int, call: Call, longer_s: float) -> SecondLook:
    """The reference decides. The planner gets its longer search where there is something to find, and where it said
    `unsolvable` after a search: that proof is tried without the checks that cut the search."""
    out = SecondLook(seed, call, decide(programs, call).solvable)
    proved_by_search = call.verdict == "unsolvable" and call.evaluated > 0
    if out.reference is not False or proved_by_search:
        limit_s = longer_s if out.reference is not False else min(longer_s, 1)
        again = plan_again(programs, call, limit_s, plain=proved_by_search)
        out.longer, out.longer_s = again["verdict"], again["wall_s"]
    return out
