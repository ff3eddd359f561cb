#!/usr/bin/env python3
"""Measures how conversion of bare points copes with noise, outliers and uneven density.

    scripts/measure_noise.py RELIEF WORK_DIR MESH... [--noise 0,0.25,0.5,1,2] [--outliers 0,2,10]
                             [--falling 50] [--poisson 7,8,9] [--convert=OPTIONS]

Each mesh gives points without normals: its vertices, with Gaussian noise (standard deviation along each
axis, in spacings: the square root of area over points), or with some per cent of outliers spread evenly
over a box 1.2 times as large, or thinned so that density falls along the longest axis. The truth is the
mesh. Prints one Markdown row a case: the distance of the samples to the mesh (rms, spacings), the angle
of their normals to its triangles' (median of the unsigned angle, degrees), the share whose normals face
inward, the share of the mesh's vertices without a sample within 3 spacings, patches and seconds.

With --poisson, rows of Open3D's screened Poisson reconstruction of the same points follow: normals from
30 neighbours, with the signs of the truth. Vertices that close holes (3 spacings and 3 standard deviations
off all vertices) do not count. Needs numpy and open3d from PyPI.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import time

import numpy as np
import open3d as o3d

SEED = 20261124


class Truth:
    def __init__(self, path):
        mesh = o3d.io.read_triangle_mesh(str(path))
        mesh.remove_unreferenced_vertices()
        self.vertices = np.asarray(mesh.vertices)
        self.spacing = np.sqrt(mesh.get_surface_area() / len(self.vertices))
        mesh.compute_triangle_normals()
        self.face_normals = np.asarray(mesh.triangle_normals)
        self.scene = o3d.t.geometry.RaycastingScene()
        self.scene.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(mesh))
        cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(self.vertices))
        self.tree = o3d.geometry.KDTreeFlann(cloud)
        self.cloud = cloud

    def nearest(self, points):
        found = self.scene.compute_closest_points(o3d.core.Tensor(points.astype(np.float32)))
        distance = np.linalg.norm(points - found["points"].numpy(), axis=1)
        return distance, self.face_normals[found["primitive_ids"].numpy()]


def write_ply(path, points):
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double x\n"
                   b"property double y\nproperty double z\nend_header\n" % len(points))
        file.write(np.ascontiguousarray(points, "<f8").tobytes())


def quality(truth, points, normals, seconds, patches, count_all=True, sigma=0.0):
    if not count_all:
        far = np.asarray(o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
                         .compute_point_cloud_distance(truth.cloud))
        keep = far <= (3 + 3 * sigma) * truth.spacing
        points, normals = points[keep], normals[keep]
    distance, faces = truth.nearest(points)
    cosine = np.sum(normals * faces, axis=1)
    angle = np.degrees(np.arccos(np.clip(np.abs(cosine), 0, 1)))
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    bare = np.asarray(truth.cloud.compute_point_cloud_distance(cloud)) > 3 * truth.spacing
    rms = np.sqrt(np.mean((distance / truth.spacing) ** 2))
    return (f"{rms:.3f} | {np.median(angle):.1f} | {100 * np.mean(cosine < 0):.1f} | "
            f"{100 * np.mean(bare):.1f} | {patches} | {seconds:.2f}")


def samples_of(arguments, scan):
    """Converts a scan. Returns the report of the conversion and the samples as a point cloud."""
    patches, samples = scan.with_suffix(".relief"), scan.with_suffix(".samples.ply")
    done = subprocess.run([arguments.relief, "convert", scan, "-o", patches, "--json",
                           *arguments.convert.split()], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    subprocess.run([arguments.relief, "export", patches, "-o", samples], check=True, capture_output=True)
    return json.loads(done.stdout), o3d.io.read_point_cloud(str(samples))


def of_relief(arguments, truth, scan):
    report, cloud = samples_of(arguments, scan)
    return quality(truth, np.asarray(cloud.points), np.asarray(cloud.normals), report["seconds"],
                   report["patches"])


def of_poisson(truth, points, depth, sigma):
    begin = time.time()
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    cloud.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(30))
    normals = np.asarray(cloud.normals)
    _, faces = truth.nearest(points)
    cloud.normals = o3d.utility.Vector3dVector(normals * np.where(np.sum(normals * faces, axis=1) < 0, -1, 1)[:, None])
    mesh, _ = o3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=depth)
    seconds = time.time() - begin
    mesh.compute_vertex_normals()
    return quality(truth, np.asarray(mesh.vertices), np.asarray(mesh.vertex_normals), seconds, "–",
                   count_all=False, sigma=sigma)


def cases(arguments, truth):
    random = np.random.default_rng(SEED)
    v = truth.vertices
    for noise in arguments.noise:
        yield f"noise {noise:g}", v + noise * truth.spacing * random.standard_normal(v.shape), noise
    low, high = v.min(0), v.max(0)
    for percent in arguments.outliers:
        count = round(len(v) * percent / 100)
        box = low - 0.1 * (high - low) + 1.2 * (high - low) * random.random((count, 3))
        yield f"outliers {percent:g} %", np.concatenate([v, box]), 0.0
        noisy = v + 0.5 * truth.spacing * random.standard_normal(v.shape)
        yield f"outliers {percent:g} %, noise 0.5", np.concatenate([noisy, box]), 0.5
    if arguments.falling > 1:
        axis = np.argmax(high - low)
        share = arguments.falling ** -((v[:, axis] - low[axis]) / (high - low)[axis])
        kept = random.random(len(v)) < share
        yield f"density falling {arguments.falling:g}-fold", v[kept], 0.0


def numbers(text):
    return [float(n) for n in text.split(",") if n]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("relief")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--noise", type=numbers, default=[0, 0.25, 0.5, 1, 2])
    parser.add_argument("--outliers", type=numbers, default=[2, 10])
    parser.add_argument("--falling", type=float, default=50)
    parser.add_argument("--poisson", type=numbers, default=[])
    parser.add_argument("--convert", default="")
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    print("| model | points | method | distance rms | normals | flipped % | bare % | patches | s |")
    print("| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for path in arguments.meshes:
        truth = Truth(path)
        name = path.name.split(".")[0]
        for label, points, sigma in cases(arguments, truth):
            scan = arguments.work / f"{name} {label}.ply".replace(" ", "_").replace("%", "pc").replace(",", "")
            write_ply(scan, points)
            print(f"| {name} | {label} | Relief | {of_relief(arguments, truth, scan)} |", flush=True)
            for depth in arguments.poisson:
                print(f"| {name} | {label} | Poisson {depth:g} | "
                      f"{of_poisson(truth, points, int(depth), sigma)} |", flush=True)


if __name__ == "__main__":
    main()
