#!/usr/bin/env python3
"""Measures the engines of volumes on five volumes at 512x512, against both truths.

usage: scripts/measure_volumes.py RELIEF DATA [--volumes engine,stent,head,ch2,cranium] [--frames 5] [--work DIR]

DATA is the folder with volumes/. Prints the Markdown tables of docs/measurements/volumes.md: the median time of a frame of
`volume-reference` and of `volume` (in turns; the first frame of `volume`, which compiles shaders, does not count), the PSNR of
each to the truths of the kernels and of the field (both with the pixel filter, `--samples 4`), and that of `volume`
to `volume-reference`. All with default options: transfer auto, linear attenuation, filter ewa, cutoff 4. The
truths of one volume take one to four CPU minutes; --work keeps them for the next run.
"""
import argparse
import json
import pathlib
import statistics
import sys
import tempfile

from run_command import run

VOLUMES = {"engine": ("engine.nii.gz",), "stent": ("stent.nrrd",),
           "head": ("head256x256x109.zip", "--raw", "256x256x109:u8:1,1,2"), "ch2": ("ch2.nii.gz",),
           "cranium": ("cranium_ct.nrrd",)}
ENGINES = ("volume-reference", "volume")
TRUTHS = {"kernels": ("--truth", "kernels", "--samples", 4), "field": ("--truth", "field", "--samples", 4)}
TURNS = 3


def measure(arguments, work, name):
    scene = arguments.data / "volumes" / VOLUMES[name][0]
    options = ("--size", "512x512", "--json", *VOLUMES[name][1:])

    def draw(image, *more):
        return json.loads(run(arguments.relief, "render", scene, "-o", image, *options, *more))

    def psnr(image, truth):
        return json.loads(run(arguments.relief, "compare", image, truth, "--json"))["psnr_db"]

    truths = {truth: work / f"{name}_{truth}.exr" for truth in TRUTHS}
    for truth, path in truths.items():
        if not path.exists():
            draw(path, "--engine", "volume-truth", *TRUTHS[truth])
    images = {engine: work / f"{name}_{engine}.exr" for engine in ENGINES}
    times = {engine: [] for engine in ENGINES}
    for _ in range(TURNS):
        for engine, path in images.items():
            drawn = draw(path, "--engine", engine, "--frames", arguments.frames)
            times[engine].append(drawn["frame_ms"])
    cells = [f"{statistics.median(times[engine]):.0f}" for engine in ENGINES]
    for path in truths.values():
        cells += [f"{psnr(images[engine], path):.2f}" for engine in ENGINES]
    cells.append(f"{psnr(images['volume'], images['volume-reference']):.1f}")
    print(f"| {name} |", " | ".join(cells), "|", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("relief")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--volumes", default=",".join(VOLUMES))
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--work", type=pathlib.Path, help="keeps images there; truths in it are not drawn again")
    arguments = parser.parse_args()
    names = arguments.volumes.split(",")
    for name in names:
        if name not in VOLUMES:
            sys.exit(f"measure_volumes.py: there is no volume {name}; take {', '.join(VOLUMES)}")
    print("| volume | reference, ms | volume, ms | reference to kernels, dB | volume to kernels, dB |"
          " reference to field, dB | volume to field, dB | volume to reference, dB |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as scratch:
        work = arguments.work or pathlib.Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        for name in names:
            measure(arguments, work, name)


if __name__ == "__main__":
    main()
