#!/usr/bin/env python3
"""The field trial (R61): flies seeded missions of missions/planetary or missions/orbital, looks at what was lost, writes a report.

    ninja -C build/release roci-rehearse roci-plan roci-validate roci_transport_inproc
    bench/field_trial/run.py --runs 400 --out FOLDER --report docs/field-trial.md
    bench/field_trial/run.py --mission orbital --runs 200 --out FOLDER --report docs/field-trial-orbital.md

Exit code 0: every invariant holds; 1: one does not; 2: wrong use. See README.md.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import report
from drop_order import broken_drop_order
from flights import Programs, fly, lay_out_mission, mission_work
from long_calls import repeat_longest
from losses import losses_of
from record import Range, Record
from second_look import decide, look_again
from trials import TRIALS, Trial

ROOT = Path(__file__).resolve().parents[2]


def first_plan(programs: Programs, record: Record) -> None:
    solved = [call for call in record.flight.calls if call.verdict == "solved"]
    if not solved:
        return
    best = decide(programs, solved[0])
    if best.solvable is False:
        record.flight.faults.append(f"call {solved[0].number}: the planner has a plan, the reference none")
    elif best.solvable:
        record.first_plan_s = record.flight.first_plan_s
        record.reference_s = best.makespan_s


def examine(programs: Programs, trial: Trial, record: Record, folder: Path, longer_s: float) -> None:
    seed = record.scenario.seed
    # Who cancels a call wants no plan of it.
    failed = [call for call in record.flight.calls if call.verdict not in ("solved", "cancelled")]
    record.looks = [look_again(programs, seed, call, longer_s) for call in failed]
    for look in record.looks:
        if look.contradiction:
            record.flight.faults.append(f"call {look.call.number}: the planner finds a plan, the reference none")
        if look.solvable and look.call.verdict == "unsolvable":
            record.flight.faults.append(f"call {look.call.number}: called unsolvable, and is not")
    record.back = trial.look_back(programs, record.scenario, record.flight, folder / "hindsight" / record.scenario.name)
    record.losses = losses_of(record.flight, record.looks, record.back)
    first_plan(programs, record)


def try_seed(
    programs: Programs, trial: Trial, draw: Callable, mission: Path, seed: int, arguments: argparse.Namespace
) -> Record:
    scenario = draw(seed)
    (mission / "scenarios" / f"{scenario.name}.yaml").write_text(scenario.yaml())
    folder = arguments.out / "flights" / scenario.name
    flight = fly(programs, mission, scenario.name, seed, folder, arguments.flown)
    flight.faults += broken_drop_order(flight, trial.goal_fact)
    record = Record(scenario, flight)
    if flight.result != "crashed":
        examine(programs, trial, record, arguments.out, arguments.longer)
    tell(record)
    return record


def tell(record: Record) -> None:
    flight = record.flight
    ends = " ".join(f"{goal.id}:{goal.state}" for goal in flight.goals)
    missed = sum(look.solvable is True for look in record.looks)
    print(f"seed {flight.seed}: {flight.result}, {len(flight.calls)} calls, {missed} missed, {ends}", flush=True)
    for fault in flight.faults:
        print(f"seed {flight.seed}: INVARIANT: {fault}", flush=True)


def main() -> int:
    parser = argparse.ArgumentParser(description="Flies seeded missions and reports what was lost.")
    parser.add_argument("--mission", choices=TRIALS, default="planetary", help="which one (planetary)")
    parser.add_argument("--runs", type=int, default=400, help="number of flights (400)")
    parser.add_argument("--seed", type=int, default=1, help="of the first; the others count up (1)")
    parser.add_argument("--seeds", type=int, nargs="+", help="these instead, e.g. to look at some losses again")
    parser.add_argument("--out", type=Path, required=True, help="folder for scenarios, journals and results")
    parser.add_argument("--report", type=Path, help="Markdown file to write (default: OUT/field-trial.md)")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin", help="programs (build/release/bin)")
    parser.add_argument("--jobs", type=int, default=2, help="flights at the same time (2)")
    parser.add_argument("--longer", type=float, default=30, help="seconds for a planner call's second try (30)")
    parser.add_argument("--work", type=int, help="evaluations of a planner call (the mission's)")
    parser.add_argument("--flown", action="store_true", help="take the flights that lie in OUT already, fly what is missing")
    parser.add_argument("--beside", type=Path, nargs="+", default=[], help="OUT folders of other ranges, to compare with")
    arguments = parser.parse_args()
    trial = TRIALS[arguments.mission]
    programs = Programs(arguments.bin, ROOT / "missions" / trial.mission, trial.schedule)
    for program in (programs.rehearse, programs.plan, programs.validate):
        if not program.exists():
            parser.error(f"{program} is missing; build it: ninja -C build/release {program.name}")
    arguments.out = arguments.out.resolve()
    own_work = mission_work(programs.mission)
    arguments.work = arguments.work or own_work
    changes = {f"work: {own_work}": f"work: {arguments.work}"} if arguments.work != own_work else {}
    mission = lay_out_mission(programs.mission, arguments.out / trial.mission, changes)
    programs.constants = trial.constants(programs, arguments.out / "constants")
    draw = trial.drawer(programs.mission)
    seeds = arguments.seeds or range(arguments.seed, arguments.seed + arguments.runs)
    with ThreadPoolExecutor(arguments.jobs) as workers:
        records = list(workers.map(lambda seed: try_seed(programs, trial, draw, mission, seed, arguments), seeds))
    calls = [(record.scenario.seed, call) for record in records for call in record.flight.calls]
    flown = Range(records, repeat_longest(programs, calls, arguments.work), arguments.work)
    flown.save(arguments.out)
    target = arguments.report or arguments.out / "field-trial.md"
    report.write(flown, [Range.load(folder) for folder in arguments.beside], target, trial)
    print(f"report: {target}")
    return 1 if any(record.flight.faults for record in records) else 0


if __name__ == "__main__":
    sys.exit(main())
