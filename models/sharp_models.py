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

STEPS = 720  # of a full turn in the meshes: chords are within 1e-5 of the radius
# A random set in which no two points are nearer than R, and into which no point fits, has about 0.6 / R^2 points for
# each unit of area.
DISC_DENSITY = 0.6


class Flat:
    """A plane face: an outline seen counter-clockwise, perhaps with a round hole, star-shaped about `centre`."""

    curved = False

    def __init__(self, corners, centre=None, hole=0.0, coarse=False):
        corners = np.asarray(corners, float)
        self.coarse = coarse
        self.origin = corners.mean(axis=0) if centre is None else np.asarray(centre, float)
        normal = sum(np.cross(a - self.origin, b - self.origin) for a, b in zip(corners, np.roll(corners, -1, axis=0)))
        self.normal = normal / np.linalg.norm(normal)
        edge = corners[1] - corners[0]
        self.u = edge / np.linalg.norm(edge)
        self.v = np.cross(self.normal, self.u)
        self.hole = hole
        self.outline = np.stack([(corners - self.origin) @ self.u, (corners - self.origin) @ self.v], axis=1)

    def lift(self, plane):
        return self.origin + plane[:, :1] * self.u + plane[:, 1:] * self.v

    def inside(self, plane):
        x, y = plane[:, 0], plane[:, 1]
        odd = np.zeros(len(plane), bool)
        for (ax, ay), (bx, by) in zip(self.outline, np.roll(self.outline, -1, axis=0)):
            if ay != by:
                odd ^= ((ay > y) != (by > y)) & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
        return odd & (x * x + y * y > self.hole ** 2)

    def area(self):
        x, y = self.outline.T
        return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) - math.pi * self.hole ** 2

    def random(self, rng, count):
        low, high = self.outline.min(axis=0), self.outline.max(axis=0)
        found = np.zeros((0, 2))
        while len(found) < count:
            tried = low + rng.random((count, 2)) * (high - low)
            found = np.concatenate([found, tried[self.inside(tried)]])
        return self.with_normals(found[:count])

    def rows(self, spacing):
        low, high = self.outline.min(axis=0), self.outline.max(axis=0)
        counts = [max(1, round((h - l) / spacing)) for l, h in zip(low, high)]
        axes = [l + (np.arange(n) + 0.5) * (h - l) / n for l, h, n in zip(low, high, counts)]
        plane = np.stack(np.meshgrid(*axes), axis=-1).reshape(-1, 2)
        return self.with_normals(plane[self.inside(plane)])

    def with_normals(self, plane):
        return self.lift(plane), np.tile(self.normal, (len(plane), 1)), np.zeros((len(plane), 2))

    def border(self, spacing):
        rows = []
        for a, b in zip(self.outline, np.roll(self.outline, -1, axis=0)):
            count = max(1, round(np.linalg.norm(b - a) / spacing))
            rows.append(a + (np.arange(count)[:, None] + 0.5) / count * (b - a))
        return self.with_normals(np.concatenate(rows))

    def mesh(self):
        """Triangles from the centre, or from the hole, to the outline."""
        outline = self.outline
        if self.hole == 0.0:
            plane = np.concatenate([[[0.0, 0.0]], outline])
            n = len(outline)
            faces = [(0, 1 + k, 1 + (k + 1) % n) for k in range(n)]
        else:
            angles = np.unique(np.concatenate([np.arctan2(outline[:, 1], outline[:, 0]),
                                               -math.pi + 2 * math.pi * (np.arange(STEPS) + 0.5) / STEPS]))
            rays = np.stack([np.cos(angles), np.sin(angles)], axis=1)
            plane = np.concatenate([self.hole * rays, rays * self.reach(rays)[:, None]])
            n = len(angles)
            faces = []
            for k in range(n):
                m = (k + 1) % n
                faces += [(k, n + k, n + m), (k, n + m, m)]
        points, normals, texcoords = self.with_normals(plane)
        return points, normals, texcoords, np.array(faces)

    def reach(self, rays):
        """How far the outline is from the centre along unit vectors."""
        found = np.full(len(rays), np.inf)
        for a, b in zip(self.outline, np.roll(self.outline, -1, axis=0)):
            side = b - a
            across = rays[:, 0] * side[1] - rays[:, 1] * side[0]
            with np.errstate(divide="ignore", invalid="ignore"):
                t = (a[0] * side[1] - a[1] * side[0]) / across
                s = (a[0] * rays[:, 1] - a[1] * rays[:, 0]) / across
            found = np.where((t > 0) & (s > -1e-9) & (s < 1 + 1e-9), np.minimum(found, t), found)
        return found


