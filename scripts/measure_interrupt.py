#!/usr/bin/env python3
"""Measures how long `relief` goes on after Ctrl-C, in every stage of its subcommands.

    scripts/measure_interrupt.py build/release/cli/relief                    # 100 interrupts, seed 1
    scripts/measure_interrupt.py build/release/cli/relief --times 10 --only tiles,ewa --max-seconds 5

Makes its own scans. Runs each job once undisturbed, or for at most 40 s, then interrupts it at
moments drawn from that time, and looks after each that the exit code is 1 (or 0, if it was done
already) and that no file is left but what the command promises: finished tiles of --memory and
finished images of a scene. Prints a row a job: the longest time until the message and until the
exit and the median of the latter, in seconds, how many interrupts were seen by the job itself (less
than 0.3 s), and in which stage the longest was. Exit code 1 if a file is left, an exit code is
wrong, or --max-seconds is exceeded by an exit.

Measure on a machine that is otherwise idle: Mesa's thread for its shader cache has the lowest
priority, so that a process that has said its last message ends only when others leave it a moment.
"""
import argparse
import math
import os
import pathlib
import pty
import random
import re
import select
import shutil
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import zlib

GRACE = 0.3  # cli/interrupt.h: then a job that has not seen the interrupt is ended
LONGEST_RUN = 40.0


def write_points(path, count, noise, seed):
    """A bumpy torus of bare points, binary PLY."""
    rng = random.Random(seed)
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\n"
    header += "".join(f"property float {c}\n" for c in "xyz") + "end_header\n"
    body = bytearray()
    for _ in range(count):
        u, v = rng.uniform(0, math.tau), rng.uniform(0, math.tau)
        r = 1.0 + 0.05 * math.sin(9 * u) * math.sin(7 * v) + rng.gauss(0.0, noise)
        body += struct.pack("<3f", (3 + r * math.cos(v)) * math.cos(u), (3 + r * math.cos(v)) * math.sin(u),
                            r * math.sin(v))
    path.write_bytes(header.encode() + body)


def write_mesh(path, side):
    """The same torus as a mesh with texture coordinates, OBJ."""
    with path.open("w") as out:
        for j in range(side + 1):
            for i in range(side + 1):
                out.write(f"vt {i / side:.6f} {j / side:.6f}\n")
        for j in range(side):
            for i in range(side):
                u, v = math.tau * i / side, math.tau * j / side
                r = 1.0 + 0.05 * math.sin(9 * u) * math.sin(7 * v)
                out.write(f"v {(3 + r * math.cos(v)) * math.cos(u):.6f} {(3 + r * math.cos(v)) * math.sin(u):.6f} "
                          f"{r * math.sin(v):.6f}\n")
        for j in range(side):
            for i in range(side):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                out.write("f " + " ".join(f"{1 + a % side + side * (b % side)}/{1 + a + (side + 1) * b}"
                                          for a, b in corners) + "\n")


def write_stack(path, count):
    """Quads on each other, with texture coordinates."""
    with path.open("w") as out:
        out.write("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n")
        for k in range(count):
            out.write("".join(f"v {x} {y} {k * 1e-6:.6f}\n" for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)]))
            out.write("f " + " ".join(f"{4 * k + c}/{c}" for c in range(1, 5)) + "\n")


def write_png(path, side):
    rows = b"".join(b"\0" + bytes(((x ^ y) * c) & 255 for x in range(side) for c in (1, 3, 7)) for y in range(side))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", side, side, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


class Job:
    def __init__(self, name, words, kept=()):
        self.name, self.words, self.kept = name, words, kept


