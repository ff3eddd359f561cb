#!/usr/bin/env python3
"""A random flight over a file in a window of `relief view`: its memory, and its stills.

    scripts/viewer_flight.py build/release/cli/relief 60m.relief --minutes 10
    scripts/viewer_flight.py build/release/cli/relief 60m.relief --minutes 3 -- --gpu-memory 1G

A hand of real input events (Xvfb, xdotool) orbits, pans, zooms, flies and rests; the same seed makes
the same moves. Prints the process's memory minute by minute, its peak, and for each still how the
window differs from `relief render` of the same view: holes, pixels that differ, PSNR. Where they differ
a window with more memory shows whether the budget alone is the reason. The pictures of a still stay
in --work. Options after `--` are those of `relief view`.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import time

from virtual_display import VirtualDisplay, difference, read_png
from viewer_window import STATUS_HEIGHT, ViewerWindow

WINDOW = (1280, 800)
BACKGROUND = (64, 64, 64)  # of `relief render` and of the window
BACKGROUND_REACH = 2  # of 255
COLOUR_REACH = 8  # of 255: a surface of the background's colour is no hole
OUTLINE = 3  # pixels
SAME_DB = 60.0  # a few pixels that round otherwise
ROOM = ("--gpu-memory", "3G", "--memory", "2G")


def megabytes(pid, key):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith(key + ":"):
            return int(line.split()[1]) / 1024
    raise RuntimeError(f"/proc/{pid}/status has no {key}")


class Hand:
    """Moves the camera at random."""

    def __init__(self, window, rng):
        self.window, self.rng = window, rng
        self.width, self.height = window.picture_size()

    def place(self):
        return (self.rng.randrange(self.width // 4, 3 * self.width // 4),
                self.rng.randrange(self.height // 4, 3 * self.height // 4))

    def drag(self, button):
        start = self.place()
        end = [a + self.rng.randrange(-200, 201) for a in start]
        self.window.drag(start, (min(max(end[0], 5), self.width - 5), min(max(end[1], 5), self.height - 40)),
                         button, steps=40)

    def move(self):
        kind = self.rng.random()
        if kind < 0.1:
            self.window.key("Home")
        elif kind < 0.4:
            self.drag(1)
        elif kind < 0.5:
            self.drag(3)
        elif kind < 0.75:
            self.window.wheel(*self.place(), self.rng.randrange(3, 12))
        elif kind < 0.9:
            self.window.wheel(*self.place(), -self.rng.randrange(2, 8))
        else:
            self.window.act("keydown", "w", "sleep", 0.5 + self.rng.random(), "keyup", "w")


def open_window(arguments, words, work, display):
    """A window on a file, at rest."""
    window = ViewerWindow(display, arguments.relief, [arguments.file, *words], work, WINDOW)
    window.patience = 600.0  # a large --gpu-memory is filled first
    window.rest_seconds = 1.0  # on a busy machine tiles still arrived after 0.4 s of silence
    try:
        window.rest()
    except BaseException:
        window.close()
        raise
    return window


def fly(arguments, work, display):
    """Returns the stills' names with their cameras, and the picture's size."""
    window = open_window(arguments, arguments.options, work, display)
    memory, stills, moves = [], [], 0
    try:
        print(f"at rest {megabytes(window.process.pid, 'VmRSS'):.0f} MB, "
              f"peak {megabytes(window.process.pid, 'VmHWM'):.0f} MB while the first view was read", flush=True)
        hand = Hand(window, random.Random(arguments.seed))
        begun, reported = time.monotonic(), 0
        while time.monotonic() - begun < 60.0 * arguments.minutes:
            hand.move()
            moves += 1
            memory.append(megabytes(window.process.pid, "VmRSS"))
            if moves % arguments.stills == 0:
                window.key("ctrl+b")
                name = work / f"still_{len(stills) + 1:02}"
                window.picture().save(f"{name}_window.png")
                stills.append(name)
            if time.monotonic() - begun >= 60.0 * (reported + 1):
                reported += 1
                print(f"minute {reported}: {moves} moves, at rest {min(memory):.0f} to {max(memory):.0f} MB, "
                      f"peak {megabytes(window.process.pid, 'VmHWM'):.0f} MB", flush=True)
                memory.clear()
        display.xdotool("key", "ctrl+q")
        code = window.end_of()
        if code != 0:
            raise RuntimeError(f"relief view ended with {code}: {window.said()}")
        # Each still has left a bookmark.
        return list(zip(stills, cameras_of(work) if stills else [], strict=True)), (hand.width, hand.height)
    finally:
        window.close()


def cameras_of(work):
    settings = json.loads((work / "config" / "relief" / "viewer.json").read_text())
    return settings["bookmarks"][0]["views"]


def camera_words(camera):
    words = ["--fov", str(camera["fov"])]
    for key in ("eye", "target", "up"):
        words += [f"--{key}", ",".join(repr(v) for v in camera[key])]
    return words


def render(arguments, camera, size, path, *words):
    subprocess.run([str(arguments.relief), "render", arguments.file, "-o", str(path), "--size",
                    f"{size[0]}x{size[1]}", *camera_words(camera), *words],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def pieces_of(pixels):
    """Sets of pixels that touch each other."""
    left = set(pixels)
    while left:
        piece, open_pixels = set(), [left.pop()]
        while open_pixels:
            x, y = open_pixels.pop()
            piece.add((x, y))
            beside = {(x + i, y + j) for i in (-1, 0, 1) for j in (-1, 0, 1)} & left
            left -= beside
            open_pixels += beside
        yield piece


def compare(shown, truth):
    """How the picture shown differs, in words, and its PSNR. Background amid what the truth covers is a hole, or belongs
    to an outline of a coarser surface if it reaches one of the truth's."""
    is_empty = lambda c: max(abs(a - b) for a, b in zip(c, BACKGROUND)) <= BACKGROUND_REACH
    squares, suspects = 0, []
    for k in range(0, len(truth.pixels), 3):
        a, b = shown.pixels[k:k + 3], truth.pixels[k:k + 3]
        if a == b:
            continue
        squares += sum((x - y) ** 2 for x, y in zip(a, b))
        if is_empty(a) and max(abs(x - y) for x, y in zip(a, b)) > COLOUR_REACH:
            suspects.append((k // 3 % truth.width, k // 3 // truth.width))

    def is_amid(x, y):
        return all(not is_empty(truth.at(min(max(x + i, 0), truth.width - 1), min(max(y + j, 0), truth.height - 1)))
                   for i in range(-OUTLINE, OUTLINE + 1) for j in range(-OUTLINE, OUTLINE + 1))

    holes, outlines = 0, 0
    for piece in pieces_of(suspects):
        amid = sum(is_amid(x, y) for x, y in piece)
        holes += amid if amid == len(piece) else 0
        outlines += amid if amid < len(piece) else 0
    psnr = math.inf if squares == 0 else 10 * math.log10(255 ** 2 * len(truth.pixels) / squares)
    return (f"holes {holes}, beside outlines {outlines}, {difference(shown, truth)[1]} of "
            f"{truth.width * truth.height} pixels differ, {psnr:.1f} dB"), psnr


def report(arguments, work, stills, size):
    """Compares each still with `relief render`, and where it is coarser what a window with room for all shows."""
    for name, camera in stills:
        render(arguments, camera, size, f"{name}_render.png")
        truth = read_png(f"{name}_render.png").crop(0, 0, size[0], size[1] - STATUS_HEIGHT)
        words, psnr = compare(read_png(f"{name}_window.png"), truth)
        print(f"{name.name}: {words}", flush=True)
        if psnr > SAME_DB:
            continue
        display = VirtualDisplay(work / "display")
        try:
            window = open_window(arguments, [*ROOM, *camera_words(camera)], work, display)
            try:
                window.picture().save(f"{name}_room.png")
            finally:
                window.close()
        finally:
            display.close()
        print(f"    with {' '.join(ROOM)}: {compare(read_png(f'{name}_room.png'), truth)[0]}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("relief", type=lambda text: pathlib.Path(text).resolve(), help="the built program")
    parser.add_argument("file", help="a patch file, better with tiles")
    parser.add_argument("--minutes", type=float, default=10.0, help="default 10")
    parser.add_argument("--stills", type=int, default=6, help="moves between stills (default 6)")
    parser.add_argument("--seed", type=int, default=1, help="default 1")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("viewer_flight"),
                        help="folder for pictures (default viewer_flight)")
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    arguments = parser.parse_args(sys.argv[1:end])
    arguments.options = sys.argv[end + 1:]
    arguments.work.mkdir(parents=True, exist_ok=True)
    work = arguments.work.resolve()
    display = VirtualDisplay(work / "display")
    try:
        stills, size = fly(arguments, work, display)
    finally:
        display.close()
    report(arguments, work, stills, size)
    return 0


if __name__ == "__main__":
    sys.exit(main())
