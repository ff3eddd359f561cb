#!/usr/bin/env python3
"""Makes the figures of docs/measurements/clip-partners.md: those of [Ivo 2011], with Relief.

usage: scripts/make_clip_figures.py RELIEF DATA [--only NAME,...] [--engine surfel|multipass|ewa] [--work DIR] [--images DIR]

DATA is the folder with sharp/. Shapes are made by models/sharp_models.py. Names: densities (Figure 1), cells (Figures 3 and
5), tower (Figure 7), uneven (Figure 8), thinned (Figure 9), gallery (Figure 10). Writes docs/images/clip_*.jpg. Red pixels
are holes, green ones overhang, as scripts/measure_clip.py counts them. Needs NumPy and Pillow.
"""
import json
import pathlib
import sys

from figure_sheet import draw_figures, marked, render, sheet
from judge_images import Truth, judge
from measure_clip import clip_options, looking_at, shape_of_mesh
from run_command import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIDE = 360
RULES = ("off", "nearest", "independent", "partners")
# The shapes are closed. Without it splats that look away from the eye show in a band behind contours.
BACK = ("--cull", "back")
NAMES = {"off": "unclipped"}
HOLE, OVERHANG = (1.0, 0.0, 0.0), (0.0, 0.75, 0.1)


class Figures:
    def __init__(self, options, work):
        self.options, self.work, self.truths = options, work, {}

    def shapes(self, *more, only):
        """The folder and models.json of shapes made with these options."""
        folder = self.work / "_".join(("shapes", *(part.strip("-") for part in more), only))
        if not folder.exists():
            run(sys.executable, ROOT / "models" / "sharp_models.py", folder, "--only", only, *more)
        return folder, json.loads((folder / "models.json").read_text())

    def draw(self, points, mesh, camera, spacing, rule):
        """Returns colours, holes and overhang of one image, and the truth's colours."""
        common = ("--size", f"{SIDE}x{SIDE}", "--material", "lit", *camera)
        key = (mesh, *camera)
        if key not in self.truths:
            path = self.work / f"truth_{len(self.truths)}.exr"
            colours, _ = render(self.options.relief, mesh, path, "--engine", "raytrace", "--samples", 16, *common)
            self.truths[key] = (Truth(path, spacing), colours)
        truth, truth_colours = self.truths[key]
        path = self.work / "image.exr"
        colours, _ = render(self.options.relief, points, path, "--engine", self.options.engine, *common, *clip_options(rule),
                            *([] if self.options.engine == "ewa" else BACK))
        _, (holes, overhang) = judge(truth, path)
        return colours, holes, overhang, truth_colours

    def row(self, name, folder, listed, view, rules=RULES, label="", target=None, zoom=1.0, painted=True):
        """Cells of one shape: the rules, then the truth; holes red and overhang green."""
        shape, cells, truth = listed[name], [], None
        camera = looking_at(target or shape["centre"], shape["radius"], view, zoom=zoom)
        points, mesh = folder / f"{name}.ply", folder / f"{name}_mesh.ply"
        for rule in rules:
            colours, holes, overhang, truth = self.draw(points, mesh, camera, shape["spacing"], rule)
            if painted:
                colours = marked(marked(colours, overhang, OVERHANG), holes, HOLE)
            count = f": {holes.sum()} holes, {overhang.sum()} over" if painted else ""
            cells.append((f"{label}{NAMES.get(rule, rule)}{count}", colours))
        return cells + [(f"{label}truth", truth)]

    def save(self, name, cells, columns):
        self.options.images.mkdir(parents=True, exist_ok=True)
        sheet(self.options.images / f"clip_{name}.jpg", cells, columns)
        print(f"clip_{name}.jpg:", "; ".join(label for label, _ in cells), flush=True)

    def draw_densities(self):
        """Figure 1: a sampling of different densities above, one that is not aligned below; unclipped and clipped."""
        cells = []
        for more, name, view in ((("--pattern", "grid", "--uneven", "2", "--points", "6000"), "plate", "25/45"),
                                 (("--pattern", "scan", "--points", "6000"), "cylinder", "25/35")):
            folder, listed = self.shapes(*more, only=name)
            cells += self.row(name, folder, listed, view, ("off", "partners"), painted=False)
        self.save("densities", cells, 3)

    def draw_cells(self):
        """Figures 3 and 5: the four cells of the table, close: rim, hole's rim, foot of the peg, hole's floor."""
        folder, listed = self.shapes("--points", "6000", only="plate")
        cells = []
        for label, target, view in (("rim, ", (0.0, -0.98, 0.4), "10/40"), ("hole's rim, ", (0.45, 0.25, 0.4), "0/40"),
                                    ("peg's foot, ", (-0.45, -0.25, 0.4), "0/35"),
                                    ("hole's floor, ", (0.45, 0.12, 0.15), "0/65")):
            cells += self.row("plate", folder, listed, view, label=label, target=target, zoom=4.0)
        self.save("cells", cells, 5)

    def draw_tower(self):
        """Figure 7: a tower by independent clipping and by partners, with crops."""
        folder, listed = self.shapes("--points", "8000", only="tower")
        cells = []
        for target, zoom in ((None, 1.0), ((0.0, -0.5, 1.75), 4.0), ((0.0, -0.55, 0.38), 4.0)):
            cells += self.row("tower", folder, listed, "20/40", target=target, zoom=zoom)
        self.save("tower", cells, 5)

    def draw_uneven(self):
        """Figure 8: splats of different sizes on both sides of edges."""
        folder, listed = self.shapes("--points", "6000", "--uneven", "3", only="cylinder")
        cells = self.row("cylinder", folder, listed, "25/35")
        cells += self.row("cylinder", folder, listed, "25/35", target=(0.3, -0.74, 1.4), zoom=4.0)
        self.save("uneven", cells, 5)

    def draw_thinned(self):
        """Figure 9: a shape with 45,000 points and with a tenth of them."""
        cells = []
        for points in ("45000", "4500"):
            folder, listed = self.shapes("--points", points, only="tower")
            cells += self.row("tower", folder, listed, "20/40", ("off", "independent", "partners"), label=f"{points}, ")
        self.save("thinned", cells, 4)

    def draw_gallery(self):
        """Figure 10: all shapes clipped by partners, and fandisk and anchor."""
        cells = []
        for name, view in (("plate", "25/45"), ("tower", "20/40"), ("pyramid5", "20/30"), ("pit4", "20/60"),
                           ("saddle", "35/45"), ("steps", "225/50"), ("notch", "135/35"), ("wedge", "30/35")):
            folder, listed = self.shapes("--points", "8000", only=name)
            cells += self.row(name, folder, listed, view, ("partners",), label=f"{name}, ", painted=False)[:1]
        for file, view in (("fandisk.obj", "205/20"), ("anchor_dense.off", "30/30")):
            path = self.options.data / "sharp" / file
            shape = shape_of_mesh(path)
            camera = looking_at(shape["centre"], shape["radius"], view, up="y")
            for rule in ("off", "partners"):
                colours, *_ = self.draw(path, path, camera, shape["spacing"], rule)
                cells.append((f"{path.stem}, {NAMES.get(rule, rule)}", colours))
        self.save("gallery", cells, 4)


DRAWINGS = ("densities", "cells", "tower", "uneven", "thinned", "gallery")


if __name__ == "__main__":
    draw_figures(__doc__, DRAWINGS, Figures,
                 lambda parser: parser.add_argument("--engine", default="surfel"))
