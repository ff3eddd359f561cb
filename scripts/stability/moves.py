"""Scale, offset, rotation and mirroring: of the scan before its conversion, and of models in a scene."""
import json

import numpy as np

from stability.page import Section
from stability.pictures import ENGINES, Failed, camera, decibels, failure, numbers, psnr, shot
from stability.plot import Plot
from stability.scans import rotation, write_ply

GOAL = 60.0  # dB, of issue 26
SCALES = [2.0 ** -100, 2.0 ** -40, 2.0 ** -30, 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9, 2.0 ** 30, 2.0 ** 40, 2.0 ** 100]
OFFSETS = [1e3, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11]  # in sizes of the model
TURNS = [((0, 0, 1), 1e-3), ((0, 1, 0), 90), ((1, 0, 0), 45), ((1, 2, 3), 37), ((1, 2, 3), 180)]


class Body:
    """A mesh and a camera, which move together."""

    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles
        low, high = vertices.min(0), vertices.max(0)
        self.centre, self.size = (low + high) / 2, np.linalg.norm(high - low)
        self.eye = self.centre + self.size * np.array([0.5, 0.3, 1.2])

    def view(self, matrix=np.eye(3), offset=np.zeros(3)):
        """Returns the options of the moved camera, with a light at the eye, which a mirror leaves there."""
        eye, target = matrix @ self.eye + offset, matrix @ self.centre + offset
        toward = matrix @ (self.eye - self.centre) / self.size
        toward /= np.linalg.norm(toward)
        return [*camera(eye, target, matrix @ [0, 1, 0]), f"--light={numbers(toward)}"]

    def write(self, path, matrix, offset, as_floats=False):
        faces = self.triangles if np.linalg.det(matrix) > 0 else self.triangles[:, ::-1]
        moved = self.vertices @ matrix.T + offset
        return write_ply(path, moved.astype(np.float32) if as_floats else moved, faces)


def converted(relief, body, matrix, offset, first=None, as_floats=False):
    """Returns the report of the moved scan's conversion and {engine: (picture, PSNR to the first, or a failure)}."""
    scan = body.write(relief.path("moved.ply"), matrix, offset, as_floats)
    patches, report = relief.convert(scan)
    found = {}
    for engine in ENGINES:
        try:
            image = shot(relief, engine, patches, scan, *body.view(matrix, offset))
            image = image.mirrored() if np.linalg.det(matrix) < 0 else image
            found[engine] = (image, psnr(image, first[engine][0]) if first else np.inf)
        except Failed as error:
            found[engine] = (None, failure(error))
    return report, found


def shown(value):
    return value if isinstance(value, str) else decibels(value)


def in_scene(relief, body, patches, scale=1.0, turn=((0, 0, 1), 0.0), offset=np.zeros(3), engine="onepass"):
    """Renders the patches through the transform of a scene, by a camera that is moved alike."""
    matrix = scale * rotation(*turn)
    scene = relief.path("scene.json")
    scene.write_text(json.dumps({"models": [{"file": patches.name, "transform": {
        "scale": scale, "rotation": {"axis": list(turn[0]), "degrees": turn[1]},
        "translation": list(offset)}}], "views": [{"name": "a"}]}))
    return relief.render(scene, *ENGINES[engine], *body.view(matrix, offset),
                         samples=None if engine == "ewa" else "1")


