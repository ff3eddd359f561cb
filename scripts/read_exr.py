"""Reads the EXR images that `relief render` writes: scan lines, ZIP or none. Needs NumPy."""
import struct
import zlib

import numpy

MAGIC = 20000630
TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}
LINES = {0: 1, 2: 1, 3: 16}  # scan lines of a block, by compression: none, ZIPS, ZIP


def attributes(data):
    """Returns the header as {name: bytes}, and where it ends."""
    at, found = 8, {}
    while data[at] != 0:
        end = data.index(b"\0", at)
        name, at = data[at:end].decode(), data.index(b"\0", end + 1) + 1
        size = struct.unpack_from("<i", data, at)[0]
        found[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channels_of(data):
    """Returns (name, type) of each channel, in the file's order."""
    at, found = 0, []
    while data[at] != 0:
        end = data.index(b"\0", at)
        found.append((data[at:end].decode(), TYPES[struct.unpack_from("<i", data, end + 1)[0]]))
        at = end + 17
    return found


def inflated(block, size):
    """Undoes ZIP: zlib, differences, and halves that hold every second byte."""
    if len(block) == size:
        return block
    steps = numpy.frombuffer(zlib.decompress(block), numpy.uint8).copy()
    steps[1:] += numpy.uint8(128)  # a difference of d is stored as d + 128
    values = numpy.cumsum(steps, dtype=numpy.uint8)
    whole = numpy.empty(size, numpy.uint8)
    whole[0::2], whole[1::2] = values[:(size + 1) // 2], values[(size + 1) // 2:]
    return whole.tobytes()


def read_exr(path):
    """Returns {channel: array of height x width}, float32 or uint32."""
    with open(path, "rb") as file:
        data = file.read()
    if struct.unpack_from("<i", data)[0] != MAGIC:
        raise ValueError(f"{path}: is no EXR image")
    header, at = attributes(data)
    compression = header["compression"][0]
    if compression not in LINES:
        raise ValueError(f"{path}: has compression {compression}; only none and ZIP are read")
    left, low, right, high = struct.unpack("<4i", header["dataWindow"])
    width, height = right - left + 1, high - low + 1
    channels = channels_of(header["channels"])
    row_bytes = width * sum(kind.itemsize for _, kind in channels)
    image = {name: numpy.empty((height, width), kind if kind.kind == "u" else numpy.float32) for name, kind in channels}
    blocks = -(-height // LINES[compression])
    for offset in struct.unpack_from(f"<{blocks}Q", data, at):
        y, size = struct.unpack_from("<2i", data, offset)
        first, rows = y - low, min(LINES[compression], high + 1 - y)
        block = inflated(data[offset + 8:offset + 8 + size], rows * row_bytes)
        place = 0
        for row in range(first, first + rows):
            for name, kind in channels:
                image[name][row] = numpy.frombuffer(block, kind, width, place)
                place += width * kind.itemsize
    return image


def displayed(image, paper=0.0):
    """Colours as a display shows them, sRGB in [0, 1], height x width x 3, over a linear grey where alpha is below 1."""
    linear = numpy.nan_to_num(numpy.stack([image[c] for c in "RGB"], axis=-1).astype(float))
    linear = numpy.clip(linear + (1 - numpy.clip(image["A"], 0, 1))[..., None] * paper, 0, 1)
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
