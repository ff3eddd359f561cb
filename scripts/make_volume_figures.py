#!/usr/bin/env python3
"""Makes the figures of docs/measurements/volume-figures.md: those of [Zwicker 2002], with Relief.

usage: scripts/make_volume_figures.py RELIEF DATA [--only NAME,...] [--work DIR]

DATA is the folder with volumes/, scans/, terrain/ and textured/. Names: zebra (Figure 14), kernels
(Figure 15), inside (Figure 16), surfaces (Figure 17 and Table I). Writes docs/images/volume_*.jpg and prints the
page's tables in Markdown. The zebra textures are made here. Needs ImageMagick (Debian: imagemagick), which the
project itself does not.
"""
import argparse
import json
import math
import pathlib
import sys
import tempfile

from run_command import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs" / "images"

# Stripes fork where the phase turns once around a place: x, y (shares of the square) and the sense.
FORKS = [(0.17, 0.71, 1), (0.33, 0.22, -1), (0.52, 0.58, 1), (0.68, 0.86, -1), (0.81, 0.35, 1), (0.44, 0.9, -1),
         (0.9, 0.64, -1), (0.24, 0.45, 1)]
STRIPES = 90  # across the square, before they bend
# Of a slice whose kernels are a surface's: their variance across it is 1e-6 of that along it (section 6.4).
FLAT = 1e-3


def stripe(x, y):
    """Returns the zebra at a place of the unit square, 0 to 255: stripes that bend, fork and narrow to the right."""
    phase = STRIPES * math.pi * (x + 0.55 * x * x + 0.09 * math.sin(5.1 * y + 2.0 * x) + 0.05 * math.sin(11.0 * y - 4.0 * x))
    for fork_x, fork_y, sense in FORKS:
        phase += sense * math.atan2(y - fork_y, x - fork_x)
    return 127.5 + 127.5 * math.tanh(6.0 * math.sin(phase))


