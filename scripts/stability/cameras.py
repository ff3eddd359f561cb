"""Cameras that are very near, very far, grazing, wide, narrow or inside, and images of odd sizes."""
import numpy as np

from stability.moves import Body
from stability.page import Section
from stability.pictures import Failed, camera, decibels, failure, psnr, shot
from stability.plot import Plot
from stability.scans import square, write_ply

# All draw the same patches, so that ray tracing, in double precision where rays begin, is the truth.
METHODS = ["onepass", "onepass direct", "onepass sprite", "multipass"]
NEAR = [10.0, 1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5]  # spacings
FAR = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6]  # sizes of the model
FIELDS = [0.01, 0.1, 1, 10, 90, 150, 170, 175]  # degrees
SIZES = ["1x1", "3x2", "1x100", "100x1", "20x2000", "2000x20", "16384x160", "160x16384"]


class Scene:
    """The Dragon's patches and its mesh."""

    def __init__(self, relief, vertices, triangles):
        self.relief, self.body = relief, Body(vertices, triangles)
        self.scan = write_ply(relief.path("camera.ply"), vertices, triangles)
        self.patches, report = relief.convert(self.scan, "camera.relief")
        self.spacing = report["spacing"]

    def row(self, name, *options, size="320x256"):
        """Returns the cells of a table's row and {method: PSNR to the ray-traced patches}."""
        try:
            truth = self.relief.render(self.patches, "--engine", "raytrace", *options, size=size)
        except Failed as error:
            return [name, failure(error)], {}
        cells, found = [name, f"{100 * truth.coverage():.2f}"], {}
        for method in METHODS:
            try:
                image = shot(self.relief, method, self.patches, self.scan, *options, size=size)
                found[method] = psnr(image, truth)
                cells.append(f"{decibels(found[method])} ({100 * image.coverage():.2f})")
            except Failed as error:
                cells.append(failure(error))
        for engine in ("ewa", "surfel"):  # their splats reach beyond the mesh: only what they cover compares
            try:
                image = shot(self.relief, engine, self.patches, self.scan, *options, size=size)
                cells.append(f"({100 * image.coverage():.2f})")
            except Failed as error:
                cells.append(failure(error))
        return cells, found


HEAD = ["camera", "truth covers, %", *METHODS, "ewa", "surfel"]


def frontmost(body):
    """Returns the vertex that is farthest in front, and its normal."""
    i = int(np.argmax(body.vertices[:, 2]))
    faces = body.triangles[(body.triangles == i).any(axis=1)]
    a, b, c = (body.vertices[faces[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a).sum(0)
    return body.vertices[i], normal / np.linalg.norm(normal)


def measure(relief, vertices, triangles):
    scene = Scene(relief, vertices, triangles)
    body, section = scene.body, Section("Cameras")
    section.text("Cells give the PSNR to the ray-traced patches in dB, and in brackets the covered share of the image in %.",
                 "`ewa` and `surfel` draw the points.")
    rows = []
    point, normal = frontmost(body)
    for spacings in NEAR:
        rows.append(scene.row(f"{spacings:g} spacings off the surface",
                              *camera(point + normal * scene.spacing * spacings, point))[0])
    far = Plot("stability_far.svg", "Camera far away, the model as large in the image", "distance, in sizes of the model",
               "PSNR to the ray-traced patches, dB", top=60.0)
    direction = np.array([0.3, 0.2, 0.93])
    for sizes in FAR:
        view = camera(body.centre + body.size * sizes * direction, body.centre)
        field = np.degrees(2 * np.arctan(0.35 / sizes))  # the image is 0.7 sizes high there
        lens = [f"--fov={field}"] if field > 0.1 else ["--fov=0.1", f"--zoom={0.1 / field}"]
        cells, found = scene.row(f"{sizes:.0e} sizes away, zoomed in", *view, *lens)
        rows.append(cells)
        for method, value in found.items():
            far.add(method, sizes, value)
    for sizes in (1e3, 1e6):
        view = camera(body.centre + body.size * sizes * direction, body.centre)
        rows.append(scene.row(f"{sizes:.0e} sizes away, orthographic", *view, f"--orthographic={body.size}")[0])
        rows.append(scene.row(f"{sizes:.0e} sizes away", *view)[0])
    for field in FIELDS:
        rows.append(scene.row(f"field of view {field:g} degrees", "--orbit=20,10", f"--fov={field}")[0])
    rows.append(scene.row("inside the model", *camera(body.centre, body.centre + [1, 0.1, 0.2]))[0])
    rows.append(scene.row("at a vertex", *camera(point, body.centre))[0])
    for size in SIZES:
        rows.append(scene.row(f"image {size}", "--orbit=20,10", size=size)[0])
    section.table(HEAD, rows)
    section.plot(far)
    grazing(relief, section)
    return section


def grazing(relief, section):
    """A plane seen ever more along itself: where holes begin."""
    scan = write_ply(relief.path("plane.ply"), square(64))
    patches, _ = relief.convert(scan, "plane.relief")
    middle, rows = np.array([31.5, 31.5, 0.0]), []
    for degrees in (80, 89, 89.9, 89.99, 89.999):
        angle = np.radians(degrees)
        view = camera(middle + 100 * np.array([np.sin(angle), 0, np.cos(angle)]), middle, (0, 0, 1))
        options = [*view, "--fov=1"]
        truth = relief.render(patches, "--engine", "raytrace", *options, size="256x2048")
        row = [f"{degrees:g}", int(truth.report["covered_pixels"])]
        for method in METHODS:
            image = shot(relief, method, patches, scan, *options, size="256x2048")
            holes = int(((truth["A"] == 1) & (image["A"] == 0)).sum())
            row.append(f"{image.report['covered_pixels']} ({holes})")
        rows.append(row)
    section.text("A plane of 64 x 64 points at grazing angles, in an image 256 pixels wide and 2048 high of one degree: covered pixels, and "
                 "in brackets those that the ray-traced patches cover and the engine does not.")
    section.table(["angle to the normal, degrees", "ray-traced", *METHODS], rows)