class Turned:
    """A face of revolution: a profile (r, z), with the outside on its right, turned about a vertical axis."""

    curved = True

    def __init__(self, profile, at=(0.0, 0.0), angles=(0.0, 2 * math.pi), coarse=False, profile_normals=None):
        self.profile = np.asarray(profile, float)
        self.at, self.angles, self.coarse = np.asarray(at, float), angles, coarse
        sides = np.diff(self.profile, axis=0)
        lengths = np.linalg.norm(sides, axis=1)
        self.s = np.concatenate([[0.0], np.cumsum(lengths)])
        if profile_normals is None:  # a straight profile
            across = np.array([sides[0][1], -sides[0][0]]) / lengths[0]
            profile_normals = np.tile(across, (len(self.profile), 1))
        self.profile_normals = np.asarray(profile_normals, float)

    def at_parameters(self, angle, s):
        r, z, nr, nz = (np.interp(s, self.s, column) for column in (*self.profile.T, *self.profile_normals.T))
        c, d = np.cos(angle), np.sin(angle)
        normals = np.stack([nr * c, nr * d, nz], axis=1)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        low, high = self.angles
        texcoords = np.stack([(angle - low) / (high - low), s / self.s[-1]], axis=1)
        return np.stack([self.at[0] + r * c, self.at[1] + r * d, z], axis=1), normals, texcoords

    def area(self):
        r = self.profile[:, 0]
        return (self.angles[1] - self.angles[0]) * np.sum(np.diff(self.s) * (r[1:] + r[:-1]) / 2)

    def random(self, rng, count):
        s = np.linspace(0, self.s[-1], 4097)
        r = np.interp(s, self.s, self.profile[:, 0])
        share = np.concatenate([[0.0], np.cumsum((r[1:] + r[:-1]) / 2)])
        low, high = self.angles
        return self.at_parameters(low + rng.random(count) * (high - low), np.interp(rng.random(count), share / share[-1], s))

    def rows(self, spacing):
        count = max(1, round(self.s[-1] / spacing))
        low, high = self.angles
        angle, s = [], []
        for row in range(count):
            here = (row + 0.5) / count * self.s[-1]
            around = max(1, round((high - low) * np.interp(here, self.s, self.profile[:, 0]) / spacing))
            angle.append(low + (np.arange(around) + (0.25 if row % 2 else 0.75)) / around * (high - low))
            s.append(np.full(around, here))
        return self.at_parameters(np.concatenate(angle), np.concatenate(s))

    def border(self, spacing):
        low, high = self.angles
        rows = []
        for s in (0.0, self.s[-1]):
            around = round((high - low) * np.interp(s, self.s, self.profile[:, 0]) / spacing)
            if around > 2:
                rows.append((low + (np.arange(around) + 0.5) / around * (high - low), np.full(around, s)))
        angle, s = (np.concatenate(column) for column in zip(*rows))
        return self.at_parameters(angle, s)

    def mesh(self):
        low, high = self.angles
        steps = max(1, round(STEPS * (high - low) / (2 * math.pi)))
        angle = np.linspace(low, high, steps + 1)
        rows = len(self.s)
        points, normals, texcoords = self.at_parameters(np.tile(angle, rows), np.repeat(self.s, steps + 1))
        if high - low > 6.28:  # the last column is the first one, to the last bit
            points[steps::steps + 1] = points[0::steps + 1]
        faces = []
        for row in range(rows - 1):
            at = row * (steps + 1) + np.arange(steps)
            a, b, c, d = at, at + 1, at + steps + 2, at + steps + 1
            if self.profile[row, 0] > 0:
                faces.append(np.stack([a, b, c], axis=1))
            if self.profile[row + 1, 0] > 0:
                faces.append(np.stack([a, c, d], axis=1))
        return points, normals, texcoords, np.concatenate(faces)


def circle(centre, radius, z, angles=(0.0, 2 * math.pi), steps=STEPS):
    """The corners of an arc, counter-clockwise from above; the last one is left out of a full circle."""
    full = angles[1] - angles[0] > 6.28
    angle = np.linspace(*angles, steps + 1)[:steps if full else None]
    return np.stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle), np.full(len(angle), z)], axis=1)


def lathe(*profile, at=(0.0, 0.0), coarse=()):
    """The faces between corners of a profile from the axis to the axis; `coarse` names some by number."""
    return [Turned(pair, at, coarse=k in coarse) for k, pair in enumerate(zip(profile, profile[1:]))]


