#!/usr/bin/env python3
"""A second reader of .relief files, written from docs/patch-file.md alone.

It shows that the page is enough to write one: ctest compares what it prints with what the C++ reader
made of the same file (tests/common/data). It needs nothing but Python and the zstd library, which
it calls by ctypes.

    read_patch_file.py FILE.relief [EXPECTED.txt]
"""

import ctypes
import ctypes.util
import math
import struct
import sys
import zlib

SKIPPED = 77  # as ctest's SKIP_RETURN_CODE
HOLE = None


def load_zstd():
    name = ctypes.util.find_library("zstd") or "libzstd.so.1"
    try:
        library = ctypes.CDLL(name)
    except OSError:
        print("the zstd library is not here")
        sys.exit(SKIPPED)
    library.ZSTD_getFrameContentSize.restype = ctypes.c_ulonglong
    library.ZSTD_decompress.restype = ctypes.c_size_t
    return library


ZSTD = load_zstd()


class Bytes:
    """Takes things from the front of a byte string."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, layout):
        values = struct.unpack_from("<" + layout, self.data, self.at)
        self.at += struct.calcsize("<" + layout)
        return values if len(values) > 1 else values[0]

    def frame(self):
        """A stream's decoded bytes; empty where its size is 0."""
        size = self.take("I")
        frame = self.data[self.at : self.at + size]
        self.at += size
        if not frame:
            return b""
        count = ZSTD.ZSTD_getFrameContentSize(frame, ctypes.c_size_t(size))
        out = ctypes.create_string_buffer(count)
        done = ZSTD.ZSTD_decompress(
            out, ctypes.c_size_t(count), frame, ctypes.c_size_t(size)
        )
        assert done == count, "a zstd frame is damaged"
        return out.raw

    def stream(self, count):
        return self.frame() or bytes(count)

    def residuals(self, count):
        low, high = self.stream(count), self.stream(count)
        assert len(low) == len(high) == count
        return [l | h << 8 for l, h in zip(low, high)]


def unzigzag(r):
    return -(r + 1) // 2 if r & 1 else r // 2


def decode_mask(data, width, height):
    runs, changes, state = iter(data.frame()), [], 0
    for byte in runs:
        length, shift = byte & 0x7F, 0
        while byte & 0x80:
            byte, shift = next(runs), shift + 7
            length |= (byte & 0x7F) << shift
        changes += [state] * length
        state ^= 1
    changes += [state] * (width * height - len(changes))
    for k in range(width, width * height):
        changes[k] ^= changes[k - width]
    return changes


def unpredict(residuals, kept, width, predict, wrap):
    """Values on a grid of which some are kept, from their residuals in scan order."""
    values, last = [0] * len(kept), 0
    residuals = iter(residuals)
    for k, is_kept in enumerate(kept):
        if not is_kept:
            continue
        i, j = k % width, k // width

        def at(inside, index):
            return values[index] if inside and kept[index] else None

        w, n = at(i > 0, k - 1), at(j > 0, k - width)
        nw = at(i > 0 and j > 0, k - width - 1)
        ne = at(j > 0 and i + 1 < width, k - width + 1)
        last = values[k] = wrap(predict(w, n, nw, ne, last) + unzigzag(next(residuals)))
    return values


def plane(w, n, nw, ne, last):
    if None not in (w, n, nw):
        return w + n - nw
    return next((v for v in (w, n, nw, ne) if v is not None), last)


def mean(w, n, nw, ne, last):
    if None not in (w, n):
        return int((w + n) / 2)  # toward zero
    return (w or 0) + (n or 0)


def wrap_unsigned(v):
    return v & 0xFFFF


def wrap_signed(v):
    return ((v + 0x8000) & 0xFFFF) - 0x8000


def wrap_byte(v):
    return v & 0xFF


def slope(heights, width, height, i, j, along_x):
    """Height indices per cell at a sample."""

    def at(step, beside):
        x, y = (i + step, j + beside) if along_x else (i + beside, j + step)
        inside = 0 <= x < width and 0 <= y < height
        return heights[y * width + x] if inside else HOLE

    total = weight = 0
    for beside, w in ((-1, 1), (0, 2), (1, 1)):
        low, high = at(-1, beside), at(1, beside)
        if low is not HOLE and high is not HOLE:
            total += w * (high - low)
            weight += 2 * w
    if weight:
        return total / weight
    here, low, high = at(0, 0), at(-1, 0), at(1, 0)
    if high is not HOLE:
        return high - here
    return here - low if low is not HOLE else 0


