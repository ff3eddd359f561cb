#!/usr/bin/env python3
"""Draws 3D Gaussians by `relief render` and by a WebGL viewer of others, from the same place, and compares.

    scripts/compare_gaussians.py build/release/cli/relief biker.compressed.ply --work out
    scripts/compare_gaussians.py build/release/cli/relief hairy.ply --make --eye 2.2,1,2.6 --target 0,0,0

--make writes FILE first: a ball with hairs and haze, made of 47,000 Gaussians.

Needs npm and Chromium (Debian: npm, chromium). npm gets three.js, the viewer GaussianSplats3D and
splat-transform, which makes the file a plain .ply, into the folder --packages. None of them is part
of Relief. WebGL runs on SwiftShader, so no GPU is needed.

Prints Markdown tables: one difference after the other is taken from the viewer and from Relief, so that
each step says what one of them costs. Images and maps of FLIP stay in --work. Positions are in
Relief's frame (Y up, Z toward the viewer); the viewer sees the file's own, turned by 180 degrees
about X.
"""
import argparse
import array
import functools
import http.server
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading

from virtual_display import Picture

PACKAGES = ["three@0.180.0", "@mkkellogg/gaussian-splats-3d@0.4.7", "@playcanvas/splat-transform@2.7.1"]
PAGE = pathlib.Path(__file__).resolve().with_suffix(".html")
LONGEST = 300  # seconds for one image of the viewer
BAND0 = 0.28209479177387814  # the harmonic of degree 0

# The viewer as it is, then without one difference more in each column. It keeps colours and opacities
# in bytes, rounded down: bytes.ply has whole bytes, so that it changes none. It blends in 8 bits, and has
# a floor under the difference of an ellipse's eigenvalues, which makes small round ones long. It sorts
# into 2^16 depths, and at most into 2^24.
VIEWERS = [("as it is", "scene", {}),
           ("whole bytes in the file", "bytes", {}),
           ("blended in floats", "bytes", {"floats": True}),
           ("round ellipses", "bytes", {"floats": True, "round": True}),
           ("sorted finely", "bytes", {"floats": True, "round": True, "finely": True})]

# The viewer's own rules, as options of ours. Each row adds its options to those above.
RULES = [("defaults", []),
         ("ellipses end at x^T Q x = 8", ["--cutoff", "8", "--min-alpha", "0"]),
         ("no largest opacity", ["--max-alpha", "1"]),
         ("no end at opaque pixels", ["--min-transmittance", "0"]),
         ("no limit of the Jacobian", ["--jacobian-clamp", "0"])]

# What each of our options does by itself.
ALONE = [("--filter unfiltered", ["--filter", "unfiltered"]),
         ("--filter ewa", ["--filter", "ewa"]),
         ("--blend linear", ["--blend", "linear"])]

# Of the last column and the last row: harmonics that are made up, to each degree that the viewer knows, and its
# filter that keeps the integral.
MORE = [(f"harmonics of degree {d}", "harmonics", {"degree": d}, ["--harmonics", str(d)]) for d in range(3)]
MORE += [("viewer anti-aliased, --filter ewa", "bytes", {"antialiased": True}, ["--filter", "ewa"])]


class Handler(http.server.SimpleHTTPRequestHandler):
    """Serves the page, the packages and the file to one viewer, and keeps what it sends."""

    def __init__(self, *args, asked, answers, **keywords):
        self.asked, self.answers = asked, answers
        super().__init__(*args, **keywords)

    def do_GET(self):
        if self.path in ("/", "/asked.json"):
            body = PAGE.read_bytes() if self.path == "/" else json.dumps(self.asked).encode()
            self.send_response(200)
            self.send_header("Content-Type", "text/html" if self.path == "/" else "application/json")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)
        else:
            super().do_GET()

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(204)
        self.end_headers()
        self.answers[self.path] = body
        self.answers["came"].set()

    def log_message(self, *_):
        pass


