#!/usr/bin/env python3
"""Measures how an image's borders and surface compare with the ray-traced input mesh.

usage: scripts/measure_seams.py RELIEF WORK_DIR MESH... [--convert=OPTIONS] [--engines=onepass,raytrace]
                                [--views N] [--poisson DIR]

Each mesh is converted and drawn lit, 1280x1024, from N views around it, by each engine; the truth is the
mesh itself, ray-traced. With --poisson, DIR/NAME.ply is another reconstruction of the same vertices,
ray-traced too. Prints one Markdown row a model and engine: PSNR of the mean squared error of all views,
errors of normals (rms and 99th percentile, degrees), and the sums of holes and of missing and extra
pixels at silhouettes.
"""
import argparse
import json
import math
import pathlib

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
               "--fov", FIELD_OF_VIEW]


def draw(relief, model, image, engine, camera):
    # One ray through each pixel's middle: what is compared are surfaces, not antialiasing.
    run(relief, "render", model, "-o", image, "--engine", engine, "--samples", 1, "--material", "lit",
        "--size", "1280x1024", *camera)


def row_of(name, image, measured):
    mean = sum(10 ** (-m["psnr_db"] / 10) for m in measured) / len(measured)
    rms = math.sqrt(sum(m["normal_rms_deg"] ** 2 for m in measured) / len(measured))
    p99 = sum(m["normal_p99_deg"] for m in measured) / len(measured)
    counts = " | ".join(str(sum(m[key] for m in measured))
                        for key in ("holes", "border_missing", "border_extra"))
    return f"| {name} | {image} | {-10 * math.log10(mean):.1f} | {rms:.1f} | {p99:.0f} | {counts} |"


def measure(arguments, mesh):
    name = mesh.name.split(".")[0]
    patches = arguments.work / f"{name}.relief"
    run(arguments.relief, "convert", mesh, "-o", patches, *arguments.convert.split())
    images = {engine: (patches, engine) for engine in arguments.engines.split(",")}
    if arguments.poisson:
        images["Poisson"] = (arguments.poisson / f"{name}.ply", "raytrace")
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
        print(row_of(name, image, measured[image]), flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("relief")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("meshes", nargs="+", type=pathlib.Path)
    parser.add_argument("--convert", default="")
    parser.add_argument("--engines", default="onepass,raytrace")
    parser.add_argument("--views", type=int, default=3)
    parser.add_argument("--poisson", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    print("| model | image | PSNR dB | normals rms | p99 | holes | missing | extra |")
    print("| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for mesh in arguments.meshes:
        measure(arguments, mesh)


if __name__ == "__main__":
    main()
