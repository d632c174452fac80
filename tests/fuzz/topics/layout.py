#!/usr/bin/env python3
"""layout.py --out layout.inc --idl FOLDER FILE.idl ...

Writes what the IDL says of every struct and enum as C++ tables, for the maker of samples (sample_maker.hpp).
"""
import argparse
import pathlib
import sys


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--idl", required=True, help="the folder with contract.py and bound_decoding.py")
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    sys.dont_write_bytecode = True
    sys.path.insert(0, arguments.idl)
    from bound_decoding import Types
    from contract import Definitions, tokens_of

    definitions = Definitions()
    for file in arguments.files:
        definitions.read(tokens_of(file.read_text(encoding="utf-8")))
    types = Types(definitions)
    shapes = {"one": "one", "sequence": "sequence", "array": "array"}
    out = "const std::map<std::string, std::vector<Member>> kStructs{\n"
    for name, members in types.members.items():
        out += f'    {{"{name}", {{\n'
        for member, kind in members.items():
            size = kind[2] if kind[0] == "array" else 0
            out += f'        {{"{member}", "{kind[1]}", Shape::{shapes[kind[0]]}, {size}, {types.least(kind[1])}}},\n'
        out += "    }},\n"
    out += "};\nconst std::map<std::string, std::uint32_t> kEnums{\n"
    for name, count in types.enums.items():
        out += f'    {{"{name}", {count}}},\n'
    arguments.out.write_text(out + "};\n", encoding="utf-8")


if __name__ == "__main__":
    main()
