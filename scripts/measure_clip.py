#!/usr/bin/env python3
"""Measures images of shapes with sharp features, whose splats are clipped by each rule, against their exact meshes.

    models/sharp_models.py SHAPES
    scripts/measure_clip.py RELIEF SHAPES [--engines ewa,surfel] [--rules off,partners] [--only cube,plate] [--json OUT.json]
    scripts/measure_clip.py RELIEF --mesh fandisk.obj     # a mesh whose vertices are the points
    scripts/measure_clip.py RELIEF SHAPES --time          # what clipping costs a frame: ratios to off, in turns

SHAPES is a folder that models/sharp_models.py wrote. Each shape is drawn by each engine with each --clip-partners, and its
mesh by raytrace, all from the same --views. Prints Markdown: a row for each shape, engine and rule, sums over the views.
scripts/judge_images.py says what the columns are. Options after -- go to `relief render` of the points. Needs NumPy.
"""
import argparse
import json
import math
import pathlib
import statistics
import sys

import numpy as np

from judge_images import Truth, judge, summary
from read_exr import displayed, read_exr
from run_command import run

RULES = ("off", "partners", "nearest", "independent", "wicke")
COLUMNS = (("holes", "holes", "d"), ("overhang", "overhang", "d"), ("silhouette_px", "silhouette", ".3f"),
           ("normal_rms_near_deg", "near: rms", ".2f"), ("normal_p99_near_deg", "p99", ".1f"),
           ("normal_rms_deg", "all: rms", ".2f"), ("normal_p99_deg", "p99", ".1f"), ("psnr_db", "PSNR", ".2f"))
FOV = 30.0
TRUTH_SAMPLES = 16


def looking_at(centre, radius, view, zoom=1.0, up="z"):
    """Options of a camera at azimuth/elevation (degrees), from where a sphere fills the image, which is then magnified."""
    a, e = (math.radians(float(angle)) for angle in view.split("/"))
    away = 1.02 * radius / math.sin(math.radians(FOV / 2))
    side, front, height = math.sin(a) * math.cos(e), math.cos(a) * math.cos(e), math.sin(e)
    direction = (side, -front, height) if up == "z" else (side, height, front)
    eye = [c + away * d for c, d in zip(centre, direction)]
    fov = math.degrees(2 * math.atan(math.tan(math.radians(FOV / 2)) / zoom))
    return [f"--eye={','.join(f'{c:.9g}' for c in eye)}", f"--target={','.join(f'{c:.9g}' for c in centre)}", "--up", up,
            "--fov", f"{fov:.6g}"]


def clip_options(rule):
    """None for off, so that commands without clip partners can be measured."""
    return [] if rule == "off" else ["--clip-partners", rule]


def row_of(found):
    return " | ".join("–" if found[key] is None else format(found[key], form) for key, _, form in COLUMNS)


class Measurement:
    def __init__(self, options):
        self.options = options
        self.common = ["--size", options.size, "--background", "none", "--material", "lit"]

    def cameras(self, shape):
        return [looking_at(shape["centre"], shape["radius"], view, up=shape.get("up", "z")) for view in self.options.views]

    def draw(self, scene, path, *options):
        if not (self.options.again and path.exists()):
            run(self.options.relief, "render", scene, "-o", path, *self.common, *options)

    def measure(self, name, shape, points, mesh):
        """Draws one shape by all engines and rules; yields (engine, rule, figures)."""
        options, truths = self.options, []
        for k, camera in enumerate(self.cameras(shape)):
            path = options.work / f"{name}_{k}_truth.exr"
            self.draw(mesh, path, "--engine", "raytrace", "--samples", TRUTH_SAMPLES, *camera)
            truths.append((camera, Truth(path, shape["spacing"], options.tolerance, options.near)))
        for engine in options.engines:
            for rule in options.rules:
                parts = []
                for k, (camera, truth) in enumerate(truths):
                    path = options.work / f"{name}_{k}_{engine}_{rule}.exr"
                    self.draw(points, path, "--engine", engine, *camera, *clip_options(rule), *options.more)
                    parts.append(judge(truth, path)[0])
                yield engine, rule, summary(parts)

    def times(self, shape, points, engine):
        """Frame times of the rules, ms, each the median of turns in which the rules alternate."""
        options, times = self.options, {rule: [] for rule in self.options.rules}
        for _ in range(options.turns):
            for rule in options.rules:
                report = run(options.relief, "render", points, "-o", options.work / "time.exr", "--engine", engine,
                             *self.common, *self.cameras(shape)[0], "--frames", options.frames, "--json",
                             *clip_options(rule), *options.more)
                times[rule].append(json.loads(report)["frame_ms"])
        return {rule: statistics.median(values) for rule, values in times.items()}


