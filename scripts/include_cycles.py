#!/usr/bin/env python3
"""Counts include cycles among the project's headers and sources.

A source and the header of its name are one unit. A cycle is a set of units that all include each
other, directly or not: a strongly connected component of more than one unit.

Usage: include_cycles.py [--fail] [ROOT]   (exit 1 with --fail if there is a cycle)
"""

import argparse
import pathlib
import re
import sys

FOLDERS = ("common", "preprocess", "renderer", "integrations", "loader", "viewer", "cli", "shaders", "tests")
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)


def read_units(root):
    """Each unit with the units that it includes, both as paths without an ending."""
    files = {}
    for folder in FOLDERS:
        for path in (root / folder).rglob("*"):
            if path.suffix in (".h", ".cpp"):
                files[path.relative_to(root).as_posix()] = path
    units = {}
    for name, path in files.items():
        included = units.setdefault(name.rsplit(".", 1)[0], set())
        for other in INCLUDE.findall(path.read_text(encoding="utf-8")):
            if other in files:
                included.add(other.rsplit(".", 1)[0])
    for name, included in units.items():
        included.discard(name)
    return units


def find_cycles(units):
    """Tarjan's strongly connected components of more than one unit, without recursion."""
    index, low, on_stack, stack, cycles = {}, {}, set(), [], []
    for start in sorted(units):
        if start in index:
            continue
        index[start] = low[start] = len(index)
        stack.append(start)
        on_stack.add(start)
        work = [(start, iter(sorted(units[start])))]
        while work:
            unit, rest = work[-1]
            for other in rest:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    on_stack.add(other)
                    work.append((other, iter(sorted(units[other]))))
                    break
                if other in on_stack:
                    low[unit] = min(low[unit], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[unit])
                if low[unit] == index[unit]:
                    cycle = []
                    while not cycle or cycle[-1] != unit:
                        cycle.append(stack.pop())
                        on_stack.discard(cycle[-1])
                    if len(cycle) > 1:
                        cycles.append(sorted(cycle))
    return sorted(cycles, key=len, reverse=True)


def main():
    parser = argparse.ArgumentParser(description="Counts include cycles.")
    parser.add_argument("root", nargs="?", default=pathlib.Path(__file__).parent.parent,
                        type=pathlib.Path, help="the checkout (by default this one)")
    parser.add_argument("--fail", action="store_true", help="exit 1 if there is a cycle")
    arguments = parser.parse_args()
    units = read_units(arguments.root)
    cycles = find_cycles(units)
    print(f"{len(units)} units, {len(cycles)} include cycles")
    for cycle in cycles:
        print(f"  a cycle of {len(cycle)}:")
        for unit in cycle:
            inside = sorted(units[unit] & set(cycle))
            print(f"    {unit} -> {', '.join(inside)}")
    return 1 if arguments.fail and cycles else 0


if __name__ == "__main__":
    sys.exit(main())
