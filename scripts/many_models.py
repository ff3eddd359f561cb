#!/usr/bin/env python3
"""Writes a scene of one model in front of many copies of it, in rows.

    scripts/many_models.py dragon.relief 1000 out/thousand.json
    relief render out/thousand.json -o out/thousand.png --frames 9

The camera sees the whole first model, as from --orbit 45,15. Each copy has another rotation. A number of 1
gives the scene to compare with. --gap: distance between models, in bounding-box diagonals. --relief: the command
that reads the model's bounds.
"""
import argparse
import json
import math
import pathlib
import subprocess

PER_ROW = 25
HALF_FOV = math.radians(22.5)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("number", type=int)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gap", type=float, default=2.25)
    parser.add_argument("--relief", default="relief")
    arguments = parser.parse_args()

    info = json.loads(subprocess.run([arguments.relief, "info", "--json", arguments.model],
                                     check=True, capture_output=True).stdout)
    low, high = info["bounds_min"], info["bounds_max"]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    diagonal = math.dist(low, high)
    azimuth, elevation = math.radians(45), math.radians(15)
    outward = (math.sin(azimuth) * math.cos(elevation), math.sin(elevation),
               math.cos(azimuth) * math.cos(elevation))
    distance = 0.5 * diagonal / math.sin(HALF_FOV)
    eye = [c + distance * d for c, d in zip(centre, outward)]

    models = [{"file": str(arguments.model.resolve())}]
    for copy in range(arguments.number - 1):
        row, column = 1 + copy // PER_ROW, copy % PER_ROW - PER_ROW // 2
        back, side = arguments.gap * diagonal * row, arguments.gap * diagonal * column
        models.append({"file": models[0]["file"], "transform": {
            "translation": [-math.sin(azimuth) * back + math.cos(azimuth) * side, 0,
                            -math.cos(azimuth) * back - math.sin(azimuth) * side],
            "rotation": {"axis": [0, 1, 0], "degrees": 37 * (copy + 1) % 360}}})
    scene = {"models": models, "views": [{"name": "front", "eye": eye, "target": centre}]}
    arguments.out.write_text(json.dumps(scene, indent=1))


if __name__ == "__main__":
    main()
