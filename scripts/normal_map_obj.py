#!/usr/bin/env python3
"""Puts a procedural normal map on a mesh: writes OBJ, MTL and PNG.

    scripts/normal_map_obj.py out/studs.obj                       # a sphere
    scripts/normal_map_obj.py out/spot.obj --mesh spot.obj --image spot.png

--mesh: an OBJ file with texture coordinates that replaces the sphere. --image: its texture. --side: pixels
along each side of the normal map. --waves: number of waves along u (as many along v for a mesh, half as many
for the sphere, whose v is half as long). --steepest: largest slope.
"""
import argparse
import math
import pathlib
import shutil
import struct
import zlib


def write_png(path, width, rows):
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    data = b"".join(b"\0" + row for row in rows)
    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def normal_rows(width, height, waves_u, waves_v, steepest):
    """Of heights cos(a) cos(b) + cos(4 a) cos(4 b) / 8, where a and b count the waves; v upward."""
    def tables(count, waves):
        angles = [2 * math.pi * waves * (k + 0.5) / count for k in range(count)]
        return ([math.cos(a) for a in angles], [math.sin(a) for a in angles],
                [math.cos(4 * a) for a in angles], [math.sin(4 * a) for a in angles])

    cu, su, cu4, su4 = tables(width, waves_u)
    cv, sv, cv4, sv4 = (list(reversed(t)) for t in tables(height, waves_v))
    scale = steepest / 1.5  # 1 + 4 / 8 where both waves are steepest
    rows = []
    for j in range(height):
        row = bytearray()
        for i in range(width):
            x = scale * (su[i] * cv[j] + 0.5 * su4[i] * cv4[j])
            y = scale * (cu[i] * sv[j] + 0.5 * cu4[i] * sv4[j])
            by = 127.5 / math.sqrt(x * x + y * y + 1)
            row += bytes((round(127.5 + x * by), round(127.5 + y * by), round(127.5 + by)))
        rows.append(bytes(row))
    return rows


def sphere_lines(rings):
    columns = 2 * rings
    for j in range(rings + 1):
        for i in range(columns):
            t, p = math.pi * j / rings, 2 * math.pi * i / columns
            n = (math.sin(t) * math.sin(p), -math.cos(t), math.sin(t) * math.cos(p))
            yield "v {:.9g} {:.9g} {:.9g}".format(*n)
            yield "vn {:.9g} {:.9g} {:.9g}".format(*n)
    for j in range(rings + 1):
        for i in range(columns + 1):
            yield f"vt {i / columns:.9g} {j / rings:.9g}"
    for j in range(rings):
        for i in range(columns):
            corners = [(j, i), (j, i + 1), (j + 1, i + 1), (j + 1, i)]
            names = [(a * columns + b % columns + 1, a * (columns + 1) + b + 1) for a, b in corners]
            yield "f " + " ".join(f"{v}/{t}/{v}" for v, t in names)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--mesh", type=pathlib.Path)
    parser.add_argument("--image", type=pathlib.Path)
    parser.add_argument("--side", type=int, default=1024)
    parser.add_argument("--waves", type=int, default=32)
    parser.add_argument("--steepest", type=float, default=0.8)
    arguments = parser.parse_args()

    arguments.out.parent.mkdir(parents=True, exist_ok=True)
    half = 1 if arguments.mesh else 2
    normal_map = arguments.out.with_name(arguments.out.stem + "_normals.png")
    rows = normal_rows(arguments.side, arguments.side, arguments.waves, arguments.waves // half,
                       arguments.steepest)
    write_png(normal_map, arguments.side, rows)
    material = f"newmtl studs\nKd 0.7 0.7 0.7\nnorm {normal_map.name}\n"
    if arguments.image:
        shutil.copyfile(arguments.image, arguments.out.parent / arguments.image.name)
        material += f"map_Kd {arguments.image.name}\n"
    arguments.out.with_suffix(".mtl").write_text(material)
    lines = sphere_lines(64)
    if arguments.mesh:
        kept = ("v", "vt", "vn", "f")
        lines = (line for line in arguments.mesh.read_text().splitlines()
                 if line.split(" ", 1)[0] in kept)
    with open(arguments.out, "w") as out:
        out.write(f"mtllib {arguments.out.with_suffix('.mtl').name}\nusemtl studs\n")
        out.writelines(line + "\n" for line in lines)


main()
