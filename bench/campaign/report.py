"""The table of a campaign: by cause, what was lost or doubled, and how much of it may hide behind a count of 0."""

from collections import Counter

COLUMNS = ("missions", "faults", "goals", "goals lost", "recalls", "recalls lost", "effects", "effects doubled", "defined ends",
           "achieved", "partial", "failed", "time up", "with a violation", "95 % bound")


def causes(record: dict) -> list[str]:
    drawn = record["draw"]
    happened = {fault["kind"] for fault in record["faults"] if fault["done"]}
    return ["all", drawn["dds"], "secured" if record["secured"] else "plain", "pair" if drawn["standby"] else "alone",
            f"{drawn['hosts']} host{'s' if drawn['hosts'] > 1 else ''}", *sorted(happened or {"nothing in time"})]


def counts(record: dict, cause: str) -> Counter:
    done = [fault for fault in record["faults"] if fault["done"]]
    kinds = {fault["kind"] for fault in done}
    return Counter({"missions": 1, "faults": sum(fault["kind"] == cause for fault in done) if cause in kinds else len(done),
                    "goals": record["goals"], "goals lost": record["goals_lost"], "recalls": record["recalls"],
                    "recalls lost": record["recalls_lost"], "effects": record["effects"],
                    "effects doubled": record["doubled"], "defined ends": int(record["defined_end"]),
                    record["result"] or "failed": 1, "time up": int(record["time_up"]), "with a violation": int(bool(record["violations"]))})


def bound(row: Counter) -> str:
    """The 95 % bound on the share of missions with a violation: 3/N where none was seen (the rule of three; Hanley and
    Lippman-Hand, 1983), else the share itself."""
    if row["with a violation"]:
        return f"{row['with a violation']} of {row['missions']}"
    return f"{100 * min(1.0, 3 / row['missions']):.1f} %"


def report(records: list[dict]) -> str:
    rows: dict[str, Counter] = {}
    for record in records:
        for cause in causes(record):
            rows.setdefault(cause, Counter()).update(counts(record, cause))
    order = ["all", "fastdds", "cyclonedds", "mixed", "plain", "secured", "alone", "pair", "1 host", "3 hosts"]
    names = [name for name in order if name in rows] + sorted(name for name in rows if name not in order)
    lines = ["| cause | " + " | ".join(COLUMNS) + " |", "|" + "---|" * (len(COLUMNS) + 1)]
    for name in names:
        cells = [bound(rows[name]) if column == "95 % bound" else str(rows[name][column]) for column in COLUMNS]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    for record in records:
        lines += [f"seed {record['seed']}: {violation}" for violation in record["violations"]]
    return "\n".join(lines)
