#!/usr/bin/env python3
"""Measures how sharp edges are after noise was removed, beside screened Poisson.

    scripts/measure_edges.py RELIEF TRUTH_MESH NOISY_MESH

Both meshes have the same frame, as fandisk.obj and fandisk_noisy_0.3.obj have. The noisy one is converted
with --noise 0 and --noise auto and exported; Poisson gets its vertices, with normals from 30 neighbours and
the signs of the truth. Prints, for positions on the truth up to 1.5 spacings from creases of 40 degrees and
for all others, the distance to the surface (rms, spacings) and the angle of its normals (median and rms of
the unsigned angle, degrees). Needs numpy and open3d from PyPI.
"""
import collections
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import open3d as o3d

POSITIONS = 60_000


def scene_of(mesh):
    mesh.compute_triangle_normals()
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(mesh))
    return scene


def nearest(mesh, positions):
    found = scene_of(mesh).compute_closest_points(o3d.core.Tensor(positions.astype(np.float32)))
    return found["points"].numpy(), np.asarray(mesh.triangle_normals)[found["primitive_ids"].numpy()]


def near_creases(mesh, positions, reach):
    vertices, normals = np.asarray(mesh.vertices), np.asarray(mesh.triangle_normals)
    faces = collections.defaultdict(list)
    for k, t in enumerate(np.asarray(mesh.triangles)):
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            faces[min(a, b), max(a, b)].append(k)
    creases = [vertices[a] + s * (vertices[b] - vertices[a]) for (a, b), f in faces.items()
               if len(f) == 2 and normals[f[0]] @ normals[f[1]] < np.cos(np.radians(40))
               for s in np.linspace(0, 1, 5)]
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(np.array(creases)))
    points = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(positions))
    return np.asarray(points.compute_point_cloud_distance(cloud)) < reach


def main():
    relief, truth_path, noisy_path = sys.argv[1:]
    o3d.utility.random.seed(0)
    truth, noisy = (o3d.io.read_triangle_mesh(p) for p in (truth_path, noisy_path))
    scene_of(truth)
    spacing = np.sqrt(truth.get_surface_area() / len(truth.vertices))
    sampled = truth.sample_points_uniformly(POSITIONS, use_triangle_normal=True)
    positions, normals = np.asarray(sampled.points), np.asarray(sampled.normals)
    at_edge = near_creases(truth, positions, 1.5 * spacing)
    print("| surface | edges: distance | normals, rms | elsewhere: distance | normals, rms |")
    print("| --- | ---: | ---: | ---: | ---: |")

    def row(name, mesh):
        closest, of_mesh = nearest(mesh, positions)
        distance = np.linalg.norm(closest - positions, axis=1) / spacing
        angle = np.degrees(np.arccos(np.clip(np.abs(np.sum(of_mesh * normals, axis=1)), 0, 1)))
        cells = [f"{np.sqrt(np.mean(distance[m] ** 2)):.3f} | {np.median(angle[m]):.1f}, "
                 f"{np.sqrt(np.mean(angle[m] ** 2)):.1f}" for m in (at_edge, ~at_edge)]
        print(f"| {name} | {' | '.join(cells)} |")

    row("the noisy mesh", noisy)
    with tempfile.TemporaryDirectory() as folder:
        for noise in ("0", "auto"):
            patches, mesh = (str(pathlib.Path(folder) / name) for name in ("a.relief", "a.obj"))
            for command in (["convert", noisy_path, "-o", patches, "--noise", noise],
                            ["export", patches, "-o", mesh]):
                subprocess.run([relief, *command], check=True, capture_output=True)
            row(f"Relief, --noise {noise}", o3d.io.read_triangle_mesh(mesh))
    cloud = o3d.geometry.PointCloud(noisy.vertices)
    cloud.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(30))
    estimated = np.asarray(cloud.normals)
    side = np.sum(estimated * nearest(truth, np.asarray(noisy.vertices))[1], axis=1) < 0
    cloud.normals = o3d.utility.Vector3dVector(np.where(side[:, None], -estimated, estimated))
    for depth in (7, 8, 9):
        row(f"Poisson, depth {depth}",
            o3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=depth)[0])


if __name__ == "__main__":
    main()
