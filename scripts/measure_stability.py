#!/usr/bin/env python3
"""Measures where Relief bends at extremes, and writes docs/stability.md with its plots.

    scripts/measure_stability.py RELIEF DATA -o docs/stability.md     # all of it, ten minutes of two cores
    scripts/measure_stability.py RELIEF --only whole --check          # what ctest runs

DATA holds scans/dragon/dragon_vrip_res4.ply.gz, colour/lion_takanawa_rgb_normals.ply.gz and
georef/vol_total.laz; scenes that it lacks are left out. Every picture's channels and every report are
looked through for NaN and infinity. With --check the exit code is 1 if any is found, or if the program
as a whole does not behave. Needs NumPy.
"""
import argparse
import concurrent.futures
import importlib
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

import numpy as np

from stability.page import Section
from stability.pictures import Relief
from stability.scans import read_mesh, sphere

SECTIONS = ["scenes", "moves", "cameras", "splats", "volumes", "points", "precision", "whole"]
HERE = pathlib.Path(__file__).parent


def mesh_of(data):
    """Returns the Dragon's vertices and triangles, or a ball's points without triangles."""
    path = data / "scans/dragon/dragon_vrip_res4.ply.gz" if data else None
    return read_mesh(path) if path and path.exists() else (sphere(5000), None)


def machine():
    names = [line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo", encoding="utf-8") if line.startswith("model name")]
    commit = subprocess.run(["git", "-C", HERE, "rev-parse", "--short", "HEAD"], capture_output=True, text=True, check=False)
    return f"{names[0] if names else platform.machine()}, {os.cpu_count()} cores, Mesa llvmpipe; commit `{commit.stdout.strip()}`"


def measured(name, program, data):
    """Returns a section, and the program's runs with what in them was not finite."""
    vertices, triangles = mesh_of(data)
    with tempfile.TemporaryDirectory(prefix="relief-stability-") as folder:
        relief = Relief(program, folder)
        relief.data = data
        section = importlib.import_module(f"stability.{name}").measure(relief, vertices, triangles)
    return section, relief


def channels(runs):
    """Returns the section about values that are not finite."""
    section, not_finite = Section("No NaN and no infinity"), [n for r in runs for n in r.not_finite]
    section.text(f"{sum(r.pictures for r in runs)} pictures with {sum(r.values for r in runs)} values, all exports and all reports "
                 f"of this page were looked through. Not finite: {len(not_finite) or 'none'}. Depth is infinite where nothing is "
                 "seen, by definition.")
    section.table(["command", "channel", "values"], not_finite)
    section.wrong = not_finite
    return section


def write(page, sections):
    page.parent.mkdir(parents=True, exist_ok=True)
    images = page.parent / "images"
    images.mkdir(exist_ok=True)
    lines = [(HERE / "stability/head.txt").read_text().format(machine=machine())]
    for section in sections:
        lines += section.lines
        for plot in section.plots:
            (images / plot.file).write_text(plot.svg())
    lines.append((HERE / "stability/tail.txt").read_text())
    page.write_text("\n".join(lines).rstrip() + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the built command")
    parser.add_argument("data", nargs="?", type=pathlib.Path, help="folder of scans")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="page to write; default: only print it")
    parser.add_argument("--only", default=",".join(SECTIONS), help="sections, separated by commas")
    parser.add_argument("--jobs", type=int, default=1, help="sections that are measured at the same time (default 1)")
    parser.add_argument("--check", action="store_true", help="exit code 1 if something is not as it should be")
    arguments = parser.parse_args()
    names = arguments.only.split(",")
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        done = list(pool.map(measured, names, [arguments.relief] * len(names), [arguments.data] * len(names)))
    sections = [section for section, _ in done] + [channels([run for _, run in done])]
    for section in sections:
        print("\n".join(section.lines))
    if arguments.output:
        write(arguments.output, sections)
    sys.exit(1 if arguments.check and any(section.wrong for section in sections) else 0)


if __name__ == "__main__":
    main()