class Figures:
    def __init__(self, arguments, work):
        self.relief = arguments.relief
        self.data = arguments.data
        self.work = work

    def render(self, scene, image, *options):
        """Draws an EXR; returns what `render --json` reports."""
        path = self.work / image
        return json.loads(run(self.relief, "render", scene, "-o", path, "--json", *options))

    def compare(self, image, truth):
        return json.loads(run(self.relief, "compare", self.work / image, self.work / truth, "--json"))

    def error(self, image, truth):
        measured = self.compare(image, truth)
        return f"{measured['psnr_db']:.1f} / {measured['flip_mean']:.4f}"

    def png(self, image):
        """Converts an EXR to what a PNG of the same render would be, for montages."""
        path = (self.work / image).with_suffix(".png")
        run("convert", self.work / image, "-colorspace", "sRGB", path)
        return path

    def montage(self, name, images, columns, size, quality=85):
        run("montage", *images, "-tile", f"{columns}x", "-geometry", f"{size}+2+2", "-quality", quality, "-strip",
            IMAGES / f"{name}.jpg")

    def transfer(self, name, **function):
        path = self.work / f"{name}.json"
        path.write_text(json.dumps(function))
        return path

    def zebra(self, width, height, thickness):
        """Writes the zebra as a volume of one slice that covers a square of `width` units."""
        path = self.work / f"zebra_{width}x{height}_{thickness}.nrrd"
        rows = bytearray()
        for j in range(height):
            rows += bytes(round(stripe((i + 0.5) / width, (j + 0.5) / height)) for i in range(width))
        header = (f"NRRD0004\ntype: uint8\ndimension: 3\nsizes: {width} {height} 1\n"
                  f"spacings: 1 {width / height} {thickness}\nencoding: raw\n\n")
        path.write_bytes(header.encode() + bytes(rows))
        return path

    def ink(self, thickness):
        """Black to white, opaque: a layer as thick as the slice lets 1e-4 through."""
        return self.transfer(f"ink_{thickness}", colour=[[0, 0.02, 0.02, 0.02], [255, 0.98, 0.98, 0.98]],
                             opacity=[[0, 0.9999]], unit_length=thickness)

    # Cameras look down by more than 45 degrees: the slice is the sheet. Seen flatter, its rows are the sheets, and
    # each hides the next one.
    def draw_filters(self):
        """Figure 14: what keeps kernels of 2:1 and 4:1 from being smaller than pixels."""
        middle = 511.5
        fork = f"{1024 * FORKS[2][0]:.0f},{1024 * FORKS[2][1]:.0f}"
        views = {"minified": ("--orthographic", 960, "--eye", f"{middle},{middle},100", "--target",
                              f"{middle},{middle},0", "--up", "0,1,0"),
                 "perspective": ("--eye", f"{middle},-20,60", "--target", f"{middle},34,0", "--up", "0,0,1",
                                 "--fov", 80),
                 "magnified": ("--orthographic", 48, "--eye", f"{fork},100", "--target", f"{fork},0", "--up",
                               "0,1,0")}
        # Flat: a thick opaque slice seen at an angle shows its upper side, which is self-occlusion, no filter's doing.
        common = ("--size", "256x256", "--transfer", self.ink(FLAT), "--material", "unlit")
        splat = ("--engine", "volume-reference", "--attenuation", "exponential")
        filters = ("unfiltered", "uniform-scaling", "ewa")
        print("| kernels | view | cutoff |", " | ".join(filters), "|\n| --- | --- | --- | --- | --- | --- |")
        rows = {view: [] for view in views}
        for ratio in (2, 4):
            zebra = self.zebra(1024, 1024 // ratio, FLAT)
            for view, camera in views.items():
                name = f"zebra_{ratio}_{view}"
                self.render(zebra, f"{name}_truth.exr", "--engine", "volume-truth", "--truth", "kernels", "--samples",
                            36, *common, *camera)
                for cutoff in (9, 4):
                    for filter_name in filters:
                        self.render(zebra, f"{name}_{filter_name}_{cutoff}.exr", *splat, "--filter", filter_name,
                                    "--cutoff", cutoff, *common, *camera)
                    errors = [self.error(f"{name}_{f}_{cutoff}.exr", f"{name}_truth.exr") for f in filters]
                    print(f"| {ratio}:1 | {view} | {cutoff} |", " | ".join(errors), "|", flush=True)
                rows[view] += [self.png(f"{name}_{f}_9.exr") for f in filters] + [self.png(f"{name}_truth.exr")]
        self.montage("volume_zebra", rows["minified"] + rows["perspective"], 4, "256x256", 80)
        self.montage("volume_zebra_close", rows["magnified"], 4, "128x128")

    def draw_kernels(self):
        """Figure 15: kernels of a volume, and the same kernels flattened into a surface's."""
        camera = ("--eye", "255.5,-20,60", "--target", "255.5,34,0", "--up", "0,0,1", "--fov", 80, "--size", "512x320",
                  "--material", "unlit")
        splat = ("--engine", "volume-reference", "--cutoff", 9, "--attenuation", "exponential")
        truth = ("--engine", "volume-truth", "--truth", "kernels", "--samples", 16)
        for name, thickness in (("volume", 1.0), ("surface", FLAT)):
            texture = (self.zebra(512, 512, thickness), "--transfer", self.ink(thickness))
            for kind, engine in (("splat", splat), ("truth", truth)):
                self.render(texture[0], f"plane_{name}_{kind}.exr", *texture[1:], *engine, *camera)
        print("| kernels | to the truth of the texture on its plane | to the truth of the same kernels |")
        print("| --- | --- | --- |")
        for name in ("volume", "surface"):
            print(f"| {name} |", self.error(f"plane_{name}_splat.exr", "plane_surface_truth.exr"), "|",
                  self.error(f"plane_{name}_splat.exr", f"plane_{name}_truth.exr"), "|", flush=True)
        self.montage("volume_plane", [self.png(f"plane_{n}.exr") for n in
                                      ("volume_splat", "surface_splat", "volume_truth", "surface_truth")], 2, "512x320")

    def draw_inside(self):
        """Figure 16: flattened iso-surfaces inside translucent volumes; and an iso-surface without flat kernels."""
        skin = ([-600, 0.9, 0.68, 0.55], [60, 0.85, 0.55, 0.45])
        scenes = {
            "engine": (("engine.nii.gz",), 175, ("--orbit", "35,25"),
                       dict(colour=[[40, 0.45, 0.6, 0.75], [150, 0.45, 0.6, 0.75], [175, 0.95, 0.85, 0.6]],
                            opacity=[[40, 0], [70, 0.08], [255, 0.08]],
                            gradient_opacity=[[0, 0.05], [10, 0.15], [40, 1]])),
            "cranium": (("cranium_ct.nrrd",), 300, ("--orbit", "150,10"),
                        dict(colour=[*skin, [250, 0.95, 0.91, 0.82]],
                             opacity=[[-500, 0], [-250, 0.1], [60, 0.03], [150, 0.02]],
                             gradient_opacity=[[0, 0.1], [60, 0.3], [250, 1]])),
            "head": (("head256x256x109.zip", "--raw", "256x256x109:u8:1,1,2"), 100,
                     ("--up", "0,-1,0", "--orbit", "215,5"),
                     dict(colour=[[20, 0.9, 0.68, 0.55], [60, 0.85, 0.55, 0.45], [95, 0.95, 0.91, 0.82]],
                          opacity=[[15, 0], [35, 0.1], [60, 0.05], [85, 0.03]],
                          gradient_opacity=[[0, 0.1], [3, 0.3], [15, 1]]))}
        print("| volume | iso | translucent and iso-surface | only the iso-surface |\n| --- | --- | --- | --- |")
        images = []
        for name, (source, iso, camera, function) in scenes.items():
            scene = (self.data / "volumes" / source[0], *source[1:], "--size", "360x360", "--iso", iso, *camera)
            errors = []
            for kind, transfer in (("inside", self.transfer(f"inside_{name}", **function)), ("only", "none")):
                image, truth = f"{kind}_{name}.exr", f"{kind}_{name}_truth.exr"
                self.render(scene[0], image, *scene[1:], "--engine", "volume-reference", "--transfer", transfer)
                # One ray a pixel: a voxel is wider than a pixel.
                self.render(scene[0], truth, *scene[1:], "--engine", "volume-truth", "--truth", "field", "--transfer",
                            transfer)
                errors.append(self.error(image, truth))
            print(f"| {name} | {iso} |", " | ".join(errors), "|", flush=True)
            images += [f"inside_{name}.exr", f"inside_{name}_truth.exr"]
        self.montage("volume_inside", [self.png(i) for i in images[0::2] + images[1::2]], 3, "360x360", 80)

    def draw_surfaces(self):
        """Figure 17 and Table I: the engine `ewa` on a face, a terrain and a semi-transparent body."""
        terrain = self.work / "terrain.obj"
        run(sys.executable, ROOT / "scripts" / "terrain_obj.py", self.data / "terrain" / "vtkjs_dem.csv",
            self.data / "terrain" / "vtkjs_dem.jpg", terrain)
        scenes = {
            "face": (self.data / "textured" / "james" / "james.obj", ("--texels-per-cell", 1, "--spacing", 0.45),
                     ("--material", "unlit", "--orbit", "20,5")),
            "terrain": (terrain, ("--texels-per-cell", 1, "--spacing", 0.0039),
                        ("--material", "unlit", "--orbit", "30,35", "--zoom", 1.6)),
            "dragon": (self.data / "scans" / "dragon" / "dragon_vrip.ply.gz", (),
                       ("--opacity", 0.5, "--background", "1,1,1", "--orbit", "20,10"))}
        print("| model | samples | 256x256, ms | 512x512, ms | 512x512, to rays to the mesh |")
        print("| --- | --- | --- | --- | --- |")
        for name, (mesh, conversion, options) in scenes.items():
            patches = self.work / f"{name}.relief"
            samples = json.loads(run(self.relief, "convert", mesh, "-o", patches, "--json", *conversion))["samples"]
            times = [self.render(patches, f"{name}_{side}.exr", "--engine", "ewa", "--frames", 3, "--size",
                                 f"{side}x{side}", *options)["frame_ms"] for side in (256, 512)]
            self.render(mesh, f"{name}_truth.exr", "--engine", "raytrace", "--samples", 16, "--size", "512x512", *options)
            print(f"| {name} | {samples} | {times[0]:.0f} | {times[1]:.0f} |",
                  self.error(f"{name}_512.exr", f"{name}_truth.exr"), "|", flush=True)
        self.montage("volume_surfaces", [self.png(f"{name}_512.exr") for name in scenes], 3, "400x400")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("relief")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("--only", default="zebra,kernels,inside,surfaces")
    parser.add_argument("--work", type=pathlib.Path, help="keeps all images there")
    arguments = parser.parse_args()
    parts = {"zebra": Figures.draw_filters, "kernels": Figures.draw_kernels,
             "inside": Figures.draw_inside, "surfaces": Figures.draw_surfaces}
    for name in arguments.only.split(","):
        if name not in parts:
            sys.exit(f"make_volume_figures.py: there is no figure {name}; take {', '.join(parts)}")
    with tempfile.TemporaryDirectory() as scratch:
        work = arguments.work or pathlib.Path(scratch)
        work.mkdir(parents=True, exist_ok=True)
        for name in arguments.only.split(","):
            print(f"\n{name}\n", flush=True)
            parts[name](Figures(arguments, work))


if __name__ == "__main__":
    main()
