#!/usr/bin/env python3
"""Writes point sets of shapes with sharp features, and the exact mesh of each as the truth.

    models/sharp_models.py OUT [--only cube,plate] [--points 20000] [--pattern scan|grid] [--uneven F]

Writes OUT/NAME.ply (points with normals) and OUT/NAME_mesh.ply (triangles with exact normals; curved faces in
steps of half a degree), and OUT/models.json, which names the shapes with their spacing, edges' kinds, centre and
radius. All shapes are about two units wide, closed, and stand on z = 0.

The shapes, by what [Ivo 2011] shows or names:
  cube, cylinder        straight convex edges with corners; convex curved edges
  plate                 a round plate with a peg and a blind hole: all four cells of Figure 5
  pyramid3, 4, 5        a convex corner of three, four and five faces
  pit3, 4, 5            the same pyramids sunk into a block: concave corners
  saddle                two ridges and two valleys meet in one corner of four faces
  steps                 a corner of six faces, edges convex and concave in turn
  notch                 a cube without one octant: three mixed corners, one concave
  tower                 a chess tower with a battlement (Figure 7)
  wedge                 edges of 30, 60 and 90 degrees
  sphere, torus         no edges; with texture coordinates, and texture.png (Figure 7 of [Textured surfels])

Points: --pattern scan draws them at random, no two nearer than about a spacing on one face, and the faces do not know of
each other: samples are not aligned across edges (Figure 1 below). --pattern grid puts them in rows parallel to edges,
the first half a spacing away. No point lies on an edge, except with --on-edges, which adds a row of them, each with the
normal of one of its two faces. --uneven F makes the spacing of every second face F times as large (Figure 8).
--no-normals leaves normals out; --noise S moves points by a Gaussian of S spacings along each axis and keeps their
normals. The same options write the same bytes. Needs NumPy.
"""
import argparse
import json
import math
import pathlib
import struct
import zlib

import numpy as np

from sharp_shapes import SHAPES, TEXTURED

# A random set in which no two points are nearer than R, and into which no point fits, has about 0.6 / R^2 points for
# each unit of area.
DISC_DENSITY = 0.6


def spread(candidates, distance):
    """Keeps points in turn where none that was kept is nearer than `distance`; returns which."""
    cells = np.floor(candidates / distance).astype(int)
    kept = {}
    chosen = []
    near = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    least = distance * distance
    for number, (cell, point) in enumerate(zip(map(tuple, cells.tolist()), candidates.tolist())):
        x, y, z = point
        free = True
        for i, j, k in near:
            for px, py, pz in kept.get((cell[0] + i, cell[1] + j, cell[2] + k), ()):
                if (px - x) ** 2 + (py - y) ** 2 + (pz - z) ** 2 < least:
                    free = False
                    break
            if not free:
                break
        if free:
            kept.setdefault(cell, []).append((x, y, z))
            chosen.append(number)
    return chosen


def sample(face, spacing, options, rng):
    if options.pattern == "grid":
        parts = [face.rows(spacing)]
    else:
        # Fourteen candidates for each point leave few gaps into which one more would fit.
        candidates = face.random(rng, max(20, int(14 * face.area() / spacing ** 2)))
        chosen = spread(candidates[0], math.sqrt(DISC_DENSITY) * spacing)
        parts = [tuple(column[chosen] for column in candidates)]
    if options.on_edges:
        parts.append(face.border(spacing))
    return [np.concatenate(columns) for columns in zip(*parts)]


def write_ply(path, points, normals=None, texcoords=None, faces=None, colours=None):
    """Writes a binary PLY; colours are 8-bit sRGB."""
    columns, names = [points], ["x", "y", "z"]
    if normals is not None:
        columns.append(normals)
        names += ["nx", "ny", "nz"]
    if texcoords is not None:
        columns.append(texcoords)
        names += ["s", "t"]
    values = np.concatenate(columns, axis=1)
    layout = [(name, "<f4") for name in names] + [(c, "u1") for c in ("red", "green", "blue") if colours is not None]
    vertices = np.zeros(len(points), layout)
    for k, name in enumerate(names):
        vertices[name] = values[:, k]
    for k, (name, _) in enumerate(layout[len(names):]):
        vertices[name] = colours[:, k]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    header += [f"property {'float' if kind == '<f4' else 'uchar'} {name}" for name, kind in layout]
    body = vertices.tobytes()
    if faces is not None:
        header += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        rows = np.zeros(len(faces), [("n", "u1"), ("v", "<i4", 3)])
        rows["n"], rows["v"] = 3, faces
        body += rows.tobytes()
    path.write_bytes(("\n".join(header) + "\nend_header\n").encode() + body)


