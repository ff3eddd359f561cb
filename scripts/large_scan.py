#!/usr/bin/env python3
"""Makes a scan that is larger than memory from real ones: a terrain, finer than its grid, on which
copies of a scanned model stand, turned and scaled by chance, all with noise.

    scripts/large_scan.py SCAN.ply.gz TERRAIN.csv OUT.las [--points 60000000] [--seed 1]

SCAN: a PLY (ASCII or binary little-endian, plain or gzipped) whose vertices begin with x, y and z
as floats. TERRAIN: heights by rows, separated by commas. OUT is LAS 1.2, point format 2, in steps of
0.1 mm at coordinates as UTM has them, with colours; points are 5 mm apart, half of them terrain.
What is in memory is little. Needs numpy (Debian's python3-numpy).
"""
import argparse
import gzip
import struct

import numpy as np

SPACING = 0.005  # metres between points
NOISE = 0.1 * SPACING  # standard deviation, metres
ORIGIN = np.array([470000.0, 4430000.0, 1800.0])  # metres
SCALE = 1e-4  # metres a step of the file
HILL = 0.04  # the terrain's relief over its side
RECORD = np.dtype([("xyz", "<i4", 3), ("intensity", "<u2"), ("flags", "u1"), ("class", "u1"),
                   ("angle", "i1"), ("user", "u1"), ("source", "<u2"), ("rgb", "<u2", 3)])


def read_vertices(path):
    """The vertices, standing on the plane z = 0 about the origin, and their spacing."""
    with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
        data = file.read()
    end = data.index(b"end_header") + len(b"end_header") + 1
    header = data[:end].decode().split("\n")
    first = next(i for i, line in enumerate(header) if line.startswith("element vertex"))
    count = int(header[first].split()[2])
    if any(line.startswith("format ascii") for line in header):
        lines = data[end:].split(b"\n", count)[:count]
        xyz = np.array([line.split()[:3] for line in lines], dtype=np.float64)
    else:
        columns = 0
        while header[first + 1 + columns].startswith("property float"):
            columns += 1
        xyz = np.frombuffer(data, "<f4", count * columns, end).reshape(count, columns)[:, :3]
    xyz = np.unique(xyz.astype(np.float64), axis=0)
    xyz = xyz[:, [0, 2, 1]] * [1, -1, 1]  # scans of statues have y upward
    xyz -= [*(xyz.min(0) + xyz.max(0))[:2] / 2, xyz[:, 2].min()]
    # The area of the surface, roughly: each occupied cube shows one face.
    side = np.ptp(xyz, axis=0).max() / 100
    cubes = len(np.unique(np.floor(xyz / side).astype(np.int64), axis=0))
    return xyz, np.sqrt(cubes * side * side / len(xyz))


class Terrain:
    def __init__(self, path, side):
        grid = np.loadtxt(path, delimiter=",")
        self.heights = (grid - grid.min()) / np.ptp(grid) * HILL * side
        self.side = side

    def height(self, x, y):
        rows, columns = self.heights.shape
        u = np.clip(x / self.side, 0, 1) * (columns - 1.001)
        v = np.clip(y / self.side, 0, 1) * (rows - 1.001)
        i, j = u.astype(int), v.astype(int)
        # Smooth between the grid's points, as a mesh of them is not.
        fu, fv = (3 - 2 * (u - i)) * (u - i) ** 2, (3 - 2 * (v - j)) * (v - j) ** 2
        h = self.heights
        low = h[j, i] * (1 - fu) + h[j, i + 1] * fu
        high = h[j + 1, i] * (1 - fu) + h[j + 1, i + 1] * fu
        return low * (1 - fv) + high * fv


def las_header(count, low, high):
    header = struct.pack("<4sHHIHH8sBB32s32sHHHIIBHIIIIII", b"LASF", 0, 0, 0, 0, 0, b"", 1, 2,
                         b"relief", b"large_scan.py", 1, 2026, 227, 227, 0, 2, RECORD.itemsize,
                         count, count, 0, 0, 0, 0)
    header += struct.pack("<12d", SCALE, SCALE, SCALE, *ORIGIN,
                          high[0], low[0], high[1], low[1], high[2], low[2])
    assert len(header) == 227
    return header


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("scan")
    parser.add_argument("terrain")
    parser.add_argument("out")
    parser.add_argument("--points", type=int, default=60_000_000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    model, model_spacing = read_vertices(arguments.scan)
    model *= SPACING / model_spacing
    copies = max(1, round(arguments.points / 2 / len(model)))
    nodes = round(np.sqrt(arguments.points - copies * len(model)))
    terrain = Terrain(arguments.terrain, nodes * SPACING)
    count, low, high = 0, np.full(3, np.inf), np.full(3, -np.inf)

    with open(arguments.out, "wb") as out:
        out.write(las_header(0, np.zeros(3), np.zeros(3)))

        def write(xyz, rgb):
            nonlocal count, low, high
            record = np.zeros(len(xyz), RECORD)
            record["xyz"] = np.rint((xyz + rng.normal(0, NOISE, xyz.shape)) / SCALE)
            record["rgb"] = np.clip(rgb, 0, 255).astype(np.uint16) * 257
            position = ORIGIN + SCALE * record["xyz"]
            low, high = np.minimum(low, position.min(0)), np.maximum(high, position.max(0))
            count += len(xyz)
            record.tofile(out)

        for rows in np.array_split(np.arange(nodes), max(1, nodes // 100)):
            x, y = np.meshgrid((np.arange(nodes) + 0.5) * SPACING, (rows + 0.5) * SPACING)
            x, y = x.ravel(), y.ravel()
            z = terrain.height(x, y)
            green = 90 + 120 * z / (HILL * terrain.side)
            write(np.stack([x, y, z], 1), np.stack([green * 0.8, green, green * 0.5], 1))

        across = int(np.ceil(np.sqrt(copies)))
        for copy in range(copies):
            angle, scale = rng.uniform(0, 2 * np.pi), rng.uniform(0.9, 1.1)
            turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
            xyz = model * scale
            xyz[:, :2] = xyz[:, :2] @ turn
            xyz[:, :2] += (np.array([copy % across, copy // across]) + 0.5) * terrain.side / across
            # The whole model follows the slope it stands on.
            xyz[:, 2] += terrain.height(xyz[:, 0], xyz[:, 1])
            shade = 150 + 60 * model[:, 2] / model[:, 2].max()
            write(xyz, shade[:, None] * rng.uniform(0.6, 1.2, 3))

        out.seek(0)
        out.write(las_header(count, low, high))
    print(f"{arguments.out}: {count} points, {copies} models on {terrain.side:.1f} m of terrain")


main()
