#!/usr/bin/env python3
"""bound_decoding.py --generated FOLDER FILE.idl ...

Makes the deserialize functions that fastddsgen wrote into FOLDER safe for bytes that anybody may have sent: the count of
every sequence is checked against what is left of the payload, by the least size that an element takes, before memory
is taken for it; an enumerator that the IDL does not name, and text with a zero byte in it, are refused as malformed. The
checks are those of idl/bounded_decoding.hpp. fastddsgen 2.3 itself takes a count for one byte an element, and the count of a
sequence of enums on trust. Ends with an error if a member is read in a way that this program does not know.
"""
import argparse
import pathlib
import re

from contract import Definitions, Unreadable, tokens_of

LEAST = {"boolean": 1, "octet": 1, "char": 1, "short": 2, "long": 4, "float": 4, "long long": 8, "double": 8,
         "string": 5}  # text ends with a zero byte
COUNT = 4

FUNCTION = re.compile(r"(?P<head>void roci::v1::(?P<struct>\w+)::deserialize\(\s*eprosima::fastcdr::Cdr& dcdr\)\s*\{)"
                      r"(?P<body>.*?)(?P<tail>\n\}\n)", re.S)
VALUE = re.compile(r"(?P<indent> *)dcdr >> m_(?P<member>\w+);")
ENUMERATOR = re.compile(r"(?P<indent> *)m_(?P<member>\w+) = \(roci::v1::(?P<enum>\w+)\)enum_value;")
ENUM_SEQUENCE = re.compile(r"(?P<indent> *)m_(?P<member>\w+)\.resize\(seq_length\);\n *"
                           r"dcdr\.deserializeArray\(reinterpret_cast<uint32_t\*>\(m_\w+\.data\(\)\), seq_length\);")


class Types:
    """What the IDL says of members, from the canonical text of contract.py."""

    def __init__(self, definitions):
        self.members = {}
        self.enums = {}
        for name, text in definitions.text.items():
            body = text[text.index("{") + 1:-1]
            if re.match(r"(@\w+ )*enum ", text):
                self.enums[name] = len(body.split(","))
            else:
                self.members[name] = dict(self.member(one) for one in body.split(";") if one)

    @staticmethod
    def member(text):
        text = re.sub(r"@\w+ ", "", text)
        array = re.fullmatch(r"(.*) (\w+) \[ (\d+) \]", text)
        if array:
            return array[2], ("array", array[1], int(array[3]))
        kind, name = text.rsplit(" ", 1)
        sequence = re.fullmatch(r"sequence < (.*) >", kind)
        return name, ("sequence", sequence[1]) if sequence else ("one", kind)

    def least(self, kind):
        """The fewest bytes that a value takes, without padding."""
        kind = kind.replace("unsigned ", "")
        if kind in LEAST:
            return LEAST[kind]
        if kind in self.enums:
            return 4
        if kind not in self.members:
            raise Unreadable(f"{kind} has no size that bound_decoding.py knows")
        return sum(self.least_of_member(member) for member in self.members[kind].values())

    def least_of_member(self, member):
        if member[0] == "sequence":
            return COUNT
        return self.least(member[1]) * (member[2] if member[0] == "array" else 1)


def bounded_body(types, struct, body):
    members = types.members[struct]
    seen = set()

    def value(match):
        member = members[match["member"]]
        seen.add(match["member"])
        lines = [match[0]]
        if member[0] == "sequence":
            lines.insert(0, f"{match['indent']}roci::idl::check_count(dcdr, {types.least(member[1])});")
        if member[1] == "string":
            lines.append(f"{match['indent']}roci::idl::check_text(m_{match['member']});")
        return "\n".join(lines)

    def enumerator(match):
        seen.add(match["member"])
        return f"{match['indent']}roci::idl::check_enumerator(enum_value, {types.enums[match['enum']]});\n{match[0]}"

    def enum_sequence(match):
        seen.add(match["member"])
        enum = members[match["member"]][1]
        return (f"{match['indent']}roci::idl::check_elements(dcdr, seq_length, {COUNT});\n{match[0]}\n"
                f"{match['indent']}roci::idl::check_enumerators(m_{match['member']}, {types.enums[enum]});")

    body = VALUE.sub(value, body)
    body = ENUMERATOR.sub(enumerator, body)
    body = ENUM_SEQUENCE.sub(enum_sequence, body)
    if seen != set(members):
        raise Unreadable(f"{struct}: fastddsgen reads {', '.join(sorted(set(members) - seen))} in an unknown way")
    return body


def bound(types, text):
    def function(match):
        return match["head"] + bounded_body(types, match["struct"], match["body"]) + match["tail"]

    text, count = FUNCTION.subn(function, text)
    return '#include "idl/bounded_decoding.hpp"\n' + text, count


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--generated", required=True, type=pathlib.Path, help="the folder with the .cxx files")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    definitions = Definitions()
    structs = 0
    try:
        for file in arguments.files:
            definitions.read(tokens_of(file.read_text(encoding="utf-8")))
        types = Types(definitions)
        for file in arguments.files:
            generated = arguments.generated / (file.stem + ".cxx")
            text, count = bound(types, generated.read_text(encoding="utf-8"))
            generated.write_text(text, encoding="utf-8")
            structs += count
        if structs != len(types.members):
            raise Unreadable(f"{structs} of {len(types.members)} structs have a deserialize that it knows")
    except Unreadable as error:
        raise SystemExit(f"bound_decoding.py: {error}")


if __name__ == "__main__":
    main()
