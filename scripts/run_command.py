"""Runs a program for a script."""
import pathlib
import subprocess
import sys


def run(*command):
    """Returns what the command prints; ends the script with one sentence if it fails."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout
