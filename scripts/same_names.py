#!/usr/bin/env python3
"""Lists types that two files define by one name in one namespace.

Then the linker takes one of their functions for both, which no compiler tells of: of two `struct Cube`, one
file's std::vector<Cube> may grow by the other's size. Sees what clang-format puts at the beginning of a line,
outside unnamed namespaces.

usage: scripts/same_names.py [--fail]
"""
import collections
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINE = re.compile(r"^(?:(?P<opened>(?:inline )?namespace ?(?P<space>[\w:]*) ?\{)"
                  r"|(?P<closed>\}  // namespace.*)"
                  r"|(?:struct|class|union|enum class|enum) (?P<type>\w+)(?: final)?(?: :[^;{]*)? ?\{)", re.MULTILINE)


def types_of(text):
    """Names of types with their namespaces."""
    spaces, found = [], []
    for line in LINE.finditer(text):
        if line["opened"]:
            spaces.append(line["space"])
        elif line["closed"]:
            spaces.pop()
        elif "" not in spaces:
            found.append("::".join([*spaces, line["type"]]))
    return found


def main():
    if sys.argv[1:] not in ([], ["--fail"]):
        sys.exit(__doc__)
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard", "*.h", "*.cpp"], cwd=ROOT,
                            capture_output=True, text=True, check=True).stdout.split()
    files = collections.defaultdict(list)
    for name in listed:
        for found in types_of((ROOT / name).read_text()):
            files[found].append(name)
    same = {name: where for name, where in files.items() if len(where) > 1}
    for name, where in sorted(same.items()):
        print(f"{name}: {', '.join(where)}")
    if same and sys.argv[1:]:
        sys.exit(1)


if __name__ == "__main__":
    main()
