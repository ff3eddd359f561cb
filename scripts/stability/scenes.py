"""The pictures of real scans, by every engine: what the other sections push starts here."""
import numpy as np

from stability.page import Section
from stability.pictures import ENGINES, Failed, camera, failure, shot
from stability.scans import write_ply

SCANS = {"Dragon": "scans/dragon/dragon_vrip_res4.ply.gz", "lion": "colour/lion_takanawa_rgb_normals.ply.gz",
         "vol_total": "georef/vol_total.laz"}


def views(report):
    """Yields (name, options) of cameras about a model, from its bounds."""
    low, high = np.array(report["bounds_min"]), np.array(report["bounds_max"])
    centre, size = (low + high) / 2, np.linalg.norm(high - low)
    yield "front", ["--orbit=20,10"]
    yield "inside", camera(centre, centre + [1.0, 0.1, 0.2], (0, 0, 1))
    yield "1e6 sizes away", camera(centre + 1e6 * size * np.array([0.3, -0.9, 0.3]), centre, (0, 0, 1))
    yield "175 degrees", ["--orbit=20,10", "--fov=175"]
    yield "grazing", ["--orbit=20,0.01"]


def readable(relief, scan):
    """Returns a scan that any build reads: LAZ needs LASzip, so laspy (PyPI, with lazrs) reads it, if it is there."""
    if scan.suffix != ".laz":
        return scan
    try:
        import laspy
    except ImportError:
        return scan
    points = laspy.read(scan)
    colours = np.stack([points.red, points.green, points.blue], axis=-1) // 256
    return write_ply(relief.path("from_laz.ply"), points.xyz, colours=colours.astype(np.uint8))


def measure(relief, _vertices, _triangles):
    section, rows = Section("Three scans, every engine"), []
    engines = list(ENGINES)
    for name, file in SCANS.items():
        scan = relief.data / file if relief.data else None
        if scan is None or not scan.exists():
            continue
        try:
            scan = readable(relief, scan)
            patches, _ = relief.convert(scan, "scene.relief")
        except Failed as error:
            rows.append([name, failure(error)])
            continue
        report = relief.parsed(relief.run("info", patches, "--json"), f"info {name}")
        for view, options in views(report):
            row = [f"{name}, {view}"]
            for engine in engines:
                try:
                    image = shot(relief, engine, patches, scan if name == "Dragon" else patches, *options, size="160x128")
                    row.append(f"{100 * image.coverage():.2f}")
                except Failed as error:
                    row.append(failure(error))
            rows.append(row)
    section.text("Covered share of the image in %. Every channel of every picture is finite; see the last section.",
                 "Large scans are drawn as their patches. `raytrace` is the truth: of the Dragon its triangles, else the patches.")
    section.table(["scan and camera", *engines], rows)
    return section
