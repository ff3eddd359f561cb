#!/usr/bin/env python3
"""Picks by real clicks in a window of `relief view`, against the ray-traced surface and the scan's points.

    scripts/viewer_picks.py build/release/cli/relief lone-star.relief --points lone-star.las

In each of some random views a polyline is clicked (Xvfb, xdotool) and written as JSON: pixels anywhere on the
surface, then pixels whose neighbour lies at least 20 pixels behind them. A pick must lie where the picture's depth is,
as `relief render` draws it. It lies on something else behind that if it is farther by half of those 20 pixels and
by a spacing: at close quarters pixels are much smaller than the spacing, from afar much larger. Where the engine
`raytrace` sees the same surface, the pick's error is its distance from where the ray through the pixel's middle
meets that. Elsewhere, on trees and at outlines, the drawn level of detail is coarser than the ray tracer's. With
--points, also the distance from the plane of the eight nearest points, and how far these lie from it themselves.
Needs NumPy; --points needs SciPy and laspy.
"""
import argparse
import json
import pathlib
import random
import subprocess

import numpy

from read_exr import read_exr
from viewer_flight import Hand, camera_words, cameras_of, open_window, render
from viewer_window import STATUS_HEIGHT, middles_of
from virtual_display import VirtualDisplay

BUTTON = (64, 71, 82)  # viewer/window/gui.cpp: ImGuiCol_Button
BUTTON_MIDDLES = (276, 62)  # from the right: of the first and of the third button of a row
FAR = 20.0  # pixels: how far behind a pixel the neighbour beyond an edge lies
BEHIND = FAR / 2.0  # pixels
SAME = 0.1  # pixels along the ray between two pictures of one surface; coarser levels of detail are farther


class View:
    """A camera, and where the rays of its picture meet the surface."""

    def __init__(self, options, camera, size, work):
        self.eye = numpy.array(camera["eye"])
        ahead = numpy.array(camera["target"]) - self.eye
        self.ahead = ahead / numpy.linalg.norm(ahead)
        right = numpy.cross(self.ahead, camera["up"])
        self.right = right / numpy.linalg.norm(right)
        self.above = numpy.cross(self.right, self.ahead)
        self.size = size
        self.pixel = 2.0 * numpy.tan(numpy.radians(camera["fov"]) / 2.0) / size[1]  # at distance 1
        self.traced, self.drawn = (self.depths(options, camera, engine, work) for engine in ("raytrace", "onepass"))

    def depths(self, options, camera, engine, work):
        """Depths along the view axis; infinite where there is nothing."""
        path = work / "depth.exr"
        render(options, camera, self.size, path, "--engine", engine, "--outputs", "depth")
        depth = read_exr(path)["Z"].astype(float)
        depth[~(depth > 0.0)] = numpy.inf
        return depth

    def point(self, x, y):
        offset = self.right * (x + 0.5 - self.size[0] / 2.0) - self.above * (y + 0.5 - self.size[1] / 2.0)
        return self.eye + self.traced[y, x] * (self.ahead + self.pixel * offset)

    def depth_of(self, position):
        return (position - self.eye) @ self.ahead

    def pixel_of(self, position, pixels):
        """The pixel, among those that were clicked, in which a position is seen."""
        ray = (position - self.eye) / self.depth_of(position) / self.pixel
        place = numpy.array([ray @ self.right + self.size[0] / 2.0, self.size[1] / 2.0 - ray @ self.above]) - 0.5
        far = numpy.abs(numpy.array(pixels) - place).max(axis=1)
        return pixels[int(far.argmin())]

    def behind(self, positions, pixels, spacing):
        """How far positions lie behind what is drawn in their pixels: in pixels, and in spacings."""
        drawn = numpy.array([self.drawn[y, x] for x, y in pixels])
        far = numpy.array([self.depth_of(position) for position in positions]) - drawn
        return numpy.column_stack([far / (self.pixel * drawn), far / spacing])

    def edges(self):
        """Pixels with a neighbour far behind them, which may be nothing, as (x, y)."""
        inside = self.traced[1:-1, 1:-1]
        beyond = numpy.maximum.reduce([self.traced[:-2, 1:-1], self.traced[2:, 1:-1],
                                       self.traced[1:-1, :-2], self.traced[1:-1, 2:]])
        with numpy.errstate(invalid="ignore"):
            found = numpy.isfinite(inside) & (beyond - inside > FAR * self.pixel * inside)
        ys, xs = numpy.nonzero(found[:-STATUS_HEIGHT])
        return list(zip(xs + 1, ys + 1))

    def anywhere(self):
        ys, xs = numpy.nonzero(numpy.isfinite(self.traced[:-STATUS_HEIGHT]))
        return list(zip(xs, ys))


def click_button(window, place, row):
    """A button of the side panel, by its place in a row and the row's, -1 being the last."""
    width, _ = window.size()
    x = width - BUTTON_MIDDLES[place]
    # Beside the text in a button's middle.
    rows = middles_of(window.whole(), x - 45, BUTTON)
    window.click(x, rows[row])


def random_views(options, display, rng, work):
    """The first view and some that a hand leads to, and the picture's size."""
    window = open_window(options, [], work, display)
    try:
        hand = Hand(window, rng)
        for number in range(options.views):
            for _ in range(3 if number else 0):
                hand.move()
            window.key("ctrl+b")
        size = window.picture_size()
        display.xdotool("key", "ctrl+q")
        window.end_of()
        return cameras_of(work), size
    finally:
        window.close()


