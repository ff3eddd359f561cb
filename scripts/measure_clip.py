#!/usr/bin/env python3
"""Measures images of shapes with sharp features, whose splats are clipped by each rule, against their exact meshes.

    models/sharp_models.py SHAPES
    scripts/measure_clip.py RELIEF SHAPES [--engines ewa,surfel] [--rules off,partners] [--only cube,plate] [--json OUT.json]
    scripts/measure_clip.py RELIEF SHAPES --mesh fandisk.obj    # a mesh whose vertices are the points
    scripts/measure_clip.py RELIEF SHAPES --time                # what clipping costs a frame, in turns

SHAPES is a folder that models/sharp_models.py wrote. Each shape is drawn by each engine with each --clip-partners, and its
mesh by raytrace, all from the same --views. Prints Markdown: a row for each shape, engine and rule, sums over the views.

Pixels are judged where the truth is certain: those that it covers entirely, or not at all.
  holes       the truth covers the pixel, and the image does not, or shows what lies farther by more than the tolerance
  overhang    the truth does not cover the pixel and the image does, or shows what is nearer by more than the tolerance
  silhouette  pixels whose coverage (alpha of 0.5) differs, over the length of the silhouette: its mean displacement, pixels
  near        within --near pixels of an edge of the truth: where normals of neighbours differ by 20 degrees, or depths jump
  rms, p99    angle between normals, degrees, where both cover; near edges, and everywhere
  PSNR        of colour as a display shows it, all pixels, dB
The tolerance of depths is --tolerance spacings, and what the truth's own depth changes by within a pixel. Needs NumPy.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys

import numpy as np

from read_exr import read_exr

RULES = ("off", "partners", "nearest", "independent", "wicke")
FOV = 30.0
EDGE_DEGREES = 20.0
TRUTH_SAMPLES = 16


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"measure_clip.py: {' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def neighbours(values):
    """The 3x3 neighbourhoods of an image, as an array of nine images; borders are repeated."""
    pad = np.pad(values, [(1, 1), (1, 1)] + [(0, 0)] * (values.ndim - 2), mode="edge")
    h, w = values.shape[:2]
    return np.stack([pad[y:y + h, x:x + w] for y in range(3) for x in range(3)])


def dilated(mask, steps):
    for _ in range(steps):
        mask = neighbours(mask).any(axis=0)
    return mask


def camera_options(shape, view):
    """The camera as options: from azimuth and elevation, at the distance from which the shape's sphere fills the image."""
    azimuth, elevation = (math.radians(float(angle)) for angle in view.split("/"))
    away = 1.02 * shape["radius"] / math.sin(math.radians(FOV / 2))
    direction = (math.sin(azimuth) * math.cos(elevation), -math.cos(azimuth) * math.cos(elevation), math.sin(elevation))
    eye = [c + away * d for c, d in zip(shape["centre"], direction)]
    return [f"--eye={','.join(f'{e:.9g}' for e in eye)}", f"--target={','.join(f'{c:.9g}' for c in shape['centre'])}",
            "--up=0,0,1", "--fov", FOV]


def unit_normals(image):
    normals = np.stack([image[f"N.{axis}"] for axis in "XYZ"], axis=-1).astype(float)
    return normals / np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-12)


