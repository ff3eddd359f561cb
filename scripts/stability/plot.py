"""Line plots as SVG. The same values always give the same bytes."""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 720, 360
LEFT, RIGHT, TOP, BOTTOM = 60, 170, 40, 50
# Distinct for colour-blind readers (Okabe and Ito).
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]


class Plot:
    """Curves over powers of ten. Values above `top` are drawn at the top."""

    def __init__(self, file, title, x_label, y_label, top=140.0, goal=None):
        self.file, self.title, self.x_label, self.y_label = file, title, x_label, y_label
        self.top, self.goal, self.curves = top, goal, {}

    def add(self, name, x, y):
        """Adds a point; x is above 0. None is a gap: the command failed."""
        self.curves.setdefault(name, []).append((math.log10(x), None if y is None else min(y, self.top)))

    def svg(self):
        xs = [x for points in self.curves.values() for x, _ in points]
        low, high = min(xs), max(xs)

        def at(x, y):
            return (LEFT + (x - low) / (high - low) * (WIDTH - LEFT - RIGHT),
                    HEIGHT - BOTTOM - max(y, 0) / self.top * (HEIGHT - TOP - BOTTOM))

        out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
               'font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
               f'<text x="{LEFT}" y="22" font-size="14">{escape(self.title)}</text>']
        for y in range(0, int(self.top) + 1, 20):
            x0, y0 = at(low, y)
            out.append(f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{WIDTH - RIGHT}" y2="{y0:.1f}" stroke="#ddd"/>')
            out.append(f'<text x="{LEFT - 6}" y="{y0 + 4:.1f}" text-anchor="end">{y}</text>')
        step = max(1, round((high - low) / 8))
        for power in range(math.ceil(low), math.floor(high) + 1, step):
            x0, y0 = at(power, 0)
            out.append(f'<text x="{x0:.1f}" y="{y0 + 18:.1f}" text-anchor="middle">1e{power}</text>')
        if self.goal is not None:
            x0, y0 = at(low, self.goal)
            out.append(f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{WIDTH - RIGHT}" y2="{y0:.1f}" stroke="#888" '
                       'stroke-dasharray="4 3"/>')
        for number, (name, points) in enumerate(self.curves.items()):
            colour = COLOURS[number % len(COLOURS)]
            for run in runs(sorted(points)):
                line = " ".join("{:.1f},{:.1f}".format(*at(x, y)) for x, y in run)
                out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
                out += ['<circle cx="{:.1f}" cy="{:.1f}" r="2.5" fill="{}"/>'.format(*at(x, y), colour) for x, y in run]
            label = TOP + 16 * number
            out.append(f'<text x="{WIDTH - RIGHT + 12}" y="{label}" fill="{colour}">{escape(name)}</text>')
        out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" text-anchor="middle">'
                   f'{escape(self.x_label)}</text>')
        out.append(f'<text transform="translate(16 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">'
                   f'{escape(self.y_label)}</text></svg>')
        return "\n".join(out) + "\n"


def runs(points):
    """Returns the parts of a curve between gaps."""
    parts, part = [], []
    for x, y in points:
        if y is None:
            parts, part = parts + [part], []
        else:
            part.append((x, y))
    return [p for p in parts + [part] if p]
