#!/usr/bin/env python3
"""Measures how many normals of bare points face the wrong side, of bodies that stand on a ground of points.

    scripts/measure_orientation.py RELIEF WORK_DIR MESH... [--noise 0.1] [--alone] [--up y]
                                   [--convert=OPTIONS] [--open3d]

Each mesh gives points without normals: its vertices, and under it a square ground of the same spacing,
twice as wide as the body, at its lowest point. All have Gaussian noise (standard deviation along each axis,
in spacings: the square root of area over points). With --alone, rows of the bodies without a ground follow.

The truth is the mesh and the ground, which faces up. A sample is flipped if its normal and the nearest
truth's are more than 90 degrees apart. Samples within 1.5 spacings of both a mesh and a ground that face
apart do not count: there the side is not known. Prints one Markdown row a case: flipped samples (per cent),
samples that do not count, patches, and seconds of the conversion and of its stage "normals". With --open3d,
rows of Open3D's minimum spanning tree on the same points follow, of the better of its two global signs.
Needs numpy and open3d from PyPI.
"""
import argparse
import gzip
import pathlib
import shutil
import time

import numpy as np
import open3d as o3d

from measure_noise import samples_of, write_ply

SEED = 20261125
BOTH = 1.5  # spacings
AXES = {"x": [1, 2, 0], "y": [2, 0, 1], "z": [0, 1, 2]}  # that become x, y and z


def read_mesh(path, work):
    if path.suffix == ".gz":
        unpacked = work / path.stem
        with gzip.open(path) as packed, open(unpacked, "wb") as out:
            shutil.copyfileobj(packed, out)
        path = unpacked
    return o3d.io.read_triangle_mesh(str(path))


class Truth:
    def __init__(self, mesh, up, has_ground):
        mesh.remove_unreferenced_vertices()
        vertices = np.asarray(mesh.vertices)[:, AXES[up]]
        vertices -= [*(vertices.min(0) + vertices.max(0))[:2] / 2, vertices[:, 2].min()]
        mesh.vertices = o3d.utility.Vector3dVector(vertices)
        mesh.compute_triangle_normals()
        self.face_normals = np.asarray(mesh.triangle_normals)
        self.spacing = np.sqrt(mesh.get_surface_area() / len(vertices))
        self.scene = o3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(mesh))
        self.has_ground = has_ground
        self.points = vertices
        if has_ground:
            half = np.ptp(vertices, axis=0)[:2].max()
            row = np.arange(-half, half, self.spacing)
            x, y = np.meshgrid(row, row)
            ground = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1)
            self.points = np.concatenate([vertices, ground])

    def normals(self, points):
        """The truth's normals at points, and which of them count."""
        found = self.scene.compute_closest_points(o3d.core.Tensor(points.astype(np.float32)))
        distance = np.linalg.norm(points - found["points"].numpy(), axis=1)
        normals = self.face_normals[found["primitive_ids"].numpy()]
        if not self.has_ground:
            return normals, np.ones(len(points), bool)
        to_ground = np.abs(points[:, 2])
        both = np.maximum(distance, to_ground) < BOTH * self.spacing
        counts = ~both | (normals[:, 2] > 0)
        return np.where((to_ground < distance)[:, None], [0.0, 0.0, 1.0], normals), counts


def flipped(truth, points, normals):
    expected, counts = truth.normals(points)
    return np.mean(np.sum(normals * expected, axis=1)[counts] < 0), 1 - counts.mean()


def of_relief(arguments, truth, scan):
    report, cloud = samples_of(arguments, scan)
    wrong, left_out = flipped(truth, np.asarray(cloud.points), np.asarray(cloud.normals))
    stage = report["stage_seconds"].get("normals", 0.0)
    return (f"{100 * wrong:.2f} | {100 * left_out:.1f} | {report['patches']} | "
            f"{report['seconds']:.2f} | {stage:.2f}")


def of_open3d(truth, points):
    begin = time.time()
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    cloud.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(30))
    cloud.orient_normals_consistent_tangent_plane(30)
    seconds = time.time() - begin
    wrong, left_out = flipped(truth, points, np.asarray(cloud.normals))
    return f"{100 * min(wrong, 1 - wrong):.2f} | {100 * left_out:.1f} | – | – | {seconds:.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("relief")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--noise", type=float, default=0.1)
    parser.add_argument("--alone", action="store_true")
    parser.add_argument("--up", choices=AXES, default="y")
    parser.add_argument("--convert", default="")
    parser.add_argument("--open3d", action="store_true")
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    print("| body | points | method | flipped % | not counted % | patches | s | s of normals |")
    print("| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |")
    for path in arguments.meshes:
        name = path.name.split(".")[0]
        for has_ground in [True, False] if arguments.alone else [True]:
            truth = Truth(read_mesh(path, arguments.work), arguments.up, has_ground)
            random = np.random.default_rng(SEED)
            noise = arguments.noise * truth.spacing * random.standard_normal(truth.points.shape)
            points = truth.points + noise
            label = "on a ground" if has_ground else "alone"
            scan = arguments.work / f"{name}_{label.replace(' ', '_')}.ply"
            write_ply(scan, points)
            print(f"| {name} | {label} | Relief | {of_relief(arguments, truth, scan)} |", flush=True)
            if arguments.open3d:
                print(f"| {name} | {label} | Open3D | {of_open3d(truth, points)} |", flush=True)


if __name__ == "__main__":
    main()
