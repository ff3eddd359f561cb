#!/usr/bin/env python3
"""Converts scans to reach errors over some decades, and with as many samples of one spacing.

    scripts/measure_error.py RELIEF SCAN... [--decades 2] [--plot OUT.svg]

The smallest error is that of the default.
Prints a Markdown table: the error asked for and reached (rms, in the scan's unit), samples, bytes,
seconds; and the error of one spacing (--spacing) with as many samples. The plot shows error over
samples, both in logarithms: solid as asked for, dashed with one spacing.
"""
import argparse
import json
import math
import os
import subprocess
import tempfile

STEPS = 7  # errors a scan
WIDTH, HEIGHT, MARGIN = 640, 480, 60  # of the plot
COLOURS = ["#1b6ca8", "#c8553d", "#3a7d44", "#7b4b94"]


def convert(relief, scan, *options):
    with tempfile.TemporaryDirectory() as folder:
        command = [relief, "convert", scan, "-o", os.path.join(folder, "a.relief"), "--json", *options]
        return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE,
                                         stderr=subprocess.DEVNULL).stdout)


def with_one_spacing(relief, scan, usual, samples):
    """As many samples of one spacing, to 2 % if eight trials find them: where borders are most of the
    patches, samples are fewer by less than the square of the spacing."""
    spacing = usual["spacing"] * math.sqrt(usual["samples"] / samples)
    power = 2.0
    before = None
    for _ in range(8):
        made = convert(relief, scan, "--spacing", f"{spacing:.9g}")
        share = made["samples"] / samples
        if 0.98 < share < 1.02:
            break
        if before and made["samples"] != before[1]:
            found = math.log(before[1] / made["samples"]) / math.log(spacing / before[0])
            power = min(max(found, 0.2), 2.0)
        before = spacing, made["samples"]
        spacing *= share ** (1.0 / power)
    return made


def measure(relief, scan, decades):
    name = os.path.basename(scan).split(".")[0]
    usual = convert(relief, scan)
    rows = []
    for step in range(STEPS):
        asked = usual["error_rms"] * 10 ** (decades * (1 - step / (STEPS - 1)))
        made = convert(relief, scan, "--error", f"{asked:.4g}")
        uniform = with_one_spacing(relief, scan, usual, made["samples"])
        rows.append((asked, made, uniform))
        print(f"| {name} | {asked:.3g} | {made['error_rms']:.3g} | {made['samples']:,} | "
              f"{made['file_bytes']:,} | {made['seconds']:.2f} | {uniform['samples']:,} | "
              f"{uniform['error_rms']:.3g} | {uniform['file_bytes']:,} |", flush=True)
    return name, usual["error_rms"], rows


def plot(path, measured):
    """Errors are in those of the default, so that scans of all units share a plot."""
    samples = [m["samples"] for _, _, rows in measured for _, *both in rows for m in both]
    errors = [m["error_rms"] / usual for _, usual, rows in measured for _, *both in rows for m in both]

    def along(value, values, length):
        low, high = math.log(min(values)), math.log(max(values))
        return (math.log(value) - low) / (high - low) * length

    def line(points, colour, dashes):
        return (f'<polyline fill="none" stroke="{colour}" stroke-width="2" {dashes} points="' +
                " ".join(f"{MARGIN + along(s, samples, WIDTH - 2 * MARGIN):.1f},"
                         f"{HEIGHT - MARGIN - along(e, errors, HEIGHT - 2 * MARGIN):.1f}"
                         for s, e in points) + '"/>')

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
             'font-family="sans-serif" font-size="13">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for power in range(math.ceil(math.log10(min(samples))), math.floor(math.log10(max(samples))) + 1):
        x = MARGIN + along(10 ** power, samples, WIDTH - 2 * MARGIN)
        parts.append(f'<path d="M{x:.1f},{MARGIN} V{HEIGHT - MARGIN}" stroke="#ddd"/>'
                     f'<text x="{x:.1f}" y="{HEIGHT - MARGIN + 20}" text-anchor="middle">{10 ** power:,}</text>')
    for share in (1, 10, 100):
        y = HEIGHT - MARGIN - along(share, errors, HEIGHT - 2 * MARGIN)
        parts.append(f'<path d="M{MARGIN},{y:.1f} H{WIDTH - MARGIN}" stroke="#ddd"/>'
                     f'<text x="{MARGIN - 8}" y="{y + 4:.1f}" text-anchor="end">{share}</text>')
    for k, (name, usual, rows) in enumerate(measured):
        colour = COLOURS[k % len(COLOURS)]
        for which, dashes in ((1, ""), (2, 'stroke-dasharray="5 4"')):
            parts.append(line([(r[which]["samples"], r[which]["error_rms"] / usual) for r in rows],
                              colour, dashes))
        parts.append(f'<text x="{WIDTH - MARGIN}" y="{MARGIN + 18 * k}" text-anchor="end" '
                     f'fill="{colour}">{name}</text>')
    parts.append(f'<text x="{WIDTH / 2}" y="{HEIGHT - 15}" text-anchor="middle">samples</text>'
                 f'<text x="{MARGIN}" y="{MARGIN - 20}">rms error, in the default\'s; '
                 'dashed: one spacing</text></svg>')
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(parts) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("relief")
    parser.add_argument("scans", nargs="+")
    parser.add_argument("--decades", type=float, default=2.0)
    parser.add_argument("--plot")
    arguments = parser.parse_args()
    print("| scan | error asked | reached | samples | bytes | s | one spacing: samples | error | bytes |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    measured = [measure(arguments.relief, scan, arguments.decades) for scan in arguments.scans]
    if arguments.plot:
        plot(arguments.plot, measured)


if __name__ == "__main__":
    main()
