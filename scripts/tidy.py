#!/usr/bin/env python3
"""Runs clang-tidy on every source file of a build, several files at a time.

Most of clang-tidy's time goes into the headers that all files include. So files whose file-local names
differ are checked as one translation unit; where such a unit does not compile, each half of it is tried.
Generated headers must be there: build before.

usage: scripts/tidy.py BUILD_FOLDER
"""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# A file takes 3.9 s in a group of 12 and 1.9 s in one of 36. Larger ones save little more, and the last one keeps
# a core waiting.
MOST_FILES = 36
# What is defined where a line begins, as clang-format leaves it: types, tests, functions, constants.
NAME = re.compile(r"^(?:template <.*>\n)?(?:(?:struct|class|enum class) (\w+)|using (\w+) =|"
                  r"TEST\w*\((\w+, \w+)|"
                  r"(?!namespace|using|static_assert|INSTANTIATE)"
                  r"[a-zA-Z_](?:[\w:<>,&*\[\] ]*[ &*>])?(\w+)(?:\(|\{| =|\[|;))", re.MULTILINE)


def names_of(file):
    """The names that a file may define. One too many costs a group, one too few a second run."""
    text = re.sub(r"//.*", "", file.read_text())
    return {next(filter(None, match.groups()), "") for match in NAME.finditer(text)} - {"main"}


def flags_of(entry):
    """The compiler's arguments without the file and what is made of it. Those of two words are one."""
    words = shlex.split(entry["command"])
    words = words[[word.endswith("c++") for word in words].index(True) + 1:]
    flags = []
    while words:
        word = words.pop(0)
        if word in ("-o", "-MF", "-MT"):
            words.pop(0)
        elif word == "-isystem":
            flags.append(word + words.pop(0))
        elif word not in ("-c", "-MD", entry["file"]):
            flags.append(word)
    return flags


def config_of(file):
    """The nearest .clang-tidy."""
    return next(folder / ".clang-tidy" for folder in file.parents if (folder / ".clang-tidy").exists())


def macros_of(flags):
    return dict(flag[2:].partition("=")[::2] for flag in flags if flag.startswith("-D"))


class Group:
    """Files that are checked as one, with the flags of all of them."""

    def __init__(self, config):
        self.config, self.flags, self.files, self.names = config, [], [], set()

    def takes(self, flags, config, names):
        own, others = macros_of(self.flags), macros_of(flags)
        return (self.config == config and len(self.files) < MOST_FILES and not names & self.names
                and all(own[name] == others[name] for name in own.keys() & others.keys()))

    def add(self, file, flags, names):
        self.files.append(file)
        self.names |= names
        self.flags += [flag for flag in flags if flag not in self.flags]


def make_groups(entries):
    groups = []
    for entry in entries:
        file = pathlib.Path(entry["file"])
        flags, config, names = flags_of(entry), config_of(file), names_of(file)
        group = next((g for g in groups if g.takes(flags, config, names)), None)
        if group is None:
            group = Group(config)
            groups.append(group)
        group.add(file, flags, names)
    return groups


def run_tidy(file, flags):
    """Its findings; nothing if there are none."""
    # Shadowing is what GCC warns of too; here a function's variable may shadow another file's
    # constant.
    result = subprocess.run(["clang-tidy", "--quiet", str(file), "--", *flags, "-Wno-shadow"],
                            capture_output=True, text=True, check=False)
    if not result.returncode:
        return ""
    # Without findings it has failed itself; then what it complained of counts.
    return result.stdout or result.stderr or f"clang-tidy failed on {file}\n"


def write_unit(files, unit):
    """Writes files as one. Not as includes: the analyzer skips what is not in the main file."""
    lines, sources = [], []
    for k, file in enumerate(files):
        # Programs are checked as one, too: their functions `main` get names of their own.
        text = re.sub(r"^int main\(", f"int main_{k}(", file.read_text(), flags=re.MULTILINE).splitlines()
        lines += text
        sources += [f"{file}:{k + 1}" for k in range(len(text))]
    unit.write_text("\n".join(lines) + "\n")
    return sources


def why_not(unit, flags):
    """Why a unit does not compile; nothing if it does. Takes a tenth of the time of all checks."""
    result = subprocess.run(["clang-tidy", "--quiet", "--checks=-*,misc-definitions-in-headers", str(unit), "--",
                             *flags, "-w"], capture_output=True, text=True, check=False)
    reason = re.search(r"error: (.*) \[clang-diagnostic-", result.stdout)
    return reason[1] if reason else ""


def check(group, files, unit):
    """The findings in some of a group's files."""
    if len(files) == 1:
        return run_tidy(files[0], group.flags)
    sources = write_unit(files, unit)
    # Headers that stand beside the files are found from elsewhere, too.
    flags = group.flags + [f"-iquote{folder}" for folder in sorted({file.parent for file in files})]
    if reason := why_not(unit, flags):
        print(f"{len(files)} files from {files[0].relative_to(ROOT)} on do not compile together: {reason}", flush=True)
        middle = len(files) // 2
        return check(group, files[:middle], unit) + check(group, files[middle:], unit)
    return re.sub(re.escape(str(unit)) + r":(\d+)", lambda m: sources[int(m[1]) - 1], run_tidy(unit, flags))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1]).resolve()
    # A file of several targets once.
    entries = {entry["file"]: entry
               for entry in json.loads((build / "compile_commands.json").read_text())
               if pathlib.Path(entry["file"]).is_relative_to(ROOT)
               and not pathlib.Path(entry["file"]).is_relative_to(build)}
    groups = make_groups(entries.values())
    print(f"clang-tidy: {len(entries)} files in {len(groups)} groups")
    units = build / "tidy"
    shutil.rmtree(units, ignore_errors=True)
    failed = False
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        runs = []
        for k, group in enumerate(groups):
            # Beside a copy of its files' configuration, whose parent is the project's.
            folder = units / group.config.parent.relative_to(ROOT)
            folder.mkdir(parents=True, exist_ok=True)
            if group.config.parent != ROOT:
                shutil.copy(group.config, folder)
            runs.append(pool.submit(check, group, group.files, folder / f"group_{k}.cpp"))
        for run in runs:
            findings = run.result()
            failed = failed or findings != ""
            print(findings, end="", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
