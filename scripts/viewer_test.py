#!/usr/bin/env python3
"""Uses a window of `relief view` as a user does, and looks at what it shows.

    scripts/viewer_test.py build/dev/cli/relief                   # the test
    scripts/viewer_test.py build/release/cli/relief --measure dragon.relief lucy_50k.ply [--runs 5]

The test opens, orbits, zooms, changes materials, compares, drops files, resizes and quits by real
input events on a display of its own (Xvfb, xdotool), and judges the window by screenshots, which stay
in --work. Prints a line for each step, with times that nothing depends on. Exit code 77 where Xvfb or
xdotool is missing, except where CI is set: there it is a failure.

--measure prints a row for each file, medians of all runs: seconds from the start to the first picture
and to rest, frames a second and their times while the camera orbits for 5 s, and CPU at rest. Measure
on a machine that is otherwise idle.
"""
import argparse
import json
import math
import os
import pathlib
import random
import shutil
import statistics
import struct
import subprocess
import sys
import time

from virtual_display import VirtualDisplay, difference, read_png
from viewer_window import ViewerWindow

SKIPPED = 77
WINDOW = (960, 600)  # small: each picture is compared byte by byte
ROOT = pathlib.Path(__file__).resolve().parent.parent

# Names as the side panel lists them (viewer/choices/material_choices.cpp), and what `relief render` calls them.
MATERIALS = [("unlit", ["unlit"]), ("lit", ["lit"]), ("mirror", ["mirror"]),
             ("rough mirror", ["mirror", "--roughness", "0.3"]), ("glass", ["glass"]), ("split", ["split"])]
UNLIT, MIRROR = 0, 2

# The window draws a picture in bands, `relief render` at once: colours of equal fragments round apart by 1
# of 255, and a fragment on the edge of a triangle may fall to either side.
EDGE_PIXELS = 20

TREMBLE = 4  # viewer/input/reaction.cpp: pixels after which a press becomes a drag, which begins there


def write_ball(path, points, turns):
    """A bumpy ball in coloured blocks, binary PLY. `turns`: exchanges the colours' channels."""
    rng = random.Random(1)
    colours = [[rng.randrange(60, 256) for _ in range(3)] for _ in range(20 ** 3)]
    body = bytearray()
    for k in range(points):
        z = 1 - (2 * k + 1) / points
        angle = k * math.pi * (3 - math.sqrt(5))
        x, y = math.sqrt(1 - z * z) * math.cos(angle), math.sqrt(1 - z * z) * math.sin(angle)
        bump = 1 + 0.08 * math.sin(5 * x) * math.sin(5 * y) * math.sin(5 * z)
        block = (int(8 * x + 10) * 20 + int(8 * y + 10)) * 20 + int(8 * z + 10)
        colour = colours[block][turns:] + colours[block][:turns]
        body += struct.pack("<3f3B", bump * x, bump * y, 0.7 * bump * z, *colour)
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {points}\n"
    header += "".join(f"property float {c}\n" for c in "xyz")
    header += "".join(f"property uchar {c}\n" for c in ("red", "green", "blue")) + "end_header\n"
    path.write_bytes(header.encode() + bytes(body))


