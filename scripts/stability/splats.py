"""Splats that are degenerate in the image: across the eye's plane, edge-on, huge, tiny, stacked."""
import numpy as np

from stability.page import Section
from stability.pictures import Failed, camera, failure
from stability.scans import sphere, square, write_ply

ENGINES = {"ewa": ["--engine", "ewa"], "ewa source-space": ["--engine", "ewa", "--filter", "source-space"],
           "surfel": ["--engine", "surfel"], "multipass": ["--engine", "multipass"],
           "onepass sprite": ["--primitive", "sprite"], "onepass": []}
LAYERS = 2000


def plane(relief, side=64):
    """Returns a square grid of red points, spacing 1, whose normals are up."""
    points = square(side)
    return write_ply(relief.path("plane.ply"), points, normals=np.tile([0.0, 0, 1], (len(points), 1)),
                     colours=np.tile(np.uint8([200, 40, 40]), (len(points), 1)))


def stack(relief):
    """Returns thousands of small sheets, five spacings behind each other, the front one red and the others blue."""
    sheet = square(6, 0.2)
    points = np.concatenate([sheet - [0.5, 0.5, k] for k in range(LAYERS)])
    colours = np.tile(np.uint8([40, 40, 200]), (len(points), 1))
    colours[:len(sheet)] = [200, 40, 40]
    return write_ply(relief.path("stack.ply"), points, normals=np.tile([0.0, 0, 1], (len(points), 1)), colours=colours)


def cases(relief):
    """Yields (name, scan, what should be covered in %, options)."""
    flat = plane(relief)
    middle = np.array([31.5, 31.5, 0.0])
    for height in (1e-2, 1e-4, 1e-6):
        eye = middle + [0, 0, height]
        yield f"eye {height:g} spacings over the plane, along it", flat, "50", camera(eye, eye + [1, 0, 0], (0, 0, 1))
        yield f"eye {height:g} spacings over the plane, down", flat, "100", camera(eye, middle, (0, 1, 0))
    yield "edge-on, the eye in the plane", flat, "0", camera(middle + [0, -100, 0], middle, (0, 0, 1))
    for degrees in (89.9, 89.9999):
        angle = np.radians(degrees)
        eye = middle + 100 * np.array([0, -np.sin(angle), np.cos(angle)])
        # Less than a pixel high: no row or one is covered; a filter covers up to three.
        yield f"at {degrees:g} degrees: anisotropy {1 / np.cos(angle):.1g}", flat, "0 to 1", camera(eye, middle, (0, 0, 1))
    coarse = write_ply(relief.path("coarse.ply"), sphere(200))
    yield "inside a sphere of 200 points: splats larger than the screen", coarse, "100", [
        *camera((0, 0, 0.97), (0, 0, 2), (0, 1, 0)), "--fov=20"]
    ball = write_ply(relief.path("ball.ply"), sphere(20000))
    for distance in (1e3, 1e6, 1e9):
        # 256 pixels over 45 degrees: a splat of 0.025 is 7.7 / distance pixels wide.
        yield f"splats of {7.7 / distance:.1g} pixels", ball, "0 to 0.02", camera((0, 0, distance), (0, 0, 0))
    yield f"{LAYERS} layers in a pixel", stack(relief), "100 of the front", [
        *camera((0, 0, 1), (0, 0, 0)), "--fov=20", "--material=unlit"]


def measure(relief, _vertices, _triangles):
    section, rows = Section("Splats"), []
    section.text("Points with given normals. Cells give the covered share of the image in %.")
    for name, scan, share, options in cases(relief):
        row = [name, share]
        for engine, words in ENGINES.items():
            try:
                image = relief.render(scan, *words, *options, samples=None if "ewa" in engine else "1")
                cell = f"{100 * image.coverage():.3f}"
                if "layers" in name:  # how red the front is
                    seen = image["A"] > 0
                    cell += f", {100 * np.mean(image['R'][seen] > image['B'][seen]):.0f} % red" if seen.any() else ""
                row.append(cell)
            except Failed as error:
                row.append(failure(error))
        rows.append(row)
    section.table(["case", "expected", *ENGINES], rows)
    return section