def displayed(image):
    """Colour over black as a display shows it: sRGB in [0, 1]."""
    linear = np.clip(np.stack([image[c] for c in "RGB"], axis=-1).astype(float), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


class Truth:
    """What images of one view are judged by."""

    def __init__(self, path, spacing, tolerance, near):
        image = read_exr(path)
        self.alpha, self.depth = image["A"].astype(float), image["Z"].astype(float)
        self.normals, self.colours = unit_normals(image), displayed(image)
        self.covered = (self.alpha >= 0.5) & np.isfinite(self.depth)
        around = neighbours(np.where(np.isfinite(self.depth), self.depth, np.nan))
        with np.errstate(all="ignore"):
            change = np.nanmax(around, axis=0) - np.nanmin(around, axis=0)
        change = np.where(np.isfinite(change), change, 0.0)
        self.tolerance = tolerance * spacing + change
        # Around a jump of depths no pixel is judged by depth: which of two surfaces it shows is a matter of its centre.
        turned = np.einsum("kijc,ijc->kij", neighbours(self.normals), self.normals).min(axis=0) < math.cos(math.radians(EDGE_DEGREES))
        border = neighbours(self.covered).any(axis=0) & ~neighbours(self.covered).all(axis=0)
        jump = change > 2.0 * spacing
        self.near = dilated((turned & self.covered) | border | jump, near) & self.covered
        self.certain_in = (self.alpha > 0.999) & np.isfinite(self.depth)
        self.certain_out = self.alpha < 0.001
        self.silhouette = max(1, int(border.sum()) / 2)  # a line's border has a pixel on each side


def judge(truth, path):
    """Returns sums of one image, which add up over views, and masks of holes and overhang."""
    image = read_exr(path)
    depth = image["Z"].astype(float)
    covered = (image["A"] >= 0.5) & np.isfinite(depth)
    both = covered & truth.certain_in
    farther = both & (depth > truth.depth + truth.tolerance)
    nearer = both & (depth < truth.depth - truth.tolerance)
    holes = (truth.certain_in & ~covered) | farther
    overhang = (truth.certain_out & covered) | nearer
    shared = covered & truth.covered
    cosine = np.clip(np.sum(unit_normals(image) * truth.normals, axis=-1), -1, 1)
    angles = np.degrees(np.arccos(cosine))
    squares = (displayed(image) - truth.colours) ** 2
    return {"holes": int(holes.sum()), "overhang": int(overhang.sum()), "uncovered": int((truth.certain_in & ~covered).sum()),
            "differ": int((covered != (truth.alpha >= 0.5)).sum()), "length": truth.silhouette, "covered": int(truth.covered.sum()),
            "angles_near": angles[shared & truth.near], "angles": angles[shared],
            "square": float(np.where(np.isfinite(squares), squares, 1.0).sum()), "values": squares.size}, (holes, overhang)


def summary(parts):
    total = {key: sum(part[key] for part in parts) for key in
             ("holes", "overhang", "uncovered", "differ", "length", "covered", "square", "values")}
    near, everywhere = (np.concatenate([part[key] for part in parts]) for key in ("angles_near", "angles"))

    def rms(angles):
        return float(np.sqrt(np.mean(angles ** 2))) if len(angles) else None
    return {"holes": total["holes"], "uncovered": total["uncovered"], "overhang": total["overhang"], "covered": total["covered"],
            "silhouette_px": total["differ"] / total["length"], "normal_rms_near_deg": rms(near),
            "normal_p99_near_deg": float(np.percentile(near, 99)) if len(near) else None, "normal_rms_deg": rms(everywhere),
            "normal_p99_deg": float(np.percentile(everywhere, 99)) if len(everywhere) else None,
            "psnr_db": -10 * math.log10(max(total["square"] / total["values"], 1e-12))}


COLUMNS = (("holes", "holes", "d"), ("overhang", "overhang", "d"), ("silhouette_px", "silhouette", ".3f"),
           ("normal_rms_near_deg", "near: rms", ".2f"), ("normal_p99_near_deg", "p99", ".1f"), ("normal_rms_deg", "all: rms", ".2f"),
           ("normal_p99_deg", "p99", ".1f"), ("psnr_db", "PSNR", ".2f"))


def row_of(found):
    return " | ".join("–" if found[key] is None else format(found[key], form) for key, _, form in COLUMNS)


class Measurement:
    def __init__(self, options):
        self.options = options
        self.common = ["--size", options.size, "--background", "none", "--material", "lit", *options.more]

    def rule_options(self, engine, rule):
        """Options of a rule; none for off, which commands without clip partners also have."""
        return [] if rule == "off" else ["--clip-partners", rule]

    def measure(self, name, shape, points, mesh):
        """Draws one shape by all engines and rules; yields (engine, rule, figures)."""
        options, truths = self.options, []
        for k, view in enumerate(options.views):
            path = options.work / f"{name}_{k}_truth.exr"
            run(options.relief, "render", mesh, "-o", path, "--engine", "raytrace", "--samples", TRUTH_SAMPLES, *self.common,
                *camera_options(shape, view))
            truths.append(Truth(path, shape["spacing"], options.tolerance, options.near))
        for engine in options.engines:
            for rule in options.rules:
                parts = []
                for k, view in enumerate(options.views):
                    path = options.work / f"{name}_{k}_{engine}_{rule}.exr"
                    run(options.relief, "render", points, "-o", path, "--engine", engine, *self.common, *camera_options(shape, view),
                        *self.rule_options(engine, rule))
                    found, (holes, overhang) = judge(truths[k], path)
                    if options.masks:
                        np.savez_compressed(path.with_suffix(".npz"), holes=holes, overhang=overhang, near=truths[k].near)
                    parts.append(found)
                yield engine, rule, summary(parts)

    def times(self, shape, points, engine):
        """Frame times of the rules over that of off, each the median of turns in which the rules alternate."""
        options, times = self.options, {rule: [] for rule in options.rules}
        for _ in range(options.turns):
            for rule in options.rules:
                report = run(options.relief, "render", points, "-o", options.work / "time.exr", "--engine", engine, *self.common,
                             *camera_options(shape, options.views[0]), "--frames", options.frames, "--json",
                             *self.rule_options(engine, rule))
                times[rule].append(json.loads(report)["frame_ms"])
        return {rule: statistics.median(values) for rule, values in times.items()}


def shape_of_mesh(options):
    """A mesh as a shape: its sphere and its spacing, by `relief info`'s own bounds would need a patch file, so by reading OBJ or OFF."""
    vertices, area = [], 0.0
    lines = options.mesh.read_text().split("\n")
    if options.mesh.suffix == ".obj":
        vertices = np.array([[float(c) for c in line.split()[1:4]] for line in lines if line.startswith("v ")])
        faces = [[int(c.split("/")[0]) - 1 for c in line.split()[1:4]] for line in lines if line.startswith("f ")]
    else:
        count, face_count = (int(c) for c in lines[1].split()[:2])
        body = [line for line in lines[2:] if line.strip()]
        vertices = np.array([[float(c) for c in line.split()[:3]] for line in body[:count]])
        faces = [[int(c) for c in line.split()[1:4]] for line in body[count:count + face_count]]
    a, b, c = (vertices[np.array(faces)[:, k]] for k in range(3))
    area = float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    centre = (low + high) / 2
    return {"points": len(vertices), "spacing": math.sqrt(area / len(vertices)), "centre": centre.tolist(),
            "radius": float(np.linalg.norm(vertices - centre, axis=1).max())}


def parse():
    def words(text):
        return text.split(",")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the command, as build/release/cli/relief")
    parser.add_argument("shapes", type=pathlib.Path, help="folder that models/sharp_models.py wrote")
    parser.add_argument("--only", type=words, help="shapes (default: all that have edges)")
    parser.add_argument("--mesh", type=pathlib.Path, help="an .obj or .off of triangles, measured in place of the shapes")
    parser.add_argument("--points", type=pathlib.Path, help="points of --mesh (default: its vertices)")
    parser.add_argument("--engines", type=words, default=["ewa", "multipass", "surfel"])
    parser.add_argument("--rules", type=words, default=list(RULES))
    parser.add_argument("--views", type=words, default=["25/35", "140/55", "250/15"], help="azimuth/elevation, degrees")
    parser.add_argument("--size", default="400x400")
    parser.add_argument("--near", type=int, default=4, help="pixels from an edge")
    parser.add_argument("--tolerance", type=float, default=0.2, help="of depths, spacings")
    parser.add_argument("--time", action="store_true", help="measure frame times instead of images")
    parser.add_argument("--turns", type=int, default=5)
    parser.add_argument("--frames", type=int, default=3)
    parser.add_argument("--masks", action="store_true", help="write holes and overhang as .npz beside the images")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("measure_clip"), help="images go there")
    parser.add_argument("--json", type=pathlib.Path, help="write all figures there")
    parser.add_argument("more", nargs="*", help="after --: more options of `relief render`, for all images of points and meshes")
    return parser.parse_args()