def draw_by_viewer(options, asked, path):
    """Starts Chromium for one image and writes it as a PNG."""
    answers = {"came": threading.Event()}
    handler = functools.partial(Handler, asked=asked, answers=answers, directory=options.packages)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    # Chromium's other processes end a moment after it, and still write.
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = subprocess.Popen(
            [options.chromium, "--headless=new", "--no-sandbox", "--no-first-run", "--use-angle=swiftshader",
             "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-dev-shm-usage",
             f"--user-data-dir={profile}", f"http://127.0.0.1:{server.server_address[1]}/"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        answers["came"].wait(LONGEST)
        browser.terminate()
        browser.wait()
    server.shutdown()
    if "/pixels" not in answers:
        sys.exit(f"compare_gaussians.py: the viewer sent no image: {answers.get('/failed', b'no answer').decode()}")
    rgba = answers["/pixels"]
    rgb = bytearray(3 * len(rgba) // 4)
    for c in range(3):
        rgb[c::3] = rgba[c::4]
    Picture(asked["width"], asked["height"], bytes(rgb)).save(path)


def flipped(position):
    """Relief's frame in that of .ply files, and the reverse."""
    x, y, z = position
    return [x, -y, -z]


def make_example(path):
    """A striped ball of flat Gaussians, thin hairs on it, and a haze of wide, faint ones about it."""
    rng = random.Random(3)
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
             "rot_0", "rot_1", "rot_2", "rot_3"]
    rows = array.array("f")
    golden = math.pi * (3 - math.sqrt(5))

    def add(centre, along_z, scales, opacity, colour):
        x, y, z = along_z  # the shortest turn from the z axis
        half = [1 + z, -y, x, 0.0] if z > -0.999 else [0.0, 1.0, 0.0, 0.0]
        length = math.hypot(*half)
        rows.extend([*centre, *((c - 0.5) / BAND0 for c in colour), math.log(opacity / (1 - opacity)),
                     *(math.log(s) for s in scales), *(h / length for h in half)])
    for k in range(40000):
        z = 1 - (2 * k + 1) / 40000
        r = math.sqrt(1 - z * z)
        n = (r * math.cos(k * golden), r * math.sin(k * golden), z)
        stripe = math.sin(14 * n[1] + 3 * n[0]) > 0
        light = 0.55 + 0.45 * n[0] * n[2]
        add(n, n, (0.012, 0.012, 0.001), 0.95, [light * c for c in ((0.9, 0.5, 0.2) if stripe else (0.2, 0.3, 0.5))])
    for k in range(7000):
        n = [rng.gauss(0, 1) for _ in range(3)]
        length = math.hypot(*n)
        n = [c / length for c in n]
        if k < 6900:
            add([1.06 * c for c in n], n, (0.0015, 0.0015, 0.05), 0.6, [0.85, 0.8, 0.7])
        else:
            add([1.25 * c for c in n], n, (0.12, 0.12, 0.12), 0.04, [0.9, 0.9, 0.95])
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(rows) // len(names)}\n"
    header += "".join(f"property float {name}\n" for name in names) + "end_header\n"
    path.write_bytes(header.encode() + rows.tobytes())


def write_scenes(folder):
    """Makes bytes.ply, and harmonics.ply, whose colours depend on the direction, of scene.ply."""
    data = (folder / "scene.ply").read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    header = data[:end].decode()
    names = [line.split()[2] for line in header.splitlines() if line.startswith("property float ")]
    values = array.array("f", data[end:])
    count = len(values) // len(names)

    def replace(name, function):
        k = names.index(name)
        values[k::len(names)] = array.array("f", map(function, values[k::len(names)]))

    def whole_colour(c):  # a little more than a byte, which rounding down leaves
        byte = min(max(math.floor((0.5 + BAND0 * c) * 255), 0), 255)
        return ((byte + 0.01) / 255 - 0.5) / BAND0

    def whole_opacity(o):
        byte = min(max(math.floor(255 / (1 + math.exp(-o))), 1), 254)
        return -math.log(255 / (byte + 0.01) - 1)
    for k in range(3):
        replace(f"f_dc_{k}", whole_colour)
    replace("opacity", whole_opacity)
    (folder / "bytes.ply").write_bytes(header.encode() + values.tobytes())

    rest = 24  # degree 2
    added = "".join(f"property float f_rest_{k}\n" for k in range(rest))
    waves = [array.array("f", (0.1 * math.sin(phase + 1.7 * k) for k in range(rest)))
             for phase in (0.01 * step for step in range(629))]
    x = names.index("x")
    rows = []
    for row in range(count):
        at = row * len(names)
        rows.append(values[at:at + len(names)].tobytes())
        rows.append(waves[int(100 * (5 * values[at + x] + 3 * values[at + x + 1])) % 629].tobytes())
    (folder / "harmonics.ply").write_bytes(header.replace("end_header\n", added + "end_header\n").encode()
                                           + b"".join(rows))


def prepare(options):
    """Installs the packages and makes a plain .ply in their folder, which is what is served."""
    options.packages.mkdir(parents=True, exist_ok=True)
    if not (options.packages / "node_modules/three").exists():
        subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--ignore-scripts", "--prefix", options.packages,
                        *PACKAGES], check=True, stdout=subprocess.DEVNULL)
    subprocess.run([options.packages / "node_modules/.bin/splat-transform", "-q", "-w", options.file,
                    options.packages / "scene.ply"], check=True)
    write_scenes(options.packages)


