#!/usr/bin/env python3
"""Writes a scene of one model in front of many copies of it, which stand in rows behind.

    scripts/many_models.py dragon.relief 1000 out/thousand.json
    relief render out/thousand.json -o out/thousand.png --frames 9

The first is seen from the side of --orbit 45,15, whole; each copy is turned otherwise. --gap: distance of two
of them in bounding-box diagonals. With a number of 1 the scene is what a thousand are compared with.
--relief: the command that reads the model's bounds.
"""
import argparse
import json
import math
import pathlib
import subprocess

PER_ROW = 25
HALF_FOV = math.radians(22.5)


def main():
    arguments = argparse.ArgumentParser(description=__doc__,
                                        formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("model", type=pathlib.Path)
    arguments.add_argument("number", type=int)
    arguments.add_argument("out", type=pathlib.Path)
    arguments.add_argument("--gap", type=float, default=2.25)
    arguments.add_argument("--relief", default="relief")
    asked = arguments.parse_args()

    info = json.loads(subprocess.run([asked.relief, "info", "--json", asked.model],
                                     check=True, capture_output=True).stdout)
    low, high = info["bounds_min"], info["bounds_max"]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    diagonal = math.dist(low, high)
    azimuth, elevation = math.radians(45), math.radians(15)
    outward = (math.sin(azimuth) * math.cos(elevation), math.sin(elevation),
               math.cos(azimuth) * math.cos(elevation))
    distance = 0.5 * diagonal / math.sin(HALF_FOV)
    eye = [c + distance * d for c, d in zip(centre, outward)]

    models = [{"file": str(asked.model.resolve())}]
    for copy in range(asked.number - 1):
        row, column = 1 + copy // PER_ROW, copy % PER_ROW - PER_ROW // 2
        back, side = asked.gap * diagonal * row, asked.gap * diagonal * column
        models.append({"file": models[0]["file"], "transform": {
            "translation": [-math.sin(azimuth) * back + math.cos(azimuth) * side, 0,
                            -math.cos(azimuth) * back - math.sin(azimuth) * side],
            "rotation": {"axis": [0, 1, 0], "degrees": 37 * (copy + 1) % 360}}})
    scene = {"models": models, "views": [{"name": "front", "eye": eye, "target": centre}]}
    asked.out.write_text(json.dumps(scene, indent=1))


if __name__ == "__main__":
    main()
