#!/usr/bin/env python3
"""contract.py --build VERSION --out contract.h FILE.idl ...

Writes the contract of the wire: for each topic type of these files a hash of its closure, that is of everything that
decides how its samples are read: names and types of all members in their order, keys, array bounds, members of enums,
and the same of every type that it stands on. Comments, white space, file names and the order of definitions do not
count. A topic type is a struct that no other contains, or that has a key or a header of its own.
"""
import argparse
import hashlib
import pathlib
import re
import sys

BASIC = {"boolean", "octet", "char", "short", "long", "unsigned", "float", "double", "string", "sequence"}
HEADERS = {"SampleHeader", "RequestHeader", "ReplyHeader"}
TOKEN = re.compile(r"@\w+|\w+(?:::\w+)*|[{}()\[\]<>;,]")


class Unreadable(Exception):
    pass


def tokens_of(text):
    text = re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r"^\s*#[^\n]*", " ", text, flags=re.M)
    tokens = TOKEN.findall(text)
    if "".join(tokens) != re.sub(r"\s+", "", text):
        raise Unreadable("there is a character that contract.py does not know")
    return tokens


class Definitions:
    """Structs and enums by name: the canonical text of each, and the types that it names."""

    def __init__(self):
        self.text = {}
        self.uses = {}
        self.topics = set()  # that have a key or a header

    def read(self, tokens):
        self.tokens, self.at, self.scope = tokens, 0, []
        while self.at < len(tokens):
            self.definition()
        if self.scope:
            raise Unreadable("a module is not closed")

    def next(self, expected=None):
        if self.at == len(self.tokens):
            raise Unreadable("the file ends early")
        token = self.tokens[self.at]
        if expected and token != expected:
            raise Unreadable(f"'{token}' stands where '{expected}' is expected")
        self.at += 1
        return token

    def annotations(self):
        found = []
        while self.tokens[self.at].startswith("@"):
            found.append(self.next())
        if self.tokens[self.at] == "(":
            raise Unreadable(f"{found[-1]} has a value; contract.py knows no such annotation")
        return found

    def definition(self):
        annotations = self.annotations()
        kind = self.next()
        if kind == "}":
            self.scope.pop()
            self.next(";")
        elif kind == "module":
            self.scope.append(self.next())
            self.next("{")
        elif kind in ("struct", "enum"):
            name = self.next()
            body = self.struct_body(name) if kind == "struct" else self.enum_body(name)
            full = "::".join(self.scope + [name])
            if name in self.text:
                raise Unreadable(f"{name} is defined twice")
            self.text[name] = " ".join(annotations + [kind, full]) + "{" + body + "}"
        else:
            raise Unreadable(f"contract.py does not know '{kind}'; teach it before the IDL uses it")

    def enum_body(self, name):
        self.uses[name] = []
        self.next("{")
        members = [self.next()]
        while self.next() == ",":
            members.append(self.next())
        self.next(";")
        return ",".join(members)

    def struct_body(self, name):
        self.uses[name] = []
        self.next("{")
        body = ""
        while self.tokens[self.at] != "}":
            member = self.annotations()
            if "@key" in member:
                self.topics.add(name)
            while self.tokens[self.at] != ";":
                member.append(self.next())
            self.next(";")
            for word in member:
                last = word.split("::")[-1]
                if re.fullmatch(r"[A-Z]\w*", last):
                    self.uses[name].append(last)
                if last in HEADERS and len(member) == 2:
                    self.topics.add(name)
            body += " ".join(member) + ";"
        self.next("}")
        self.next(";")
        return body

    def closure(self, name):
        """The names that a type stands on, itself included, each once."""
        seen, waiting = set(), [name]
        while waiting:
            one = waiting.pop()
            if one in seen:
                continue
            if one not in self.text:
                raise Unreadable(f"{name} uses {one}, which is not defined")
            seen.add(one)
            waiting += self.uses[one]
        return seen

    def hash_of(self, name):
        text = self.text[name] + "".join(self.text[one] for one in sorted(self.closure(name) - {name}))
        return hashlib.sha256(text.encode()).hexdigest()[:8]

    def topic_types(self):
        contained = {used for uses in self.uses.values() for used in uses}
        structs = {name for name, text in self.text.items() if re.match(r"(@\w+ )*struct ", text)}
        return sorted(name for name in structs if name in self.topics or name not in contained)


def contract_of(files):
    definitions = Definitions()
    for file in files:
        try:
            definitions.read(tokens_of(pathlib.Path(file).read_text(encoding="utf-8")))
        except Unreadable as error:
            raise SystemExit(f"{file}: {error}")
    try:
        return {name: definitions.hash_of(name) for name in definitions.topic_types()}
    except Unreadable as error:
        raise SystemExit(str(error))


def header(contract, build):
    entries = "".join(f' \\\n  ";{name}={value}"' for name, value in contract.items())
    return f"""/* Generated from the files of idl/ by idl/contract.py: the contract of this build, for the USER_DATA of a participant
   (docs/dds.md, "Same types on both sides"). It is C and C++. */
#ifndef ROCI_IDL_CONTRACT_H
#define ROCI_IDL_CONTRACT_H

#define ROCI_BUILD "{build}"

#define ROCI_ANNOUNCEMENT "roci;build=" ROCI_BUILD{entries}

#endif
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="unknown", help="version that is announced beside the hashes")
    parser.add_argument("--out", help="the header to write; without it NAME=HASH lines go to standard output")
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    contract = contract_of(arguments.files)
    if arguments.out:
        pathlib.Path(arguments.out).write_text(header(contract, arguments.build), encoding="utf-8")
    else:
        sys.stdout.write("".join(f"{name}={value}\n" for name, value in contract.items()))


if __name__ == "__main__":
    main()
