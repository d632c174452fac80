"""The report of a field trial as Markdown, losses first. The same seeds give the same text, wall times apart."""

from __future__ import annotations

import statistics
from collections import Counter
from pathlib import Path

import problem
from flights import Call, mission_work
from long_calls import LONG_S, LongCall
from losses import EXPLANATIONS, Loss
from record import Range, Record
from trials import Trial

MISSIONS = Path(__file__).resolve().parents[2] / "missions"

CLASSES = ["hard", "optional", "opportunistic"]
EXAMPLES = 6


def table(head: list[str], rows: list[list[object]]) -> str:
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def percent(part: float, whole: float) -> str:
    return f"{100 * part / whole:.1f} %" if whole else "–"


def examples(seeds: list[int]) -> str:
    shown = sorted(set(seeds))
    return ", ".join(str(seed) for seed in shown[:EXAMPLES]) + (" …" if len(shown) > EXAMPLES else "")


def bars(rows: list[tuple[str, int]]) -> str:
    """A horizontal bar chart as SVG."""
    widest = max((count for _, count in rows), default=1) or 1
    height = 22 * len(rows) + 8
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="640" height="{height}" font-family="sans-serif" font-size="13">']
    out.append(f'<rect width="640" height="{height}" fill="white"/>')
    for i, (name, count) in enumerate(rows):
        y = 22 * i + 6
        width = round(400 * count / widest)
        out.append(f'<text x="150" y="{y + 13}" text-anchor="end">{name}</text>')
        out.append(f'<rect x="160" y="{y}" width="{width}" height="16" fill="#4878a8"/>')
        out.append(f'<text x="{166 + width}" y="{y + 13}">{count}</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def losses_section(records: list[Record], picture: str) -> str:
    losses = [loss for record in records for loss in record.losses]
    by_kind: dict[str, list[Loss]] = {kind: [] for kind in EXPLANATIONS}
    for loss in losses:
        by_kind[loss.kind].append(loss)
    rows: list[list[object]] = []
    for kind, some in by_kind.items():
        if some:
            counts = Counter(loss.goal.importance for loss in some)
            rows.append([kind, *(counts[name] for name in CLASSES), EXPLANATIONS[kind], examples([l.seed for l in some])])
    rows.sort(key=lambda row: -sum(row[1:4]))
    return (
        "## What was lost, and why\n\n"
        + f"![Goals given up, by cause]({picture})\n\n"
        + table(["class", *CLASSES, "cause", "seeds"], rows)
    )


def hard_section(records: list[Record]) -> str:
    rows: list[list[object]] = []
    words = {True: "yes", None: "undecided"}
    failed = [loss for record in records for loss in record.losses if loss.goal.state == "failed"]
    for loss in failed:
        if loss.possible is not False:
            rows.append([loss.seed, loss.goal.id, loss.kind, words[loss.possible], shorten(loss.goal.reason)])
    text = (
        f"\n## Hard goals that failed\n\n{len(failed)} failed. With hindsight {len(failed) - len(rows)} of them were out of reach "
        "besides the hard goals achieved; the others:\n\n"
    )
    return text + table(["seed", "goal", "class", "achievable", "reason"], rows)


def shorten(reason: str) -> str:
    text = reason.split("\n")[0].replace("|", "/")
    return text if len(text) < 100 else text[:97] + "…"


def calls_section(records: list[Record], work: int, of_mission: int) -> str:
    calls = [call for record in records for call in record.flight.calls]
    looks = [look for record in records for look in record.looks]
    verdicts = Counter(call.verdict for call in calls)
    missed = [look for look in looks if look.solvable]
    rows: list[list[object]] = []
    for verdict, count in verdicts.most_common():
        some = [look for look in looks if look.call.verdict == verdict]
        solvable = "–" if verdict == "solved" else sum(look.solvable is True for look in some)
        undecided = "–" if verdict == "solved" else sum(look.solvable is None for look in some)
        rows.append([verdict, count, solvable, undecided])
    most = max((call.evaluated for call in calls if call.verdict == "solved"), default=0)
    out = (
        f"\n## Planner calls (R61)\n\n{len(calls)} calls with a budget of {work:,} evaluations (the mission's: "
        f"{of_mission:,}); a solved one took {most:,} at most. Solvable problems missed: **{len(missed)}**.\n\n"
    )
    out += table(["verdict", "calls", "of these solvable", "undecided"], rows)
    if missed:
        rows = [
            [look.seed, look.call.number, look.call.verdict, look.call.evaluated, goals_of(look.call)] for look in missed[:20]
        ]
        out += f"\nMissed{', the first 20' if len(missed) > 20 else ''}; the schedules found are valid by `roci-validate`:\n\n"
        out += table(["seed", "call", "verdict", "evaluated", "goals"], rows)
    return out


def goals_of(call: Call) -> str:
    return ", ".join(" ".join(goal) for goal in problem.parse(call.problem.read_text()).goals)


def wall_section(records: list[Record], long: list[LongCall]) -> str:
    """The only part that another run of the same seeds may change."""
    calls = [(call.wall_s, call, record.scenario.seed) for record in records for call in record.flight.calls]
    if not calls:
        return ""
    solved = [item for item in calls if item[1].verdict == "solved"]
    rows = []
    unsolved = {call.verdict for _, call, _ in calls} - {"solved"}
    kinds = [(verdict, [item for item in calls if item[1].verdict == verdict]) for verdict in sorted(unsolved)]
    for name, some in (("all", calls), ("solved", solved), *kinds):
        if not some:
            continue
        walls = sorted(wall for wall, _, _ in some)
        longest = max(some, key=lambda item: item[0])
        over = sum(wall > 2 for wall in walls)
        rows.append(
            [
                name,
                len(some),
                f"{statistics.median(walls):.3f}",
                f"{walls[int(0.99 * (len(walls) - 1))]:.2f}",
                f"{longest[0]:.2f} (seed {longest[2]}, call {longest[1].number})",
                over,
            ]
        )
    missed = [look for record in records for look in record.looks if look.solvable]
    later = sum(look.longer == "solved" for look in missed)
    flown = sum(record.flight.wall_s for record in records)
    return (
        f"\n## Wall times\n\nOf this machine and its other load; flights took {flown:.0f} s in all.\n\n"
        + table(["calls", "number", "median s", "99th percentile s", "longest s", "over 2 s"], rows)
        + f"\nOf the {len(missed)} missed problems roci-plan solves {later} with a longer budget (`--longer`).\n"
        + alone(long)
    )


def alone(long: list[LongCall]) -> str:
    """The longest calls again, alone."""
    if not long:
        return ""
    over = [one for one in long if one.cpu_s > LONG_S]
    most = max(long, key=lambda one: one.cpu_s)
    rate = sum(one.cpu_s for one in long) / max(1, sum(one.evaluated for one in long))
    rows = [
        [one.seed, one.call.number, one.call.verdict, f"{one.call.wall_s:.2f}", f"{one.cpu_s:.2f}", one.evaluated]
        for one in long[:20]
    ]
    return (
        f"\nThe {len(long)} longest calls again, one after the other, each a process of its own (`roci-plan`): {len(over)} of them "
        f"took over {LONG_S:.0f} s of processor time, the longest {most.cpu_s:.2f} s (seed {most.seed}, call {most.call.number}); "
        f"{1000 * rate:.2f} ms for an evaluation.\n\n"
        + table(["seed", "call", "verdict", "wall s in the trial", "processor s alone", "evaluated"], rows)
    )


def goals_section(records: list[Record]) -> str:
    states = ["achieved", "dropped", "failed", "recalled", "rejected", "planned", "pending"]
    count = Counter((goal.importance, goal.state) for record in records for goal in record.flight.goals)
    rows = []
    for importance in CLASSES:
        numbers = [count[importance, state] for state in states]
        rows.append([importance, sum(numbers), *numbers, percent(numbers[0], sum(numbers) - numbers[3])])
    results = Counter(record.flight.result for record in records)
    replans = [record.flight.replans for record in records]
    branches: Counter[str] = Counter()
    for record in records:
        branches.update(record.flight.branches)
    faults = [(record.scenario.seed, fault) for record in records for fault in record.flight.faults]
    out = f"\n## Flights\n\n{len(records)} flights: " + ", ".join(f"{n} {name}" for name, n in results.most_common())
    out += f"; {sum(replans)} replans, at most {max(replans)} in one flight.\n\n"
    out += table(["class", "goals", *states, "achieved of not recalled"], rows)
    out += "\nStarts against the windows [lb, ub] of the plan as adopted (R49):\n\n"
    out += table(["at lb", "inside", "after ub: replanned"], [[branches[k] for k in ("at lb", "inside", "after ub")]])
    out += "\nInvariants (every goal ends in a final state with a reason, or the robot is safe and says why; no hard goal is "
    out += "dropped; goals go in the order of R53; no command without a plan; a plan or a proof never contradicts the reference): "
    out += f"{'all hold' if not faults else str(len(faults)) + ' broken'}.\n"
    return out + "".join(f"- seed {seed}: {fault}\n" for seed, fault in faults)


def oracle_section(records: list[Record]) -> str:
    some = [record for record in records if record.back and record.back.oracle is not None]
    best = sum(record.back.oracle for record in some)
    got = sum(record.back.achieved for record in some)
    less = [record for record in some if record.back.achieved < record.back.oracle]
    more = [record for record in some if record.back.achieved > record.back.oracle]
    out = (
        f"\n## Optional goals against hindsight\n\n{len(some)} flights with one to four optional and opportunistic goals: utility "
        f"{got:.0f} of {best:.0f} that hindsight could have had, **{percent(got, best)}**; less in {len(less)} flights, more in "
        f"{len(more)} (true drives and waits vary around the values that hindsight counts with).\n\n"
    )
    lost: Counter[str] = Counter()
    seeds: dict[str, list[int]] = {}
    for record in less:
        for loss in record.losses:
            if loss.goal.id in record.back.best:
                lost[loss.kind] += int(loss.goal.utility)
                seeds.setdefault(loss.kind, []).append(record.scenario.seed)
    rows = [[kind, utility, EXPLANATIONS[kind], examples(seeds[kind])] for kind, utility in lost.most_common()]
    return out + "Goals of the best set that were not achieved:\n\n" + table(["class", "utility", "cause", "seeds"], rows)


def makespan_section(records: list[Record]) -> str:
    some = [record for record in records if record.first_plan_s and record.reference_s]
    if not some:
        return ""
    ratios = sorted(record.first_plan_s / record.reference_s for record in some)
    worst = max(some, key=lambda record: record.first_plan_s / record.reference_s)
    equal = sum(ratio < 1.01 for ratio in ratios)
    return (
        f"\n## Makespan of the first plan (R62)\n\nOf {len(some)} first plans {equal} are as short as the shortest there is (within "
        f"1 %). Makespan over shortest: median {statistics.median(ratios):.2f}, 90th percentile "
        f"{ratios[int(0.9 * (len(ratios) - 1))]:.2f}, largest {ratios[-1]:.2f} (seed {worst.scenario.seed}). What the planner has "
        "when its budget for improvements is spent is executed; the order of goals is not optimal.\n"
    )


def seeds_of(records: list[Record]) -> str:
    seeds = [record.scenario.seed for record in records]
    whole = seeds == list(range(seeds[0], seeds[0] + len(seeds)))
    return f"{seeds[0]} to {seeds[-1]}" if whole and len(seeds) > 1 else ", ".join(str(seed) for seed in seeds)


def ranges_section(flown: list[Range]) -> str:
    """What ranges of seeds have in common, and what not."""
    if len(flown) < 2:
        return ""
    rows: list[list[object]] = []
    for one in flown:
        goals = [goal for record in one.records for goal in record.flight.goals]
        shares = []
        for importance in CLASSES:
            kept = [goal for goal in goals if goal.importance == importance and goal.state != "recalled"]
            shares.append(percent(sum(goal.state == "achieved" for goal in kept), len(kept)))
        results = Counter(record.flight.result for record in one.records)
        failed = [loss for record in one.records for loss in record.losses if loss.goal.state == "failed"]
        seen = [record.back for record in one.records if record.back and record.back.oracle is not None]
        missed = sum(bool(look.solvable) for record in one.records for look in record.looks)
        calls = sum(len(record.flight.calls) for record in one.records)
        most = max((long.cpu_s for long in one.long), default=0)
        rows.append(
            [
                seeds_of(one.records),
                len(one.records),
                results["achieved"],
                *shares,
                f"{len(failed)} ({sum(loss.possible is not False for loss in failed)})",
                percent(sum(back.achieved for back in seen), sum(back.oracle for back in seen)),
                f"{calls} ({missed})",
                f"{most:.2f}",
                sum(len(record.flight.faults) for record in one.records),
            ]
        )
    head = ["seeds", "flights", "achieved", *CLASSES, "hard failed (not out of reach)", "utility of hindsight's"]
    head += ["planner calls (missed)", "longest again, processor s", "broken invariants"]
    return "\n## Ranges of seeds\n\nThe code was tuned on seeds 1 to 400 alone.\n\n" + table(head, rows)


HAND = "\n## Explained one by one\n"  # from here on a page is written by hand, and stays


def write(flown: Range, others: list[Range], target: Path, trial: Trial) -> None:
    records, work = flown.records, flown.work
    target.parent.mkdir(parents=True, exist_ok=True)
    pictures = target.parent / "pictures"
    pictures.mkdir(exist_ok=True)
    kinds = Counter(loss.kind for record in records for loss in record.losses)
    picture = pictures / f"{target.stem}.svg"
    picture.write_text(bars(kinds.most_common()))
    first = records[0].scenario.seed
    named = "" if trial.mission == "planetary" else f"--mission {trial.mission} "
    head = f"""# Field trial{"" if trial.mission == "planetary" else ": the " + trial.mission + " mission"}

{len(records)} missions of `missions/{trial.mission}`, seeds {seeds_of(records)}, each drawn at random: {trial.drawn}.
Written by `bench/field_trial/run.py {named}--runs {len(records)} --seed {first} --work {work} --out FOLDER --report {trial.target}`
([how it works](../bench/field_trial/README.md)). One flight again, alone, with all processes:

    bench/field_trial/run.py {named}--runs 1 --seed {first} --work {work} --out FOLDER && ./run FOLDER/{trial.mission} --scenario seed-{first:04d} --seed {first}

"""
    sections = [losses_section(records, f"pictures/{picture.name}"), hard_section(records)]
    sections.append(calls_section(records, work, mission_work(MISSIONS / trial.mission)))
    sections += [oracle_section(records), makespan_section(records), goals_section(records), ranges_section([flown, *others])]
    sections += [wall_section(records, flown.long)]
    old = target.read_text() if target.exists() else ""
    by_hand = old[old.index(HAND) :] if HAND in old else ""
    target.write_text(head + "".join(sections) + by_hand)