def write_texture(path, width=1024, height=512):
    """A chequered map whose hue goes around and whose lightness goes up, with thin lines."""
    y, x = np.mgrid[0:height, 0:width] / np.array([height, width]).reshape(2, 1, 1)
    hue = np.stack([0.5 + 0.5 * np.cos(2 * math.pi * (x - shift)) for shift in (0, 1 / 3, 2 / 3)], axis=-1)
    dark = ((np.floor(16 * x) + np.floor(8 * y)) % 2)[..., None]
    colour = (0.35 + 0.6 * hue) * (1.0 - 0.55 * dark) * (1.0 - 0.35 * y[..., None])
    lines = (np.abs((32 * x) % 1 - 0.5) > 0.46) | (np.abs((16 * y) % 1 - 0.5) > 0.46)
    colour[lines] = 0.95
    pixels = (255 * np.clip(colour, 0, 1)).astype(np.uint8).reshape(height, -1)
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels], axis=1)  # each row begins with its filter: none

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def make(name, folder, options):
    """Writes the points and the mesh of one shape; returns what models.json says of it."""
    faces = SHAPES[name]()
    finer = [face.area() / (options.uneven if face.coarse else 1.0) ** 2 for face in faces]
    spacing = math.sqrt(sum(finer) / options.points)
    rng = np.random.default_rng([options.seed, zlib.crc32(name.encode())])
    sampled = [sample(face, spacing * (options.uneven if face.coarse else 1.0), options, rng) for face in faces]
    points, normals, texcoords = (np.concatenate(columns) for columns in zip(*sampled))
    if options.noise > 0:
        points = points + rng.normal(0.0, options.noise * spacing, points.shape)
    textured = name in TEXTURED
    write_ply(folder / f"{name}.ply", points, None if options.no_normals else normals, texcoords if textured else None)
    meshes = [face.mesh() for face in faces]
    firsts = np.cumsum([0] + [len(mesh[0]) for mesh in meshes])
    triangles = np.concatenate([mesh[3] + first for mesh, first in zip(meshes, firsts)])
    vertices, vertex_normals, vertex_texcoords = (np.concatenate([mesh[k] for mesh in meshes]) for k in range(3))
    write_ply(folder / f"{name}_mesh.ply", vertices, vertex_normals, vertex_texcoords if textured else None, triangles)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return {"points": len(points), "spacing": spacing, "largest_spacing": spacing * options.uneven,
            "centre": ((low + high) / 2).round(6).tolist(),
            "radius": float(np.linalg.norm(vertices - (low + high) / 2, axis=1).max())}


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, help="folder, made if it is not there")
    parser.add_argument("--only", default=",".join(SHAPES), help="shapes, separated by commas")
    parser.add_argument("--points", type=int, default=20000, help="about so many points for each shape")
    parser.add_argument("--pattern", choices=("scan", "grid"), default="scan")
    parser.add_argument("--uneven", type=float, default=1.0, help="spacing of every second face, over that of the others")
    parser.add_argument("--on-edges", action="store_true")
    parser.add_argument("--no-normals", action="store_true")
    parser.add_argument("--noise", type=float, default=0.0, help="standard deviation along each axis, in spacings")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    unknown = [name for name in options.only.split(",") if name not in SHAPES]
    if unknown:
        parser.error(f"no shape is called {unknown[0]}; there are {', '.join(SHAPES)}")
    return options


def main():
    options = parse()
    options.out.mkdir(parents=True, exist_ok=True)
    found = {name: make(name, options.out, options) for name in options.only.split(",")}
    if any(name in TEXTURED for name in found):
        write_texture(options.out / "texture.png")
    (options.out / "models.json").write_text(json.dumps(found, indent=1) + "\n")


if __name__ == "__main__":
    main()
