"""A virtual screen, and on it the window of `hlodbench view` with a user's keys and pointer."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from PIL import Image
from small_scene import write_relief

LIMIT = 120  # seconds until a test that waits in vain gives up
SIZE = (320, 240)  # of the view, pixels
PANEL = 310  # pixels of the window to the left of the view
MIDDLE = (PANEL + SIZE[0] // 2, SIZE[1] // 2)  # of the view, in the window

# Sends the message; xdotool of Debian 12 cannot. In a process of its own, for Xlib ends that at
# errors.
CLOSE = """
import ctypes
x = ctypes.CDLL("libX11.so.6")
class Message(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("sent", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong),
                ("message", ctypes.c_ulong), ("format", ctypes.c_int), ("data", ctypes.c_long * 5),
                ("rest", ctypes.c_long * 24)]
x.XOpenDisplay.restype = ctypes.c_void_p
x.XInternAtom.restype = ctypes.c_ulong
display = ctypes.c_void_p(x.XOpenDisplay(None))
atom = lambda name: x.XInternAtom(display, name, 0)
data = (ctypes.c_long * 5)(atom(b"WM_DELETE_WINDOW"))
message = Message(33, 0, 1, display, {window}, atom(b"WM_PROTOCOLS"), 32, data)
x.XSendEvent(display, ctypes.c_ulong({window}), 0, ctypes.c_long(0), ctypes.byref(message))
x.XSync(display, 0)
"""


def wait_until(condition, what):
    """The first true value of the condition."""
    end = time.monotonic() + LIMIT
    while not (found := condition()):
        assert time.monotonic() < end, f"waited {LIMIT} s in vain for {what}"
        time.sleep(0.02)
    return found


class Screen:
    """Xvfb, on a display number of its own."""

    def __init__(self, folder):
        reading, writing = os.pipe()
        arguments = ["-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"]
        self.process = subprocess.Popen(
            ["Xvfb", *arguments, "-noreset", "-fbdir", folder],
            pass_fds=[writing],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(writing)
        with os.fdopen(reading) as number:
            self.display = f":{number.readline().strip()}"
        assert self.display != ":", "Xvfb does not start"
        self.pixels = folder / "Xvfb_screen0"

    def environment(self):
        hidden = ("WAYLAND_DISPLAY", "XAUTHORITY")
        return {k: v for k, v in os.environ.items() if k not in hidden} | {"DISPLAY": self.display}

    def read(self):
        """What is on it: height x width x 3 bytes, from the file of XWD that Xvfb keeps."""
        content = self.pixels.read_bytes()
        header = np.frombuffer(content, ">u4", 25)
        width, height, line, colors = (int(header[i]) for i in (4, 5, 12, 19))
        begin = int(header[0]) + 12 * colors
        rows = np.frombuffer(content, np.uint8, line * height, begin).reshape(height, line)
        return rows.reshape(height, -1, 4)[:, :width, 2::-1]

    def close(self):
        self.process.terminate()
        self.process.wait()


class View:
    """A running `hlodbench view`. Without a window manager the window is at the upper left."""

    def __init__(self, screen, log, *arguments):
        self.screen = screen
        self.log = log
        command = [os.environ["HLODBENCH_EXE"], "view", *map(str, arguments)]
        with log.open("w", encoding="utf-8") as stderr:
            self.process = subprocess.Popen(
                command,
                env=screen.environment(),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=stderr,
            )
        self.window = None

    def errors(self):
        return self.log.read_text(encoding="utf-8")

    def wait(self, condition, what):
        def check():
            found = condition()
            assert found or self.process.poll() is None, f"ended before {what}: {self.errors()}"
            return found

        try:
            return wait_until(check, what)
        except AssertionError as error:
            raise AssertionError(f"{error}; stderr: {self.errors()}") from None

    def wait_for_line(self, pattern, count=1):
        """The match, in what it said, of this line; of the count-th of them."""
        regex = re.compile(f"^{pattern}$", re.MULTILINE)
        matches = self.wait(
            lambda: found if len(found := list(regex.finditer(self.errors()))) >= count else None,
            f"line {count} of {pattern!r}",
        )
        return matches[count - 1]

    def find(self):
        """Waits for the window, which has the keys from then on."""
        search = ["search", "--onlyvisible", "--pid", self.process.pid]
        self.window = self.wait(lambda: self.xdotool(*search, check=False).split(), "a window")[0]
        self.focus()
        return self

    def open(self):
        """Waits until the scene is there."""
        self.find()
        self.wait_for_line("showing .*")
        return self

    def focus(self):
        self.xdotool("windowfocus", self.window)

    def focus_nothing(self):
        """Another window, which takes the keys, is asked for; it is the screen's root."""
        (root,) = self.xdotool("search", "--maxdepth", 0, ".*").split()
        self.xdotool("windowfocus", root)

    def xdotool(self, *arguments, check=True):
        result = subprocess.run(
            ["xdotool", *map(str, arguments)],
            env=self.screen.environment(),
            capture_output=True,
            text=True,
            timeout=LIMIT,
        )
        assert not check or result.returncode == 0, result.stderr
        return result.stdout

    def press(self, *keys):
        self.xdotool("key", *keys)

    def point(self, x, y):
        self.xdotool("mousemove", "--window", self.window, x, y)

    def drag(self, *steps, start=MIDDLE):
        """With the left button, by so many pixels each."""
        moves = []
        for step in steps:
            moves += ["mousemove_relative", "--", *step, "sleep", 0.02]
        to_start = ["mousemove", "--window", self.window, *start, "sleep", 0.1]
        self.xdotool(*to_start, "mousedown", 1, *moves, "mouseup", 1)

    def keep_picture(self, key="p"):
        """The path of the picture that the key makes."""
        pattern = r"wrote (.*\.png)"
        before = len(re.findall(f"^{pattern}$", self.errors(), re.MULTILINE))
        self.press(key)
        return self.wait_for_line(pattern, before + 1).group(1)

    def look(self):
        return read_picture(self.keep_picture())

    def wait_for_end(self):
        """The exit code. No window is left."""
        wait_until(lambda: self.process.poll() is not None, "the end of the program")
        return self.process.returncode

    def ask_to_close(self):
        """As the button does that a window manager draws: by WM_DELETE_WINDOW."""
        script = CLOSE.format(window=self.window)
        command = [sys.executable, "-c", script]
        subprocess.run(command, env=self.screen.environment(), check=True, timeout=LIMIT)

    def quit(self):
        self.press("ctrl+q")
        return self.wait_for_end()

    def kill(self):
        """Ends it as a crash does."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGKILL)
        self.process.wait()


def read_picture(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB")).astype(float)


def count_differing(a, b):
    """Pixels whose colour differs by more than rounding does."""
    assert a.shape == b.shape
    return int((np.abs(a - b).max(axis=2) > 8).sum())


def read_session(path):
    return json.loads(path.read_text(encoding="utf-8"))


def count_journal_poses(path):
    """The whole lines after the header; 0 where there is no journal yet."""
    return max(0, path.read_text(encoding="utf-8").count("\n") - 1) if path.exists() else 0


def record(view, journal, frames, step=(2, 1)):
    """Records, while orbiting, until at least so many poses are in the journal, then pauses."""
    view.press("r")
    view.wait(journal.exists, "a journal")
    while count_journal_poses(journal) < frames:
        view.drag(*[step] * 10)
        assert view.process.poll() is None, view.errors()
    view.press("r")


@pytest.fixture(scope="session")
def screen(hlodbench, tmp_path_factory):
    for program, package in (("Xvfb", "xvfb"), ("xdotool", "xdotool")):
        if shutil.which(program) is None:
            pytest.skip(f"{program} is missing (Debian: {package}): no window is tested")
    result = hlodbench("view", "none.hlod", "--frames", "1", env={"DISPLAY": ""})
    if "built without a window" in result.stderr:
        pytest.skip(result.stderr.strip())
    screen = Screen(tmp_path_factory.mktemp("screen"))
    yield screen
    screen.close()


@pytest.fixture
def start(screen, tmp_path):
    """Starts the program on a small view: start(SCENE, ...) gives a View."""
    views = []

    def start(*arguments, folder=tmp_path):
        fixed = ["--size", f"{SIZE[0]}x{SIZE[1]}", "--no-vsync", "--folder", folder]
        fixed += ["--cache", tmp_path / "cache"]
        log = tmp_path / f"stderr-{len(views)}.txt"
        views.append(View(screen, log, *arguments, *fixed))
        return views[-1]

    yield start
    for view in views:
        view.kill()


@pytest.fixture(scope="session")
def relief(hlodbench, tmp_path_factory):
    """A small hierarchy of some nodes."""
    folder = tmp_path_factory.mktemp("relief")
    hlod = folder / "relief.hlod"
    mesh = write_relief(folder / "relief.ply")
    result = hlodbench("build", mesh, "-o", hlod, "--max-triangles", "200")
    assert result.returncode == 0, result.stderr
    return hlod
