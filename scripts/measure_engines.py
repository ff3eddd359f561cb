#!/usr/bin/env python3
"""Compares the engines on three models; writes the table of docs/engines.md and docs/images/engines.svg.

    scripts/measure_engines.py RELIEF FOLDER... [--frames 20] [--size 1280x1024] [--work DIR]

The folders hold, at any depth, dragon_vrip.ply.gz (models/fetch_dragon.sh gets it), fandisk.obj and
lion_takanawa_rgb_normals.ply.gz. Runs `relief bench MODEL --engines all` for each. With --work the reports are kept
there, and those that are there already are not measured again. Takes some minutes, on a machine that does nothing else.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from find_file import find_file
from page_section import write_section

MODELS = ("dragon_vrip.ply.gz", "fandisk.obj", "lion_takanawa_rgb_normals.ply.gz")
DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs"
PAGE = DOCS / "engines.md"
PLOT = DOCS / "images" / "engines.svg"
BEGIN, END = "<!-- Written by scripts/measure_engines.py from here -->", "<!-- to here -->"
PLOT_TITLE = "PSNR over covered pixels against the time of a frame, for each engine on three models"
COLUMNS = ("", "draws", "frame, ms", "over onepass", "GPU, MB", "PSNR, covered", "FLIP", "normals, degrees", "holes",
           "missing", "overhang")


def measure(arguments, path, work):
    """The report and the plot of a model."""
    report, plot = work / f"{path.name}.json", work / f"{path.name}.svg"
    if not report.exists():
        # In the model's folder, so that titles have its name without a path.
        command = [str(arguments.relief.resolve()), "bench", path.name, "--engines", "all", "--json", "--size",
                   arguments.size, "--frames", str(arguments.frames), "--plot", str(plot.resolve())]
        done = subprocess.run(command, capture_output=True, text=True, cwd=path.parent)
        if done.returncode != 0:
            sys.exit(f"measure_engines.py: {' '.join(command)}: {done.stderr.strip()}")
        report.write_text(done.stdout)
    return json.loads(report.read_text()), plot.read_text()


def number(value, digits=0, scale=1.0, missing="-"):
    return missing if value is None else f"{value * scale:,.{digits}f}"


def row_of(row, usual):
    # PSNR and normals of equal images are infinite, or 0, which JSON writes as null only for PSNR.
    name = f"**{row['name']}**" if row["default"] else row["name"]
    psnr = number(row["psnr_covered_db"], 1, missing="same" if row["flip_mean"] == 0.0 else "-")
    cells = (name, row["input"], number(row["frame_ms"]), number(row["frame_ms"] / usual, 2),
             number(row["gpu_bytes"], 1, 1e-6), psnr, number(row["flip_mean"], 4), number(row["normal_rms_deg"], 1),
             number(row["holes"]), number(row["border_missing"]), number(row["border_extra"]))
    return f"| {' | '.join(cells)} |"


def default_of(report):
    return next(row for row in report["rows"] if row["default"])


def description_of(name, report):
    """A line about a model."""
    default = default_of(report)
    points = next((f"{row['samples']:,} points, " for row in report["rows"] if row["input"] == "points"), "")
    truth = (f"truth: its {report['mesh_triangles']:,} faces" if report["truth"] == "faces" else
             "it has no faces; truth: the triangles of the patches, which are what onepass draws with cells")
    return f"- {name}: {points}{default['samples']:,} samples, {default['covered_pixels']:,} pixels; {truth}"


def rows_of(name, report):
    truth = "faces" if report["truth"] == "faces" else "its patches' own triangles"
    usual = default_of(report)["frame_ms"]
    return [f"| *{name}*, truth: {truth} |{' |' * (len(COLUMNS) - 1)}"] + [row_of(row, usual) for row in report["rows"]]


def table_of(reports, arguments):
    any_report = next(iter(reports.values()))
    root = DOCS.parent
    commit = subprocess.run(["git", "-C", root, "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    lines = [f"`relief bench MODEL --engines all --frames {any_report['frames']}`, "
             f"{any_report['width']}x{any_report['height']}, {any_report['material']}; {os.cpu_count()} cores, "
             f"{any_report['renderer']}, commit {commit or 'unknown'}. Medians; engines on the CPU 1 to 5 frames.", "",
             *(description_of(name, report) for name, report in reports.items()), "",
             f"| {' | '.join(COLUMNS)} |", f"| --- | --- |{' ---: |' * (len(COLUMNS) - 2)}"]
    for name, report in reports.items():
        lines += rows_of(name, report)
    return "\n".join([*lines, "", f"![{PLOT_TITLE}](images/{PLOT.name})"])


def first_panel(svg):
    """The width and height of a plot's first panel, and what the plot draws."""
    width, height = (float(v) for v in re.search(r'viewBox="0 0 (\S+) (\S+)"', svg).groups())
    panels = svg.count('class="frame"')
    return width / panels, height, svg[svg.index(">") + 1:svg.rindex("</svg>")]


def stack(plots):
    """The plots' first panels one below the other. The styles of all are the same."""
    panels = [first_panel(plot) for plot in plots]
    width, height = max(p[0] for p in panels), sum(p[1] for p in panels)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
           f'viewBox="0 0 {width:.0f} {height:.0f}">']
    top = 0.0
    for own_width, own_height, content in panels:
        out.append(f'<svg y="{top:.0f}" width="{own_width:.0f}" height="{own_height:.0f}" '
                   f'viewBox="0 0 {own_width:.0f} {own_height:.0f}">{content.rstrip()}\n</svg>')
        top += own_height
    return "\n".join([*out, "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--size", default="1280x1024")
    parser.add_argument("--work", type=pathlib.Path, help="keeps reports there; those in it are not measured again")
    arguments = parser.parse_args()
    paths = [find_file(arguments.folders, name) for name in MODELS]
    reports, plots = {}, []
    with tempfile.TemporaryDirectory() as scratch:
        work = arguments.work or pathlib.Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        for path in paths:
            print(f"measuring {path.name}", file=sys.stderr, flush=True)
            report, plot = measure(arguments, path, work)
            reports[path.name] = report
            plots.append(plot)
    write_section(PAGE, BEGIN, END, table_of(reports, arguments))
    PLOT.write_text(stack(plots), encoding="utf-8")


if __name__ == "__main__":
    main()
