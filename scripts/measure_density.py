#!/usr/bin/env python3
"""Measures images of a scan whose density falls with the distance from the scanner.

    scripts/measure_density.py RELIEF WORK_DIR MESH... [--step 0.35] [--noise 0.001] [--poisson 10]

The meshes (y up) stand as statues of 1.2 to 1.6 m in a room of 22 x 9 x 4 m, at 2 to 10 m from a scanner that
measures at equal angles: points of the far wall lie 20 times as far apart as those of the floor below it.
`--step`: degrees; `--noise`: standard deviation along the ray, metres. The scan is converted with one spacing
and by default, normals towards the scanner, and drawn in six views from it, where all that is scanned is seen;
the truth is the room, ray-traced. With --poisson, Open3D's screened Poisson reconstruction of that depth
follows, normals from 30 neighbours.

Prints a Markdown row each: PSNR lit and normals (rms, degrees) over the six views, holes and pixels of the
scene, patches, samples, spacings and seconds. Needs numpy and open3d from PyPI.
"""
import argparse
import json
import pathlib
import time

import numpy as np
import open3d as o3d

from run_command import run

SEED = 20261127
SCANNER = np.array([0.0, 0.0, 1.6])
VIEWS = [(10, -10), (70, -15), (130, -10), (190, -15), (250, -10), (310, -15)]


def box(low, high, inside=False):
    mesh = o3d.geometry.TriangleMesh.create_box(*(np.array(high) - low))
    mesh.translate(low)
    if inside:
        mesh.triangles = o3d.utility.Vector3iVector(np.asarray(mesh.triangles)[:, ::-1])
    return mesh


def statue(path, height, at, turn):
    mesh = o3d.io.read_triangle_mesh(str(path))
    x, y, z = np.asarray(mesh.vertices).T
    c, s = np.cos(turn), np.sin(turn)
    v = np.stack([c * x + s * z, s * x - c * z, y], axis=1)
    v -= [v[:, 0].mean(), v[:, 1].mean(), v[:, 2].min()]
    mesh.vertices = o3d.utility.Vector3dVector(v * height / v[:, 2].max() + at)
    return mesh


def room(paths):
    mesh = box([-8, -4, 0], [14, 5, 4], inside=True)
    places = [(1.2, [1.5, 1.5, 0.8], 2.0), (1.4, [-3.0, -1.0, 0.0], 1.0), (1.5, [8.0, -2.0, 0.0], 3.5),
              (1.6, [10.0, 3.0, 0.5], -1.5)]
    for k, place in enumerate(places):
        mesh += statue(paths[k % len(paths)], *place)
    for low, high in [([1, 1, 0], [2, 2, 0.8]), ([9, 2, 0], [11, 4, 0.5]), ([3, -3.9, 0], [5, -3, 1])]:
        mesh += box(low, high)
    return mesh


def scan_of(mesh, step, noise):
    random = np.random.default_rng(SEED)
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(mesh))
    turn, rise = np.meshgrid(np.arange(0, 360, step), np.arange(-60, 80, step))
    turn, rise = np.radians(turn).ravel(), np.radians(rise).ravel()
    rays = np.stack([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)], axis=1)
    starts = np.tile(SCANNER, (len(rays), 1))
    reach = scene.cast_rays(o3d.core.Tensor(np.hstack([starts, rays]).astype(np.float32)))["t_hit"].numpy()
    met = np.isfinite(reach)
    return SCANNER + rays[met] * (reach[met] + noise * random.standard_normal(met.sum()))[:, None]


def report_of(*command):
    return json.loads(run(*command, "--json"))


def draw(relief, model, image, view, *options):
    turn, rise = np.radians(view)
    toward = SCANNER + [np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)]
    run(relief, "render", model, "-o", image, "--size", "640x512", "--fov", "70", "--up", "z", "--material", "lit",
        "--eye=" + ",".join(map(str, SCANNER)), "--target=" + ",".join(map(str, toward)), *options)


def quality(arguments, model, *options):
    """PSNR and normals over all views, holes, pixels of the scene."""
    squares, angles, holes, pixels = [], [], 0, 0
    for k, view in enumerate(VIEWS):
        image = arguments.work / "view.exr"
        draw(arguments.relief, model, image, view, *options)
        errors = report_of(arguments.relief, "compare", image, arguments.work / f"truth{k}.exr")
        squares.append(10 ** (-errors["psnr_db"] / 10))
        angles.append(errors["normal_rms_deg"] ** 2)
        holes += errors["holes"]
        pixels += errors["covered_reference"]
    return f"{-10 * np.log10(np.mean(squares)):.1f} | {np.sqrt(np.mean(angles)):.1f} | {holes} of {pixels}"


def poisson(points, depth, path):
    begin = time.monotonic()
    cloud = o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points))
    cloud.estimate_normals(o3d.geometry.KDTreeSearchParamKNN(30))
    cloud.orient_normals_towards_camera_location(SCANNER)
    mesh, _ = o3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=depth)
    mesh.compute_vertex_normals()
    mesh.vertex_colors = o3d.utility.Vector3dVector()
    seconds = time.monotonic() - begin
    o3d.io.write_triangle_mesh(str(path), mesh)
    return len(mesh.vertices), seconds


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("relief")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--step", type=float, default=0.35)
    parser.add_argument("--noise", type=float, default=0.001)
    parser.add_argument("--poisson", type=int, default=0)
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    truth = arguments.work / "room.ply"
    mesh = room(arguments.meshes)
    o3d.io.write_triangle_mesh(str(truth), mesh, write_vertex_normals=False)
    for k, view in enumerate(VIEWS):
        draw(arguments.relief, truth, arguments.work / f"truth{k}.exr", view, "--engine", "raytrace")
    points = scan_of(mesh, arguments.step, arguments.noise)
    scan = arguments.work / "scan.ply"
    o3d.io.write_point_cloud(str(scan), o3d.geometry.PointCloud(o3d.utility.Vector3dVector(points)))
    print(f"{len(points)} points\n")
    print("| | dB lit | normals | holes | patches | samples | spacings, m | s |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for label, options in [("one spacing", ["--even-spacing"]), ("default", [])]:
        model = arguments.work / "scan.relief"
        begin = time.monotonic()
        report = report_of(arguments.relief, "convert", scan, "-o", model,
                           "--normals", "toward=" + ",".join(map(str, SCANNER)), *options)
        seconds = time.monotonic() - begin
        print(f"| {label} | {quality(arguments, model)} | {report['patches']} | {report['samples']} | "
              f"{report['finest_spacing']:.3f} to {report['coarsest_spacing']:.3f} | {seconds:.1f} |", flush=True)
    if arguments.poisson:
        path = arguments.work / "poisson.ply"
        vertices, seconds = poisson(points, arguments.poisson, path)
        print(f"| Poisson, depth {arguments.poisson} | {quality(arguments, path, '--engine', 'raytrace')} | – | "
              f"{vertices} | – | {seconds:.1f} |")


if __name__ == "__main__":
    main()