def jobs(data, quick):
    """Every subcommand, and every kind of input and engine. OUT stands for the output's folder."""
    mesh, noisy, large, png = data / "mesh.obj", data / "noisy.ply", data / "large.ply", data / "texture.png"
    stack, patches, view = data / "stack.obj", data / "mesh.relief", ["--orbit", "30,20"]
    scene = data / "scene.json"
    big = "3000x3000" if quick else "8192x8192"
    return [
        Job("convert mesh", ["convert", mesh, "-o", "OUT/a.relief"]),
        Job("convert noisy", ["convert", noisy, "-o", "OUT/a.relief"]),
        Job("convert compact", ["convert", noisy, "-o", "OUT/a.relief", "--codec", "compact", "--noise", "0"]),
        Job("convert tiles", ["convert", large, "-o", "OUT/a.relief", "--memory", "256M"], ["a.relief.parts"]),
        Job("convert clean", ["convert", noisy, "-o", "OUT/a.relief", "--clean", "--thin", "0.005"]),
        Job("convert textured", ["convert", mesh, "-o", "OUT/a.relief", "--texture", png]),
        Job("convert stack", ["convert", stack, "-o", "OUT/a.relief", "--texture", png]),
        Job("convert error", ["convert", mesh, "-o", "OUT/a.relief", "--error", "0.0005"]),
        Job("convert gz", ["convert", data / "noisy.ply.gz", "-o", "OUT/a.relief"]),
        Job("render scan", ["render", noisy, "-o", "OUT/a.png", *view]),
        Job("render large", ["render", patches, "-o", "OUT/a.png", "--size", big, "--samples", "16", *view]),
        Job("render large exr", ["render", patches, "-o", "OUT/a.exr", "--size", big, *view]),
        Job("render multipass", ["render", patches, "-o", "OUT/a.png", "--engine", "multipass", "--size", big, *view]),
        Job("render mirror", ["render", patches, "-o", "OUT/a.png", "--material", "mirror", "--roughness", "0.3", *view]),
        Job("render glass", ["render", patches, "-o", "OUT/a.png", "--material", "glass", "--opacity", "0.5", "--samples",
                             "16", "--size", "2048x2048", *view]),
        Job("render ewa", ["render", noisy, "-o", "OUT/a.png", "--engine", "ewa", "--size", "2048x2048", *view]),
        Job("render ewa texture", ["render", mesh, "-o", "OUT/a.png", "--engine", "ewa", "--texture", png, *view]),
        Job("render raytrace", ["render", mesh, "-o", "OUT/a.png", "--engine", "raytrace", "--samples", "64", *view]),
        Job("render scene", ["render", scene, "-o", "OUT/{view}.png"], ["a.png", "b.png", "c.png", "d.png"]),
        Job("export", ["export", patches, "-o", "OUT/a.glb"]),
        Job("bench", ["bench", patches, "--frames", "5", "--plot", "OUT/a.svg"]),
        Job("compare", ["compare", data / "one.exr", data / "two.exr", "--heatmap", "OUT/a.png"]),
        Job("info", ["info", patches, "--verify"]),
    ]


