"""Faces of the shapes of sharp_shapes.py: plane ones and those of revolution, as points and as triangles.

Both have area(), in square units; random(rng, count), points spread evenly by chance; rows(spacing), points in rows
parallel to the border, the first half a spacing away; border(spacing), points on the border; each as positions, unit
normals and texture coordinates; and mesh(), the same of vertices, and triangles, counter-clockwise from outside. `coarse`
marks the faces whose spacing --uneven makes larger. Needs NumPy.
"""
import math

import numpy as np

STEPS = 720  # of a full turn in the meshes: chords are within 1e-5 of the radius
# Meshes of faces reach so far beyond their borders. Readers merge vertices at one position, and their normals with them.
BEYOND = 3e-6


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
        outline = self.outline * (1 + BEYOND)
        if self.hole == 0.0:
            plane = np.concatenate([[[0.0, 0.0]], outline])
            n = len(outline)
            faces = [(0, 1 + k, 1 + (k + 1) % n) for k in range(n)]
        else:
            angles = np.unique(np.concatenate([np.arctan2(outline[:, 1], outline[:, 0]),
                                               -math.pi + 2 * math.pi * (np.arange(STEPS) + 0.5) / STEPS]))
            rays = np.stack([np.cos(angles), np.sin(angles)], axis=1)
            plane = np.concatenate([self.hole * (1 - BEYOND) * rays, rays * (1 + BEYOND) * self.reach(rays)[:, None]])
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
        angle = low + rng.random(count) * (high - low)
        return self.at_parameters(angle, np.interp(rng.random(count), share / share[-1], s))

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
        angle = np.linspace(low, high + BEYOND, steps + 1)
        rows = len(self.s)
        points, normals, texcoords = self.at_parameters(np.tile(angle, rows), np.repeat(self.s, steps + 1))
        grid = points.reshape(rows, steps + 1, 3)
        for end, inner in ((0, 1), (-1, -2)):
            if self.profile[end, 0] > 0:
                along = grid[end] - grid[inner]
                grid[end] += BEYOND * along / np.linalg.norm(along, axis=1, keepdims=True)
        faces = []
        for row in range(rows - 1):
            at = row * (steps + 1) + np.arange(steps)
            a, b, c, d = at, at + 1, at + steps + 2, at + steps + 1
            if self.profile[row, 0] > 0:
                faces.append(np.stack([a, b, c], axis=1))
            if self.profile[row + 1, 0] > 0:
                faces.append(np.stack([a, c, d], axis=1))
        return points, normals, texcoords, np.concatenate(faces)
