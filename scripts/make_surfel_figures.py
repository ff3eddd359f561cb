#!/usr/bin/env python3
"""Makes the figures of docs/measurements/surfel-figures.md: those of [Textured surfels], with Relief.

usage: scripts/make_surfel_figures.py RELIEF DATA [--only NAME,...] [--work DIR] [--images DIR]

DATA is the folder with scans/ and textured/. Names: points (Figure 1), primitives (Figure 2), blending (Figure 3), triangles
(Figure 5), sizes (Figure 6), textured (Figure 7), scans (Figure 8). Writes docs/images/surfel_*.jpg and prints the tables
of the page. Red pixels are holes: the truth covers them, and the image does not or shows what is far behind. Needs NumPy
and Pillow.
"""
import argparse
import gzip
import json
import math
import pathlib
import sys

import numpy as np

from figure_sheet import draw_figures, marked, render, sheet
from judge_images import Truth, judge, summary
from measure_clip import looking_at
from run_command import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "models"))
from sharp_models import sample, write_ply  # noqa: E402
from sharp_shapes import SHAPES  # noqa: E402

SIDE = 400
BALL = (*looking_at((0.0, 0.0, 1.0), 1.02, "20/20"), "--material", "lit")
SURFEL = ("--engine", "surfel")
HOLE = (1.0, 0.0, 0.0)
# Colours that tell neighbours apart, 8-bit sRGB.
PALETTE = np.array([(230, 97, 1), (253, 184, 99), (94, 60, 153), (178, 171, 210), (26, 150, 65), (166, 217, 106),
                    (43, 131, 186), (215, 25, 28)], np.uint8)


def many_colours(count):
    return PALETTE[np.random.default_rng(5).integers(0, len(PALETTE), count)]


def clusters_of(points):
    """Splits points across their direction of greatest variation until three or fewer are left (section 3.3).

    As renderer/surfels/triangle_clusters.h has it: a split is at the mean, moved by so few points that one side has a
    multiple of three. Returns arrays of indices.
    """
    done, wide = [], [np.arange(len(points))]
    while wide:
        members = wide.pop()
        count = len(members)
        if count <= 3:
            done.append(members)
            continue
        centred = points[members] - points[members].mean(axis=0)
        along = centred @ np.linalg.eigh(centred.T @ centred)[1][:, 2]
        below = int((along < 0).sum())
        sizes = [n for n in range(max(1, below - 3), min(count - 1, below + 3) + 1) if n % 3 == 0 or (count - n) % 3 == 0]
        lower = min(sizes, key=lambda n: abs(n - below))
        members = members[np.argsort(along, kind="stable")]
        wide += [members[:lower], members[lower:]]
    return done