def make_data(relief, data, quick):
    scale = 4 if quick else 1
    write_points(data / "noisy.ply", 400_000 // scale, 0.01, 1)
    write_points(data / "large.ply", 3_000_000 // scale, 0.0, 2)
    write_mesh(data / "mesh.obj", 500 // scale)
    write_stack(data / "stack.obj", 2_000 // scale)
    write_png(data / "texture.png", 2048 // scale)
    (data / "scene.json").write_text(
        '{"models": [{"file": "mesh.relief"}], "views": [%s]}' %
        ", ".join('{"name": "%s", "size": [1500, 1500], "samples": 4, "orbit": [%d, 20]}' % (n, 40 * k)
                  for k, n in enumerate("abcd")))
    subprocess.run(["gzip", "-k", data / "noisy.ply"], check=True)
    quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    subprocess.run([relief, "convert", data / "mesh.obj", "-o", data / "mesh.relief"], **quiet)
    for name, orbit in (("one", "30,20"), ("two", "30.1,20")):
        subprocess.run([relief, "render", data / "mesh.relief", "-o", data / f"{name}.exr", "--orbit", orbit,
                        "--size", "1500x1500" if quick else "4000x4000"], **quiet)


class Run:
    """A run of the command: its exit code, seconds from the interrupt to the exit, last stage, messages."""

    def __init__(self, relief, job, out, interrupt_after):
        words = [str(w).replace("OUT", str(out)) if str(w).startswith("OUT") else str(w) for w in job.words]
        ours, theirs = pty.openpty()
        process = subprocess.Popen([relief, *words], stdout=subprocess.DEVNULL, stderr=theirs,
                                   stdin=subprocess.DEVNULL, env={**os.environ, "TERM": "xterm"})
        os.close(theirs)
        text, start, sent = b"", time.monotonic(), None
        self.message = math.nan
        while True:
            now = time.monotonic()
            if sent is None and now - start >= interrupt_after:
                process.send_signal(signal.SIGINT)
                sent = time.monotonic()
            wait = 0.05 if sent is not None else min(0.05, max(0.0, interrupt_after - (now - start)))
            if select.select([ours], [], [], wait)[0]:
                try:
                    text += os.read(ours, 65536)
                    if math.isnan(self.message) and b"relief: interrupted" in text and sent is not None:
                        self.message = time.monotonic() - sent
                except OSError:
                    break  # the other side is closed: the process has ended
        process.wait()
        self.seconds = time.monotonic() - (start if sent is None else sent)
        os.close(ours)
        self.interrupted = sent is not None
        self.code = process.returncode
        self.text = text.decode(errors="replace")
        stages = re.findall(r"\r\x1b\[K([a-z][a-z ]*?) *(?:\.\.\.|\[)", self.text)
        self.stage = stages[-1] if stages else "start"


def complaints(run, job, out):
    """What is wrong with what a run left."""
    left = sorted(p.name for p in out.iterdir())
    if run.code == 0:
        return []
    found = []
    if run.code != 1:
        found.append(f"exit code {run.code}")
    if "relief: interrupted; " not in run.text:
        found.append(f"no message, but {run.text[-200:]!r}")
    found += [f"{name} is left" for name in left if name not in job.kept]
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the built command")
    parser.add_argument("--times", type=int, default=100, help="interrupts, spread over the jobs")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="jobs whose names contain one of these, separated by commas")
    parser.add_argument("--quick", action="store_true", help="smaller scans and images")
    parser.add_argument("--max-seconds", type=float, help="fail if an exit takes longer")
    arguments = parser.parse_args()
    relief = str(pathlib.Path(arguments.relief).resolve())
    rng = random.Random(arguments.seed)
    bad, slowest, times, messages = [], 0.0, [], []
    with tempfile.TemporaryDirectory(prefix="relief-interrupt-") as folder:
        data = pathlib.Path(folder)
        make_data(relief, data, arguments.quick)
        wanted = [w for w in arguments.only.split(",") if w]
        chosen = [j for j in jobs(data, arguments.quick) if not wanted or any(w in j.name for w in wanted)]
        print(f"{'job':<20} {'runs for':>9} {'message':>8} {'exit':>8} {'median':>8} {'seen':>7}  in stage")
        for number, job in enumerate(chosen):
            def fresh():
                shutil.rmtree(data / "out", ignore_errors=True)
                (data / "out").mkdir()
                return data / "out"

            whole = Run(relief, job, fresh(), LONGEST_RUN)
            if not whole.interrupted and whole.code != 0:
                sys.exit(f"measure_interrupt.py: {job.name}: exit code {whole.code}: {whole.text}")
            length = LONGEST_RUN if whole.interrupted else whole.seconds
            count = arguments.times // len(chosen) + (number < arguments.times % len(chosen))
            runs = []
            for _ in range(count):
                out = fresh()
                moment = rng.uniform(0.02, length)
                run = Run(relief, job, out, moment)
                bad += [f"{job.name} after {moment:.2f} s: {c}" for c in complaints(run, job, out)]
                if run.interrupted and run.code != 0:
                    runs.append(run)
            if not runs:
                continue
            longest = max(runs, key=lambda r: r.seconds)
            times += [r.seconds for r in runs]
            messages += [r.message for r in runs]
            seen = sum(r.seconds < GRACE for r in runs)
            print(f"{job.name:<20} {length:9.2f} {max(r.message for r in runs):8.3f} {longest.seconds:8.3f} "
                  f"{statistics.median(r.seconds for r in runs):8.3f} {seen:3}/{len(runs):<3}  {longest.stage}", flush=True)
            slowest = max(slowest, longest.seconds)
    if times:
        print(f"{len(times)} interrupts: message after {max(messages):.3f} s at most; exit: longest {max(times):.3f} s, median {statistics.median(times):.3f} s, "
              f"{sum(t <= 0.5 for t in times)} within 0.5 s; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    for complaint in bad:
        print(f"measure_interrupt.py: {complaint}", file=sys.stderr)
    if arguments.max_seconds is not None and slowest > arguments.max_seconds:
        bad.append(f"an exit took {slowest:.3f} s")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