def shapes_of(options):
    """Returns [(name, figures, points, mesh)]."""
    if options.mesh:
        return [(options.mesh.stem, shape_of_mesh(options), options.points or options.mesh, options.mesh)]
    listed = json.loads((options.shapes / "models.json").read_text())
    names = options.only or [name for name in listed if name not in ("sphere", "torus")]
    return [(name, listed[name], options.shapes / f"{name}.ply", options.shapes / f"{name}_mesh.ply") for name in names]


def main():
    options = parse()
    options.work.mkdir(parents=True, exist_ok=True)
    measurement, found = Measurement(options), {}
    if options.time:
        print("| shape | engine | off, ms | " + " | ".join(r for r in options.rules if r != "off") + " |")
        print("| --- | --- |" + " ---: |" * len(options.rules))
    else:
        print("| shape | engine | rule | " + " | ".join(name for _, name, _ in COLUMNS) + " |")
        print("| --- | --- | --- |" + " ---: |" * len(COLUMNS))
    for name, shape, points, mesh in shapes_of(options):
        if options.time:
            for engine in options.engines:
                times = measurement.times(shape, points, engine)
                found.setdefault(name, {})[engine] = times
                ratios = [f"{times[rule] / times['off']:.2f}" for rule in options.rules if rule != "off"]
                print(f"| {name} | {engine} | {times['off']:.1f} | {' | '.join(ratios)} |", flush=True)
            continue
        for engine, rule, figures in measurement.measure(name, shape, points, mesh):
            found.setdefault(name, {}).setdefault(engine, {})[rule] = figures
            print(f"| {name} | {engine} | {rule} | {row_of(figures)} |", flush=True)
    if options.json:
        options.json.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
