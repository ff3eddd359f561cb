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
import pathlib
import sys
import tempfile

import numpy as np

import measure_clip
from figure_sheet import displayed, looking_at, marked, render, run, sheet

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "models"))
import sharp_models  # noqa: E402

SIDE = 400
SURFEL = ("--engine", "surfel")
HOLE = (1.0, 0.0, 0.0)
# Colours that tell neighbours apart, 8-bit sRGB.
PALETTE = np.array([(230, 97, 1), (253, 184, 99), (94, 60, 153), (178, 171, 210), (26, 150, 65), (166, 217, 106), (43, 131, 186),
                    (215, 25, 28)], np.uint8)


def clusters_of(points):
    """Splits points across their direction of greatest variance, at the mean, until three or fewer are left; as lists of indices.

    As section 3.3 has it; of four or five points, the smaller part has fewer than three and makes no triangle.
    """
    done, open_sets = [], [np.arange(len(points))]
    while open_sets:
        members = open_sets.pop()
        if len(members) <= 3:
            done.append(members)
            continue
        centred = points[members] - points[members].mean(axis=0)
        direction = np.linalg.eigh(centred.T @ centred)[1][:, 2]
        upper = centred @ direction > 0
        if upper.all() or not upper.any():
            upper = np.arange(len(members)) < len(members) // 2
        open_sets += [members[upper], members[~upper]]
    return done


