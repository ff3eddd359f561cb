"""Finds the scans that a script measures."""
import pathlib
import sys


def find_file(folders, *names):
    """Returns the first file, at any depth of the folders, that has the first of the names that one has; ends the script with one
    sentence if there is none."""
    for name in names:
        for folder in folders:
            for path in sorted(folder.rglob(name)):
                return path
    sys.exit(f"{pathlib.Path(sys.argv[0]).name}: none of the folders holds {names[0]}")
