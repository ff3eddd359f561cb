"""A window of `relief view` on a virtual display, and what a user does with it."""
import contextlib
import csv
import json
import os
import pathlib
import signal
import subprocess
import time

from virtual_display import Desktop

# Numbers of viewer/: the test looks for widgets by their colours where it can.
HEADER = (61, 69, 79)  # window/gui.cpp: ImGuiCol_Header, a section of the side panel
FRAME = (51, 54, 59)  # ImGuiCol_FrameBg, a list that opens
PANEL_WIDTH = 336  # panels/side_panel.cpp: kPanelWidth
STATUS_HEIGHT = 24  # panels/status_bar.cpp: a frame's height, 21 with the font that Debian has
SECTIONS = ("Files", "Views", "Look", "Light", "Drawing", "Compare")

REST_SECONDS = 0.2  # of a window that draws and computes nothing


class ViewerWindow:
    """Starts `relief view`. `folder` takes its settings and its log of frames."""

    def __init__(self, display, relief, arguments, folder, size):
        self.display = display
        self.patience = 60.0  # seconds that coming to rest may take
        self.rest_seconds = REST_SECONDS
        folder = pathlib.Path(folder).resolve()  # a relative XDG_CONFIG_HOME does not count
        settings = folder / "config" / "relief" / "viewer.json"
        settings.parent.mkdir(parents=True, exist_ok=True)
        settings.write_text(json.dumps({"window": size, "sections": {s: s == "Look" for s in SECTIONS}}))
        self.log_path = folder / "frames.csv"
        self.log_path.unlink(missing_ok=True)
        self.errors = (folder / "stderr.txt").open("w+")
        environment = dict(display.environment, XDG_CONFIG_HOME=str(folder / "config"))
        self.started = time.monotonic()
        self.process = subprocess.Popen([str(relief), "view", *map(str, arguments), "--frame-log", str(self.log_path)],
                                        env=environment, stdout=subprocess.DEVNULL, stderr=self.errors)
        try:
            self.id = self.find()
            self.take_keys()
        except BaseException:
            self.close()
            raise

    def find(self):
        end = time.monotonic() + 60.0
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise RuntimeError(f"relief view ended with {self.process.returncode}: {self.said()}")
            found = self.shown()
            if found:
                return found[0]
            time.sleep(0.02)
        raise RuntimeError("relief view opens no window in a minute")

    def shown(self):
        """The process's windows that are to be seen."""
        found = self.display.xdotool("search", "--onlyvisible", "--pid", self.process.pid, check=False)
        return [int(word) for word in found.split()]

    def take_keys(self):
        """Gives the window the keys, as a window manager does when one appears."""
        self.display.xdotool("windowfocus", self.id)

    def said(self):
        self.errors.seek(0)
        return self.errors.read().strip()

    def close(self):
        """Ends the process, whatever it does."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.errors.close()

    def end_of(self, seconds=30.0):
        """The exit code of a window that is about to close."""
        try:
            return self.process.wait(timeout=seconds)
        except subprocess.TimeoutExpired:
            raise RuntimeError(f"the window has not closed in {seconds} s") from None

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)

    # What it does.

    def frames(self):
        """The log so far; a line that is being written is left out."""
        if not self.log_path.exists():
            return []
        lines = self.log_path.read_text().split("\n")[:-1]
        return [dict(r, seconds=float(r["seconds"]), ms=float(r["ms"])) for r in csv.DictReader(lines)]

    def cpu_seconds(self):
        fields = pathlib.Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def is_working(self):
        """Whether a thread runs, or would if the machine let it."""
        for stat in pathlib.Path(f"/proc/{self.process.pid}/task").glob("*/stat"):
            try:
                if stat.read_text().rsplit(")", 1)[1].split()[0] in "RD":
                    return True
            except OSError:  # a thread that has ended meanwhile
                pass
        return False

    def rest(self):
        """Waits until the window has drawn something and draws and computes no more."""
        end = time.monotonic() + self.patience
        quiet_since, seen = time.monotonic(), 0
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise RuntimeError(f"relief view ended with {self.process.returncode}: {self.said()}")
            size = self.log_path.stat().st_size if self.log_path.exists() else 0
            now = time.monotonic()
            if size != seen or self.is_working():
                quiet_since, seen = now, size
            elif seen > 0 and now - quiet_since > self.rest_seconds:
                return
            time.sleep(0.02)
        raise RuntimeError(f"the window does not come to rest in {self.patience} s")

    def wait_until(self, condition, what, seconds=60.0):
        end = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > end:
                raise RuntimeError(f"in {seconds} s {what} has not happened")
            time.sleep(0.05)
        self.rest()

    def title(self):
        return self.display.xdotool("getwindowname", self.id).strip()

    # What is to be seen.

    def size(self):
        text = self.display.xdotool("getwindowgeometry", "--shell", self.id)
        values = dict(line.split("=") for line in text.split())
        return int(values["WIDTH"]), int(values["HEIGHT"])

    def whole(self):
        """The window at rest, without the cursor."""
        width, height = self.size()
        self.display.xdotool("mousemove", self.display.width - 1, self.display.height - 1)
        self.rest()
        return self.display.screenshot().crop(0, 0, width, height)

    def picture_size(self):
        width, height = self.size()
        return width - min(PANEL_WIDTH, width // 2), height

    def picture(self):
        """The picture but for what the status bar hides."""
        width, height = self.picture_size()
        return self.whole().crop(0, 0, width, height - STATUS_HEIGHT)

    # What a user does.

    def act(self, *words):
        """One or more commands of xdotool, and what they lead to."""
        self.display.xdotool(*words)
        self.rest()

    def key(self, *names):
        self.act("key", *names)

    def click(self, x, y, button=1):
        # As a hand does: it comes, presses, and lets go.
        self.act("mousemove", x, y, "sleep", 0.15, "mousedown", button, "sleep", 0.1, "mouseup", button)

    def drag(self, start, end, button=1, steps=20):
        # The window knows what is under the cursor a frame after it has come. Frames are slow on a busy machine.
        self.act("mousemove", *start)
        words = ["mousedown", button]
        for k in range(1, steps + 1):
            at = [round(a + (b - a) * k / steps) for a, b in zip(start, end)]
            words += ["sleep", 0.01, "mousemove", *at]
        self.act(*words, "sleep", 0.1, "mouseup", button)

    def wheel(self, x, y, steps):
        button = 4 if steps > 0 else 5
        words = ["mousemove", x, y]
        for _ in range(abs(steps)):
            words += ["sleep", 0.05, "click", button]
        self.act(*words)

    def drop(self, paths):
        with contextlib.closing(Desktop(self.display.name)) as desktop:
            desktop.drop(self.id, paths, 300, 300)

    def minimise(self):
        with contextlib.closing(Desktop(self.display.name)) as desktop:
            desktop.minimise(self.id)

    def restore(self):
        with contextlib.closing(Desktop(self.display.name)) as desktop:
            desktop.restore(self.id)
        self.wait_until(lambda: self.id in self.shown(), "a restored window")
        self.take_keys()

    def resize(self, width, height):
        self.display.xdotool("windowsize", self.id, width, height)
        self.wait_until(lambda: self.size() == (width, height), f"a resize to {width}x{height}")

    # The side panel.

    def choose_material(self, index, count):
        """Takes a row of the list of materials, the first of the section "Look"."""
        width, _ = self.size()
        shown = self.whole()
        x = width - 60
        top = middles_of(shown, width - PANEL_WIDTH + 12, HEADER)[SECTIONS.index("Look")]
        lists = [y for y in middles_of(shown, x, FRAME) if y > top]
        if not lists:
            raise RuntimeError("there is no list of materials in the side panel")
        self.click(x, lists[0])
        rows = rows_of_text(self.whole(), shown)
        if len(rows) != count:
            raise RuntimeError(f"the list of materials has {len(rows)} rows, not {count}")
        self.click(x, rows[index])


def middles_of(picture, x, colour):
    """Middles of runs of a colour in a column, at least 8 pixels long."""
    found, start = [], None
    for y in range(picture.height + 1):
        is_inside = y < picture.height and picture.at(x, y) == colour
        if is_inside and start is None:
            start = y
        elif not is_inside and start is not None:
            if y - start >= 8:
                found.append((start + y - 1) // 2)
            start = None
    return found


def rows_of_text(opened, before):
    """Middles of the lines of text in what has opened over the side panel."""
    left = opened.width - PANEL_WIDTH
    panel = [(y, [x for x in range(left, opened.width - 8) if opened.at(x, y) != before.at(x, y)])
             for y in range(opened.height)]
    # What is wide is the list; the widget that opened it is only lit.
    rows = [(y, xs) for y, xs in panel if len(xs) > 100]
    if not rows:
        return []
    top, bottom = rows[0][0], rows[-1][0]
    x0, x1 = rows[0][1][0], rows[0][1][0] + 60
    # Above 140: text; the list's frame is darker.
    is_text = [max(max(opened.at(x, y)) for x in range(x0 + 2, x1)) > 140 for y in range(top, bottom + 1)]
    middles, start = [], None
    for k, inside in enumerate(is_text + [False]):
        if inside and start is None:
            start = k
        elif not inside and start is not None:
            middles.append(top + (start + k - 1) // 2)
            start = None
    return middles
