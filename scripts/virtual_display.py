"""A display without a screen: Xvfb, what is to be seen on it, and hands that use it.

Needs the programs Xvfb and xdotool, and libX11, which GLFW needs, too. Nothing of Python but its
standard library.
"""
import ctypes
import mmap
import os
import pathlib
import struct
import subprocess
import time
import urllib.parse
import zlib


class Picture:
    """Pixels, 3 bytes each (sRGB), from the upper left corner."""

    def __init__(self, width, height, pixels):
        self.width, self.height, self.pixels = width, height, pixels

    def crop(self, left, top, right, bottom):
        rows = [self.pixels[3 * (y * self.width + left):3 * (y * self.width + right)] for y in range(top, bottom)]
        return Picture(right - left, bottom - top, b"".join(rows))

    def at(self, x, y):
        return tuple(self.pixels[3 * (y * self.width + x):3 * (y * self.width + x) + 3])

    def row(self, y):
        return self.pixels[3 * y * self.width:3 * (y + 1) * self.width]

    def share(self, test):
        """The share of pixels whose colour passes a test."""
        known = {}
        passed = 0
        for r, g, b in zip(self.pixels[0::3], self.pixels[1::3], self.pixels[2::3]):
            colour = (r, g, b)
            if colour not in known:
                known[colour] = test(colour)
            passed += known[colour]
        return passed / (self.width * self.height)

    def save(self, path):
        """Writes a PNG."""
        rows = b"".join(b"\0" + self.row(y) for y in range(self.height))
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        header = struct.pack(">2I5B", self.width, self.height, 8, 2, 0, 0, 0)
        pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                                       + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


def difference(a, b):
    """The largest difference of two pictures of one size, and how many pixels differ by more than 1."""
    if (a.width, a.height) != (b.width, b.height):
        raise AssertionError(f"pictures of {a.width}x{a.height} and of {b.width}x{b.height}")
    most, far = 0, 0
    for y in range(a.height):
        p, q = a.row(y), b.row(y)
        if p == q:
            continue
        off = [abs(i - j) for i, j in zip(p, q)]
        largest = max(off)
        most = max(most, largest)
        if largest > 1:
            far += len({k // 3 for k, d in enumerate(off) if d > 1})
    return most, far


def read_png(path):
    """A PNG of 8-bit RGB, not interlaced, as `relief render` writes it."""
    data = pathlib.Path(path).read_bytes()
    width, height, depth, kind, _, _, interlaced = struct.unpack(">2I5B", data[16:29])
    if (depth, kind, interlaced) != (8, 2, 0):
        raise ValueError(f"{path}: 8-bit RGB is expected, not depth {depth}, colour type {kind}")
    packed, at = b"", 8
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        at += 12 + size
    raw = zlib.decompress(packed)
    stride = 3 * width
    above, out = bytes(stride), bytearray()
    for y in range(height):
        start = y * (stride + 1)
        above = unfiltered(raw[start], raw[start + 1:start + 1 + stride], above)
        out += above
    return Picture(width, height, bytes(out))


def unfiltered(kind, line, above):
    """One row of a PNG without its filter, with 3 bytes a pixel."""
    if kind == 0:
        return line
    if kind == 2:
        return bytes((x + b) & 255 for x, b in zip(line, above))
    out = bytearray(3) + line
    up = bytes(3) + above
    for i in range(3, len(out)):
        a, b, c = out[i - 3], up[i], up[i - 3]
        if kind == 1:
            guess = a
        elif kind == 3:
            guess = (a + b) // 2
        else:
            pa, pb, pc = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            guess = a if pa <= pb and pa <= pc else b if pb <= pc else c
        out[i] = (out[i] + guess) & 255
    return bytes(out[3:])


class VirtualDisplay:
    """An X server of its own, of which nobody else knows. `folder` takes its framebuffer."""

    def __init__(self, folder, width=1280, height=800):
        self.folder, self.width, self.height = pathlib.Path(folder), width, height
        self.folder.mkdir(parents=True, exist_ok=True)
        listening, telling = os.pipe()
        # The server looks for a free number itself.
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(telling), "-screen", "0", f"{width}x{height}x24", "-fbdir", str(self.folder),
             "-nolisten", "tcp", "-noreset"],
            pass_fds=[telling], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(telling)
        with os.fdopen(listening) as told:
            number = told.readline().strip()
        if not number:
            raise RuntimeError(f"Xvfb does not start (exit code {self.server.wait()})")
        self.name = f":{number}"
        self.environment = dict(os.environ, DISPLAY=self.name)
        self.environment.pop("WAYLAND_DISPLAY", None)

    def close(self):
        self.server.terminate()
        self.server.wait()

    def screenshot(self):
        """All that the screen shows. The server keeps it in a file, as XWD."""
        with (self.folder / "Xvfb_screen0").open("rb") as file, \
                mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            header = struct.unpack(">25I", data[:100])
            offset = header[0] + 12 * header[19]  # after the header and its colours
            width, height, bits, stride = header[4], header[5], header[11], header[12]
            if bits != 32 or stride != 4 * width:
                raise RuntimeError(f"Xvfb's framebuffer has {bits} bits a pixel, {stride} bytes a row")
            bgrx = data[offset:offset + stride * height]
        pixels = bytearray(3 * width * height)
        pixels[0::3], pixels[1::3], pixels[2::3] = bgrx[2::4], bgrx[1::4], bgrx[0::4]
        return Picture(width, height, bytes(pixels))

    def xdotool(self, *arguments, check=True):
        words = ["xdotool"] + [str(a) for a in arguments]
        done = subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=60, check=False)
        if check and done.returncode != 0:
            raise RuntimeError(f"{' '.join(words)}: {done.stderr.strip()}")
        return done.stdout


