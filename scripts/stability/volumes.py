"""Volumes and 3D Gaussians: grids of any size, needles, specks and giants, on OpenGL and on the CPU."""
import numpy as np

from stability.page import Section
from stability.pictures import Failed, camera, decibels, failure, psnr

ENGINES = ["volume", "volume-reference"]


def write_grid(path, step):
    """Writes a ball of 24 x 24 x 24 values as NRRD, `step` between nodes."""
    axis = np.linspace(-1, 1, 24)
    z, y, x = np.meshgrid(axis, axis, axis, indexing="ij")
    values = np.clip(1.2 - np.sqrt(x * x + y * y + z * z), 0, 1).astype("<f4")
    with open(path, "wb") as file:
        file.write(("NRRD0004\ntype: float\ndimension: 3\nsizes: 24 24 24\nspace dimension: 3\nspace directions: "
                    f"({step!r},0,0) (0,{step!r},0) (0,0,{step!r})\nencoding: raw\nendian: little\n\n").encode())
        file.write(values.tobytes())
    return path


def write_gaussians(path, centres, sizes):
    """Writes opaque grey 3D Gaussians of these standard deviations along x, y and z."""
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
             "rot_0", "rot_1", "rot_2", "rot_3"]
    rows = np.zeros((len(centres), len(names)), "<f4")
    rows[:, :3], rows[:, 6], rows[:, 7:10], rows[:, 10] = centres, 3.0, np.log(sizes), 1.0
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}",
            *[f"property float {n}" for n in names], "end_header\n"]
    with open(path, "wb") as file:
        file.write("\n".join(head).encode() + rows.tobytes())
    return path


def gaussians():
    """Yields (name, centres, sizes, camera) of small scenes."""
    cloud = np.random.default_rng(1).normal(size=(200, 3))
    front = camera((0, 0, 8), (0, 0, 0))
    yield "as usual", cloud, np.full((200, 3), 0.2), front
    yield "needles, 1e6 : 1", cloud, np.tile([1e2, 1e-4, 1e-4], (200, 1)), front
    yield "discs, 1 : 1e6", cloud, np.tile([1e2, 1e2, 1e-4], (200, 1)), front
    yield "specks of 1e-12", cloud, np.full((200, 3), 1e-12), front
    yield "giants of 1e12", cloud, np.full((200, 3), 1e12), front
    yield "the eye inside", cloud, np.full((200, 3), 0.5), camera((0, 0, 0), (0, 0, 1))
    yield "edge-on discs", cloud, np.tile([0.3, 1e-9, 0.3], (200, 1)), front
    yield "5000 in a pixel", np.stack([np.zeros(5000), np.zeros(5000), np.linspace(0, -5, 5000)], axis=-1), np.full((5000, 3), 0.01), front
    yield "1e6 away", cloud + [1e6, 0, 0], np.full((200, 3), 0.2), camera((1e6, 0, 8), (1e6, 0, 0))


def pair(relief, scene, options, first=None):
    """Returns the cells of both engines: covered share, and PSNR between them and to a first picture."""
    images, cells = [], []
    for engine in ENGINES:
        try:
            images.append(relief.render(scene, "--engine", engine, *options, size="160x128",
                                        samples=None))
            cells.append(f"{100 * images[-1].coverage():.2f}")
        except Failed as error:
            images.append(None)
            cells.append(failure(error))
    both = all(i is not None for i in images)
    cells.append(decibels(psnr(*images)) if both else "")
    if first is not None:
        cells.append(" / ".join(decibels(psnr(i, f)) if i is not None else "–" for i, f in zip(images, first)))
    return cells, images


def measure(relief, _vertices, _triangles):
    section, rows = Section("Volumes and 3D Gaussians"), []
    first = None
    for step in (1.0, 1e-9, 1e-6, 1e6, 1e9, 2.0 ** -30, 2.0 ** 30):
        grid = write_grid(relief.path("grid.nrrd"), step)
        cells, images = pair(relief, grid, ["--orbit=30,20"], first or [None] * 2) if first else pair(relief, grid, ["--orbit=30,20"])
        first = first or images
        rows.append([f"nodes {step:.3g} apart", *cells, *([""] if len(cells) == 3 else [])])
    section.text("A ball of 24 x 24 x 24 values, from 1e-9 to 1e9 between nodes. Covered share of the image in %, PSNR between the engines, "
                 "and that of each to the picture with nodes 1 apart.")
    section.table(["grid", *ENGINES, "between them, dB", "to 1 apart, dB"], rows)
    rows = []
    for name, centres, sizes, view in gaussians():
        scene = write_gaussians(relief.path("gaussians.ply"), centres, sizes)
        rows.append([name, *pair(relief, scene, view)[0]])
    section.text("3D Gaussians:")
    section.table(["scene", *ENGINES, "between them, dB"], rows)
    return section