def normals_of_heights(patch, step):
    width, height, heights = patch["width"], patch["height"], patch["heights"]
    out = [(0, 0)] * len(heights)
    for k, h in enumerate(heights):
        if h is HOLE:
            continue
        x = slope(heights, width, height, k % width, k // width, True)
        y = slope(heights, width, height, k % width, k // width, False)
        length = (abs(x) + abs(y) + patch["spacing"] / patch["step"]) * step
        out[k] = tuple(math.floor(-s * 32767.0 / length + 0.5) for s in (x, y))
    return out


def kept_texels(patch, scale):
    width, height = patch["width"], patch["height"]
    kept = []
    for b in range(scale * (height - 1) + 1):
        for a in range(scale * (width - 1) + 1):
            columns = {a // scale, (a + scale - 1) // scale}
            rows = {b // scale, (b + scale - 1) // scale}
            nodes = (patch["heights"][y * width + x] for y in rows for x in columns)
            kept.append(int(any(h is not HOLE for h in nodes)))
    return kept


def continue_over_holes(texels, kept, width):
    """Ring by ring, each hole texel becomes the mean of its neighbours that have a value."""
    height = len(kept) // width
    known = {k for k, is_kept in enumerate(kept) if is_kept}

    def neighbours(k):
        i, j = k % width, k // width
        for y in range(max(j - 1, 0), min(j + 2, height)):
            for x in range(max(i - 1, 0), min(i + 2, width)):
                yield y * width + x

    while known:
        ring = {n for k in known for n in neighbours(k)} - known
        if not ring:
            break
        for k in ring:
            around = [texels[n] for n in neighbours(k) if n in known]
            count = len(around)
            texels[k] = tuple((2 * sum(c) + count) // (2 * count) for c in zip(*around))
        known |= ring


def decode_heights(data, patch, scale):
    width, height = patch["width"], patch["height"]
    mask = decode_mask(data, width, height)
    assert sum(mask) == patch["samples"]
    values = unpredict(
        data.residuals(sum(mask)), mask, width, plane, wrap_unsigned
    )
    patch["heights"] = [v if m else HOLE for v, m in zip(values, mask)]


def decode_normals(data, patch, scale):
    step, predictor = data.take("HB")
    kept = kept_texels(patch, scale)
    width, count = scale * (patch["width"] - 1) + 1, sum(kept)
    residuals = data.residuals(2 * count)
    bases = normals_of_heights(patch, step) if predictor == 1 else [(0, 0)] * len(kept)
    predict = mean if predictor == 1 else plane
    xs = unpredict(residuals[:count], kept, width, predict, wrap_signed)
    ys = unpredict(residuals[count:], kept, width, predict, wrap_signed)
    texels = [((x + b[0]) * step, (y + b[1]) * step) for x, y, b in zip(xs, ys, bases)]
    continue_over_holes(texels, kept, width)
    patch["normals"] = (scale, width, texels)


def decode_colours(data, patch, scale):
    kept = kept_texels(patch, scale)
    width, count = scale * (patch["width"] - 1) + 1, sum(kept)
    green, red, blue = (
        unpredict(data.stream(count), kept, width, plane, wrap_byte) for _ in range(3)
    )
    texels = [
        ((r + g) & 0xFF, g, (b + g) & 0xFF) for r, g, b in zip(red, green, blue)
    ]
    continue_over_holes(texels, kept, width)
    patch["colours"] = (scale, width, texels)


DECODERS = {b"HGHT": decode_heights, b"NRML": decode_normals, b"COLR": decode_colours}


def numbers(values):
    return " ".join("%.17g" % v for v in values)


def describe_map(name, patch):
    if name not in patch:
        return [name + " none"]
    scale, width, texels = patch[name]
    lines = ["%s scale %d size %d %d" % (name, scale, width, len(texels) // width)]
    for first in range(0, len(texels), width):
        row = texels[first : first + width]
        lines.append(" ".join(",".join(map(str, texel)) for texel in row))
    return lines


def describe(file):
    assert file[:8] == b"\x89RLF\r\n\x1a\n", "no .relief file"
    header = Bytes(file[:128])
    header.take("8s")
    version, header_bytes = header.take("II")
    assert version == 1 and header_bytes == 128
    file_bytes, index_offset, patches, chunks, samples = header.take("QQIIQ")
    spacing, *bounds = header.take("7d")
    radius, _ = header.take("dQ")
    index_sum, header_sum = header.take("II")
    assert header_sum == zlib.crc32(file[:124]) and file_bytes == len(file)
    assert index_sum == zlib.crc32(file[index_offset:])
    lines = ["spacing %.17g" % spacing, "bounds " + numbers(bounds), "radius %.17g" % radius]

    index = Bytes(file[index_offset:])
    patch_records = [index.take("14d3I2H2hf2I") for _ in range(patches)]
    chunk_records = [index.take("4sHHQII") for _ in range(chunks)]
    for record in patch_records:
        patch = dict(zip(("spacing", "step", "width", "height", "samples"), record[12:]))
        first, count = record[-2:]
        for kind, codec, scale, offset, size, checksum in chunk_records[first : first + count]:
            data = file[offset : offset + size]
            assert zlib.crc32(data) == checksum
            if kind in DECODERS:
                assert codec == 1
                DECODERS[kind](Bytes(data), patch, scale)
        width, heights = patch["width"], patch["heights"]
        lines += [
            "patch %d %d spacing %.17g step %.17g"
            % (width, patch["height"], patch["spacing"], patch["step"]),
            "origin " + numbers(record[:3]),
            "axes " + numbers(record[3:12]),
        ]
        for k in range(0, len(heights), width):
            row = heights[k : k + width]
            lines.append(" ".join("." if h is HOLE else str(h) for h in row))
        lines += describe_map("normals", patch) + describe_map("colours", patch)
    return "\n".join(lines) + "\n"


def main():
    with open(sys.argv[1], "rb") as file:
        text = describe(file.read())
    if len(sys.argv) < 3:
        sys.stdout.write(text)
        return
    with open(sys.argv[2], encoding="ascii") as file:
        expected = file.read()
    for number, (ours, theirs) in enumerate(
        zip(text.splitlines(), expected.splitlines()), 1
    ):
        if ours != theirs:
            sys.exit("line %d is\n%s\ninstead of\n%s" % (number, ours, theirs))
    if text != expected:
        sys.exit("one of the texts is longer")
    print("the same")


main()
