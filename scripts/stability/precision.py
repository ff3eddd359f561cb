"""Single against double precision: what OpenGL draws beside what the CPU computes, and what narrower numbers would cost."""
import numpy as np

from stability.moves import Body, in_scene
from stability.page import Section
from stability.pictures import ENGINES, numbers
from stability.scans import rotation, write_ply

METHODS = ["onepass", "onepass direct", "onepass sprite"]
# The same scene with other roundings.
SCALE, TURN = 1.1, ((1, 2, 3), 37)


def angles(one, other):
    """Returns the angles between two fields of vectors, degrees. By the sine: a cosine near 1 is blunt."""
    cross = np.linalg.norm(np.cross(one, other), axis=-1)
    return np.degrees(np.arctan2(cross, np.sum(one * other, axis=-1)))


def normals(image):
    return np.stack([image[f"N.{c}"] for c in "XYZ"], axis=-1).astype(float)


def errors(image, truth):
    """Returns {quantity: differences} where both see the same patch within half a cell of each other."""
    seen = (image["patch"] == truth["patch"]) & (image["patch"] > 0)
    apart = np.hypot(image["UV.U"] - truth["UV.U"], image["UV.V"] - truth["UV.V"])
    seen &= apart < 0.5
    colour = np.max([np.abs(image[c] - truth[c]) for c in "RGB"], axis=0)
    return {"depth, relative": np.abs(image["Z"][seen] / truth["Z"][seen] - 1),
            "grid coordinates, cells": apart[seen],
            "normal, degrees": angles(normals(image)[seen], normals(truth)[seen]),
            "colour, linear": colour[seen]}, int(seen.sum())


def roundings(one, other):
    """Returns {quantity: differences} of a picture and that of the scaled and turned scene, and the share of pixels in both."""
    seen = (one["A"] == 1) & (other["A"] == 1)
    covered = max(int(((one["A"] == 1) | (other["A"] == 1)).sum()), 1)
    if "patch" in one:
        seen &= one["patch"] == other["patch"]
    turned = normals(other) @ rotation(*TURN)
    found = {"depth, relative": np.abs(other["Z"][seen] / (SCALE * one["Z"][seen]) - 1),
             "normal, degrees": angles(normals(one)[seen], turned[seen]),
             "colour, linear": np.max([np.abs(one[c] - other[c]) for c in "RGB"], axis=0)[seen]}
    if "UV.U" in one:
        found["grid coordinates, cells"] = np.hypot(one["UV.U"] - other["UV.U"], one["UV.V"] - other["UV.V"])[seen]
    return found, int(seen.sum()) / covered


def row(name, values):
    return [name, f"{values.max():.2g}", f"{np.sqrt(np.mean(values ** 2)):.2g}"]


def narrow(image, spacing):
    """Returns rows: what half floats and 16-bit integers would cost in each channel of a picture."""
    seen = image["A"] == 1
    rows, z = [], image["Z"][seen].astype(float)
    half = np.abs(z.astype(np.float16).astype(float) - z)
    rows.append(["depth", "half float", f"{half.max() / spacing:.2g} spacings", "no: splats a spacing apart change order"])
    step = (z.max() - z.min()) / 65535
    rows.append(["depth", "16-bit integer over the model's range", f"{step / 2 / spacing:.2g} spacings",
                 "for this picture; the range of a scene is not bounded"])
    n = normals(image)[seen]
    turn = angles(n, n.astype(np.float16).astype(float))
    rows.append(["normal", "half float", f"{turn.max():.2g} degrees", "yes: files keep 0.5 degrees at best"])
    uv = np.stack([image["UV.U"][seen], image["UV.V"][seen]]).astype(float)
    error = np.abs(uv.astype(np.float16).astype(float) - uv).max()
    rows.append(["grid coordinates", "half float", f"{error:.2g} cells", "no: neighbouring texels are one cell apart or less"])
    rows.append(["grid coordinates", "16-bit integer over 16384 cells", "0.125 cells", "no: the same"])
    c = np.stack([image[k][seen] for k in "RGB"]).astype(float)
    error = np.abs(c.astype(np.float16).astype(float) - c).max()
    rows.append(["colour", "half float", f"{error:.2g}", "yes: half a step of an 8-bit image is 0.002"])
    return rows


def measure(relief, vertices, triangles):
    body, section = Body(vertices, triangles), Section("Single against double precision")
    scan = write_ply(relief.path("single.ply"), vertices, triangles)
    patches, report = relief.convert(scan, "single.relief")
    # A light from a fixed direction, and the finest level: the ray tracer draws that.
    options = ["--orbit=20,10", "--pixels-per-sample=0", f"--light={numbers((0.3, 0.4, 0.9))}"]
    truth = relief.render(patches, "--engine", "raytrace", "--orbit=20,10", options[2], size="640x512")
    rows = []
    for method in METHODS:
        image = relief.render(patches, *ENGINES[method], *options, size="640x512")
        found, count = errors(image, truth)
        rows += [[f"`{method}`", *row(name, values), count] for name, values in found.items()]
    section.text("What OpenGL draws in single precision, beside the ray tracer, which intersects the same patches on the CPU, at the "
                 "pixels where both see the same place. `direct` and `sprite` also differ by their method: the error is then theirs.")
    section.table(["engine", "quantity", "largest", "rms", "pixels"], rows)
    rows = []
    for engine in ENGINES:
        found, share = roundings(in_scene(relief, body, patches, engine=engine),
                                 in_scene(relief, body, patches, scale=SCALE, turn=TURN, engine=engine))
        rows += [[f"`{engine}`", name, f"{values.max():.2g}", f"{np.percentile(values, 99):.2g}",
                  f"{np.sqrt(np.mean(values ** 2)):.2g}", f"{100 * share:.2f}"] for name, values in found.items()]
    section.text(f"What rounding alone does: the picture of a scene, beside that of the scene {SCALE} times as large and turned by "
                 f"{TURN[1]} degrees, by a camera that moves with it. Every number is then another, and rounded otherwise; the picture "
                 "is the same but for that. `ewa` and `raytrace` compute in double precision; `surfel` draws other means (see the limits). "
                 "Of pixels that show the same patch in both, whose share is in the last column.")
    section.table(["engine", "quantity", "largest", "99 % below", "rms", "pixels, %"], rows)
    section.text("What narrower numbers would cost in this picture:")
    section.table(["channel", "type", "largest error", "would it do?"], narrow(truth, report["spacing"]))
    return section
