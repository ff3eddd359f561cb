#!/usr/bin/env python3
"""Measures what each feature of five scenes costs; writes the tables of docs/explain.md.

    scripts/measure_features.py RELIEF FOLDER... [--turns 9] [--size 640x512] [--work DIR]

The folders hold, at any depth, dragon_vrip.ply.gz (models/fetch_dragon.sh gets it), lion_takanawa_rgb_normals.ply.gz,
spot_triangulated.obj with spot_texture.png, and venice_sunset_1k.hdr. Converts them, writes a scene file for each scene, and runs
`relief render SCENE --explain-cost`. With --work files and reports are kept there, and those that are there already are not made
again. Takes some minutes, on a machine that does nothing else.
"""
import argparse
import json
import os
import pathlib
import shutil
import sys
import tempfile

from find_file import find_file
from page_section import write_section
from run_command import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "explain.md"
BEGIN, END = "<!-- Written by scripts/measure_features.py from here -->", "<!-- to here -->"
DRAGON, LION, SPOT, TEXTURE, SKY = ("dragon_vrip.ply.gz", "lion_takanawa_rgb_normals.ply.gz", "spot_triangulated.obj",
                                    "spot_texture.png", "venice_sunset_1k.hdr")
# Spot stands on a square mirror with waves: its feet are at a height of -0.737.
POOL = {"file": "pool.relief", "material": "mirror",
        "transform": {"translation": [0, -0.737, 0.2], "rotation": {"axis": [1, 0, 0], "degrees": -90}, "scale": 1.3}}
SCENES = {
    "Unlit, no colours": {
        "scene": {"models": [{"file": "dragon.relief", "material": "unlit"}]},
        "says": "The Dragon as a silhouette. The file's normals are read for its seams alone: no map but the masks of coarser levels is "
                "on the GPU, and one pass draws the image. Levels of detail are the only feature; they are there to save time, and cost memory and code."},
    "Unlit colours": {
        "scene": {"models": [{"file": "lion.relief", "material": "unlit"}]},
        "says": "A scan with colours, as points with colours are shown by default. Its colours are a section of the file, a map on the GPU and "
                "a lookup a fragment. Its normals stay in the file."},
    "Lit, with colours": {
        "scene": {"models": [{"file": "lion.relief", "material": "lit"}]},
        "says": "Light brings the normals: their section, their map, and the visibility buffer with a pass of its own, so that each pixel is "
                "shaded once. The pass that shades at once goes."},
    "Lit by an environment, with a texture": {
        "scene": {"models": [{"file": "spot.relief", "material": "lit"}], "env": SKY},
        "says": "A texture of several texels a cell has mip levels and is averaged over each pixel's footprint, so that it is shaded where "
                "it is found: there is no visibility buffer. The environment is light, and is seen behind."},
    "Glass over a mirror with fine normals": {
        "scene": {"models": [{"file": "spot_plain.relief", "material": "glass", "opacity": 0.9}, POOL], "env": SKY},
        "says": "Transparency finds and shades the surfaces layer by layer. Refraction and reflection share the environment with what is seen "
                "behind, so that no row has its bytes. One model with fine normals makes the maps of all of them have room for mip levels."},
}
SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"


def make_models(arguments, work):
    """Converts the scans, and a square with a normal map of waves."""
    def convert(scan, name, *options):
        if not (work / name).exists():
            run(arguments.relief, "convert", scan, "-o", work / name, *options)

    convert(find_file(arguments.folders, DRAGON), "dragon.relief")
    convert(find_file(arguments.folders, LION), "lion.relief")
    convert(find_file(arguments.folders, SPOT), "spot.relief", "--texture", find_file(arguments.folders, TEXTURE))
    convert(find_file(arguments.folders, SPOT), "spot_plain.relief", "--texture", "none")
    (work / "square.obj").write_text(SQUARE)
    run(sys.executable, ROOT / "scripts" / "normal_map_obj.py", work / "waves.obj", "--mesh", work / "square.obj", "--side", 512,
        "--waves", 16, "--steepest", 0.3)
    convert(work / "waves.obj", "pool.relief", "--spacing", 0.05)
    shutil.copyfile(find_file(arguments.folders, SKY), work / SKY)