class Event(ctypes.Structure):
    """What all events of X begin with."""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong)]


class ClientMessage(Event):
    _fields_ = [("message", ctypes.c_ulong), ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class SelectionRequest(Event):
    """`window` is the owner."""
    _fields_ = [("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong),
                ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]


class SelectionNotify(Event):
    """`window` is the requestor."""
    _fields_ = [("selection", ctypes.c_ulong), ("target", ctypes.c_ulong), ("property", ctypes.c_ulong),
                ("time", ctypes.c_ulong)]


class AnyEvent(ctypes.Union):
    _fields_ = [("any", Event), ("client", ClientMessage), ("request", SelectionRequest),
                ("notify", SelectionNotify), ("padding", ctypes.c_long * 24)]


class Desktop:
    """The other programs of a desktop, as far as a window meets them: a file manager from which files
    are dragged (XDND, version 5), and a window manager that minimises (ICCCM 4.1.3 and 4.1.4)."""

    ANY_TIME = 0
    SELECTION_REQUEST, SELECTION_NOTIFY, CLIENT_MESSAGE = 30, 31, 33
    ATOM, NORMAL, ICONIC = 4, 1, 3

    def __init__(self, display_name):
        self.x = ctypes.CDLL("libX11.so.6")
        self.x.XOpenDisplay.restype = ctypes.c_void_p
        self.x.XOpenDisplay.argtypes = [ctypes.c_char_p]
        for name in ("XDefaultRootWindow", "XInternAtom", "XCreateSimpleWindow"):
            getattr(self.x, name).restype = ctypes.c_ulong
        pointer = self.x.XOpenDisplay(display_name.encode())
        if not pointer:
            raise RuntimeError(f"{display_name}: no such display")
        self.display = ctypes.c_void_p(pointer)
        self.root = self.x.XDefaultRootWindow(self.display)

    def close(self):
        self.x.XCloseDisplay(self.display)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def set_property(self, window, name, kind, bits, data, count):
        self.x.XChangeProperty(self.display, ctypes.c_ulong(window), ctypes.c_ulong(name), ctypes.c_ulong(kind), bits,
                               0, data, count)

    def send(self, window, event):
        union = AnyEvent()
        ctypes.memmove(ctypes.byref(union), ctypes.byref(event), ctypes.sizeof(event))
        self.x.XSendEvent(self.display, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(union))
        self.x.XFlush(self.display)

    def message(self, window, name, *data):
        values = (ctypes.c_long * 5)(*data)
        self.send(window, ClientMessage(type=self.CLIENT_MESSAGE, window=window, message=self.atom(name), format=32,
                                        data=values))

    def wait_for(self, kind, message=None, seconds=20.0):
        """Takes events until one of a kind comes. Answers whoever asks for what is dragged."""
        end = time.monotonic() + seconds
        event = AnyEvent()
        while time.monotonic() < end:
            if not self.x.XPending(self.display):
                time.sleep(0.01)
                continue
            self.x.XNextEvent(self.display, ctypes.byref(event))
            if event.any.type == kind and (message is None or event.client.message == self.atom(message)):
                return event
        raise RuntimeError(f"the window does not answer with {message or 'a request for what is dropped'}")

    def drop(self, window, paths, x, y):
        """Drops files at a place of the screen, which is over the window."""
        uris = "".join("file://" + urllib.parse.quote(str(pathlib.Path(p).absolute())) + "\r\n" for p in paths).encode()
        source = self.x.XCreateSimpleWindow(self.display, ctypes.c_ulong(self.root), 0, 0, 1, 1, 0, ctypes.c_ulong(0),
                                            ctypes.c_ulong(0))
        selection, uri_list = self.atom("XdndSelection"), self.atom("text/uri-list")
        self.x.XSetSelectionOwner(self.display, ctypes.c_ulong(selection), ctypes.c_ulong(source),
                                  ctypes.c_ulong(self.ANY_TIME))
        self.message(window, "XdndEnter", source, 5 << 24, uri_list, 0, 0)
        self.message(window, "XdndPosition", source, 0, x << 16 | y, self.ANY_TIME, self.atom("XdndActionCopy"))
        status = self.wait_for(self.CLIENT_MESSAGE, "XdndStatus")
        if not status.client.data[1] & 1:
            raise RuntimeError("the window does not want what is dropped")
        self.message(window, "XdndDrop", source, 0, self.ANY_TIME, 0, 0)
        request = self.wait_for(self.SELECTION_REQUEST).request
        self.set_property(request.requestor, request.property, uri_list, 8, uris, len(uris))
        self.send(request.requestor, SelectionNotify(
            type=self.SELECTION_NOTIFY, window=request.requestor, selection=selection, target=request.target,
            property=request.property, time=request.time))
        # GLFW 3.3 tells the number of bytes where the protocol has the bit for success.
        self.wait_for(self.CLIENT_MESSAGE, "XdndFinished")
        self.x.XDestroyWindow(self.display, ctypes.c_ulong(source))
        self.x.XFlush(self.display)

    def minimise(self, window):
        self.set_state(window, self.ICONIC)
        self.x.XUnmapWindow(self.display, ctypes.c_ulong(window))
        self.x.XFlush(self.display)

    def restore(self, window):
        self.x.XMapWindow(self.display, ctypes.c_ulong(window))
        self.set_state(window, self.NORMAL)

    def set_state(self, window, state):
        name = self.atom("WM_STATE")
        self.set_property(window, name, name, 32, (ctypes.c_long * 2)(state, 0), 2)
        self.x.XFlush(self.display)