def parse():
    def numbers(text):
        return [float(part) for part in text.split(",")]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("relief", help="the command, as build/release/cli/relief")
    parser.add_argument("file", type=pathlib.Path, help="3D Gaussians, in a form that splat-transform reads")
    parser.add_argument("--make", action="store_true", help="write an example to FILE first")
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("compare_gaussians"), help="images go there")
    parser.add_argument("--packages", type=pathlib.Path, default=pathlib.Path.home() / ".cache/relief-compare-gaussians")
    parser.add_argument("--chromium", default=shutil.which("chromium") or "chromium")
    parser.add_argument("--eye", type=numbers, default=[-3.0, 2.4, 3.4], help="in Relief's frame")
    parser.add_argument("--target", type=numbers, default=[-0.06, 1.6, 0.03])
    parser.add_argument("--up", type=numbers, default=[0.0, 1.0, 0.0])
    parser.add_argument("--fov", type=float, default=45.0, help="vertical, degrees")
    parser.add_argument("--size", default="1280x1024")
    parser.add_argument("--engine", default="volume-reference")
    options = parser.parse_args()
    options.packages = options.packages.resolve()
    return options


def main():
    options = parse()
    options.work.mkdir(parents=True, exist_ok=True)
    if options.make:
        make_example(options.file)
    prepare(options)
    width, height = (int(side) for side in options.size.split("x"))

    def view(name, scene, told):
        asked = {"file": f"{scene}.ply", "width": width, "height": height, "fov": options.fov, "near": 0.1,
                 "eye": flipped(options.eye), "target": flipped(options.target), "up": flipped(options.up),
                 "floats": False, "round": False, "finely": False, "antialiased": False, "degree": 2, **told}
        path = options.work / f"viewer_{name}.png"
        draw_by_viewer(options, asked, path)
        return path

    def place(position):
        return ",".join(str(coordinate) for coordinate in position)

    def render(name, scene, more):
        path = options.work / f"relief_{name}.png"
        subprocess.run([options.relief, "render", options.packages / f"{scene}.ply", "--engine", options.engine,
                        f"--eye={place(options.eye)}", f"--target={place(options.target)}", f"--up={place(options.up)}",
                        "--fov", str(options.fov), "--size", options.size, "--background", "0,0,0", *more, "-o", path],
                       check=True, stdout=subprocess.DEVNULL)
        return path

    def compare(ours, theirs, name):
        run = subprocess.run([options.relief, "compare", ours, theirs, "--heatmap", options.work / f"flip_{name}.png",
                              "--json"], check=True, capture_output=True, text=True)
        found = json.loads(run.stdout)
        psnr = "same" if found["psnr_db"] is None else f"{found['psnr_db']:.1f}"
        return f"{psnr} / {found['flip_mean']:.4f}"

    viewers = [view(k, scene, told) for k, (_, scene, told) in enumerate(VIEWERS)]
    print("PSNR (dB) / mean FLIP of Relief against the viewer. Each row adds to those above; each column, too.\n")
    print("| Relief | " + " | ".join(name for name, _, _ in VIEWERS) + " |")
    print("| --- |" + " ---: |" * len(VIEWERS))
    matched = []
    for k, (name, added) in enumerate(RULES):
        matched = matched + added
        ours = {scene: render(f"{scene}_{k}", scene, matched) for scene in ("scene", "bytes")}
        cells = [compare(ours[scene], viewers[v], f"{k}_{v}") for v, (_, scene, _) in enumerate(VIEWERS)]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)

    print("\nWith the last row's options, against the viewer of the last column.\n\n| both | |\n| --- | ---: |")
    for k, (name, scene, told, more) in enumerate(MORE):
        theirs = view(f"more_{k}", scene, {**VIEWERS[-1][2], **told})
        print(f"| {name} | {compare(render(f'more_{k}', scene, matched + more), theirs, f'more_{k}')} |", flush=True)

    print("\nOne option by itself, against Relief's own defaults and against the viewer as it is.\n")
    print("| Relief | its defaults | the viewer |\n| --- | ---: | ---: |")
    for name, added in RULES[1:] + ALONE:
        ours = render("alone", "scene", added)
        print(f"| {name} | {compare(ours, options.work / 'relief_scene_0.png', 'alone')} | "
              f"{compare(ours, viewers[0], 'alone')} |", flush=True)


if __name__ == "__main__":
    main()