def measure(arguments, name, scene, work):
    """What the features of a scene cost, and what was read of its files."""
    stem = name.lower().replace(",", "").replace(" ", "_")
    report, file = work / f"{stem}.report.json", work / f"{stem}.json"
    if not report.exists():
        file.write_text(json.dumps({**scene, "orbit": [30, 25], "views": [{"name": "view"}]}, indent=2))
        report.write_text(run(arguments.relief, "render", file, "-o", work / f"{stem}.png", "--explain-cost", "--frames", arguments.turns,
                              "--size", arguments.size, "--json"))
    view = json.loads(report.read_text())["views"][0]
    return view["explain"], view["renderer"]


def passes_of(cost):
    """Each name once, with how often it is there."""
    def names(passes, sign):
        return [f"{sign}{name}" + (f" × {passes.count(name)}" if passes.count(name) > 1 else "") for name in dict.fromkeys(passes)]

    if "saved_passes" not in cost:
        return ", ".join(names(cost["passes"], ""))
    return ", ".join(names(cost["passes"], "+") + names(cost["saved_passes"], "−"))


def signed(value, digits=0):
    return f"{value:,.{digits}f}" if value < 0 else f"+{value:,.{digits}f}"


def row_of_frame(name, cost):
    cells = (f"**{name}**", f"{cost['gpu_bytes'] / 1e6:,.2f}", f"{(cost['file_bytes'] or 0) / 1e3:,.0f}", f"{cost['shader_lines']:,}",
             f"{cost['frame_ms']:.1f}", passes_of(cost))
    return f"| {' | '.join(cells)} |"


def row_of(cost):
    cells = (cost["feature"] + (f" (else: {cost['instead']})" if cost["instead"] else ""), signed(cost["gpu_bytes"] / 1e6, 2),
             f"{(cost['file_bytes'] or 0) / 1e3:,.0f}", signed(cost["shader_lines"]),
             f"{signed(cost['frame_ms'], 1)} ± {cost['spread_ms'] / 2:.1f}", passes_of(cost))
    return f"| {' | '.join(cells)} |"


def section_of(name, scene, explanation):
    read = explanation["read_bytes"]
    kilobytes = ", ".join(f"{section} {bytes_read / 1e3:,.0f}" for section, bytes_read in read.items())
    costs = explanation["costs"]
    return [f"### {name}", "", scene["says"], "", f"Read of files, kB: {kilobytes}.", "",
            "| | GPU, MB | file, kB | shader lines | ms | passes |", "| --- | ---: | ---: | ---: | ---: | --- |",
            row_of_frame("whole frame", costs["whole"]), *(row_of(cost) for cost in costs["features"]),
            row_of_frame("without all of these", costs["rest"]), ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="+")
    parser.add_argument("--turns", type=int, default=9)
    parser.add_argument("--size", default="640x512")
    parser.add_argument("--work", type=pathlib.Path, help="keeps files and reports there; those in it are not made again")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        work = arguments.work or pathlib.Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        make_models(arguments, work)
        lines = []
        for name, scene in SCENES.items():
            print(f"measuring {name}", file=sys.stderr, flush=True)
            explanation, renderer = measure(arguments, name, scene["scene"], work)
            lines += section_of(name, scene, explanation)
    commit = run("git", "-C", ROOT, "rev-parse", "--short", "HEAD").strip()
    head = [f"`relief render SCENE -o OUT.png --explain-cost --frames {arguments.turns} --size {arguments.size}`; {os.cpu_count()} cores, "
            f"{renderer}, commit {commit}. One sample per pixel.", ""]
    write_section(PAGE, BEGIN, END, "\n".join(head + lines))


if __name__ == "__main__":
    main()
