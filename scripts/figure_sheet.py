"""Renders images by `relief render` as arrays, and puts arrays on one labelled sheet. Needs NumPy and Pillow."""
import json
import math
import pathlib
import subprocess
import sys

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from read_exr import read_exr

PAPER = np.array([1.0, 1.0, 1.0])  # behind the models
LINE = 18


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def looking_at(centre, radius, view, fov=30.0, zoom=1.0, up="0,0,1"):
    """Options of a camera at azimuth/elevation (degrees, z up) from which a sphere fills the image, then narrowed."""
    azimuth, elevation = (math.radians(float(angle)) for angle in view.split("/"))
    away = 1.02 * radius / math.sin(math.radians(fov / 2))
    direction = (math.sin(azimuth) * math.cos(elevation), -math.cos(azimuth) * math.cos(elevation), math.sin(elevation))
    eye = [c + away * d for c, d in zip(centre, direction)]
    narrow = math.degrees(2 * math.atan(math.tan(math.radians(fov / 2)) / zoom))
    return [f"--eye={','.join(f'{e:.9g}' for e in eye)}", f"--target={','.join(f'{c:.9g}' for c in centre)}", f"--up={up}",
            "--fov", f"{narrow:.6g}"]


def displayed(image):
    """Premultiplied linear colour over PAPER as a display shows it, height x width x 3 in [0, 1]."""
    linear = np.nan_to_num(np.stack([image[c] for c in "RGB"], axis=-1).astype(float))
    paper = np.where(PAPER <= 0.04045, PAPER / 12.92, ((PAPER + 0.055) / 1.055) ** 2.4)
    linear = np.clip(linear + (1 - np.clip(image["A"], 0, 1))[..., None] * paper, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def render(relief, scene, path, *options):
    """Draws an EXR without background; returns its channels and what --json reports."""
    report = json.loads(run(relief, "render", scene, "-o", path, "--background", "none", "--json", *options))
    return read_exr(path), report


def marked(colours, mask, colour=(1.0, 0.0, 0.0)):
    """Colours with a mask of pixels painted over."""
    painted = colours.copy()
    painted[mask] = colour
    return painted


def magnified(colours, box, factor):
    """The pixels of box (x, y, width, height), each as a square of `factor` pixels."""
    x, y, width, height = box
    return np.repeat(np.repeat(colours[y:y + height, x:x + width], factor, axis=0), factor, axis=1)


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