def measure(relief, vertices, triangles):
    body = Body(vertices, triangles)
    section = Section("Scale, offset and rotation")
    section.text(f"The Dragon with {len(vertices)} vertices is scaled, moved, turned or mirrored before it is converted. "
                 "The camera moves with it. Each picture is compared with the one of the mesh as it is. The goal is "
                 f"{GOAL:.0f} dB. `raytrace`, `ewa` and `surfel` draw the scan, the others its patches.")
    first_report, first = converted(relief, body, np.eye(3), np.zeros(3))

    def row(name, matrix, offset, as_floats=False):
        try:
            report, found = converted(relief, body, matrix, offset, first, as_floats)
        except Failed as error:
            return [name, failure(error), "", *["" for _ in ENGINES]], {}
        return [name, report["patches"], report["samples"], *[shown(v) for _, v in found.values()]], found

    head = ["case", "patches", "samples", *ENGINES]
    rows = [["as it is", first_report["patches"], first_report["samples"], *["" for _ in ENGINES]]]
    scale_plot = Plot("stability_scale.svg", "Picture of a scaled scan", "scale", "PSNR to the scan as it is, dB", goal=GOAL)
    for scale in SCALES:
        cells, found = row(f"scale {scale:.3g}", scale * np.eye(3), np.zeros(3))
        rows.append(cells)
        for engine, (_, value) in found.items():
            scale_plot.add(engine, scale, None if isinstance(value, str) else value)
    offset_plot = Plot("stability_offset.svg", "Picture of a scan far from the origin", "offset, in sizes of the model",
                       "PSNR to the scan as it is, dB", goal=GOAL)
    for sizes in OFFSETS:
        cells, found = row(f"offset {sizes:.0e} sizes", np.eye(3), body.size * sizes * np.array([1, -0.7, 0.3]))
        rows.append(cells)
        for engine, (_, value) in found.items():
            offset_plot.add(engine, sizes, None if isinstance(value, str) else value)
    for axis, degrees in TURNS:
        rows.append(row(f"turned by {degrees:g} about {axis}", rotation(axis, degrees), np.zeros(3))[0])
        rows.append(row("the same, rounded to floats", rotation(axis, degrees), np.zeros(3), True)[0])
    rows.append(row("mirrored", np.diag([-1.0, 1, 1]), np.zeros(3))[0])
    section.table(head, rows)
    section.plot(scale_plot)
    section.plot(offset_plot)
    accuracy(relief, body, section)
    scenes(relief, body, section)
    return section


def accuracy(relief, body, section):
    """Shows that patches are as near to the scan in any frame."""
    rows = []
    for name, matrix in [("as it is", np.eye(3)), *[(f"{d:g} about {a}", rotation(a, d)) for a, d in TURNS],
                         ("mirrored", np.diag([-1.0, 1, 1]))]:
        scan = body.write(relief.path("moved.ply"), matrix, np.zeros(3))
        patches, report = relief.convert(scan)
        view = body.view(matrix)
        truth = shot(relief, "raytrace", patches, scan, *view)
        image = shot(relief, "onepass", patches, scan, *view)
        rows.append([name, report["patches"], f"{report['psnr_db']:.2f}", decibels(psnr(image, truth))])
    section.text("A [conversion has a frame of its own](decisions/0142-conversions-have-their-own-frame.md), which turns with the scan "
                 "and is mirrored with it. How near the patches are to the scan:")
    section.table(["turn", "patches", "points to patches, dB", "picture to ray-traced mesh, dB"], rows)


def scenes(relief, body, section):
    """Moves patches by a scene."""
    patches, _ = relief.convert(body.write(relief.path("moved.ply"), np.eye(3), np.zeros(3)))
    engines = [e for e in ENGINES if e != "onepass sprite"]
    first = {e: in_scene(relief, body, patches, engine=e) for e in engines}
    cases = [(f"scale {s:.0e}", {"scale": s}) for s in (1e-9, 1e-4, 1e4, 1e9)]
    cases += [(f"turned by {d:g} about {a}", {"turn": (a, d)}) for a, d in TURNS]
    cases += [(f"offset {k:.0e} sizes", {"offset": body.size * k * np.array([1, -0.7, 0.3])}) for k in (1e3, 1e6, 1e9)]
    rows = []
    for name, move in cases:
        row = [name]
        for engine in engines:
            try:
                row.append(decibels(psnr(in_scene(relief, body, patches, engine=engine, **move), first[engine])))
            except Failed as error:
                row.append(failure(error))
        rows.append(row)
    section.text("The same patches, moved by the transform of a [scene](scene.md). A scene does not mirror models.")
    section.table(["transform", *engines], rows)
