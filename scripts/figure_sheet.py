"""Renders images by `relief render` as arrays, and puts arrays on one labelled sheet. Needs NumPy and Pillow."""
import json
import pathlib
import sys

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from measure_clip import run
from read_exr import displayed, read_exr

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
