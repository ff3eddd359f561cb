#!/usr/bin/env python3
"""Checks that the mesh of patches that meet at seams is as closed as the mesh they were made from.

usage: scripts/check_export.py RELIEF MESH... [--convert=OPTIONS] [--keep DIR]

Each mesh is converted and exported. Prints two Markdown rows a mesh, its own with equal
positions merged, and the export's as it is in the file: border edges (of one triangle) and the loops that
they form; edges of three or more triangles; pairs of neighbours that face opposite ways; triangles
without area; components; vertices without a triangle; whether trimesh finds the winding consistent. With
--keep, the exports stay in DIR.
Needs the Python module trimesh, which is no dependency of Relief.
"""
import argparse
import pathlib
import sys
import tempfile

try:
    import numpy as np
    import trimesh
except ImportError as missing:
    sys.exit(f"check_export.py: needs the Python module {missing.name}; "
             "install it in a virtual environment")

from run_command import run  # noqa: E402


def load(path, merge):
    mesh = trimesh.load(path, force="mesh", process=False)
    if merge:
        mesh.merge_vertices(merge_norm=True, merge_tex=True)
    return mesh


def row_of(name, kind, mesh):
    if len(mesh.faces) == 0:
        return f"| {name} | {kind} | not read |" + 8 * " – |"
    directed = mesh.edges
    edges, use = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)
    border = edges[use == 1]
    # A directed edge that occurs twice: both of its triangles are on the same side.
    turned = np.unique(directed, axis=0, return_counts=True)[1]
    loops = trimesh.graph.connected_components(border) if len(border) else []
    numbers = [len(mesh.faces), len(border), len(loops), int((use > 2).sum()),
               int((turned > 1).sum()), int((mesh.area_faces == 0).sum()), mesh.body_count,
               len(mesh.vertices) - len(np.unique(mesh.faces)),
               "yes" if mesh.is_winding_consistent else "no"]
    return f"| {name} | {kind} | {' | '.join(map(str, numbers))} |"


def main():
    parser = argparse.ArgumentParser(usage=__doc__, add_help=False)
    parser.add_argument("relief")
    parser.add_argument("meshes", type=pathlib.Path, nargs="+")
    parser.add_argument("--convert", default="")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    print("| model | mesh | triangles | border edges | loops | edges of 3 | flipped | no area | components "
          "| unused | winding |\n| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | --- |")
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or pathlib.Path(temporary)
        for path in arguments.meshes:
            name = path.name.split(".")[0]
            patches, export = folder / f"{name}.relief", folder / f"{name}.ply"
            run(arguments.relief, "convert", path, "-o", patches, *arguments.convert.split())
            run(arguments.relief, "export", patches, "-o", export, "--as", "mesh")
            print(row_of(name, "input", load(path, True)))
            print(row_of(name, "export", load(export, False)), flush=True)


if __name__ == "__main__":
    main()
