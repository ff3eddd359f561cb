"""Points that hardly are a surface: degenerate, uneven, noisy, with outliers, thin, sharp, with wrong normals."""
import numpy as np

from stability.page import Section
from stability.pictures import Failed, failure
from stability.scans import sphere, square, write_ply

SEED = 20261126


def read_samples(path):
    """Returns positions and normals of a PLY file that `relief export` wrote."""
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    kinds = {"double": "<f8", "float": "<f4", "uchar": "u1", "ushort": "<u2"}
    lines = [line.split() for line in head.decode().splitlines()]
    count = next(int(line[2]) for line in lines if line[:2] == ["element", "vertex"])
    fields = [(line[2], kinds[line[1]]) for line in lines if line[0] == "property" and line[1] in kinds]
    rows = np.frombuffer(body, np.dtype(fields), count)
    return (np.stack([rows[c] for c in "xyz"], axis=-1).astype(float),
            np.stack([rows["n" + c] for c in "xyz"], axis=-1).astype(float))


def of_sphere(positions, normals, spacing):
    """Returns how far samples lie off the unit sphere, rms in spacings, and how many normals face inward, %."""
    radius = np.linalg.norm(positions, axis=1)
    inward = np.mean(np.sum(positions * normals, axis=1) < 0)
    return f"{np.sqrt(np.mean((radius - 1) ** 2)) / spacing:.3f}", f"{100 * inward:.1f}"


def rings(count, ratio, rng):
    """Returns points of the unit sphere in rings; points along a ring are `ratio` times as dense as rings."""
    lines = []
    for polar in np.pi * (np.arange(count) + 0.5) / count:
        points = max(3, round(2 * count * np.sin(polar) * ratio))
        turn = 2 * np.pi * (np.arange(points) + rng.random()) / points
        lines.append(np.stack([np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.full(points, np.cos(polar))], axis=-1))
    return np.concatenate(lines)


def spheres(rng):
    """Yields (name, points, normals or None, options) of the unit sphere of 10000 points."""
    count = 10000
    points = sphere(count)
    spacing = np.sqrt(4 * np.pi / count)
    yield "sphere", points, None, []
    for noise in (0.25, 0.5, 1.0, 2.0):
        yield f"noise of {noise:g} spacings", points + noise * spacing * rng.standard_normal(points.shape), None, []
    for percent in (1, 5, 20):
        some = rng.uniform(-1.5, 1.5, (count * percent // 100, 3))
        yield f"{percent} % outliers", np.concatenate([points, some]), None, []
    for ratio in (100, 10000):
        kept = rng.random(200000) < ratio ** -((1 - sphere(200000)[:, 2]) / 2)
        yield f"density 1 : {ratio}", sphere(200000)[kept], None, []
        yield f"density 1 : {ratio}, --even-spacing", sphere(200000)[kept], None, ["--even-spacing"]
    near = np.repeat(points, 10, axis=0) + 1e-12 * rng.standard_normal((10 * count, 3))
    yield "all points ten times", np.repeat(points, 10, axis=0), None, []
    yield "all points ten times, apart by rounding", near, None, []
    yield "the same, --thin 1e-6", near, None, ["--thin", "1e-6"]
    for noise in (0.1, 0.5):
        rays = np.repeat(points, 10, axis=0)
        yield (f"all points ten times, noise of {noise:g} spacings along the rays",
               rays * (1 + noise * spacing * rng.standard_normal((10 * count, 1))), None, [])
    for ratio in (5, 20):
        lines = rings(round(np.sqrt(count / ratio) * 0.89), ratio, rng)
        yield f"scan lines, density 1 : {ratio}", lines, None, []
        yield (f"scan lines, density 1 : {ratio}, noise of 0.2 lines",
               lines * (1 + 0.2 * spacing * np.sqrt(ratio) * rng.standard_normal((len(lines), 1))), None, [])
    yield "normals of zero", points, np.zeros_like(points), []
    yield "normals of NaN", points, np.full_like(points, np.nan), []
    yield "normals at random", points, rng.standard_normal(points.shape), []
    yield "normals at random, --normals outward", points, rng.standard_normal(points.shape), ["--normals", "outward"]
    yield "a tenth of the normals flipped", points, points * np.where(rng.random(count) < 0.1, -1, 1)[:, None], []
    yield "normals 1e30 long", points, points * 1e30, []


def others(rng):
    """Yields (name, points, options) of scans that are no sphere."""
    line = np.outer(np.arange(1000.0), [1, 2, 3])
    yield "a line", line, []
    yield "a line with 1e-9 noise", line + 1e-9 * rng.standard_normal(line.shape), []
    yield "a line with 0.01 noise", line + 0.01 * rng.standard_normal(line.shape), []
    yield "a plane, exact", square(50), []
    yield "one point ten thousand times", np.tile([[1.0, 2, 3]], (10000, 1)), []
    yield "a cloud without a surface", rng.random((5000, 3)), []
    for thickness in (1.0, 0.5, 0.1):
        sheet = square(60)
        yield f"a plate {thickness:g} spacings thick", np.concatenate([sheet, sheet + [0.5, 0.5, thickness]]), []
    angle, height = rng.uniform(0, 2 * np.pi, 8000), rng.random(8000)
    cone = np.stack([height ** 2 * np.cos(angle), height ** 2 * np.sin(angle), 1 - height], axis=-1)
    yield "a cusp", cone, []
    yield "with infinities and NaN", np.concatenate([sphere(5000), [[np.inf, 0, 0], [np.nan, 0, 0], [1e308, 0, 0]]]), []
    yield "one point at 1e12", np.concatenate([sphere(5000), [[1e12, 0, 0]]]), []


def convert(relief, points, normals, options):
    """Returns the cells that describe a conversion, and its samples."""
    scan = write_ply(relief.path("points.ply"), points, normals=normals)
    try:
        patches, report = relief.convert(scan, "points.relief", *options)
    except Failed as error:
        return [failure(error), "", "", "", "", "", ""], None, 0.0
    relief.run("export", patches, "-o", relief.path("samples.ply"))
    samples = read_samples(relief.path("samples.ply"))
    for name, values in zip(("position", "normal"), samples):
        if not np.isfinite(values).all():
            relief.not_finite.append((f"export of {patches}", name, int((~np.isfinite(values)).sum())))
    image = relief.render(patches)
    counts = [report["patches"], report["samples"], report["stray_points_removed"] + report["points_dropped"],
              report["normals_repaired"], report["uncovered_points"], report["fits_replaced"],
              f"{report['fit_condition']:.0e}"]
    return [*counts, f"{100 * image.coverage():.1f}"], samples, report["spacing"]


def measure(relief, _vertices, _triangles):
    rng, section, rows = np.random.default_rng(SEED), Section("Points, normals and orientation"), []
    head = ["scan", "patches", "samples", "points left out", "normals repaired", "points uncovered", "fits replaced", "largest condition",
            "share of the picture covered, %"]
    for name, points, normals, options in spheres(rng):
        cells, samples, _ = convert(relief, points, normals, options)
        spacing = np.sqrt(4 * np.pi / 10000)
        rows.append([name, *cells, *(of_sphere(*samples, spacing) if samples else ("", ""))])
    section.text("The unit sphere of 10,000 points. The distance of samples from the sphere is in its spacings; those of the uneven "
                 "scans lie on coarser points.")
    section.table([*head, "off the sphere, rms", "normals inward, %"], rows)
    rows = [[name, *convert(relief, points, None, options)[0]] for name, points, options in others(rng)]
    section.text("Other scans. One sentence is a refusal.")
    section.table(head, rows)
    return section
