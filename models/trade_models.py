#!/usr/bin/env python3
"""Writes scans of shapes that are known exactly, with noise and holes, and the mesh of each as the truth.

    models/trade_models.py OUT [--points 60000] [--noise 0.3] [--seed 1]

Writes OUT/NAME.ply (points without normals or faces) and OUT/NAME_truth.ply (triangles), for `relief bench --trade
OUT/NAME.ply --truth OUT/NAME_truth.ply`. The shapes:

  shell   closed, with spiral ridges and pimples
  vase    open at its top, fluted, with a sharp rim and foot
  dunes   a terrain with steep ridges and boulders; the points have colours

Points are drawn at random, evenly by area. --noise moves each along the normal by a Gaussian of so many spacings. Some
balls of 2 to 4 % of the size have no points. They are cut out of the truth, too, because what was not scanned can't be
known. The same options write the same bytes. Needs NumPy.
"""
import argparse
import pathlib

import numpy as np

STEPS = 700  # of the truth, along each side; more than the points tell
HOLES = 12


def shell(u, v):
    """A sphere whose radius varies; u is the azimuth, v goes from pole to pole."""
    azimuth, height = 2 * np.pi * u, np.pi * v
    waves = np.sin(6 * azimuth + 9 * height) * np.sin(height) ** 2
    radius = 1 + 0.09 * np.tanh(3 * waves) + 0.025 * np.sin(23 * azimuth) * np.sin(19 * height) * np.sin(height) ** 2
    return radius[..., None] * np.stack([np.sin(height) * np.cos(azimuth), np.sin(height) * np.sin(azimuth), np.cos(height)], -1)


def vase(u, v):
    """A lathe with flutes; v goes along the profile from the axis at the foot to the rim."""
    azimuth = 2 * np.pi * u
    profile = np.array([(0, 0), (0.5, 0), (0.5, 0.08), (0.42, 0.12), (0.75, 0.7), (0.7, 1.3), (0.35, 1.75), (0.33, 1.9), (0.52, 2.05)])
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(profile, axis=0), axis=1))])
    radius, z = (np.interp(v * along[-1], along, profile[:, k]) for k in (0, 1))
    flutes = 0.035 * np.abs(np.sin(10 * azimuth)) * np.clip((z - 0.2) * 4, 0, 1) * np.clip((1.7 - z) * 4, 0, 1)
    radius = radius - flutes
    return np.stack([radius * np.cos(azimuth), radius * np.sin(azimuth), z], -1)


def dunes(u, v):
    x, y = 40 * u, 30 * v
    bend = 2.5 * np.sin(0.25 * y) + 0.8 * np.sin(0.7 * y + 1)
    phase = (x + bend) / 8
    ridge = 1 - np.abs(2 * (phase - np.floor(phase)) - 1) ** 0.8
    z = 2.2 * ridge + 0.15 * np.sin(2.3 * x) * np.sin(1.9 * y) + 0.02 * x
    for k in range(25):
        cx, cy, size = 40 * ((k * 0.618) % 1), 30 * ((k * 0.755) % 1), 0.5 + 0.8 * ((k * 0.37) % 1)
        z = np.maximum(z, z + 0.9 * size * np.sqrt(np.clip(1 - ((x - cx) ** 2 + (y - cy) ** 2) / size ** 2, 0, None)))
    return np.stack([x, y, z], -1)


def sand(points):
    """A colour for each point of the dunes, 0 to 255."""
    light = 0.5 + 0.5 * np.sin(3 * points[:, 0] + 2 * points[:, 2]) * np.sin(2.6 * points[:, 1])
    return np.clip(np.outer(0.6 + 0.4 * light, (225, 190, 140)), 0, 255).astype(np.uint8)


SHAPES = {"shell": (shell, None), "vase": (vase, None), "dunes": (dunes, sand)}


def mesh_of(surface):
    """The corners of a grid over the surface and its triangles, without those that have no area."""
    side = np.linspace(0, 1, STEPS + 1)
    u, v = np.meshgrid(side, side)
    corners = surface(u, v).reshape(-1, 3)
    at = np.arange(STEPS)[:, None] * (STEPS + 1) + np.arange(STEPS)
    # Outward where u goes around and v goes down or up: turned below if it is not.
    triangles = np.concatenate([np.stack([at, at + 1, at + STEPS + 2], -1).reshape(-1, 3),
                                np.stack([at, at + STEPS + 2, at + STEPS + 1], -1).reshape(-1, 3)])
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    has_area = np.linalg.norm(cross, axis=1) > 1e-12
    triangles, cross, middle = triangles[has_area], cross[has_area], ((a + b + c) / 3)[has_area]
    away = middle - corners.mean(0) if np.ptp(corners[:, 2]) > 0.3 * np.ptp(corners[:, 0]) else np.array([0, 0, 1.0])
    if (cross * away).sum() < 0:
        triangles = triangles[:, ::-1]
    return corners, triangles


def outside(points, balls):
    keep = np.ones(len(points), bool)
    for centre, radius in balls:
        keep &= ((points - centre) ** 2).sum(1) > radius ** 2
    return keep


def scan_of(corners, triangles, count, noise, random):
    """Points on triangles, evenly by area, moved along the normal by so many spacings."""
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    area = np.linalg.norm(cross, axis=1) / 2
    chosen = random.choice(len(triangles), count, p=area / area.sum())
    s, t = random.random((2, count))
    s, t = np.where(s + t > 1, 1 - s, s), np.where(s + t > 1, 1 - t, t)
    points = a[chosen] + s[:, None] * (b - a)[chosen] + t[:, None] * (c - a)[chosen]
    normals = cross[chosen] / (2 * area[chosen, None])
    return points + noise * np.sqrt(area.sum() / count) * random.standard_normal((count, 1)) * normals


def write_ply(path, points, colours=None, triangles=None):
    fields = [("x", "<f4"), ("y", "<f4"), ("z", "<f4")]
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
    if colours is not None:
        fields += [("r", "u1"), ("g", "u1"), ("b", "u1")]
        header += "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    vertices = np.zeros(len(points), fields)
    for k, name in enumerate("xyz"):
        vertices[name] = points[:, k]
    for k, name in enumerate("rgb" if colours is not None else ""):
        vertices[name] = colours[:, k]
    faces = b""
    if triangles is not None:
        header += f"element face {len(triangles)}\nproperty list uchar int vertex_indices\n"
        records = np.zeros(len(triangles), [("n", "u1"), ("corners", "<i4", 3)])
        records["n"], records["corners"] = 3, triangles
        faces = records.tobytes()
    path.write_bytes(f"{header}end_header\n".encode() + vertices.tobytes() + faces)


def write_model(out, name, arguments):
    surface, paint = SHAPES[name]
    random = np.random.default_rng(arguments.seed + sorted(SHAPES).index(name))
    corners, triangles = mesh_of(surface)
    size = np.ptp(corners, axis=0).max()
    balls = [(corners[random.integers(len(corners))], size * random.uniform(0.02, 0.04)) for _ in range(HOLES)]
    triangles = triangles[outside(corners[triangles].mean(1), balls)]
    points = scan_of(corners, triangles, arguments.points, arguments.noise, random)
    write_ply(out / f"{name}.ply", points, paint(points) if paint else None)
    write_ply(out / f"{name}_truth.ply", corners, paint(corners) if paint else None, triangles)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--points", type=int, default=60000)
    parser.add_argument("--noise", type=float, default=0.3)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name in SHAPES:
        write_model(arguments.out, name, arguments)


if __name__ == "__main__":
    main()
