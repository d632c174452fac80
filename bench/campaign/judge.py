"""What a flight of the campaign must not do: effects doubled, goals and recalls lost, an end that nobody has defined."""

import json
import sqlite3
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "kill"))
from effects import doubled_effects  # noqa: E402

RECALLED, FINAL = 6, {0, 3, 4, 5, 6}  # idl/goal.idl, GoalState
HELD_BY_BOTH = "held by both"  # the second stage of an acknowledgement, as roci tells it
DEFINED = ("achieved", "partial", "failed")
# A command that was sent before the recall was acknowledged may begin after it: so long on the wall may it be on its way where
# nobody has noted when it was sent.
ON_ITS_WAY_S = 1.0
# Each host's launcher begins mission time for itself, so two hosts may differ by so much on the wall.
ANCHORS_APART_S = 0.3


def read_goals(journal: Path) -> dict[str, tuple[int, str]]:
    with sqlite3.connect(f"file:{journal}?mode=ro", uri=True) as database:
        return {f"{issuer}/{name}": (state, reason)
                for issuer, name, state, reason in database.execute("SELECT issuer, id, state, reason FROM goal")}


def first_commanded(journals: list[Path]) -> dict[tuple[str, int], float]:
    """When each command (activity, attempt) was first written down, in s of mission time, by any of the journals."""
    out: dict[tuple[str, int], float] = {}
    for journal in journals:
        with sqlite3.connect(f"file:{journal}?mode=ro", uri=True) as database:
            rows = database.execute("SELECT time_us, CAST(text AS TEXT) FROM record WHERE kind='trace'")
            for time_us, text in rows:
                words = text.split()
                if len(words) > 4 and words[1] == "command" and words[4] == "action=0":
                    key = (words[2], int(words[3]))
                    out[key] = min(out.get(key, time_us / 1e6), time_us / 1e6)
    return out


def after_the_end(journal: Path, speed: float) -> set[str]:
    """Goals that were accepted when the robot's service had left for good, or so shortly before that it cannot have heard:
    its mission was over, as far as it knew."""
    out: set[str] = set()
    accepted: dict[str, float] = {}
    left = False
    with sqlite3.connect(f"file:{journal}?mode=ro", uri=True) as database:
        rows = database.execute("SELECT time_us / 1e6, CAST(text AS TEXT) FROM record WHERE kind='event' ORDER BY seq")
        for at, text in rows:
            words = text.split()
            if words[0] == "goal.accepted":
                accepted[words[2]] = at
                if left:
                    out.add(words[2])
            if words[1:2] == ["sim_svc"]:
                left = words[0] == "service.lost" and text.endswith("left")
                out = {goal for goal, then in accepted.items() if at - then < ON_ITS_WAY_S * speed} if left else set()
    return out


def flown_after_recall(recalls: list[dict], effects: list[dict], commanded: dict, speed: float) -> list[str]:
    """Effects of a goal that were commanded only after its recall was acknowledged."""
    out = []
    for recall in recalls:
        name = recall["goal"].split("/", 1)[1]
        for effect in effects:
            begun = effect["time_us"] / 1e6
            if not effect["object"].endswith(f"-{name}") or begun <= recall["answered_s"]:
                continue
            sent = commanded.get((effect["activity"], effect["attempt"]))
            if sent is None and begun <= recall["answered_s"] + ON_ITS_WAY_S * speed:
                continue
            if sent is None or sent > recall["answered_s"] + ANCHORS_APART_S * speed:
                out.append(f"recall of {recall['goal']} was acknowledged at {recall['answered_s']:.1f} s, and "
                           f"{effect['kind']} {effect['object']} by {effect['activity']} begun at {begun:.1f} s")
    return out


def accepted(answers: list[dict]) -> list[dict]:
    return [one for one in answers if one["verb"] == "add" and one["state"] != "rejected"]


def recalled(answers: list[dict]) -> list[dict]:
    return [one for one in answers if one["verb"] == "recall" and one["state"] == "recalled"]


def lost_goals(answers: list[dict], scenario_goals: list[str], final: dict, others: list[dict]) -> list[str]:
    """Which goals the final executive's journal lacks and must not: those of the scenario, those that were answered as held by
    both, and those that were answered as journaled alone if no other journal has them either. What a leader has journaled
    alone survives if its disk comes back (docs/resilience.md)."""
    added = {}
    for one in accepted(answers):
        added.setdefault(one["goal"], set()).add(one["acknowledged"])
    lost = [f"goal {goal} is not in the journal" for goal in sorted(set(scenario_goals) - set(final))]
    for goal in sorted(set(added) - set(final)):
        if HELD_BY_BOTH in added[goal]:
            lost.append(f"goal {goal} was held by both and is not in the journal")
        elif not any(goal in other for other in others):
            lost.append(f"goal {goal} is in no journal")
    return lost


def lost_recalls(answers: list[dict], final: dict, others: list[dict]) -> list[str]:
    """Which recalls the final executive's journal contradicts and must not, by the same rule."""
    out = []
    for one in recalled(answers):
        goal = one["goal"]
        if goal not in final or final[goal][0] == RECALLED:
            continue
        if one["acknowledged"] == HELD_BY_BOTH or not any(other.get(goal, (None,))[0] == RECALLED for other in others):
            out.append(f"recall of {goal} was acknowledged, and its state is {final[goal]}")
    return out


def judge(flight: dict, effects: list[dict], final: Path | None, journals: list[Path], speed: float) -> dict:
    """`flight`: exits and summaries by host, answers of the ground, scenario goals, whether it was killed by the watchdog."""
    violations = []
    if flight["watchdog"]:
        violations.append("no end: the campaign had to kill it")
    for host, code in flight["exits"].items():
        result = flight["summaries"].get(host, {}).get("result", "")
        if code not in (0, 1) or result not in (*DEFINED, "served"):
            violations.append(f"no defined end: {host} exit {code}, result '{result}'")
    defined = not violations
    if final is None:
        violations.append("no executive told its end")
    goals = read_goals(final) if final else {}
    others = [read_goals(journal) for journal in journals if journal != final]
    asked = {one["goal"] for one in accepted(flight["answers"])} | set(flight["scenario_goals"])
    lost = lost_goals(flight["answers"], flight["scenario_goals"], goals, others)
    late = after_the_end(final, speed) if final else set()
    lost += [f"goal {goal} is still open ({goals[goal][1]})" for goal in sorted(asked & set(goals) - late)
             if goals[goal][0] not in FINAL and not flight["time_up"] and "waiting for the ground" not in goals[goal][1]]
    recalls = recalled(flight["answers"])
    recalls_lost = lost_recalls(flight["answers"], goals, others)
    held = [one for one in recalls if one["acknowledged"] == HELD_BY_BOTH or not others]
    recalls_lost += flown_after_recall(held, effects, first_commanded(journals), speed)
    doubled = doubled_effects(effects)
    violations += lost + recalls_lost + [f"{what} {count} times" for what, count in doubled.items()]
    return {"goals": len(asked), "goals_lost": len(lost), "recalls": len(recalls), "recalls_lost": len(recalls_lost),
            "effects": len(effects), "doubled": sum(count - 1 for count in doubled.values()), "defined_end": defined,
            "violations": violations}


def read_effects(file: Path) -> list[dict]:
    try:
        return [json.loads(line) for line in file.read_text().splitlines() if line]
    except OSError:
        return []