def write_cloud(path):
    """A soft ball of 24 nodes a side, from -1.6 to 1.6, NRRD."""
    side, step = 24, 3.2 / 23
    values = bytearray()
    for k in range(side ** 3):
        p = [-1.6 + step * (k // side ** a % side) for a in range(3)]
        values.append(max(0, round(255 * (1 - math.hypot(*p) / 1.5))))
    header = f"NRRD0004\ntype: uchar\ndimension: 3\nspace dimension: 3\nsizes: {side} {side} {side}\nencoding: raw\n"
    header += f"space directions: ({step},0,0) (0,{step},0) (0,0,{step})\nspace origin: (-1.6,-1.6,-1.6)\n"
    path.write_bytes((header + "\n").encode() + bytes(values))


def shift_of(before, after, x, y, expected, reach=12, half=28):
    """How far what is around a pixel of one picture has moved in another. What is around has several
    blocks, as one edge alone says nothing of a motion along it."""
    patch = before.crop(x - half, y - half, x + half + 1, y + half + 1).pixels

    def error(at):
        there = after.crop(x + at[0] - half, y + at[1] - half, x + at[0] + half + 1, y + at[1] + half + 1).pixels
        return sum(abs(p - q) for p, q in zip(patch[::3], there[::3]))

    return min(((expected[0] + i, expected[1] + j) for i in range(-reach, reach + 1, 2)
                for j in range(-reach, reach + 1, 2)), key=error)


def has_key(name):
    """Whether the window's list of keys (key ?) has one."""
    return f'{{"{name}"' in (ROOT / "viewer" / "panels" / "help.cpp").read_text()


class Test:
    def __init__(self, relief, work):
        self.relief, self.work = pathlib.Path(relief).resolve(), pathlib.Path(work)
        self.work.mkdir(parents=True, exist_ok=True)
        for old in list(self.work.glob("[0-9][0-9]_*.png")) + [self.work / "failed.png"]:
            old.unlink(missing_ok=True)
        self.model, self.other = self.work / "ball.relief", self.work / "other.relief"
        self.references = {}
        self.window = None
        self.shots = 0
        self.begun = time.monotonic()
        self.display = VirtualDisplay(self.work / "display")

    def close(self):
        if self.window:
            self.window.close()
        self.display.close()
        shutil.rmtree(self.work / "display", ignore_errors=True)

    def say(self, step, text):
        print(f"{time.monotonic() - self.begun:6.1f} s  {step:<10} {text}", flush=True)

    def check(self, holds, text):
        if not holds:
            raise AssertionError(text)

    def command(self, *words):
        done = subprocess.run([str(self.relief), *map(str, words)], capture_output=True, text=True, check=False,
                              timeout=120)
        if done.returncode != 0:
            raise RuntimeError(f"relief {words[0]}: {done.stderr.strip()}")

    def open(self, *arguments):
        if self.window:
            self.window.close()
        self.window = ViewerWindow(self.display, self.relief, arguments, self.work, WINDOW)
        self.window.rest()

    def shoot(self, name):
        """The picture, which also stays in a file."""
        picture = self.window.picture()
        self.shots += 1
        self.display.screenshot().save(self.work / f"{self.shots:02}_{name}.png")
        return picture

    def reference(self, material=UNLIT, model=None):
        """What `relief render` makes of the first view of a model."""
        model = model or self.model
        key = (material, model.read_bytes())
        if key not in self.references:
            path = self.work / "reference.png"
            width, height = self.window.picture_size()
            self.command("render", model, "-o", path, "--size", f"{width}x{height}", "--material",
                         *MATERIALS[material][1])
            self.references[key] = read_png(path)
        return self.references[key]

    def check_equal(self, picture, reference, what, left=0, right=None, top=0):
        """Compares a part of the picture; what the status bar hides is no part of it."""
        box = (left, top, picture.width if right is None else right, picture.height)
        most, far = difference(picture.crop(*box), reference.crop(*box))
        self.check(far <= EDGE_PIXELS, f"{what}: {far} pixels differ by more than 1 of 255, by {most} at most")
        return f"{far} pixels differ by more than 1 of 255, by {most} at most"

    # The steps, in their order. Each leaves the window as the next one expects it.

    def make_files(self):
        for path, turns in ((self.model, 0), (self.other, 1)):
            scan = path.with_suffix(".ply")
            write_ball(scan, 12000, turns)
            self.command("convert", scan, "-o", path)
        (self.work / "broken.ply").write_bytes((self.work / "ball.ply").read_bytes()[:5000])
        self.say("files", f"{self.model.stat().st_size} bytes")

    def no_display(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment["XDG_CONFIG_HOME"] = str(self.work / "config")
        done = subprocess.run([str(self.relief), "view", str(self.model)], env=environment, capture_output=True,
                              text=True, check=False, timeout=60)
        self.check(done.returncode == 1, f"without a display the exit code is {done.returncode}, not 1")
        lines = done.stderr.strip().split("\n")
        self.check(len(lines) == 1 and "relief render" in lines[0], f"without a display it says {lines}")
        self.say("no display", lines[0])

    def first_sight(self):
        self.open(self.model)
        picture = self.shoot("open")
        self.check(self.window.title() == "ball.relief - Relief", f"the title is {self.window.title()!r}")
        text = self.check_equal(picture, self.reference(), "the first picture and relief render")
        shown = next(f for f in self.window.frames() if f["kind"] != "empty")
        self.say("open", f"first picture after {shown['seconds'] - self.window.started:.2f} s; at rest {text}")

    def materials(self):
        for index in list(range(1, len(MATERIALS))) + [UNLIT]:
            name = MATERIALS[index][0]
            self.window.choose_material(index, len(MATERIALS))
            picture = self.shoot(name.replace(" ", "_"))
            text = self.check_equal(picture, self.reference(index), f"material {name} and relief render")
            self.say("material", f"{name}: {text}")

    def wipe(self):
        self.window.key("c")
        self.window.choose_material(MIRROR, len(MATERIALS))
        width, height = self.window.picture_size()
        # The divider, its handle, and labels of two lines at the top.
        gap, top = 16, 70
        before = width // 2
        for at in (width // 2, width // 5):
            if at != before:
                self.window.drag((before, height // 3), (at, height // 3))
            picture = self.shoot(f"wipe_{at}")
            self.check_equal(picture, self.reference(UNLIT), f"left of a divider at {at}", right=at - gap, top=top)
            self.check_equal(picture, self.reference(MIRROR), f"right of a divider at {at}", left=at + gap, top=top)
        self.window.key("c")
        self.check_equal(self.shoot("one_look"), self.reference(), "one look again")
        self.say("wipe", f"unlit | mirror at {width // 2} and {width // 5}")

    def orbit(self):
        before = self.reference()
        x, y = before.width // 2 - 20, before.height // 2 - 20
        log = len(self.window.frames())
        self.window.drag((x, y), (x + 70, y + 20), steps=40)
        frames = [f for f in self.window.frames()[log:] if f["kind"] == "moving"]
        after = self.shoot("orbit")
        _, far = difference(before.crop(0, 0, after.width, after.height), after)
        self.check(far > after.width * after.height // 10, f"orbiting changed only {far} pixels")
        shift = shift_of(before, after, x, y, (0, 0))
        # A turned patch matches within a few pixels of where it was.
        self.check(math.hypot(*shift) <= 4, f"the point under the cursor moved by {shift}")
        seconds = frames[-1]["seconds"] - frames[0]["seconds"]
        self.say("orbit", f"{len(frames) / seconds:.0f} frames a second, the slowest "
                          f"{max(f['ms'] for f in frames):.0f} ms; the point under the cursor moved by {shift}")

    def pan(self):
        before = self.shoot("before_pan")
        x, y = before.width // 2 - 20, before.height // 2 - 20
        self.window.drag((x, y), (x + 80, y - 60), button=3, steps=100)
        # 100 pixels, a pixel a step, of which the first ones only begin the drag.
        expected = [round(side * (100 - TREMBLE - 1) / 100) for side in (80, -60)]
        shift = shift_of(before, self.shoot("pan"), x, y, expected)
        # Pixels are searched in steps of 2, and the surface's parts move apart: they are not equally far.
        self.check(math.dist(shift, expected) <= 3, f"a drag by (80, -60) moved the surface by {shift}")
        self.say("pan", f"a drag by (80, -60) moved the surface by {shift}")

    def close_up(self):
        before = self.shoot("before_zoom")
        background = before.at(2, 2)
        x, y = before.width // 2, before.height // 2
        aside = (x - 60, y + 40)
        self.window.wheel(*aside, 1)
        shift = shift_of(before, self.shoot("one_step"), *aside, (0, 0))
        self.check(math.hypot(*shift) <= 3, f"zooming moved the point under the cursor by {shift}")
        self.window.wheel(x, y, 9)
        after = self.shoot("zoom")
        share = [p.share(lambda c: c == background) for p in (before, after)]
        self.check(share[1] < 0.5 * share[0], f"of the background {share[0]:.2f} were seen, now {share[1]:.2f}")
        middle = after.crop(after.width // 4, after.height // 4, 3 * after.width // 4, 3 * after.height // 4)
        holes = middle.share(lambda c: c == background or max(c) < 30)  # no colour of the ball is that dark
        self.check(holes == 0, f"in the middle of a close-up {holes:.2%} are background or black")
        self.window.wheel(x, y, 14)
        self.shoot("close_up")
        self.window.key("w")
        self.window.key("Home")
        text = self.check_equal(self.shoot("home"), self.reference(), "the first view again and relief render")
        self.say("zoom", f"the point under the cursor moved by {shift}; background {share[0]:.0%}, then "
                         f"{share[1]:.0%}; back at the first view {text}")

    def panels(self):
        """Hidden and back; the list of keys."""
        width, _ = self.window.size()
        self.window.key("Tab")
        whole = self.window.whole()
        self.check(whole.at(width - 4, 4) == whole.at(4, 4), "key Tab does not hide the side panel")
        self.window.key("Tab")
        self.window.key("question")
        with_keys = self.shoot("keys")
        _, far = difference(with_keys, self.reference().crop(0, 0, with_keys.width, with_keys.height))
        self.check(far > 20000, "key ? shows no list of keys")
        self.window.key("Escape")
        self.check_equal(self.shoot("no_keys"), self.reference(), "without the list of keys")
        self.say("panels", "hidden, shown; keys listed")

    def drop(self):
        self.window.drop([self.other])
        self.window.wait_until(lambda: self.window.title().startswith("other"), "the title of a dropped file")
        text = self.check_equal(self.shoot("drop"), self.reference(model=self.other), "a dropped patch file")
        self.say("drop", f"patch file: {text}")
        self.window.drop([self.work / "ball.ply"])
        self.window.wait_until(lambda: self.window.title().startswith("ball.ply"), "the title of a dropped scan")
        scan = self.shoot("drop_scan")
        # From its points, not from its patches: the view is about the same.
        share = scan.share(lambda c: c == scan.at(2, 2))
        self.check(0.1 < share < 0.7, f"background of a dropped scan: {share:.0%}")
        self.window.drop([self.model])
        self.window.wait_until(lambda: self.window.title().startswith("ball.relief"), "the title of the first file")
        self.check_equal(self.shoot("drop_again"), self.reference(), "the first file, dropped")
        self.say("drop", "scan, and the first file again")

    def drop_broken(self):
        self.window.drop([self.work / "broken.ply"])
        is_error = lambda c: c[0] > 240 and abs(c[1] - 140) < 12 and abs(c[2] - 115) < 12  # panels/messages.cpp
        message = lambda: self.display.screenshot().crop(0, 0, self.window.picture_size()[0], 90).share(is_error)
        self.window.wait_until(lambda: message() > 0.001, "a message about a broken file")
        picture = self.shoot("broken")
        self.check(self.window.title() == "ball.relief - Relief", f"the title is {self.window.title()!r}")
        self.check_equal(picture, self.reference(), "the picture below the message", top=100)
        self.window.click(self.window.picture_size()[0] // 2, 30)
        self.check_equal(self.shoot("no_message"), self.reference(), "after a click on the message")
        self.check(message() == 0.0, "a click on a message does not close it")
        self.say("broken", "a message, and the old picture stays")

    def resize(self):
        for size in ((500, 400), (1, 1), (1280, 800), WINDOW):
            self.window.resize(*size)
            if size[0] > 1:
                picture = self.shoot(f"{size[0]}x{size[1]}")
                share = picture.share(lambda c, corner=picture.at(2, 2): c == corner)
                self.check(0.02 < share < 0.9, f"at {size[0]}x{size[1]} {share:.0%} are background")
        text = self.check_equal(self.shoot("old_size"), self.reference(), "the old size again")
        self.say("resize", f"500x400, 1x1, 1280x800, and back: {text}")

    def minimise(self):
        self.window.minimise()
        self.window.rest()
        log, cpu = len(self.window.frames()), self.window.cpu_seconds()
        time.sleep(1.0)
        used = self.window.cpu_seconds() - cpu
        self.check(len(self.window.frames()) == log, "a minimised window draws")
        self.window.restore()
        text = self.check_equal(self.shoot("restored"), self.reference(), "a restored window")
        self.say("minimise", f"CPU {used:.0%}; restored: {text}")

    def change_file(self):
        before = self.window.frames()[-1]
        shutil.copy(self.other, self.work / "new")
        os.replace(self.work / "new", self.model)
        self.window.wait_until(lambda: self.window.frames()[-1] != before, "a new picture of a file that changed")
        text = self.check_equal(self.shoot("changed"), self.reference(), "a file that changed")
        self.say("changed", f"the new file: {text}")
        expected = self.reference()
        self.model.unlink()
        time.sleep(1.0)
        self.check_equal(self.shoot("deleted"), expected, "a file that was deleted", top=100)
        self.say("deleted", "the picture stays")

    def quit(self):
        cpu = self.window.cpu_seconds()
        time.sleep(2.0)
        used = (self.window.cpu_seconds() - cpu) / 2.0
        self.finish()
        self.say("quit", f"exit code 0; CPU at rest before {used:.1%}")

    def empty_window(self):
        self.open()
        picture = self.shoot("empty")
        share = picture.share(lambda c: c == picture.at(2, 2))
        self.check(share == 1.0, f"a window without a file has one colour on {share:.0%}")
        self.window.drop([self.other])
        self.window.wait_until(lambda: self.window.title().startswith("other"), "the title of a dropped file")
        self.check_equal(self.shoot("empty_drop"), self.reference(model=self.other), "a file in an empty window")
        self.window.interrupt()
        code = self.window.end_of()
        self.check(code == 0, f"Ctrl-C ends with {code}: {self.window.said()}")
        self.say("empty", "a file dropped; Ctrl-C: exit code 0")

    # In windows of their own: what they leave over the picture is nobody else's.

    def measure(self):
        """Two points and what lies between them."""
        self.open(self.other)
        self.window.key("m")
        x, y = (side // 2 for side in self.window.picture_size())
        self.window.click(x - 60, y)
        one = self.shoot("one_point")
        _, far = difference(one, self.reference(model=self.other).crop(0, 0, one.width, one.height))
        self.check(far > 20, "the first point of a measurement is not to be seen")
        self.window.click(x + 60, y + 20)
        _, far = difference(one, self.shoot("two_points"))
        # A line of 126 pixels, and what it measures.
        self.check(far > 120, "the second point of a measurement is not to be seen")
        self.finish()
        self.say("measure", f"the second point changes {far} pixels")

    def write_picture(self):
        self.open(self.other)
        self.reference(model=self.other)
        before = set(self.work.glob("*.png"))
        written = lambda: set(self.work.glob("*.png")) - before
        self.window.key("ctrl+s")
        self.window.wait_until(written, "a picture that is written beside the model")
        file = written().pop()
        picture, reference = read_png(file), self.reference(model=self.other)
        file.unlink()
        self.check(picture.pixels == reference.pixels, "a written picture is not to the byte that of relief render")
        self.finish()
        self.say("picture", "that of relief render, to the byte")

    def volume(self):
        """A volume around the ball: `relief render` draws the same with the same engine."""
        write_cloud(self.work / "cloud.nrrd")
        scene = self.work / "cloud.json"
        scene.write_text(json.dumps({"models": [{"file": "cloud.nrrd"}, {"file": self.other.name}],
                                     "engine": "volume", "views": [{"name": "all"}]}))
        self.open(scene)
        width, height = self.window.picture_size()
        path = self.work / "reference.png"
        self.command("render", scene, "-o", path, "--size", f"{width}x{height}")
        text = self.check_equal(self.shoot("volume"), read_png(path), "a scene with a volume and relief render")
        before = self.window.picture()
        self.window.drag((200, 300), (260, 320))
        _, far = difference(before, self.shoot("volume_turned"))
        self.check(far > 1000, "a scene with a volume does not turn")
        self.finish()
        self.say("volume", text)

    def finish(self):
        self.display.xdotool("key", "ctrl+q")
        code = self.window.end_of()
        self.check(code == 0, f"Ctrl+Q ends with {code}: {self.window.said()}")
        self.check(self.window.said() == "", f"the window said: {self.window.said()}")

    def run(self):
        self.make_files()
        self.no_display()
        self.first_sight()
        self.materials()
        self.wipe()
        self.orbit()
        self.pan()
        self.close_up()
        self.panels()
        self.drop()
        self.drop_broken()
        self.resize()
        self.minimise()
        self.change_file()
        self.quit()
        self.empty_window()
        self.volume()
        for key, step in (("M", self.measure), ("Ctrl + S", self.write_picture)):
            if has_key(key):
                step()
            else:
                self.say("not tested", f"the window's list of keys (viewer/panels/help.cpp) has no {key}")


def run_test(relief, work):
    test = Test(relief, work)
    try:
        test.run()
    except Exception as error:
        failed = test.work / "failed.png"
        test.display.screenshot().save(failed)
        print(f"FAILED: {error}\nScreenshots: {test.work}, the last one: {failed}", file=sys.stderr)
        if not isinstance(error, (AssertionError, RuntimeError)):
            raise
        return 1
    finally:
        test.close()
    print(f"passed in {time.monotonic() - test.begun:.0f} s; screenshots: {test.work}")
    return 0


def measure_once(relief, file, work):
    display = VirtualDisplay(work / "display")
    window = ViewerWindow(display, relief, [file], work, (1280, 800))
    try:
        window.patience = 600.0  # large files
        window.rest()
        frames = window.frames()
        first = next(f["seconds"] for f in frames if f["kind"] != "empty") - window.started
        rest = frames[-1]["seconds"] - window.started
        path = [(640 + 300 * math.sin(0.015 * k), 400 + 100 * math.sin(0.0105 * k)) for k in range(334)]
        log = len(frames)
        words = ["mousemove", 640, 400, "mousedown", 1]
        for x, y in path:
            words += ["sleep", 0.015, "mousemove", round(x), round(y)]
        display.xdotool(*words, "mouseup", 1)
        moving = [f for f in window.frames()[log:] if f["kind"] == "moving"]
        window.rest()
        cpu = window.cpu_seconds()
        time.sleep(4.0)
        idle = (window.cpu_seconds() - cpu) / 4.0
    finally:
        window.close()
        display.close()
        shutil.rmtree(work / "display", ignore_errors=True)
    times = sorted(f["ms"] for f in moving)
    gaps = [1000 * (b["seconds"] - a["seconds"]) for a, b in zip(moving, moving[1:])]
    return [first, rest, (len(moving) - 1) / (moving[-1]["seconds"] - moving[0]["seconds"]),
            statistics.median(times), times[-1], max(gaps), 100 * idle]


def measure(relief, files, runs, work):
    work.mkdir(parents=True, exist_ok=True)
    print("| file | first picture, s | at rest, s | frames a second | frame, ms | slowest, ms | longest gap, ms "
          "| CPU at rest, % |\n| --- " + "| ---: " * 7 + "|")
    for file in files:
        rows = [measure_once(relief, file, work) for _ in range(runs)]
        values = [statistics.median(column) for column in zip(*rows)]
        texts = [f"{v:.{digits}f}" for v, digits in zip(values, (2, 2, 0, 0, 0, 0, 1))]
        print(f"| {pathlib.Path(file).name} | " + " | ".join(texts) + " |", flush=True)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("relief", type=pathlib.Path, help="the built program")
    parser.add_argument("--work", type=pathlib.Path,
                        help="folder for what it writes (default: viewer_test in the build folder)")
    parser.add_argument("--measure", nargs="+", metavar="FILE", help="files to measure with, instead of the test")
    parser.add_argument("--runs", type=int, default=5, help="of --measure, for each file (default 5)")
    arguments = parser.parse_args()
    if not arguments.relief.is_file():
        parser.error(f"{arguments.relief}: there is no such file")
    missing = [name for name in ("Xvfb", "xdotool") if shutil.which(name) is None]
    if missing:
        print(f"{' and '.join(missing)} cannot be found: scripts/packages.sh window-test installs them")
        return 1 if "CI" in os.environ else SKIPPED
    work = arguments.work or arguments.relief.resolve().parent.parent / "viewer_test"
    if arguments.measure:
        return measure(arguments.relief.resolve(), arguments.measure, arguments.runs, work)
    return run_test(arguments.relief, work)


if __name__ == "__main__":
    sys.exit(main())
