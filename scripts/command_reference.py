#!/usr/bin/env python3
"""Writes docs/command-reference.md from the help of the built command.

    scripts/command_reference.py build/release/cli/relief            # writes the page
    scripts/command_reference.py build/release/cli/relief --check    # exit code 1 if it is out of date

The page holds what `relief --help` and `relief SUBCOMMAND --help` print, as tables. The text is
taken apart instead of copied, so that column widths and blank lines, which differ between versions
of CLI11, do not change the page.
"""
import argparse
import difflib
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "command-reference.md"
COLUMN = 30  # CLI11 starts descriptions here

INTRODUCTION = """# Command reference

<!-- Written by scripts/command_reference.py from the command's own help. Do not edit. -->

What `relief --help` and `relief SUBCOMMAND --help` print. Topic pages explain the options:
[convert](convert.md), [export](export.md), [render](render.md), [compare](compare.md), [bench](bench.md).
"""


class Help:
    """One help text: lines of the description, usage, {section: [[name, text]]}, lines of the footer."""

    def __init__(self, text):
        self.description, self.usage, self.sections, self.footer = [], "", {}, []
        section = None
        seen_blank = False
        for line in text.splitlines():
            if line.startswith("Usage:"):
                self.usage = line.removeprefix("Usage:").strip()
            elif not self.usage:
                self.description.append(line.strip())
            elif not self.footer and re.fullmatch(r"[A-Z][\w ,-]*:", line) and not line.startswith("Examples"):
                section = self.sections.setdefault(line.rstrip(":").capitalize(), [])
                seen_blank = False
            elif not self.footer and not line.strip():
                seen_blank = True
            elif section is not None and not self.footer and line.startswith("  ") and not seen_blank:
                self.add(section, line)
            else:
                self.footer.append(line.rstrip())
        while self.footer and not self.footer[-1]:
            self.footer.pop()

    @staticmethod
    def add(section, line):
        """A line of a section: a name and its text, a name too long for the column, or more text."""
        if line.startswith(" " * COLUMN):
            section[-1][1] = " ".join([section[-1][1], line.strip()]).strip()
        elif len(line) > COLUMN and line[COLUMN - 1] == " ":
            section.append([line[:COLUMN].strip(), line[COLUMN:].strip()])
        else:
            section.append([line.strip(), ""])


def cell(text):
    return text.replace("|", "\\|")


def row_of(name, text):
    """A table row. CLI11 prints what an option needs and excludes behind its name, in the order of addresses."""
    name, *relations = re.split(r" (?=(?:Needs|Excludes|REQUIRED)\b)", name)
    words = [relation.replace(":", "").split() for relation in relations]
    sentences = [text.rstrip("."), *(" ".join([first, *sorted(options)]) for first, *options in words)]
    return f"| `{cell(name)}` | {cell('. '.join(sentences))} |"


def page_of(help_text, heading):
    """The Markdown of one help text."""
    parsed = Help(help_text)
    out = [f"## {heading}", "", " ".join(part for part in parsed.description if part), ""]
    out += ["```", parsed.usage, "```", ""]
    for section, rows in parsed.sections.items():
        out += [f"| {section} | |", "| --- | --- |"]
        out += [row_of(name, text) for name, text in rows]
        out.append("")
    if parsed.footer:
        out += ["```text", *parsed.footer, "```", ""]
    return out, [name for name, _ in parsed.sections.get("Subcommands", [])]


def reference(command):
    def help_of(*arguments):
        done = subprocess.run([command, *arguments, "--help"], capture_output=True, text=True, check=True)
        return done.stdout

    lines, subcommands = page_of(help_of(), "relief")
    if not subcommands:
        sys.exit(f"command_reference.py: {command} --help lists no subcommands")
    for name in subcommands:
        lines += page_of(help_of(name), f"relief {name}")[0]
    return INTRODUCTION + "\n" + "\n".join(lines).rstrip() + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the built command")
    parser.add_argument("--check", action="store_true", help="compare with the page instead of writing it")
    arguments = parser.parse_args()
    try:
        text = reference(arguments.relief)
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"command_reference.py: cannot run {arguments.relief}: {error}")
    if not arguments.check:
        PAGE.write_text(text, encoding="utf-8")
        return
    found = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
    if found == text:
        return
    name = "docs/command-reference.md"
    sys.stdout.writelines(difflib.unified_diff(found.splitlines(keepends=True), text.splitlines(keepends=True),
                                               name, "the command's help"))
    sys.exit(f"command_reference.py: {name} is out of date; run scripts/command_reference.py {arguments.relief}")


if __name__ == "__main__":
    main()
