#!/usr/bin/env python3
"""Writes a grid of heights with an image over it as a textured mesh: OBJ, MTL and a copy of the image.

    scripts/terrain_obj.py ../shared/data/terrain/vtkjs_dem.csv ../shared/data/terrain/vtkjs_dem.jpg out/dem.obj

Rows of the CSV file run from the image's top to its bottom. --step: distance between two heights;
--exaggerate: factor on them. The defaults are those of the vtk.js example of this terrain.
"""
import argparse
import csv
import pathlib
import shutil


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("heights", type=pathlib.Path)
    parser.add_argument("image", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--step", type=float, default=0.01568)
    parser.add_argument("--exaggerate", type=float, default=0.06666)
    arguments = parser.parse_args()

    with open(arguments.heights, newline="") as file:
        rows = [[float(cell) for cell in row] for row in csv.reader(file) if row]
    height, width = len(rows), len(rows[0])
    if any(len(row) != width for row in rows) or width < 2 or height < 2:
        raise SystemExit(f"{arguments.heights}: its rows do not all have the same number of heights")

    # The image lies beside the mesh: names that lead out of its folder are not followed.
    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(arguments.image, arguments.out.parent / arguments.image.name)
    material = arguments.out.with_suffix(".mtl")
    material.write_text(f"newmtl ground\nmap_Kd {arguments.image.name}\n")
    with open(arguments.out, "w") as out:
        out.write(f"mtllib {material.name}\nusemtl ground\n")
        for j, row in enumerate(rows):
            for i, value in enumerate(row):
                x = (i - (width - 1) / 2) * arguments.step
                z = (j - (height - 1) / 2) * arguments.step
                out.write(f"v {x:.6g} {value * arguments.exaggerate:.6g} {z:.6g}\n")
        for j in range(height):
            for i in range(width):
                out.write(f"vt {i / (width - 1):.7g} {1 - j / (height - 1):.7g}\n")
        for j in range(height - 1):
            for i in range(width - 1):
                a = j * width + i + 1
                b, c, d = a + width, a + width + 1, a + 1
                out.write(f"f {a}/{a} {b}/{b} {c}/{c}\nf {a}/{a} {c}/{c} {d}/{d}\n")


main()
