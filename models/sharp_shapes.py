"""Closed shapes with sharp features, about two units wide, each as a list of faces. Needs NumPy.

SHAPES names what makes each; models/sharp_models.py says what each is for.
"""
import math

import numpy as np

from sharp_faces import STEPS, Flat, Turned


def circle(centre, radius, z, angles=(0.0, 2 * math.pi), steps=STEPS):
    """The corners of an arc, counter-clockwise from above; the last one is left out of a full circle."""
    full = angles[1] - angles[0] > 6.28
    angle = np.linspace(*angles, steps + 1)[:steps if full else None]
    return np.stack([centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle), np.full(len(angle), z)], axis=1)


def lathe(*profile, at=(0.0, 0.0), coarse=()):
    """The faces between corners of a profile from the axis to the axis; `coarse` names some by number."""
    return [Turned(pair, at, coarse=k in coarse) for k, pair in enumerate(zip(profile, profile[1:]))]


def box_faces(low, high):
    (a, b, c), (d, e, f) = low, high
    return [Flat([(a, b, c), (a, e, c), (d, e, c), (d, b, c)]),
            Flat([(a, b, f), (d, b, f), (d, e, f), (a, e, f)], coarse=True),
            Flat([(a, b, c), (d, b, c), (d, b, f), (a, b, f)]),
            Flat([(d, e, c), (a, e, c), (a, e, f), (d, e, f)]),
            Flat([(d, b, c), (d, e, c), (d, e, f), (d, b, f)], coarse=True),
            Flat([(a, e, c), (a, b, c), (a, b, f), (a, e, f)], coarse=True)]