class Figures:
    def __init__(self, options, work):
        self.options, self.work, self.truths = options, work, {}

    def draw(self, scene, *options, engine=SURFEL, size=SIDE):
        return render(self.options.relief, scene, self.work / "image.exr", *engine, "--size", f"{size}x{size}", *options)

    def save(self, name, cells, columns):
        self.options.images.mkdir(parents=True, exist_ok=True)
        sheet(self.options.images / f"surfel_{name}.jpg", cells, columns)
        print(f"surfel_{name}.jpg:", "; ".join(label for label, _ in cells), flush=True)

    def sphere(self, count, coloured=True):
        """Writes a sphere of about `count` points, perhaps of many colours; returns the file, positions and normals."""
        face = SHAPES["sphere"]()[0]
        scan = argparse.Namespace(pattern="scan", on_edges=False)
        points, normals, _ = sample(face, np.sqrt(face.area() / count), scan, np.random.default_rng(2))
        path = self.work / f"sphere_{count}.ply"
        write_ply(path, points, normals, colours=many_colours(len(points)) if coloured else None)
        return path, points, normals

    def draw_points(self):
        """Figure 1: points of a sphere, surfels that leave gaps, and surfels that overlap."""
        path, _, _ = self.sphere(1500)
        common = (*BALL, "--samples", 4, "--surfel-falloff", 8, "--surfel-offset", 0)
        cells = [(f"({letter}) {label}: scale {scale}", self.draw(path, *common, "--surfel-scale", scale)[0])
                 for letter, label, scale in (("a", "points", 0.2), ("b", "surfels", 0.8), ("c", "overlapping", 1.6))]
        self.save("points", cells, 3)

    def draw_primitives(self):
        """Figure 2: flat and bent surfels at a contour, of one colour each and with the alpha texture."""
        path, _, _ = self.sphere(160)
        camera = (*looking_at((0.0, 0.0, 1.75), 1.0, "20/10", zoom=2.2), "--material", "lit", "--samples", 16)
        cells = []
        for label, texture in (("one alpha", ("--surfel-falloff", 8, "--surfel-scale", 1, "--surfel-offset", 0)),
                               ("alpha texture", ("--surfel-blend", "sorted"))):
            cells += [(f"{kind}, {label}", self.draw(path, *camera, *texture, "--surfel-curved", curved)[0])
                      for kind, curved in (("flat", "none"), ("curved", "all"))]
        self.save("primitives", cells, 4)

    def draw_blending(self):
        """Figure 3: only the nearest surfel of each pixel, and blended ones by both rules."""
        path, _, _ = self.sphere(1500)
        cells = [(label, self.draw(path, *BALL, *more)[0]) for label, more in (
            ("without blending", ("--surfel-offset", 0)), ("blended, normalised", ()),
            ("blended, sorted", ("--surfel-blend", "sorted")))]
        self.save("blending", cells, 3)

    def draw_triangles(self):
        """Figure 5: the triangles that the clusters make, and the surfels that have their sizes."""
        path, points, normals = self.sphere(1500, coloured=False)
        faces = []
        for cluster in (c for c in clusters_of(points) if len(c) == 3):
            a, b, c = points[cluster]
            faces.append(cluster if np.cross(b - a, c - a) @ normals[cluster[0]] > 0 else cluster[::-1])
        print(f"{len(faces)} triangles of {len(points)} points; {len(points) - 3 * len(faces)} points are in none")
        corners = np.concatenate(faces)
        mesh = self.work / "triangles.ply"
        write_ply(mesh, points[corners], normals[corners], colours=np.repeat(many_colours(len(faces)), 3, axis=0),
                  faces=np.arange(len(corners)).reshape(-1, 3))
        cells = [("triangles of the clusters", self.draw(mesh, *BALL, engine=("--engine", "raytrace"))[0])]
        cells += [(f"surfels, {size}", self.draw(path, *BALL, "--samples", 4, "--surfel-size", size)[0])
                  for size in ("bsp-edge", "bsp-circle")]
        self.save("triangles", cells, 3)

    def measured(self, path, camera, spacing, size, *more):
        """Draws the points of a mesh; returns colours with red holes, figures, the report, and the truth's colours."""
        common = ("--size", f"{size}x{size}", "--material", "lit", *camera)
        if path not in self.truths:
            image = self.work / f"truth_{path.stem}.exr"
            colours, _ = render(self.options.relief, path, image, "--engine", "raytrace", *common)
            self.truths[path] = (Truth(image, spacing, tolerance=1.0), colours)
        truth, truth_colours = self.truths[path]
        image = self.work / "measured.exr"
        colours, report = render(self.options.relief, path, image, *SURFEL, *common, "--frames", 7, *more)
        found, (holes, _) = judge(truth, image)
        return marked(colours, holes, HOLE), summary([found]), report, truth_colours

    def draw_sizes(self):
        """Figure 6: sizes by the BSP and by QSplat's spheres, at scale 1 and at the scale that closes gaps."""
        path = self.options.data / "scans" / "dragon" / "dragon_vrip.ply.gz"
        centre, radius, spacing = sphere_of(path)
        camera = looking_at(centre, radius, "20/10", up="y")
        print("| size | scale | holes, of covered pixels | surfels a covered pixel | PSNR | frame, over the first |")
        print("| --- | --- | ---: | ---: | ---: | ---: |")
        cells, first = [], None
        for size in ("bsp-edge", "bsp-circle", "qsplat"):
            for scale in ("1", "default"):
                more = () if scale == "default" else ("--surfel-scale", scale)
                colours, found, report, _ = self.measured(path, camera, spacing, 600, "--surfel-size", size, *more)
                first = first or report["frame_ms"]
                overlap = report["fragments"] / report["covered_pixels"] if report["fragments"] else math.nan
                print(f"| {size} | {scale} | {found['holes']} of {found['covered']} | {overlap:.2f} | {found['psnr_db']:.1f} | "
                      f"{report['frame_ms'] / first:.2f} |", flush=True)
                cells.append((f"{size}, scale {scale}: {found['holes']} holes", colours))
        self.save("sizes", [cells[k] for k in (0, 1, 4, 5)], 2)

    def draw_textured(self):
        """Figure 7: textured sphere and torus, and Spot."""
        cells = []
        folder = self.work / "textured"
        run(sys.executable, ROOT / "models" / "sharp_models.py", folder, "--only", "sphere,torus", "--points", "60000")
        listed = json.loads((folder / "models.json").read_text())
        scenes = [(name, folder / f"{name}.ply", folder / f"{name}_mesh.ply", folder / "texture.png",
                   looking_at(listed[name]["centre"], listed[name]["radius"], "20/35"))
                  for name in ("sphere", "torus")]
        spot = self.options.data / "textured" / "spot"
        mesh = spot / "spot_triangulated.obj"
        scenes.append(("spot", mesh, mesh, spot / "spot_texture.png", looking_at((0, 0.1, 0.1), 1.15, "30/15", up="y")))
        for name, points, mesh, texture, camera in scenes:
            common = (*camera, "--material", "unlit", "--texture", texture)
            cells.append((f"{name}: surfels", self.draw(points, *common)[0]))
            cells.append((f"{name}: the mesh", self.draw(mesh, *common, engine=("--engine", "raytrace"))[0]))
        self.save("textured", cells, 4)

    def draw_scans(self):
        """Figure 8: Igea and the Buddha, blended, beside rays to their meshes."""
        cells = []
        print("| scan | holes | normals, rms | PSNR | frame, ms |\n| --- | ---: | ---: | ---: | ---: |")
        for name, file in (("igea", "igea.ply"), ("buddha", "happy_vrip_res3.ply.gz")):
            path = self.options.data / "scans" / file
            centre, radius, spacing = sphere_of(path)
            camera = looking_at(centre, radius, "20/5", up="y")
            colours, found, report, truth = self.measured(path, camera, spacing, 480)
            print(f"| {name} | {found['holes']} of {found['covered']} | {found['normal_rms_deg']:.2f} | "
                  f"{found['psnr_db']:.1f} | {report['frame_ms']:.0f} |", flush=True)
            cells += [(f"{name}: surfels, {found['holes']} holes", colours), (f"{name}: rays to the mesh", truth)]
        self.save("scans", cells, 4)


