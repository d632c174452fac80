"""Physical effects that happened more often than they were commanded, by what a robot wrote down as it did them."""

from collections import Counter

DONE_ONCE = {"image", "pick", "drop", "send"}  # deeds that end their activity; a retry only follows one that did not come


def doubled_effects(effects: list[dict]) -> dict[str, int]:
    """Physical effects that one command caused more than once, whatever epoch its key names, and deeds that one activity
    did more than once, whatever attempt; with how often."""
    causes = Counter()
    for one in effects:
        what = f"{one['robot']}.{one['component']} {one['kind']} {one['object']} by {one['activity']} of {one['commander']}"
        if one["kind"] == "detour":
            continue  # a drive looks for a way around as often as it must
        causes[what if one["kind"] in DONE_ONCE else f"{what} attempt {one['attempt']}"] += 1
    return {what: count for what, count in causes.items() if count > 1}
