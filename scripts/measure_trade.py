#!/usr/bin/env python3
"""Measures the trade of six scans; writes the tables of docs/trade.md and docs/images/trade_*.svg.

    scripts/measure_trade.py RELIEF FOLDER... [--seconds 420] [--size 640x512] [--frames 20] [--work DIR]

The folders hold, at any depth, dragon_vrip.ply.gz (models/fetch_dragon.sh gets it), lion_takanawa_rgb_normals.ply.gz
and vol_total.las (or vol_total.laz, for a RELIEF with LASzip). The other three scans are made by models/trade_models.py,
which needs NumPy: nothing was chosen by them, so they judge the presets. Runs `relief bench --trade` for each. With --work
the pages and reports are kept there, and those that are there already are not measured again.
"""
import argparse
import json
import os
import pathlib
import re
import sys
import tempfile

from find_file import find_file
from page_section import write_section
from run_command import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "trade.md"
BEGIN, END = "<!-- Written by scripts/measure_trade.py from here -->", "<!-- to here -->"
SCANS = {"dragon": ("dragon_vrip.ply.gz",), "lion": ("lion_takanawa_rgb_normals.ply.gz",), "vol_total": ("vol_total.las", "vol_total.laz")}
UNSEEN = ("shell", "vase", "dunes")
PLOTS = 3  # of a page, in an image
TRUTHS = {"file": "the known surface", "faces": "its faces", "finest patches": "its patches with 4 samples a point"}


def measure(arguments, name, scan, work, truth=None):
    """The report of a scan and its page."""
    report, page = work / f"{name}.json", work / f"{name}.html"
    if not report.exists():
        print(f"measuring {name}", file=sys.stderr, flush=True)
        command = [arguments.relief, "bench", "--trade", scan, "--trade-seconds", arguments.seconds, "--size", arguments.size,
                   "--frames", arguments.frames, "--report", page, "--json"]
        printed = run(*command, *(("--truth", truth) if truth else ()))
        report.write_text(printed, encoding="utf-8")
    return json.loads(report.read_text(encoding="utf-8")), page.read_text(encoding="utf-8")


def number(value, digits=1, scale=1.0, missing="-"):
    return missing if value is None else f"{value * scale:,.{digits}f}"


def costs(row):
    return (number(row["frame_ms"], 0), number(row["psnr_db"]), number(row["surface_psnr_db"]), number(row["normal_rms_deg"]),
            number(row["file_bytes"], 2, 1e-6), number(row["gpu_bytes"], 1, 1e-6), number(row["convert_seconds"]),
            number(row["load_seconds"], 2))


COSTS = ("frame, ms", "picture, dB", "surface, dB", "normals, degrees", "file, MB", "GPU, MB", "conversion, s", "reading, s")


def table(columns, rows, numbers):
    """A table whose last `numbers` columns are numbers."""
    words = len(columns) - numbers
    return [f"| {' | '.join(columns)} |", f"|{' --- |' * words}{' ---: |' * numbers}",
            *(f"| {' | '.join(row)} |" for row in rows)]


def answers_of(reports):
    rows = []
    for name, report in reports.items():
        for answer in report["answers"]:
            if answer["row"] is None:
                rows.append((name, answer["question"], f"none: {answer['why_not']}", *[""] * len(COSTS)))
            else:
                row = report["rows"][answer["row"]]
                rows.append((name, answer["question"], row["name"], *costs(row)))
    return table(("scan", "question", "differs from the default in", *COSTS), rows, len(COSTS))


def presets_of(reports):
    rows = []
    for name, report in reports.items():
        for quality in ("draft", "balanced", "exact"):
            row = next(r for r in report["rows"] if r["quality"] == quality)
            distance = row["distance_to_front"]
            rows.append((name, quality, *costs(row), number(distance["judged"], 1, 100), number(distance["picture_frame"], 1, 100)))
    return table(("scan", "preset", *COSTS, "behind, %", "behind without bytes, %"), rows, len(COSTS) + 2)


def description_of(name, report):
    complete = ", every neighbour of the fronts among them" if report["complete"] else ""
    return (f"- {name}: {report['points']:,} points; truth: {TRUTHS[report['truth']]}, {report['truth_triangles']:,} triangles; "
            f"{len(report['rows'])} settings in {report['seconds']:.0f} s{complete}")


def first_plots(page):
    """A picture of a page's first plots, one below the other."""
    style = re.search(r"<style>(.*?)</style>", page, re.S).group(1)
    rules = "\n".join(line for line in style.splitlines() if line.startswith(".trade"))
    plots = re.findall(r'<svg class="trade" viewBox="0 0 (\d+) (\d+)"[^>]*>(.*?)</svg>', page, re.S)[:PLOTS]
    painters = re.findall(r'background: (#\w+)"></i>([^<]*)', page)
    width, height = int(plots[0][0]), int(plots[0][1])
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" class="trade" width="{width}" height="{height * len(plots) + 30}" '
           f'viewBox="0 0 {width} {height * len(plots) + 30}">', f"<style>{rules}</style>", '<rect width="100%" height="100%" fill="white"/>']
    left = 10
    for colour, name in painters:
        out.append(f'<circle cx="{left + 5}" cy="14" r="5" fill="{colour}"/><text x="{left + 13}" y="18" style="font-size: 10px">{name}</text>')
        left += 24 + 5.2 * len(name)
    for k, (_, _, content) in enumerate(plots):
        out.append(f'<g transform="translate(0 {30 + k * height})">{content}</g>')
    return "\n".join([*out, "</svg>", ""])


def text_of(reports, unseen, arguments):
    any_report = next(iter(reports.values()))
    commit = run("git", "-C", ROOT, "rev-parse", "--short", "HEAD").strip()
    lines = [f"`relief bench --trade SCAN --trade-seconds S --size {arguments.size} --frames {arguments.frames}`, "
             f"{any_report['material']}; {os.cpu_count()} cores, {any_report['renderer']}, commit {commit}:", "",
             *(description_of(name, report) for name, report in {**reports, **unseen}.items()), "",
             "### Answers", "", *answers_of(reports), "", "### Presets", "", *presets_of({**reports, **unseen}), "", "### Plots", ""]
    for name in reports:
        lines += [f"![{name}: the picture against frame time, the surface and the picture against bytes on disk](images/trade_{name}.svg)", ""]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("--seconds", type=int, default=420)
    parser.add_argument("--size", default="640x512")
    parser.add_argument("--frames", type=int, default=20)
    parser.add_argument("--work", type=pathlib.Path, help="keeps pages and reports there; those in it are not measured again")
    arguments = parser.parse_args()
    scans = {name: find_file(arguments.folders, *names) for name, names in SCANS.items()}
    with tempfile.TemporaryDirectory() as scratch:
        work = arguments.work or pathlib.Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        measured = {name: measure(arguments, name, scan, work) for name, scan in scans.items()}
        run(sys.executable, ROOT / "models" / "trade_models.py", work / "models")
        unseen = {name: measure(arguments, name, work / "models" / f"{name}.ply", work, work / "models" / f"{name}_truth.ply")
                  for name in UNSEEN}
    for name, (_, page) in measured.items():
        (ROOT / "docs" / "images" / f"trade_{name}.svg").write_text(first_plots(page), encoding="utf-8")
    text = text_of({name: report for name, (report, _) in measured.items()},
                   {name: report for name, (report, _) in unseen.items()}, arguments)
    write_section(PAGE, BEGIN, END, text)


if __name__ == "__main__":
    main()
