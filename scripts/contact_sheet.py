#!/usr/bin/env python3
"""Renders every scan of a folder with no option but its name, and puts the images on one sheet.

Usage: contact_sheet.py RELIEF FOLDER SHEET.png [--only WORD] [--size WxH] [--columns N] [RENDER OPTION...]

A scan is a file that `relief render` can read, or that the options given make readable; others are listed and skipped.
Below each image stand its name, the share of the image that the model covers, and the larger of its width and height
as shares of the image's. Needs Pillow and NumPy.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy
from PIL import Image, ImageDraw

SCANS = (".ply", ".pcd", ".las", ".laz", ".ptx", ".obj", ".gltf", ".glb", ".drc", ".off", ".stl", ".xyz", ".tif",
         ".csv", ".relief")
THUMBNAIL = (400, 320)
LINE = 16


def scans_in(folder, only):
    """All scans below a folder, sorted by name."""
    for path in sorted(folder.rglob("*")):
        suffix = pathlib.Path(path.stem).suffix if path.suffix == ".gz" else path.suffix
        if path.is_file() and suffix.lower() in SCANS and only in str(path):
            yield path


def covered_box(image):
    """The shares of the image's width and height that differ from its corner's colour."""
    pixels = numpy.asarray(image.convert("RGB")).astype(int)
    differs = numpy.abs(pixels - pixels[0, 0]).max(axis=2) > 6
    if not differs.any():
        return 0.0, 0.0
    rows, columns = numpy.nonzero(differs.any(axis=1))[0], numpy.nonzero(differs.any(axis=0))[0]
    return (columns[-1] - columns[0] + 1) / pixels.shape[1], (rows[-1] - rows[0] + 1) / pixels.shape[0]


def thumbnail_of(relief, scan, options, folder):
    """A labelled thumbnail, or None and the error."""
    out = folder / "image.png"
    done = subprocess.run([relief, "render", scan, "-o", out, "--json", *options], capture_output=True, text=True)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1]
    report = json.loads(done.stdout)
    image = Image.open(out).convert("RGB")
    share = report["covered_pixels"] / (report["width"] * report["height"])
    label = f"{scan.name}  {100 * share:.0f} %  {100 * max(covered_box(image)):.0f} %"
    cell = Image.new("RGB", (THUMBNAIL[0], THUMBNAIL[1] + LINE), "white")
    image.thumbnail(THUMBNAIL, Image.LANCZOS)
    cell.paste(image, ((THUMBNAIL[0] - image.width) // 2, 0))
    ImageDraw.Draw(cell).text((4, THUMBNAIL[1] + 2), label, fill="black")
    return cell, label


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("sheet")
    parser.add_argument("--only", default="")
    parser.add_argument("--columns", type=int, default=5)
    arguments, options = parser.parse_known_args()
    cells = []
    with tempfile.TemporaryDirectory() as folder:
        for scan in scans_in(arguments.folder, arguments.only):
            cell, text = thumbnail_of(arguments.relief, scan, options, pathlib.Path(folder))
            print(text, flush=True)
            if cell is not None:
                cells.append(cell)
    columns = min(arguments.columns, len(cells))
    rows = -(-len(cells) // columns)
    sheet = Image.new("RGB", (columns * THUMBNAIL[0], rows * (THUMBNAIL[1] + LINE)), "white")
    for number, cell in enumerate(cells):
        sheet.paste(cell, (number % columns * THUMBNAIL[0], number // columns * (THUMBNAIL[1] + LINE)))
    sheet.save(arguments.sheet)


if __name__ == "__main__":
    main()
