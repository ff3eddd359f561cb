"""Runs `relief` and looks at what it makes: channels that are not finite, and differences of pictures."""
import json
import pathlib
import re
import subprocess
import time

import numpy as np

from read_exr import displayed, read_exr

# An identical picture has no finite PSNR; the pages show this instead.
SAME = np.inf


class Failed(Exception):
    """A command that did not end with exit code 0. `code` is negative for a signal."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code, self.message = code, message


class Relief:
    """The program, a folder to work in, and a list of every value that was not finite."""

    def __init__(self, program, folder):
        self.program, self.folder = pathlib.Path(program).resolve(), pathlib.Path(folder)
        self.not_finite = []  # (command, channel, count)
        self.pictures = 0
        self.values = 0

    def path(self, name):
        return self.folder / name

    def run(self, *words, timeout=300):
        """Returns standard output. Raises Failed otherwise."""
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True, timeout=timeout)
        if done.returncode != 0:
            raise Failed(done.returncode, done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "")
        return done.stdout

    def convert(self, scan, name="model.relief", *options):
        """Returns the path of the patch file and the report."""
        out = self.path(name)
        text = self.run("convert", scan, "-o", out, "--json", *options)
        return out, self.parsed(text, f"convert {scan}")

    def parsed(self, text, what):
        """Returns a report. JSON has no NaN; Python would read it."""
        report = json.loads(text, parse_constant=lambda name: self.not_finite.append((what, name, 1)))
        return report

    def render(self, scene, *options, size="320x256", samples="1"):
        """Returns the channels of a picture, with its report as `report` and wall time as `seconds`."""
        out, begin = self.path("picture.exr"), time.time()
        several = [] if samples is None else ["--samples", samples]
        # Alpha 0 then tells where nothing is seen, and depth may be infinite.
        words = ["render", scene, "-o", out, "--json", "--size", size, "--background", "none", *several, *options]
        report = self.parsed(self.run(*words), " ".join(map(str, words)))
        image = Picture(read_exr(out), report, time.time() - begin)
        self.look_at(image, " ".join(map(str, words[1:])))
        return image

    def look_at(self, image, what):
        """Notes every value that is not finite. Depth is infinite where nothing is seen, by definition."""
        self.pictures += 1
        for name, values in image.items():
            if values.dtype.kind != "f":
                continue
            self.values += values.size
            wrong = ~np.isfinite(values)
            if name == "Z":
                wrong &= ~(np.isposinf(values) & (image["A"] < 1))
            if wrong.any():
                self.not_finite.append((what, name, int(wrong.sum())))


class Picture(dict):
    """Channels by name."""

    def __init__(self, channels, report, seconds):
        super().__init__(channels)
        self.report, self.seconds = report, seconds

    def mirrored(self):
        """Returns the picture with left and right exchanged."""
        return Picture({name: values[:, ::-1] for name, values in self.items()}, self.report, self.seconds)

    def coverage(self):
        return float(self.report["covered_pixels"]) / self["R"].size


def psnr(one, other):
    """Returns 10 log10(1 / mean squared difference) of the displayed colours."""
    error = float(((displayed(one) - displayed(other)) ** 2).mean())
    return SAME if error == 0 else -10 * np.log10(error)


def decibels(value):
    return "same" if value == SAME else f"{value:.1f}"


def numbers(values):
    """Returns coordinates as an option has them, every digit."""
    return ",".join(repr(float(v)) for v in values)


def camera(eye, target, up=(0, 1, 0)):
    return [f"--eye={numbers(eye)}", f"--target={numbers(target)}", f"--up={numbers(up)}"]


def failure(error):
    """Returns in a few words how a command failed."""
    if error.code < 0:
        return f"signal {-error.code}"
    return re.sub(r"^relief: (\S*/)?", "", error.message)[:90]


# Every engine for surfaces, with the options that make variants of it. Engines that take points or
# triangles draw the scan itself.
ENGINES = {
    "onepass": [],
    "onepass direct": ["--interpolation", "direct", "--primitive", "quad"],
    "onepass sprite": ["--primitive", "sprite"],
    "multipass": ["--engine", "multipass"],
    "ewa": ["--engine", "ewa"],
    "surfel": ["--engine", "surfel"],
    "raytrace": ["--engine", "raytrace"],
}
OF_SCANS = ("ewa", "surfel", "raytrace")


def shot(relief, engine, patches, scan, *options, size="320x256"):
    """Renders with an engine what it draws best: patches, or the scan itself."""
    return relief.render(scan if engine in OF_SCANS else patches, *ENGINES[engine], *options, size=size,
                         samples=None if engine == "ewa" else "1")