def plate():
    """The peg stands in the left half and the hole in the right one; the top consists of two halves."""
    height, peg, hole = 0.4, (-0.45, 0.0), (0.45, 0.0)
    faces = [Turned([(0, 0), (1, 0)], coarse=True), Turned([(1, 0), (1, height)])]
    for centre, angles in ((peg, (math.pi / 2, 3 * math.pi / 2)), (hole, (-math.pi / 2, math.pi / 2))):
        faces.append(Flat(circle((0, 0), 1.0, height, angles, STEPS // 2), (*centre, height), hole=0.25, coarse=True))
    # The profile of the hole goes down: its outside is toward the axis.
    return faces + [Turned([(0.25, height), (0.25, height + 0.5)], peg),
                    Turned([(0.25, height + 0.5), (0, height + 0.5)], peg, coarse=True),
                    Turned([(0.25, height), (0.25, 0.12)], hole),
                    Turned([(0.25, 0.12), (0, 0.12)], hole, coarse=True)]


def pyramid(sides):
    base = circle((0, 0), 1.0, 0.0, steps=sides)
    apex = np.array([0.0, 0.0, 1.2])
    faces = [Flat(base[::-1], coarse=True)]
    return faces + [Flat([a, b, apex], coarse=k % 2 == 1) for k, (a, b) in enumerate(zip(base, np.roll(base, -1, axis=0)))]


def pit(sides):
    low, high, rim = (circle((0, 0), r, z, steps=sides) for r, z in ((1.0, 0.0), (1.0, 1.2), (0.8, 1.2)))
    apex = np.array([0.0, 0.0, 0.3])
    faces = [Flat(low[::-1])]
    for k in range(sides):
        m = (k + 1) % sides
        faces += [Flat([low[k], low[m], high[m], high[k]]), Flat([high[k], high[m], rim[m], rim[k]], coarse=True),
                  Flat([rim[k], rim[m], apex])]
    return faces


def saddle():
    """z = 0.8 + 0.5 (|x| - |y|) over a square: a valley along y, a ridge along x."""
    def up(x, y):
        return (x, y, 0.8 + 0.5 * (abs(x) - abs(y)))
    faces = [Flat([(-1, -1, 0), (-1, 1, 0), (1, 1, 0), (1, -1, 0)])]
    for k, (x, y) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        corners = [up(0, 0), up(x, 0), up(x, y), up(0, y)]
        faces.append(Flat(corners if x * y > 0 else corners[::-1], coarse=k % 2 == 1))
    for side in (1, -1):
        faces.append(Flat([(side, -side, 0), (side, side, 0), up(side, side), up(side, 0), up(side, -side)], coarse=True))
        faces.append(Flat([(side, side, 0), (-side, side, 0), up(-side, side), up(0, side), up(side, side)], (0, side, 0.15)))
    return faces


def steps():
    """Quarters of a square as high as 1.2, 0.8, 0.4 and 0.8: six faces meet in the middle."""
    h = {(1, 1): 1.2, (-1, 1): 0.8, (-1, -1): 0.4, (1, -1): 0.8}
    faces = [Flat([(-1, -1, 0), (-1, 1, 0), (1, 1, 0), (1, -1, 0)])]
    for (x, y), z in h.items():
        corners = [(0, 0, z), (x, 0, z), (x, y, z), (0, y, z)]
        faces.append(Flat(corners if x * y > 0 else corners[::-1], coarse=True))
    for y in (1, -1):  # walls across x
        low, high = h[-1, y], h[1, y]
        faces.append(Flat([(0, max(y, 0), low), (0, min(y, 0), low), (0, min(y, 0), high), (0, max(y, 0), high)]))
    for x in (1, -1):  # walls across y
        low, high = h[x, -1], h[x, 1]
        faces.append(Flat([(min(x, 0), 0, low), (max(x, 0), 0, low), (max(x, 0), 0, high), (min(x, 0), 0, high)]))
    for side in (1, -1):
        for other in (1, -1):
            z = h[side, other]
            a, b = (0, other) if side * other > 0 else (other, 0)
            faces.append(Flat([(side, a, 0), (side, b, 0), (side, b, z), (side, a, z)]))
            z = h[other, side]
            a, b = (other, 0) if side * other > 0 else (0, other)
            faces.append(Flat([(a, side, 0), (b, side, 0), (b, side, z), (a, side, z)]))
    return faces


def notch():
    """A cube of side 1.6 without the octant where all coordinates are large."""
    a, b, m = 0.0, 1.6, 0.8
    faces = [Flat([(a, a, a), (a, b, a), (b, b, a), (b, a, a)]), Flat([(a, a, a), (b, a, a), (b, a, b), (a, a, b)]),
             Flat([(a, b, a), (a, a, a), (a, a, b), (a, b, b)])]
    # Each of the other sides is an L, star-shaped about its inner corner's diagonal.
    for axes in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        def at(p, q, r):
            point = [0.0, 0.0, 0.0]
            for axis, value in zip(axes, (p, q, r)):
                point[axis] = value
            return point
        faces.append(Flat([at(b, a, a), at(b, b, a), at(b, b, m), at(b, m, m), at(b, m, b), at(b, a, b)], at(b, 0.5, 0.5),
                          coarse=True))
        faces.append(Flat([at(m, m, m), at(m, b, m), at(m, b, b), at(m, m, b)]))
    return faces


def wedge():
    """A prism whose edges along y have 30, 60 and 90 degrees."""
    a, b = (-1.0, 0.0), (1.0, 0.0)
    c = (0.5, math.sqrt(3) / 2)
    faces = []
    for k, (p, q) in enumerate(((a, b), (b, c), (c, a))):
        faces.append(Flat([(q[0], -0.8, q[1]), (p[0], -0.8, p[1]), (p[0], 0.8, p[1]), (q[0], 0.8, q[1])], coarse=k == 2))
    for y, corners in ((-0.8, (a, b, c)), (0.8, (b, a, c))):
        faces.append(Flat([(x, y, z) for x, z in corners]))
    return faces


def tower():
    """A foot, a shaft, a head with a hollow, and six merlons on its wall."""
    inner, outer, floor, low, high = 0.42, 0.62, 1.55, 1.7, 2.0
    faces = lathe((0, 0), (0.9, 0), (0.9, 0.22), (0.72, 0.22), (0.72, 0.38), (0.45, 0.38), (0.4, 1.25), (outer, 1.4),
                  (outer, low), coarse=(0,))
    faces += lathe((inner, low), (inner, floor), (0, floor))
    merlons = 6
    for k in range(merlons):
        a, b, c = (2 * math.pi * (k + share) / merlons for share in (0.0, 0.55, 1.0))
        faces += [Turned([(outer, low), (outer, high)], angles=(a, b)),
                  Turned([(outer, high), (inner, high)], angles=(a, b), coarse=True),
                  Turned([(inner, high), (inner, low)], angles=(a, b)),
                  Turned([(outer, low), (inner, low)], angles=(b, c), coarse=True)]
        for angle, side in ((a, 1), (b, -1)):
            c, d = math.cos(angle), math.sin(angle)
            corners = [(r * c, r * d, z) for r, z in ((inner, low), (outer, low), (outer, high), (inner, high))]
            faces.append(Flat(corners if side > 0 else corners[::-1]))
    return faces


def sphere():
    angle = np.linspace(-math.pi / 2, math.pi / 2, STEPS // 2 + 1)
    across = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    across[[0, -1], 0] = 0.0
    return [Turned(across + [0, 1], profile_normals=across)]


def torus():
    angle = np.linspace(-math.pi, math.pi, STEPS // 2 + 1)
    across = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return [Turned(0.35 * across + [0.75, 0.35], profile_normals=across)]


SHAPES = {
    "cube": lambda: box_faces((-0.8, -0.8, 0.0), (0.8, 0.8, 1.6)),
    "cylinder": lambda: lathe((0, 0), (0.8, 0), (0.8, 1.4), (0, 1.4), coarse=(0, 2)),
    "plate": plate,
    **{f"pyramid{k}": (lambda k=k: pyramid(k)) for k in (3, 4, 5)},
    **{f"pit{k}": (lambda k=k: pit(k)) for k in (3, 4, 5)},
    "saddle": saddle, "steps": steps, "notch": notch, "tower": tower, "wedge": wedge, "sphere": sphere, "torus": torus,
}
TEXTURED = ("sphere", "torus")
