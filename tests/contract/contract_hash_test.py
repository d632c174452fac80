#!/usr/bin/env python3
"""What changes the hash of a topic type (idl/contract.py), and what does not."""
import pathlib
import re
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "idl"))
import contract  # noqa: E402

FILES = {path.name: path.read_text(encoding="utf-8") for path in sorted((ROOT / "idl").glob("*.idl"))}


def contract_of(files):
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for name, text in files.items():
            paths.append(pathlib.Path(folder) / name)
            paths[-1].write_text(text, encoding="utf-8")
        return contract.contract_of(paths)


def changed(file, old, new):
    assert old in FILES[file], (file, old)
    return contract_of({**FILES, file: FILES[file].replace(old, new, 1)})


class ContractHash(unittest.TestCase):
    base = contract_of(FILES)

    def differing(self, other):
        return {name for name in self.base.keys() | other.keys() if self.base.get(name) != other.get(name)}

    def test_each_topic_type_has_one(self):
        table = (ROOT / "services" / "topics" / "topics.hpp").read_text(encoding="utf-8")
        self.assertEqual(set(self.base), set(re.findall(r'"roci::v1::(\w+)"', table)))
        self.assertEqual(len(set(self.base.values())), len(self.base))

    def test_comments_white_space_and_the_order_of_files_do_not_count(self):
        bare = {name: re.sub(r"\s+", " ", re.sub(r"//[^\n]*", "", re.sub(r"(?m)^#.*$", "", text)))
                for name, text in reversed(FILES.items())}
        self.assertEqual(contract_of(bare), self.base)
        commented = {name: re.sub(r"(?m)^@final ", "@final /* a\n * b */ ", text) for name, text in FILES.items()}
        self.assertEqual(contract_of(commented), self.base)

    def test_the_order_of_definitions_does_not_count(self):
        text = FILES["rpc.idl"]
        first = re.search(r"@final struct SampleIdentity.*?\};\n", text, re.S).group(0)
        moved = text.replace(first, "").replace("}; };", first + "}; };")
        self.assertNotEqual(moved, text)
        self.assertEqual(contract_of({**FILES, "rpc.idl": moved}), self.base)

    def test_names_types_order_keys_and_bounds_count(self):
        for old, new in (("long priority;", "long precedence;"), ("long priority;", "short priority;"),
                         ("  long priority;\n", ""), ("sequence<double> utility;", "double utility;"),
                         ("  @key string id;\n  SampleHeader header;\n  string robot;",
                          "  string id;\n  SampleHeader header;\n  string robot;")):
            self.assertEqual(self.differing(changed("goal.idl", old, new)) & {"Goal", "GoalStatus"}, {"Goal"}, old)
        swapped = changed("goal.idl", "long long opens_us; ", "long long closes_us; ")
        self.assertIn("Goal", self.differing(swapped))
        bound = changed("rpc.idl", "octet writer_guid[16]", "octet writer_guid[12]")
        self.assertIn("PathReply", self.differing(bound))
        self.assertNotIn("Goal", self.differing(bound))

    def test_members_of_enums_count_through_all_types_that_use_them(self):
        enum = changed("goal.idl", "GOAL_HARD, GOAL_OPTIONAL", "GOAL_OPTIONAL, GOAL_HARD")
        self.assertTrue({"Goal", "GoalStatus"} <= self.differing(enum))
        self.assertNotIn("Heartbeat", self.differing(enum))

    def test_a_member_of_the_header_changes_all_that_carry_it(self):
        self.assertEqual(self.differing(changed("basic.idl", "  string sender;", "  string sending;")),
                         set(self.base) - {"ClockReady", "ClockStep", "ClockDone", "Heartbeat", "TimeProbe",
                                           "LeaseMessage", "JournalChunk", "LeaseRequest", "LeaseState",
                                           "GoalHandOver"})

    def test_what_it_cannot_read_it_refuses(self):
        for old, new in (("enum GoalClass", "union GoalClass"), ("@key string issuer;", "@id(3) string issuer;"),
                         ("SampleHeader answers;", "SampleFooter answers;"), ("long priority;", "long priority = 3;")):
            with self.assertRaises(SystemExit, msg=new):
                changed("goal.idl", old, new)


if __name__ == "__main__":
    unittest.main()