def clicked(options, display, camera, pixels, work):
    """The positions that clicks on pixels give, by way of the written JSON."""
    file = pathlib.Path(options.file).with_name(pathlib.Path(options.file).stem + "-measurements.json")
    file.unlink(missing_ok=True)
    window = open_window(options, camera_words(camera), work, display)
    try:
        window.key("m")
        click_button(window, 1, 0)  # Polyline
        for x, y in pixels:
            window.click(int(x), int(y))
            window.act("sleep", 0.4)  # else a double click, which ends the polyline
        window.key("Return")
        click_button(window, 0, -1)  # Write JSON
        window.wait_until(file.exists, f"that {file} is written")
    finally:
        window.close()
    points = json.loads(file.read_text())["measurements"][-1]["points"]
    return numpy.array([point["position"] for point in points])


def plane_distances(points, picks):
    """Distances of picks from the planes of the eight nearest points, and the planes' own residuals (rms)."""
    from scipy.spatial import cKDTree
    _, nearest = cKDTree(points).query(picks, 8)
    distances, residuals = [], []
    for pick, rows in zip(picks, nearest):
        middle = points[rows].mean(axis=0)
        near = points[rows] - middle
        normal = numpy.linalg.svd(near)[2][2]
        distances.append(abs((pick - middle) @ normal))
        residuals.append(numpy.sqrt(numpy.mean((near @ normal) ** 2)))
    return numpy.array(distances), numpy.array(residuals)


def spacing_of(options):
    words = [str(options.relief), "info", options.file, "--json"]
    return json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)["spacing"]


def summary(values):
    sizes = numpy.abs(values)
    return f"{numpy.median(sizes):.2g}, {numpy.percentile(sizes, 95):.2g}, {sizes.max():.2g}"


def report(options, picks, errors, behind, undrawn):
    """`behind`: of the picks where something is drawn, as View.behind() has it. `undrawn`: the number of others, at
    outlines. `picks`, `errors`: where both pictures show one surface."""
    pixels, spacings = behind.T
    print(f"{len(behind)} picks: {((pixels > BEHIND) & (spacings > 1.0)).sum()} lie on what is behind; median, p95 and "
          f"most of what is between picks and the picture: {summary(pixels)} pixels, {summary(spacings)} spacings")
    print(f"{undrawn} picks in pixels in whose middle nothing is drawn")
    print(f"{len(errors)} picks where the ray tracer sees the same surface: {numpy.median(errors):.2g} from it "
          f"(median), {numpy.percentile(errors, 95):.2g} (p95), {errors.max():.2g} at most")
    if not options.points:
        return
    import laspy
    las = laspy.read(options.points)
    distances, residuals = plane_distances(numpy.column_stack([las.x, las.y, las.z]), picks)
    print(f"these from the plane of the eight nearest points: {numpy.median(distances):.2g} median, "
          f"{numpy.percentile(distances, 95):.2g} p95; the points themselves {numpy.median(residuals):.2g} (rms); "
          f"the file's scale {las.header.scales.max():g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", type=pathlib.Path)
    parser.add_argument("file")
    parser.add_argument("--points", help="LAS file that FILE was made of")
    parser.add_argument("--views", type=int, default=6)
    parser.add_argument("--clicks", type=int, default=12,
                        help="clicks a view, on the surface, and as many at edges (default 12)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--work", type=pathlib.Path, default="picks")
    options = parser.parse_args()
    options.relief = options.relief.resolve()
    work = options.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    spacing = spacing_of(options)
    display = VirtualDisplay(work)
    rng = random.Random(options.seed)
    picks, errors, everywhere, undrawn = [], [], [], 0
    try:
        cameras, size = random_views(options, display, rng, work)
        for number, camera in enumerate(cameras):
            view = View(options, camera, size, work)
            for kind, candidates in (("surface", view.anywhere()), ("edge", view.edges())):
                pixels = rng.sample(candidates, min(options.clicks, len(candidates)))
                if len(pixels) < 2:
                    continue
                found = clicked(options, display, camera, pixels, work)
                hit = [view.pixel_of(position, pixels) for position in found]
                is_drawn = numpy.isfinite([view.drawn[y, x] for x, y in hit])
                behind = view.behind(found[is_drawn], [p for p, drawn in zip(hit, is_drawn) if drawn], spacing)
                undrawn += int((~is_drawn).sum())
                is_same = numpy.abs([view.drawn[y, x] / view.traced[y, x] - 1.0 for x, y in hit]) < SAME * view.pixel
                far = numpy.linalg.norm(found - [view.point(x, y) for x, y in hit], axis=1)[is_same]
                print(f"view {number + 1}, {kind}: {len(pixels)} clicks, {len(found)} picks; {behind[:, 0].min():.1f} "
                      f"to {behind[:, 0].max():.1f} pixels behind what is drawn", flush=True)
                everywhere += list(behind)
                errors += list(far)
                picks += list(found[is_same])
    finally:
        display.close()
    report(options, numpy.array(picks), numpy.array(errors), numpy.array(everywhere), undrawn)


if __name__ == "__main__":
    main()
