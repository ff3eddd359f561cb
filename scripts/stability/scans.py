"""Scans that are pushed to extremes: read, moved and written."""
import gzip

import numpy as np


def read_mesh(path):
    """Returns the vertices and triangles of a PLY file of text, such as the Stanford Dragon's."""
    with gzip.open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    lines = head.decode().splitlines()
    counts = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    face = next(i for i, line in enumerate(lines) if line.startswith("element face"))
    properties = sum(line.startswith("property") for line in lines[:face])
    numbers = np.array(body.split(), dtype=float)
    end = counts["vertex"] * properties
    vertices = numbers[:end].reshape(-1, properties)[:, :3]
    return vertices, numbers[end:].reshape(counts["face"], 4)[:, 1:].astype(int)


def write_ply(path, positions, triangles=None, normals=None, colours=None):
    """Writes points or a mesh, coordinates as doubles. Returns the path."""
    fields, head = [("p", "<f8", 3)], [f"property double {c}" for c in "xyz"]
    if normals is not None:
        fields.append(("n", "<f8", 3))
        head += [f"property double n{c}" for c in "xyz"]
    if colours is not None:
        fields.append(("c", "u1", 3))
        head += [f"property uchar {c}" for c in ("red", "green", "blue")]
    if triangles is not None:
        head += [f"element face {len(triangles)}", "property list uchar int vertex_indices"]
    rows = np.zeros(len(positions), fields)
    for name, values in (("p", positions), ("n", normals), ("c", colours)):
        if values is not None:
            rows[name] = values
    with open(path, "wb") as file:
        file.write("\n".join(["ply", "format binary_little_endian 1.0", f"element vertex {len(positions)}",
                              *head, "end_header\n"]).encode())
        file.write(rows.tobytes())
        if triangles is not None:
            faces = np.zeros(len(triangles), [("count", "u1"), ("corner", "<i4", 3)])
            faces["count"], faces["corner"] = 3, triangles
            file.write(faces.tobytes())
    return path


def rotation(axis, degrees):
    """Returns the matrix that turns about an axis."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    turn, cross = np.radians(degrees), np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(turn) * cross + (1 - np.cos(turn)) * cross @ cross


def sphere(count, seed=1):
    """Returns points spread evenly over the unit sphere, in random order."""
    z = 1 - (2 * np.arange(count) + 1) / count
    angle = np.arange(count) * np.pi * (3 - np.sqrt(5))
    points = np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], axis=-1)
    return np.random.default_rng(seed).permutation(points)


def square(side, spacing=1.0):
    """Returns a regular grid of side x side points in the plane z = 0."""
    x, y = np.meshgrid(np.arange(side) * spacing, np.arange(side) * spacing)
    return np.stack([x.ravel(), y.ravel(), np.zeros(side * side)], axis=-1)