def sphere_of(path):
    """Centre and radius of a PLY's vertices, and the median distance to the nearest other one."""
    data = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().split("\n")
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    first = next(k for k, line in enumerate(lines) if line.startswith("element vertex"))
    names = []
    for line in lines[first + 1:]:
        if not line.startswith("property"):
            break
        names.append(line.split())
    if "ascii" in lines[1]:
        rows = data[end:].split(b"\n", count)[:count]
        points = np.array([[float(c) for c in row.split()[:3]] for row in rows])
    else:
        kinds = {"float": "f4", "float32": "f4", "uchar": "u1", "double": "f8", "int": "i4"}
        layout = [(name, ("<" if "little" in lines[1] else ">") + kinds[kind]) for _, kind, name in names]
        vertices = np.frombuffer(data, layout, count, end)
        points = np.stack([vertices[c].astype(float) for c in "xyz"], axis=1)
    low, high = points.min(axis=0), points.max(axis=0)
    centre = (low + high) / 2
    some = points[np.random.default_rng(1).integers(0, count, 100)]
    nearest = [np.partition(np.linalg.norm(points - point, axis=1), 1)[1] for point in some]
    return centre.tolist(), float(np.linalg.norm(points - centre, axis=1).max()), float(np.median(nearest))


DRAWINGS = ("points", "primitives", "blending", "triangles", "sizes", "textured", "scans")


if __name__ == "__main__":
    draw_figures(__doc__, DRAWINGS, Figures)
