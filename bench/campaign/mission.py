"""The mission that the campaign flies: the planetary one with a scenario of its own, and waits that are those of a wire."""

import re
import shutil
from pathlib import Path

SCENARIO = """description: Images a short drive apart, for as long as something goes wrong.
duration_s: {duration}
start: {{x: 40, y: 40, heading: 0, arm: stow, battery: 900000}}
world: {{slip: 0.04, image_noise: 0.02}}
science: {{enabled: false}}
stimuli:
  - {{at_s: 10, goal: {{issuer: ground, id: ridge, kind: photo, importance: hard, arguments: {{x: 60, y: 44}}}}}}
  - {{at_s: 10, goal: {{issuer: ground, id: crest, kind: photo, importance: hard, arguments: {{x: 52, y: 56}}}}}}
"""
SAMPLES = """  - {at_s: 10, goal: {issuer: ground, id: soil, kind: pick_sample, importance: hard, arguments: {x: 48, y: 46}}}
  - {at_s: 10, goal: {issuer: ground, id: depot, kind: drop_sample, importance: hard, arguments: {x: 54, y: 44, sample: soil}}}
"""
GOALS = {"ground/ridge", "ground/crest"}
SAMPLE_GOALS = {"ground/soil", "ground/depot"}


def make_mission(source: Path, folder: Path, samples: bool, speed: float, longest_s: float) -> set[str]:
    """A copy in which every wait of the executive for somebody else is at least as long on the wall as its default is in
    mission time at speed 1 (or a useful part of it). Returns the scenario's goals."""
    shutil.copytree(source, folder)
    file = folder / "mission.yaml"
    text = file.read_text()

    def put(key: str, value: float) -> None:
        nonlocal text
        text, count = re.subn(rf"\b{key}: *[\d.]+", f"{key}: {value:g}", text)
        if count != 1:
            raise SystemExit(f"{file}: {key} stands {count} times in it, expected once")

    put("ack_timeout_s", 3 * speed)
    put("allowance_s", 1.5 * speed)
    put("failure_limit", 20)
    put("replan_limit", 500)
    text = text.replace("executive:\n", f"executive:\n  fallback_timeout_s: {10 * speed:g}\n  call_retries: 20\n", 1)
    text = text.replace("planner:\n", f"planner:\n  reply_timeout_s: {30 * speed:g}\n", 1)
    text = re.sub(r"open: \[\[.*\]\]", "open: [[100, 1000000]]", text, count=1)
    file.write_text(text)
    scenario = SCENARIO.format(duration=int(longest_s * speed))
    (folder / "scenarios/campaign.yaml").write_text(scenario + (SAMPLES if samples else ""))
    return GOALS | (SAMPLE_GOALS if samples else set())
