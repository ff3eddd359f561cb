"""Judges images by the truth of the same view: holes, overhang, silhouette, normals, colours. Needs NumPy.

Pixels are judged where the truth is certain: those that it covers entirely, or not at all.
  holes       the truth covers the pixel, and the image does not, or shows what lies farther by more than a spacing
  overhang    the truth does not cover the pixel and the image does, or shows what is nearer by more than the tolerance
  silhouette  pixels whose coverage (alpha of 0.5) differs, over the length of the silhouette: its mean displacement, pixels
  near        within some pixels of an edge of the truth: where normals of neighbours differ by 20 degrees, or depths jump
  rms, p99    angle between normals, degrees, where both cover; near edges, and everywhere
  PSNR        of colour as a display shows it, all pixels, dB
The tolerance of depths is a share of the spacing; what the truth's own depth changes by within a pixel adds to both. Less
than a spacing farther is no hole: engines show a mean of what lies in a range of depths.
"""
import math

import numpy as np

from read_exr import displayed, read_exr

EDGE_DEGREES = 20.0


def neighbours(values):
    """The 3x3 neighbourhoods of an image, as an array of nine images; borders are repeated."""
    pad = np.pad(values, [(1, 1), (1, 1)] + [(0, 0)] * (values.ndim - 2), mode="edge")
    h, w = values.shape[:2]
    return np.stack([pad[y:y + h, x:x + w] for y in range(3) for x in range(3)])


def dilated(mask, steps):
    for _ in range(steps):
        mask = neighbours(mask).any(axis=0)
    return mask


def unit_normals(image):
    normals = np.stack([image[f"N.{axis}"] for axis in "XYZ"], axis=-1).astype(float)
    return normals / np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-12)


class Truth:
    """What images of one view are judged by: rays to the mesh, several a pixel."""

    def __init__(self, path, spacing, tolerance=0.2, near=4):
        image = read_exr(path)
        self.alpha, self.depth = image["A"].astype(float), image["Z"].astype(float)
        self.normals, self.colours = unit_normals(image), displayed(image)
        seen = np.isfinite(self.depth)
        self.covered = (self.alpha >= 0.5) & seen
        around = neighbours(self.depth)
        low = np.where(np.isfinite(around), around, np.inf).min(axis=0)
        high = np.where(np.isfinite(around), around, -np.inf).max(axis=0)
        change = np.where(high > low, high - low, 0.0)
        # So wide about a jump of depths: which of two surfaces a pixel shows there is a matter of its centre.
        self.tolerance, self.farther = tolerance * spacing + change, spacing + change
        cosine = np.einsum("kijc,ijc->kij", neighbours(self.normals), self.normals).min(axis=0)
        turned = self.covered & (cosine < math.cos(math.radians(EDGE_DEGREES)))
        border = neighbours(self.covered).any(axis=0) & ~neighbours(self.covered).all(axis=0)
        self.near = dilated(turned | border | (change > 2.0 * spacing), near) & self.covered
        self.certain_in = (self.alpha > 0.999) & seen
        self.certain_out = self.alpha < 0.001
        self.silhouette = max(1.0, border.sum() / 2)  # a line's border has a pixel on each side


def judge(truth, path):
    """Returns the figures of one image, for summary(), and masks of its holes and overhang."""
    image = read_exr(path)
    depth = image["Z"].astype(float)
    covered = (image["A"] >= 0.5) & np.isfinite(depth)
    both = covered & truth.certain_in
    uncovered = truth.certain_in & ~covered
    holes = uncovered | (both & (depth > truth.depth + truth.farther))
    overhang = (truth.certain_out & covered) | (both & (depth < truth.depth - truth.tolerance))
    shared = covered & truth.covered
    angles = np.degrees(np.arccos(np.clip(np.sum(unit_normals(image) * truth.normals, axis=-1), -1, 1)))
    squares = (displayed(image) - truth.colours) ** 2
    sums = {"holes": holes.sum(), "uncovered": uncovered.sum(), "overhang": overhang.sum(),
            "differ": (covered != (truth.alpha >= 0.5)).sum(), "length": truth.silhouette, "covered": truth.covered.sum(),
            "squares": squares.sum(), "values": squares.size}
    return {"sums": sums, "near": angles[shared & truth.near], "all": angles[shared]}, (holes, overhang)


def summary(parts):
    """The figures of one or several images as one."""
    total = {key: sum(float(part["sums"][key]) for part in parts) for key in parts[0]["sums"]}
    found = {key: int(total[key]) for key in ("holes", "uncovered", "overhang", "covered")}
    found["silhouette_px"] = total["differ"] / total["length"]
    for key, name in (("near", "normal_{}_near_deg"), ("all", "normal_{}_deg")):
        angles = np.concatenate([part[key] for part in parts])
        found[name.format("rms")] = float(np.sqrt(np.mean(angles ** 2))) if len(angles) else None
        found[name.format("p99")] = float(np.percentile(angles, 99)) if len(angles) else None
    found["psnr_db"] = -10 * math.log10(max(total["squares"] / total["values"], 1e-12))
    return found