def shape_of_mesh(path):
    """What models.json says of a shape, of an .obj or .off of triangles; they stand along y."""
    lines = path.read_text().split("\n")
    if path.suffix == ".obj":
        vertices = [[float(c) for c in line.split()[1:4]] for line in lines if line.startswith("v ")]
        faces = [[int(c.split("/")[0]) - 1 for c in line.split()[1:4]] for line in lines if line.startswith("f ")]
    else:
        body = [line.split() for line in lines[1:] if line.strip() and not line.startswith("#")]
        count, face_count = int(body[0][0]), int(body[0][1])
        vertices = [[float(c) for c in line[:3]] for line in body[1:1 + count]]
        faces = [[int(c) for c in line[1:4]] for line in body[1 + count:1 + count + face_count]]
    vertices = np.array(vertices)
    a, b, c = (vertices[np.array(faces)[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    return {"points": len(vertices), "spacing": math.sqrt(area / len(vertices)), "centre": centre.tolist(), "up": "y",
            "radius": float(np.linalg.norm(vertices - centre, axis=1).max())}


def parse():
    def words(text):
        return text.split(",")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the command, as build/release/cli/relief")
    parser.add_argument("shapes", type=pathlib.Path, nargs="?", help="folder that models/sharp_models.py wrote")
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
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("measure_clip"), help="images go there")
    parser.add_argument("--again", action="store_true", help="judge the images that --work has; draw only those it lacks")
    parser.add_argument("--sheet", help="also write the images of the first view as one .jpg, with holes and overhang; needs Pillow")
    parser.add_argument("--json", type=pathlib.Path, help="write all figures there")
    own, more = (sys.argv[1:], []) if "--" not in sys.argv else (sys.argv[1:sys.argv.index("--")],
                                                                 sys.argv[sys.argv.index("--") + 1:])
    options = parser.parse_args(own)
    if (options.shapes is None) == (options.mesh is None):
        parser.error("give either SHAPES or --mesh")
    options.more = more
    return options


def write_sheet(options, shapes):
    """Puts the first view of all shapes on one sheet: a row for each engine, holes red, overhang green, the truth last."""
    from figure_sheet import PAPER, marked, sheet  # it needs Pillow, which tables do not
    cells = []
    for name, shape, _, _ in shapes:
        path = options.work / f"{name}_0_truth.exr"
        truth = Truth(path, shape["spacing"], options.tolerance, options.near)
        for engine in options.engines:
            for rule in options.rules:
                image = options.work / f"{name}_0_{engine}_{rule}.exr"
                holes, overhang = judge(truth, image)[1]
                colours = marked(displayed(read_exr(image), PAPER), overhang, (0.0, 0.75, 0.1))
                cells.append((f"{name}, {rule}: {holes.sum()} holes, {overhang.sum()} over", marked(colours, holes)))
            cells.append((f"{name}, truth", displayed(read_exr(path), PAPER)))
    sheet(options.sheet, cells, len(options.rules) + 1)


def shapes_of(options):
    """Returns [(name, figures, points, mesh)]."""
    if options.mesh:
        return [(options.mesh.stem, shape_of_mesh(options.mesh), options.points or options.mesh, options.mesh)]
    listed = json.loads((options.shapes / "models.json").read_text())
    names = options.only or [name for name in listed if name not in ("sphere", "torus")]
    return [(name, listed[name], options.shapes / f"{name}.ply", options.shapes / f"{name}_mesh.ply") for name in names]


def main():
    options = parse()
    options.work.mkdir(parents=True, exist_ok=True)
    measurement, found = Measurement(options), {}
    others = [rule for rule in options.rules if rule != "off"]
    if options.time:
        print(f"| shape | engine | off, ms | {' | '.join(others)} |\n| --- | --- |" + " ---: |" * len(options.rules))
    else:
        print(f"| shape | engine | rule | {' | '.join(name for _, name, _ in COLUMNS)} |\n| --- | --- | --- |"
              + " ---: |" * len(COLUMNS))
    for name, shape, points, mesh in shapes_of(options):
        for engine in options.engines if options.time else ():
            times = found.setdefault(name, {})[engine] = measurement.times(shape, points, engine)
            ratios = [f"{times[rule] / times['off']:.2f}" for rule in others]
            print(f"| {name} | {engine} | {times['off']:.1f} | {' | '.join(ratios)} |", flush=True)
        for engine, rule, figures in () if options.time else measurement.measure(name, shape, points, mesh):
            found.setdefault(name, {}).setdefault(engine, {})[rule] = figures
            print(f"| {name} | {engine} | {rule} | {row_of(figures)} |", flush=True)
    if options.sheet:
        write_sheet(options, shapes_of(options))
    if options.json:
        options.json.write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
