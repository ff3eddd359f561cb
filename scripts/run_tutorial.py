#!/usr/bin/env python3
"""Runs the commands of docs/tutorial.md in an empty folder, as a new user would.

    scripts/run_tutorial.py [BUILD] [FOLDER]    # build/release and a temporary folder by default

Runs every `sh` block in order and writes the `json` block to views.json. Blocks without a language
are not run: they build Relief and create the folder. Exits with 1 at the first command that fails.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def run_blocks(build, folder):
    page = (ROOT / "docs" / "tutorial.md").read_text(encoding="utf-8")
    environment = dict(os.environ, RELIEF=str(ROOT), PATH=f"{build / 'cli'}:{os.environ['PATH']}")
    for language, block in re.findall(r"^```(sh|json)\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
        if language == "json":
            (folder / "views.json").write_text(block, encoding="utf-8")
            continue
        commands = block.replace('"$RELIEF"/build/release', f'"{build}"')
        done = subprocess.run(["bash", "-exc", commands], cwd=folder, env=environment, check=False)
        if done.returncode != 0:
            sys.exit(f"run_tutorial.py: exit code {done.returncode} of a command of docs/tutorial.md (see above)")


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