class Figures:
    def __init__(self, options, work):
        self.options, self.work, self.truths = options, work, {}

    def draw(self, scene, *options, engine=SURFEL, size=SIDE):
        image, report = render(self.options.relief, scene, self.work / "image.exr", *engine, "--size", f"{size}x{size}", *options)
        return displayed(image), report

    def save(self, name, cells, columns):
        self.options.images.mkdir(parents=True, exist_ok=True)
        sheet(self.options.images / f"surfel_{name}.jpg", cells, columns)
        print(f"surfel_{name}.jpg:", "; ".join(label for label, _ in cells), flush=True)

    def sphere(self, count, pattern="scan", coloured=True):
        """A sphere of `count` points of many colours; returns the file and its camera's centre and radius."""
        face = sharp_models.sphere()[0]
        options = argparse.Namespace(pattern=pattern, on_edges=False)
        points, normals, texcoords = sharp_models.sample(face, np.sqrt(face.area() / count), options, np.random.default_rng(2))
        colours = PALETTE[np.random.default_rng(5).integers(0, len(PALETTE), len(points))]
        path = self.work / f"sphere_{count}_{pattern}_{coloured}.ply"
        sharp_models.write_ply(path, points, normals, colours=colours if coloured else None)
        return path, (0, 0, 1), 1.02

    def draw_points(self):
        """Figure 1: points of a sphere, surfels that leave gaps, and surfels that overlap."""
        path, centre, radius = self.sphere(1500)
        camera = looking_at(centre, radius, "20/20")
        common = (*camera, "--material", "lit", "--samples", 4, "--surfel-falloff", 8, "--surfel-blend", "sorted")
        cells = [(label, self.draw(path, *common, "--surfel-scale", scale)[0])
                 for label, scale in (("(a) points: scale 0.2", 0.2), ("(b) surfels: scale 0.8", 0.8), ("(c) overlapping: scale 1.6", 1.6))]
        self.save("points", cells, 3)

    def draw_primitives(self):
        """Figure 2: flat and bent surfels at a contour, of one colour each and with the alpha texture."""
        path, centre, radius = self.sphere(160)
        camera = looking_at((0.0, 0.0, 1.75), radius, "20/10", zoom=2.2)
        cells = []
        for falloff, scale, texture in ((8, 1.0, "one alpha"), (0.5, 1.6, "alpha texture, h = 0.5")):
            for curved in ("none", "all"):
                colours, _ = self.draw(path, *camera, "--material", "lit", "--samples", 16, "--surfel-falloff", falloff, "--surfel-scale",
                                       scale, "--surfel-blend", "sorted", "--surfel-curved", curved)
                cells.append((f"{'flat' if curved == 'none' else 'curved'}, {texture}", colours))
        self.save("primitives", cells, 4)

    def draw_blending(self):
        """Figure 3: only the nearest surfel of each pixel, and blended ones by both rules."""
        path, centre, radius = self.sphere(1500)
        camera = looking_at(centre, radius, "20/20")
        cells = [(label, self.draw(path, *camera, "--material", "lit", *more)[0]) for label, more in (
            ("without blending", ("--surfel-offset", 0)), ("blended: normalised", ()), ("blended: sorted", ("--surfel-blend", "sorted")))]
        self.save("blending", cells, 3)

    def draw_triangles(self):
        """Figure 5: the triangles that the clusters make, and the surfels that have their sizes."""
        path, centre, radius = self.sphere(1500, coloured=False)
        face = sharp_models.sphere()[0]
        points, normals, _ = sharp_models.sample(face, np.sqrt(face.area() / 1500), argparse.Namespace(pattern="scan", on_edges=False),
                                                 np.random.default_rng(2))
        faces, colours = [], []
        found = clusters_of(points)
        for cluster in (c for c in found if len(c) == 3):
            a, b, c = points[cluster]
            outward = np.cross(b - a, c - a) @ normals[cluster[0]] > 0
            faces.append(cluster if outward else cluster[::-1])
        corners = np.concatenate([points[f] for f in faces])
        colours = np.repeat(PALETTE[np.random.default_rng(5).integers(0, len(PALETTE), len(faces))], 3, axis=0)
        mesh = self.work / "triangles.ply"
        sharp_models.write_ply(mesh, corners, np.concatenate([normals[f] for f in faces]), colours=colours,
                               faces=np.arange(len(corners)).reshape(-1, 3))
        camera = looking_at(centre, radius, "20/20")
        print(f"{len(faces)} triangles of {len(points)} points, {len(points) - 3 * len(faces)} points in none")
        cells = [("triangles of the clusters", self.draw(mesh, *camera, "--material", "lit", engine=("--engine", "raytrace"))[0])]
        cells += [(f"surfels, {size}", self.draw(path, *camera, "--material", "lit", "--samples", 4, "--surfel-size", size)[0])
                  for size in ("bsp-edge", "bsp-circle")]
        self.save("triangles", cells, 3)

    def measured(self, scene, mesh, camera, spacing, options, size=SIDE, frames=5):
        """Colours with holes in red, counts of holes and of overhang, normals' rms, and the report of one image."""
        common = ("--size", f"{size}x{size}", "--material", "lit", *camera)
        key = (mesh, *camera, size)
        if key not in self.truths:
            truth_path = self.work / f"truth_{len(self.truths)}.exr"
            image, _ = render(self.options.relief, mesh, truth_path, "--engine", "raytrace", *common)
            self.truths[key] = (measure_clip.Truth(truth_path, spacing, 1.0, 4), displayed(image))
        judged, truth = self.truths[key]
        path = self.work / "measured.exr"
        image, report = render(self.options.relief, scene, path, *SURFEL, *common, "--frames", frames, *options)
        found, (holes, _) = measure_clip.judge(judged, path)
        return marked(displayed(image), holes, HOLE), found, report, truth

    def draw_sizes(self):
        """Figure 6: sizes by the BSP and by QSplat's spheres, at scale 1 and at the scale that closes gaps."""
        path = self.options.data / "scans" / "dragon" / "dragon_vrip.ply.gz"
        centre, radius, spacing = sphere_of(path)
        camera = upright(centre, radius, 20, 10)
        print("| size | scale | holes, of covered pixels | surfels a covered pixel | PSNR | frame, ms, over bsp-edge |")
        print("| --- | --- | ---: | ---: | ---: | ---: |")
        cells, first = [], None
        for size in ("bsp-edge", "bsp-circle", "qsplat"):
            for scale in ("1", "default"):
                more = ("--surfel-size", size) + (("--surfel-scale", scale) if scale != "default" else ())
                colours, found, report, truth = self.measured(path, path, camera, spacing, more, size=600, frames=7)
                first = first or report["frame_ms"]
                overlap = report["fragments"] / report["covered_pixels"] if report.get("fragments") else float("nan")
                psnr = measure_clip.summary([found])["psnr_db"]
                print(f"| {size} | {scale} | {found['holes']} of {found['covered']} | {overlap:.2f} | {psnr:.1f} | "
                      f"{report['frame_ms'] / first:.2f} |", flush=True)
                cells.append((f"{size}, scale {scale}: {found['holes']} holes", colours))
        self.save("sizes", [*cells[:2], cells[4], cells[5]], 2)

    def draw_textured(self):
        """Figure 7: textured sphere and torus, and Spot."""
        cells = []
        folder = self.work / "textured"
        run(sys.executable, ROOT / "models" / "sharp_models.py", folder, "--only", "sphere,torus", "--points", "60000")
        listed = json.loads((folder / "models.json").read_text())
        scenes = [(name, folder / f"{name}.ply", folder / f"{name}_mesh.ply", folder / "texture.png",
                   looking_at(listed[name]["centre"], listed[name]["radius"], "20/35")) for name in ("sphere", "torus")]
        spot = self.options.data / "textured" / "spot"
        mesh = spot / "spot_triangulated.obj"
        scenes.append(("spot", mesh, mesh, spot / "spot_texture.png", upright((0, 0.05, 0.1), 1.15, 30, 15)))
        for name, points, mesh, texture, camera in scenes:
            common = (*camera, "--material", "unlit", "--texture", texture)
            cells.append((f"{name}: surfels", self.draw(points, *common)[0]))
            cells.append((f"{name}: the mesh", self.draw(mesh, *common, engine=("--engine", "raytrace"))[0]))
        self.save("textured", cells, 4)

    def draw_scans(self):
        """Figure 8: Igea and the Buddha, blended, beside rays to their meshes."""
        cells = []
        print("| scan | holes | normals, rms | PSNR | frame, ms |\n| --- | ---: | ---: | ---: | ---: |")
        for name, file, azimuth in (("igea", "igea.ply", 15), ("buddha", "happy_vrip_res3.ply.gz", 20)):
            path = self.options.data / "scans" / file
            centre, radius, spacing = sphere_of(path)
            colours, found, report, truth = self.measured(path, path, upright(centre, radius, azimuth, 5), spacing, (), size=480)
            total = measure_clip.summary([found])
            print(f"| {name} | {found['holes']} of {found['covered']} | {total['normal_rms_deg']:.2f} | {total['psnr_db']:.1f} | "
                  f"{report['frame_ms']:.0f} |", flush=True)
            cells += [(f"{name}: surfels, {found['holes']} holes", colours), (f"{name}: rays to the mesh", truth)]
        self.save("scans", cells, 4)


def upright(centre, radius, azimuth, elevation):
    """Options of a camera for scans that stand along y, whose front looks along z."""
    a, e, fov = np.radians(azimuth), np.radians(elevation), 30.0
    away = 1.02 * radius / np.sin(np.radians(fov / 2))
    eye = np.asarray(centre) + away * np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    return [f"--eye={','.join(f'{c:.9g}' for c in eye)}", f"--target={','.join(f'{c:.9g}' for c in centre)}", "--up=0,1,0", "--fov", fov]


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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the command, as build/release/cli/relief")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--only", default=",".join(DRAWINGS))
    parser.add_argument("--work", type=pathlib.Path, help="images stay there (default: a folder that is removed)")
    parser.add_argument("--images", type=pathlib.Path, default=ROOT / "docs" / "images")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        work = options.work or pathlib.Path(temporary)
        work.mkdir(parents=True, exist_ok=True)
        figures = Figures(options, work)
        for name in options.only.split(","):
            getattr(figures, f"draw_{name}")()


if __name__ == "__main__":
    main()
