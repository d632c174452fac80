"""The rows of docs/requirements.md and the mutations of mutations.yaml, as plain values.

A row of the table is one line of markdown: | R5 | section | what it asks | state | where |. In its last cell a name in
backticks that holds ": " is a test ("file: Suite.Name", or "file: name" for a test that CMake or Python declares), and one
that holds "/" is a file or a folder of the project.
"""
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "requirements.md"
MUTATIONS = Path(__file__).with_name("mutations.yaml")
STATES = ("built", "partly", "open")
NUMBER_OF_ROWS = 149
NUMBER_BEYOND = 1
NUMBER_OF_READINGS = 24


class Row:
    """One row: its name (R5), the section of the paper, what it asks, its state and what stands in its last cell."""

    def __init__(self, line_number, name, section, asks, state, where):
        self.line_number = line_number
        self.name = name
        self.section = section
        self.asks = asks
        self.state = state.split()[0].rstrip(":,;") if state else ""
        self.where = where
        quoted = re.findall(r"`([^`]+)`", where)
        self.tests = [tuple(part.strip() for part in text.split(": ", 1)) for text in quoted if "/" in text.split(": ")[0] and ": " in text]
        self.files = [text for text in quoted if ": " not in text and "/" in text and " " not in text]


def read_rows(text):
    """Every line of the form | R<n> | … |, | B<n> | … | or | Z<n> | … |, in the order of the page."""
    rows = []
    for number, line in enumerate(text.splitlines(), 1):
        if not re.match(r"\| [RBZ]\d+ \|", line):
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]
        if len(cells) != 5:
            raise SystemExit(f"{TABLE.name}:{number}: a row has 5 cells, this one has {len(cells)}")
        rows.append(Row(number, *cells))
    return rows


def unquoted(text, where):
    if text.startswith("'"):
        if len(text) < 2 or not text.endswith("'"):
            raise SystemExit(f"{where}: the quote is not closed")
        return text[1:-1].replace("''", "'")
    if ": " in text or " #" in text or text.endswith(":") or text[:1] in tuple("*&!%@`{[|>\"#"):
        raise SystemExit(f"{where}: YAML reads this value as something else than text; put it into single quotes")
    return text


def read_mutations(text):
    """A list of flat mappings, the small part of YAML that the file uses: '- key: value' begins one, '  key: value' goes on
    with it, values are plain or in single quotes, a line that begins with # is a comment."""
    entries = []
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{MUTATIONS.name}:{number}"
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        match = re.fullmatch(r"(- |  )([a-z]+): (.*)", line)
        if not match:
            raise SystemExit(f"{where}: expected '- key: value' or '  key: value', got: {line}")
        if match[1] == "- ":
            entries.append({"line": number})
        if not entries or match[2] in entries[-1]:
            raise SystemExit(f"{where}: '{match[2]}' stands twice in an entry, or before the first one")
        entries[-1][match[2]] = unquoted(match[3].strip(), where)
    return entries


class Place:
    """Where a mutation changes what: the file, its text, the number of the line (from 0), the line after the change."""

    def __init__(self, file, lines, number, mutated):
        self.file = file
        self.lines = lines
        self.number = number
        self.mutated = mutated

    def text(self):
        return "\n".join(self.lines[: self.number] + [self.mutated] + self.lines[self.number + 1 :]) + "\n"


def find_place(entry, root=ROOT):
    """The one place that an entry names, or the reason why there is none.

    `file` is a path or a pattern (** is any folders), so that a function may move to another file of its part. `before` is
    a part of the line, `match` a regular expression for a part of it; `after` stands in its place. Each of the two must be
    found once in all files that `file` names."""
    files = sorted(path for path in root.glob(entry["file"]) if path.is_file())
    if not files:
        return None, f"no file is named {entry['file']}"
    pattern = re.compile(entry["match"]) if "match" in entry else re.compile(re.escape(entry["before"]))
    found = []
    for file in files:
        lines = file.read_text().split("\n")
        if lines and not lines[-1]:
            lines.pop()
        for number, line in enumerate(lines):
            for match in pattern.finditer(line):
                after = match.expand(entry["after"]) if "match" in entry else entry["after"]
                found.append(Place(file, lines, number, line[: match.start()] + after + line[match.end() :]))
    wanted = entry.get("match", entry.get("before"))
    if len(found) != 1:
        at = ", ".join(f"{place.file.relative_to(root)}:{place.number + 1}" for place in found[:4])
        return None, f"'{wanted}' is found {len(found)} times in {entry['file']}, not once" + (f" ({at})" if at else "")
    if found[0].lines[found[0].number] == found[0].mutated:
        return None, f"the mutation of '{wanted}' changes nothing"
    return found[0], ""
