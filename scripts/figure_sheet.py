"""What scripts of figures share: images by `relief render` as arrays, arrays on one labelled sheet, the command line.
Needs NumPy and Pillow."""
import argparse
import json
import pathlib
import sys
import tempfile

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from read_exr import displayed, read_exr
from run_command import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAPER = 1.0  # linear; behind the models
LINE = 18


def render(relief, scene, path, *options):
    """Draws an EXR without background; returns its colours on white paper and what --json reports."""
    report = json.loads(run(relief, "render", scene, "-o", path, "--background", "none", "--json", *options))
    return displayed(read_exr(path), PAPER), report


def marked(colours, mask, colour=(1.0, 0.0, 0.0)):
    """Colours with a mask of pixels painted over."""
    painted = colours.copy()
    painted[mask] = colour
    return painted


def sheet(path, cells, columns, limit=290_000):
    """Writes (label, colours) cells as a JPEG of at most `limit` bytes, the best quality that fits."""
    pictures = [Image.fromarray((255 * np.clip(colours, 0, 1) + 0.5).astype(np.uint8)) for _, colours in cells]
    rows = [list(range(first, min(first + columns, len(cells)))) for first in range(0, len(cells), columns)]
    gap = 4
    width = max(sum(pictures[k].width + gap for k in row) for row in rows) - gap
    height = sum(max(pictures[k].height for k in row) + LINE + gap for row in rows) - gap
    whole = Image.new("RGB", (width, height), "white")
    draw, font, y = ImageDraw.Draw(whole), ImageFont.load_default(size=13), 0
    for row in rows:
        x, deepest = 0, max(pictures[k].height for k in row)
        for k in row:
            whole.paste(pictures[k], (x, y))
            draw.text((x + 2, y + pictures[k].height + 1), cells[k][0], fill="black", font=font)
            x += pictures[k].width + gap
        y += deepest + LINE + gap
    for quality in (92, 85, 78, 70, 60, 50, 40):
        whole.save(path, quality=quality, optimize=True)
        if pathlib.Path(path).stat().st_size <= limit:
            return
    sys.exit(f"{path}: is larger than {limit} bytes at any quality")


def draw_figures(description, drawings, make_figures, add_options=None):
    """Parses the command line of a script of figures and draws those of `drawings` that it asks for: draw_NAME() of
    what make_figures(options, work) returns. `add_options(parser)`: the script's own options."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the command, as build/release/cli/relief")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--only", default=",".join(drawings))
    if add_options:
        add_options(parser)
    parser.add_argument("--work", type=pathlib.Path, help="shapes and images stay there (default: a folder that is removed)")
    parser.add_argument("--images", type=pathlib.Path, default=ROOT / "docs" / "images")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = options.work or pathlib.Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        figures = make_figures(options, work)
        for name in options.only.split(","):
            getattr(figures, f"draw_{name}")()
