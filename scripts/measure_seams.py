#!/usr/bin/env python3
"""Measures how an image's borders and surface compare with the ray-traced input mesh.

usage: scripts/measure_seams.py RELIEF WORK_DIR MESH... [--convert=OPTIONS] [--engines=onepass,raytrace]
                                [--views N] [--poisson DEPTH]

Each mesh is converted and drawn lit, 1280x1024, from N views around it, by each engine; the truth is the
mesh itself, ray-traced. With --poisson, a row of Open3D's screened Poisson reconstruction follows, ray-traced
too: of the mesh's vertices and their normals, without what lies farther than three spacings from the mesh.
Prints one Markdown row a model and engine: PSNR of the mean squared error of all views, errors of normals
(rms and 99th percentile, degrees), the sums of holes and of missing and extra pixels at silhouettes, and seconds:
of the whole conversion, and of Poisson without reading, writing and normals.

--poisson needs open3d from PyPI, and meshes that Open3D reads: neither gzipped nor of strips.
"""
import argparse
import json
import math
import pathlib
import time

from run_command import run

GOLDEN_ANGLE = math.radians(137.507764)
FIELD_OF_VIEW = 45.0


def cameras(info, count):
    """Returns options for views from evenly around the model, all of it in the image."""
    low, high = info["bounds_min"], info["bounds_max"]
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    distance = math.dist(low, high) / 2 / math.sin(math.radians(FIELD_OF_VIEW / 2))
    for k in range(count):
        y = 0.8 * ((2 * k + 1) / count - 1)
        ring, angle = math.sqrt(1 - y * y), k * GOLDEN_ANGLE
        direction = (ring * math.sin(angle), y, ring * math.cos(angle))
        eye = [m + distance * d for m, d in zip(middle, direction)]
        yield ["--eye", ",".join(map(repr, eye)), "--target", ",".join(map(repr, middle)),
               "--fov", FIELD_OF_VIEW, "--up", "y"]


def draw(relief, model, image, engine, camera):
    # One ray through each pixel's middle: what is compared are surfaces, not antialiasing.
    run(relief, "render", model, "-o", image, "--engine", engine, "--samples", 1, "--material", "lit",
        "--size", "1280x1024", *camera)


def reconstruct(mesh, path, depth):
    """Writes the Poisson reconstruction of a mesh's vertices. Returns the seconds it took."""
    import numpy as np
    import open3d as o3d

    truth = o3d.io.read_triangle_mesh(str(mesh))
    truth.remove_unreferenced_vertices()
    truth.compute_vertex_normals()
    cloud = o3d.geometry.PointCloud(truth.vertices)
    cloud.normals = truth.vertex_normals
    spacing = math.sqrt(truth.get_surface_area() / len(truth.vertices))
    begin = time.monotonic()
    made, _ = o3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=depth)
    seconds = time.monotonic() - begin
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.t.geometry.TriangleMesh.from_legacy(truth))
    distances = scene.compute_distance(o3d.core.Tensor(np.asarray(made.vertices, np.float32))).numpy()
    made.remove_vertices_by_mask(distances > 3 * spacing)
    made.compute_vertex_normals()
    made.vertex_colors = o3d.utility.Vector3dVector()  # Open3D makes all vertices black.
    o3d.io.write_triangle_mesh(str(path), made)
    return seconds


def row_of(name, image, measured, seconds):
    mean = sum(10 ** (-m["psnr_db"] / 10) for m in measured) / len(measured)
    rms = math.sqrt(sum(m["normal_rms_deg"] ** 2 for m in measured) / len(measured))
    p99 = sum(m["normal_p99_deg"] for m in measured) / len(measured)
    counts = " | ".join(str(sum(m[key] for m in measured))
                        for key in ("holes", "border_missing", "border_extra"))
    return f"| {name} | {image} | {-10 * math.log10(mean):.1f} | {rms:.1f} | {p99:.0f} | {counts} | {seconds:.2f} |"


def measure(arguments, mesh):
    name = mesh.name.split(".")[0]
    patches = arguments.work / f"{name}.relief"
    report = json.loads(run(arguments.relief, "convert", mesh, "-o", patches, "--json", *arguments.convert.split()))
    images = {engine: (patches, engine) for engine in arguments.engines.split(",")}
    seconds = dict.fromkeys(images, report["seconds"])
    if arguments.poisson:
        path = arguments.work / f"{name}_poisson.ply"
        seconds["Poisson"] = reconstruct(mesh, path, arguments.poisson)
        images["Poisson"] = (path, "raytrace")
    measured = {image: [] for image in images}
    info = json.loads(run(arguments.relief, "info", patches, "--json"))
    for k, camera in enumerate(cameras(info, arguments.views)):
        truth = arguments.work / f"{name}_{k}_truth.exr"
        if not truth.exists():
            draw(arguments.relief, mesh, truth, "raytrace", camera)
        for image, (model, engine) in images.items():
            path = arguments.work / f"{name}_{k}_{image}.exr"
            draw(arguments.relief, model, path, engine, camera)
            measured[image].append(json.loads(run(arguments.relief, "compare", path, truth, "--json")))
    for image in images:
        print(row_of(name, image, measured[image], seconds[image]), flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("relief")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--convert", default="")
    parser.add_argument("--engines", default="onepass,raytrace")
    parser.add_argument("--views", type=int, default=3)
    parser.add_argument("--poisson", type=int)
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    print("| model | image | PSNR dB | normals rms | p99 | holes | missing | extra | s |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for mesh in arguments.meshes:
        measure(arguments, mesh)


if __name__ == "__main__":
    main()