def box_faces(low, high):
    (a, b, c), (d, e, f) = low, high
    return [Flat([(a, b, c), (a, e, c), (d, e, c), (d, b, c)]), Flat([(a, b, f), (d, b, f), (d, e, f), (a, e, f)], coarse=True),
            Flat([(a, b, c), (d, b, c), (d, b, f), (a, b, f)]), Flat([(d, e, c), (a, e, c), (a, e, f), (d, e, f)]),
            Flat([(d, b, c), (d, e, c), (d, e, f), (d, b, f)], coarse=True),
            Flat([(a, e, c), (a, b, c), (a, b, f), (a, e, f)], coarse=True)]


def plate():
    """The peg stands in the left half and the hole in the right one; the top consists of two halves."""
    height, peg, hole = 0.4, (-0.45, 0.0), (0.45, 0.0)
    faces = [Turned([(0, 0), (1, 0)], coarse=True), Turned([(1, 0), (1, height)])]
    for centre, angles in ((peg, (math.pi / 2, 3 * math.pi / 2)), (hole, (-math.pi / 2, math.pi / 2))):
        faces.append(Flat(circle((0, 0), 1.0, height, angles, STEPS // 2), (*centre, height), hole=0.25, coarse=True))
    faces += [Turned([(0.25, height), (0.25, height + 0.5)], peg), Turned([(0.25, height + 0.5), (0, height + 0.5)], peg, coarse=True),
              Turned([(0.25, height), (0.25, 0.12)], hole), Turned([(0.25, 0.12), (0, 0.12)], hole, coarse=True)]
    # Going down, the outside of the hole's wall is toward its axis: the right-hand side of the profile.
    return faces


def pyramid(sides):
    base = circle((0, 0), 1.0, 0.0, steps=sides)
    apex = np.array([0.0, 0.0, 1.2])
    faces = [Flat(base[::-1], coarse=True)]
    return faces + [Flat([a, b, apex], coarse=k % 2 == 1) for k, (a, b) in enumerate(zip(base, np.roll(base, -1, axis=0)))]


def pit(sides):
    low, high, rim = (circle((0, 0), r, z, steps=sides) for r, z in ((1.0, 0.0), (1.0, 1.2), (0.8, 1.2)))
    apex = np.array([0.0, 0.0, 0.3])
    faces = [Flat(low[::-1])]
    for k in range(sides):
        m = (k + 1) % sides
        faces += [Flat([low[k], low[m], high[m], high[k]]), Flat([high[k], high[m], rim[m], rim[k]], coarse=True),
                  Flat([rim[k], rim[m], apex])]
    return faces


def saddle():
    """z = 0.8 + 0.5 (|x| - |y|) over a square: a valley along y, a ridge along x."""
    def up(x, y):
        return (x, y, 0.8 + 0.5 * (abs(x) - abs(y)))
    faces = [Flat([(-1, -1, 0), (-1, 1, 0), (1, 1, 0), (1, -1, 0)])]
    for k, (x, y) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        corners = [up(0, 0), up(x, 0), up(x, y), up(0, y)]
        faces.append(Flat(corners if x * y > 0 else corners[::-1], coarse=k % 2 == 1))
    for side in (1, -1):
        faces.append(Flat([(side, -side, 0), (side, side, 0), up(side, side), up(side, 0), up(side, -side)], coarse=True))
        faces.append(Flat([(side, side, 0), (-side, side, 0), up(-side, side), up(0, side), up(side, side)], (0, side, 0.15)))
    return faces


def steps():
    """Quarters of a square as high as 1.2, 0.8, 0.4 and 0.8: six faces meet in the middle."""
    h = {(1, 1): 1.2, (-1, 1): 0.8, (-1, -1): 0.4, (1, -1): 0.8}
    faces = [Flat([(-1, -1, 0), (-1, 1, 0), (1, 1, 0), (1, -1, 0)])]
    for (x, y), z in h.items():
        corners = [(0, 0, z), (x, 0, z), (x, y, z), (0, y, z)]
        faces.append(Flat(corners if x * y > 0 else corners[::-1], coarse=True))
    for y in (1, -1):  # walls across x
        low, high = h[-1, y], h[1, y]
        faces.append(Flat([(0, max(y, 0), low), (0, min(y, 0), low), (0, min(y, 0), high), (0, max(y, 0), high)]))
    for x in (1, -1):  # walls across y
        low, high = h[x, -1], h[x, 1]
        faces.append(Flat([(min(x, 0), 0, low), (max(x, 0), 0, low), (max(x, 0), 0, high), (min(x, 0), 0, high)]))
    for side in (1, -1):
        for other in (1, -1):
            z = h[side, other]
            a, b = (0, other) if side * other > 0 else (other, 0)
            faces.append(Flat([(side, a, 0), (side, b, 0), (side, b, z), (side, a, z)]))
            z = h[other, side]
            a, b = (other, 0) if side * other > 0 else (0, other)
            faces.append(Flat([(a, side, 0), (b, side, 0), (b, side, z), (a, side, z)]))
    return faces


def notch():
    """A cube of side 1.6 without the octant where all coordinates are large."""
    a, b, m = 0.0, 1.6, 0.8
    faces = [Flat([(a, a, a), (a, b, a), (b, b, a), (b, a, a)]), Flat([(a, a, a), (b, a, a), (b, a, b), (a, a, b)]),
             Flat([(a, b, a), (a, a, a), (a, a, b), (a, b, b)])]
    # Each of the other sides is an L, star-shaped about its inner corner's diagonal.
    for axes in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        def at(p, q, r):
            point = [0.0, 0.0, 0.0]
            for axis, value in zip(axes, (p, q, r)):
                point[axis] = value
            return point
        faces.append(Flat([at(b, a, a), at(b, b, a), at(b, b, m), at(b, m, m), at(b, m, b), at(b, a, b)], at(b, 0.5, 0.5),
                          coarse=True))
        faces.append(Flat([at(m, m, m), at(m, b, m), at(m, b, b), at(m, m, b)]))
    return faces


def wedge():
    """A prism whose edges along y have 30, 60 and 90 degrees."""
    a, b = (-1.0, 0.0), (1.0, 0.0)
    c = (0.5, math.sqrt(3) / 2)
    faces = []
    for k, (p, q) in enumerate(((a, b), (b, c), (c, a))):
        faces.append(Flat([(q[0], -0.8, q[1]), (p[0], -0.8, p[1]), (p[0], 0.8, p[1]), (q[0], 0.8, q[1])], coarse=k == 2))
    for y, corners in ((-0.8, (a, b, c)), (0.8, (b, a, c))):
        faces.append(Flat([(x, y, z) for x, z in corners]))
    return faces


def tower():
    """A foot, a shaft, a head with a hollow, and six merlons on its wall."""
    inner, outer, floor, low, high = 0.42, 0.62, 1.55, 1.7, 2.0
    faces = lathe((0, 0), (0.9, 0), (0.9, 0.22), (0.72, 0.22), (0.72, 0.38), (0.45, 0.38), (0.4, 1.25), (outer, 1.4), (outer, low),
                  coarse=(0,))
    faces += lathe((inner, low), (inner, floor), (0, floor))
    merlons = 6
    for k in range(merlons):
        a, b, c = (2 * math.pi * (k + share) / merlons for share in (0.0, 0.55, 1.0))
        faces += [Turned([(outer, low), (outer, high)], angles=(a, b)), Turned([(outer, high), (inner, high)], angles=(a, b), coarse=True),
                  Turned([(inner, high), (inner, low)], angles=(a, b)), Turned([(outer, low), (inner, low)], angles=(b, c), coarse=True)]
        for angle, side in ((a, 1), (b, -1)):
            c, d = math.cos(angle), math.sin(angle)
            corners = [(inner * c, inner * d, low), (outer * c, outer * d, low), (outer * c, outer * d, high), (inner * c, inner * d, high)]
            faces.append(Flat(corners if side > 0 else corners[::-1]))
    return faces


def sphere():
    angle = np.linspace(-math.pi / 2, math.pi / 2, STEPS // 2 + 1)
    across = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    across[[0, -1], 0] = 0.0
    return [Turned(across + [0, 1], profile_normals=across)]


def torus():
    angle = np.linspace(-math.pi, math.pi, STEPS // 2 + 1)
    across = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return [Turned(0.35 * across + [0.75, 0.35], profile_normals=across)]


SHAPES = {
    "cube": lambda: box_faces((-0.8, -0.8, 0.0), (0.8, 0.8, 1.6)),
    "cylinder": lambda: lathe((0, 0), (0.8, 0), (0.8, 1.4), (0, 1.4), coarse=(0, 2)),
    "plate": plate,
    **{f"pyramid{k}": (lambda k=k: pyramid(k)) for k in (3, 4, 5)},
    **{f"pit{k}": (lambda k=k: pit(k)) for k in (3, 4, 5)},
    "saddle": saddle, "steps": steps, "notch": notch, "tower": tower, "wedge": wedge, "sphere": sphere, "torus": torus,
}
TEXTURED = ("sphere", "torus")


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
    rows = np.concatenate([np.zeros((height, 1), np.uint8), (255 * np.clip(colour, 0, 1)).astype(np.uint8).reshape(height, -1)], axis=1)

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
