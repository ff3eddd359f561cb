"""The program as a whole: signals, limits, outputs that cannot be written, runs beside each other, pipes."""
import os
import resource
import signal
import subprocess
import time

import numpy as np

from stability.page import Section
from stability.scans import sphere, write_ply

MEGABYTE = 2 ** 20
MOMENTS = 5


def outcome(done):
    """Returns the exit code, or the signal, and the last line of standard error."""
    code = f"exit {done.returncode}" if done.returncode >= 0 else f"signal {-done.returncode}"
    lines = done.stderr.decode(errors="replace").strip().splitlines()
    return code, lines[-1] if lines else ""


class Whole:
    def __init__(self, relief):
        self.program = relief.program
        self.folder = relief.path("whole")
        self.folder.mkdir(exist_ok=True)
        self.scan = write_ply(self.folder / "scan.ply", sphere(20000))
        self.rows, self.bad = [], []

    def started(self, *words, **options):
        return subprocess.Popen([self.program, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    def run(self, *words, **options):
        return subprocess.run([self.program, *map(str, words)], capture_output=True, timeout=300, **options)

    def left(self):
        """Returns the files beside the scan, and removes them."""
        names = sorted(p.name for p in self.folder.iterdir() if p != self.scan)
        for name in names:
            (self.folder / name).unlink()
        return names

    def note(self, case, seen, good):
        self.rows.append([case, seen])
        if not good:
            self.bad.append(case)

    def signals(self):
        """Sends signals at moments spread over a conversion. Only SIGKILL may leave a file, and none half an output."""
        begin = time.time()
        self.run("convert", self.scan, "-o", self.folder / "out.relief")
        whole = time.time() - begin
        self.left()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL):
            files, leftovers, codes = 0, 0, set()
            for part in np.linspace(0.1, 0.9, MOMENTS):
                running = self.started("convert", self.scan, "-o", self.folder / "out.relief")
                time.sleep(part * whole)
                running.send_signal(number)
                running.communicate(timeout=60)
                left = self.left()
                files += running.returncode != 0 and "out.relief" in left
                leftovers += any(name != "out.relief" for name in left)
                codes.add(f"exit {running.returncode}" if running.returncode >= 0 else f"signal {-running.returncode}")
            self.note(f"{signal.Signals(number).name}, {MOMENTS} times during a conversion of {whole:.1f} s",
                      f"{', '.join(sorted(codes))}; {files} half files, {leftovers} temporary files",
                      files == 0 and (leftovers == 0 or number == signal.SIGKILL))

    def outputs(self):
        """Outputs that cannot be written."""
        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)

        for case, target, options in [("files of at most 4 KiB", self.folder / "out.relief", {"preexec_fn": limited}),
                                      ("a read-only folder", "/sys/out.relief", {}),
                                      ("a full device", "/dev/full", {})]:
            words = ("convert", self.scan, "-o", target)
            if str(target) == "/dev/full":  # a patch file on standard output, which is full
                with open("/dev/full", "wb") as full:
                    done = subprocess.run([self.program, "convert", self.scan, "-o", "-"], stdout=full,
                                          stderr=subprocess.PIPE, timeout=300, check=False)
            else:
                done = self.run(*words, **options)
            code, message = outcome(done)
            left = self.left()
            self.note(case, f"{code}: {message}", done.returncode == 1 and not left)

    def memory(self):
        """Limits of the address space, down to where the program no longer starts."""
        for limit in (4096, 1024, 512, 256, 128):
            def limited(limit=limit):
                resource.setrlimit(resource.RLIMIT_AS, (limit * MEGABYTE, limit * MEGABYTE))

            for name, words in (("convert", ("convert", self.scan, "-o", self.folder / "out.relief", "--threads", "2")),
                                ("render", ("render", self.scan, "-o", self.folder / "out.png", "--size", "256x256"))):
                done = self.run(*words, preexec_fn=limited)
                code, message = outcome(done)
                left = self.left()
                # LLVM, which Mesa compiles shaders with, ends a process that has no room for them: by
                # signal 6 with a message, or by 11. Then only the file counts.
                is_llvm = name == "render" and done.returncode in (-6, -11)
                self.note(f"{name} in {limit} MiB of addresses", code if done.returncode == 0 else f"{code}: {message[:110]}",
                          done.returncode == 0 or (not left and (done.returncode == 1 or is_llvm)))

    def beside(self):
        """Four conversions to one output at once: the file is one of theirs, whole."""
        self.run("convert", self.scan, "-o", self.folder / "one.relief")
        one = (self.folder / "one.relief").read_bytes()
        running = [self.started("convert", self.scan, "-o", self.folder / "out.relief") for _ in range(4)]
        for process in running:
            process.communicate(timeout=300)
        same = (self.folder / "out.relief").read_bytes() == one
        left = [n for n in self.left() if n not in ("one.relief", "out.relief")]
        codes = sorted(p.returncode for p in running)
        self.note("four conversions to one output at once", f"exit codes {codes}; the file is {'whole' if same else 'damaged'}; "
                  f"left: {', '.join(left) or 'nothing'}", same and not left)

    def pipes(self):
        """Standard input and output, and a reader that leaves."""
        command = f'"{self.program}" convert - -o - < "{self.scan}" 2>/dev/null | "{self.program}" render - -o - --size 64x64 2>/dev/null | head -c 8 | od -An -c'
        done = subprocess.run(["bash", "-c", command], capture_output=True, timeout=300, check=False)
        self.note("convert to render to `head -c 8`, all by pipes", " ".join(done.stdout.decode().split()),
                  b"P   N   G" in done.stdout)
        done = subprocess.run(["bash", "-c", f'"{self.program}" convert "{self.scan}" -o - | head -c 1 > /dev/null; echo ${{PIPESTATUS[0]}}'],
                              capture_output=True, timeout=300, check=False)
        self.note("a reader that leaves", f"exit {done.stdout.decode().strip()}", done.stdout.strip() in (b"0", b"1"))

    def contexts(self):
        """OpenGL that cannot be had."""
        done = self.run("render", self.scan, "-o", self.folder / "out.png", "--gl", "egl",
                        env={**os.environ, "__EGL_VENDOR_LIBRARY_FILENAMES": "/nonexistent"})
        code, message = outcome(done)
        self.note("no OpenGL driver", f"{code}: {message}", done.returncode == 1 and not self.left())


def measure(relief, _vertices, _triangles):
    whole, section = Whole(relief), Section("The program as a whole")
    for part in (whole.signals, whole.outputs, whole.memory, whole.beside, whole.pipes, whole.contexts):
        part()
    folder = str(whole.folder)
    section.text("Exit code 1 with one sentence and no file is what a failure should be.",
                 "A lost OpenGL context cannot be made on llvmpipe; `LostContext` in `renderer_test` makes it up.")
    section.table(["case", "what happened"], [[a, b.replace(folder + "/", "")] for a, b in whole.rows])
    section.wrong = whole.bad
    section.text(f"Not as it should be: {', '.join(whole.bad) or 'none'}.")
    return section
