#!/usr/bin/env python3
"""Runs the commands of docs/tutorial.md in an empty folder, as a new user would.

    scripts/run_tutorial.py [BUILD] [FOLDER]    # build/release and a temporary folder by default

Runs every `sh` block in order and writes the `json` block to views.json. Every line of a `text` block
must be printed by the commands before it. Blocks without a language are not run: they build Relief
and create the folder. Exits with 1 if a command fails or a line is missing. (With another version of
Mesa or Embree than that of Debian 12, last digits of the comparison may differ.)
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def run_block(block, build, folder):
    """Runs a block of commands and returns what they print."""
    environment = dict(os.environ, RELIEF=str(ROOT), PATH=f"{build / 'cli'}:{os.environ['PATH']}")
    commands = block.replace('"$RELIEF"/build/release', f'"{build}"')
    done = subprocess.run(["bash", "-exc", commands], cwd=folder, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    sys.stdout.write(done.stdout)
    sys.stdout.flush()
    if done.returncode != 0:
        sys.exit(f"run_tutorial.py: exit code {done.returncode} of a command of docs/tutorial.md (see above)")
    return done.stdout


def run_blocks(build, folder):
    page = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    printed, missing = set(), []
    for language, block in re.findall(r"^```(sh|json|text)\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
        if language == "json":
            (folder / "views.json").write_text(block, encoding="utf-8")
        elif language == "sh":
            printed.update(run_block(block, build, folder).splitlines())
        else:
            missing += [line for line in block.splitlines() if line not in printed]
    for line in missing:
        print(f"docs/tutorial.md shows a line that no command printed: {line}")
    if missing:
        sys.exit(f"run_tutorial.py: {len(missing)} lines of docs/tutorial.md are out of date")


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build" / "release").resolve()
    if len(sys.argv) > 2:
        folder = pathlib.Path(sys.argv[2])
        folder.mkdir(parents=True)
        run_blocks(build, folder)
        return
    with tempfile.TemporaryDirectory() as folder:
        run_blocks(build, pathlib.Path(folder))


if __name__ == "__main__":
    main()
