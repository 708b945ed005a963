"""A viewer on a virtual display of its own, driven by real mouse and key events, and its screen read back.

What is waited for is a condition, never a time: a line of the recording, a file, a picture.

SPDX-License-Identifier: Apache-2.0
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import window_pictures
from x_client import XClient

PROGRAM = os.environ["FUAI_PROGRAM"]
PATIENCE = 60.0  # seconds that anything may take on a busy machine; nothing is measured
CLOTH_BOX, CLOTH_LIGHT = 24, 100  # pixels, of 255: the ground has less than 70
LONG_STEP = 100  # ticks of Shift+Right
HASH_TICKS = 100
SETTLED = 1.5    # seconds without a change before a reference is taken anew
STILL = 0.1      # mean difference of 255 that is none: times in the bar below


def wait_for(what, condition, patience=PATIENCE):
    end = time.monotonic() + patience
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.03)
    raise AssertionError(f"waited in vain for {what}")


class Display:
    """Xvfb with its frame buffer in a file."""

    def __init__(self, folder, width=1280, height=720):
        self.width, self.height = width, height
        self.buffer = pathlib.Path(folder) / "screen"
        self.buffer.mkdir()
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24",
                                        "-fbdir", str(self.buffer), "-noreset"],
                                       pass_fds=[write], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            self.name = ":" + pipe.readline().strip()
        self.client = XClient(self.name)

    def picture(self):
        return window_pictures.read_screen(self.buffer / "Xvfb_screen0")

    def stop(self):
        self.client.close()
        self.server.terminate()
        self.server.wait()


class Window:
    """A viewer on a display. @param environment more variables of the program @param cloth its fabrics and scene"""

    # Where things are on 1280 x 720, with both panels.
    MIDDLE = (640, 330)
    CLOTH = ("wool-tropical", "--scene", "hanging_sheet", "--size", "17", "--spacing", "2cm")

    def __init__(self, display, folder, *words, out=None, environment=None, cloth=CLOTH):
        self.display, self.folder = display, pathlib.Path(folder)
        self.settings = self.folder / "config" / "fuai" / "viewer.toml"
        self.environment = {**os.environ, "DISPLAY": display.name, "LIBGL_ALWAYS_SOFTWARE": "1",
                            "XDG_CONFIG_HOME": str(self.folder / "config")}
        self.record = self.folder / "r.fuai-view"
        self.program = subprocess.Popen(
            [PROGRAM, "--json", "view", *cloth, "--record", str(self.record), "--out", str(out or self.folder), *words],
            env={**self.environment, **(environment or {})}, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True,
            restore_signals=False)  # SIGXFSZ stays ignored: a limit of file sizes is a full disk
        self.window = wait_for("the window", self.find)
        wait_for("the focus", self.focus)

    # ---- input ----
    def do(self, *words, check=True):
        run = subprocess.run(["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True,
                             timeout=PATIENCE)
        if check and run.returncode != 0:
            raise AssertionError(run.stderr)
        return run.stdout

    def find(self):
        if self.program.poll() is not None:
            raise AssertionError(self.program.communicate()[1])
        found = self.do("search", "--name", "^fuai$", check=False).split()
        return found[0] if found else None

    def focus(self):
        self.do("windowfocus", self.window, check=False)  # refused until the window is there to be seen
        return self.do("getwindowfocus", check=False).strip() == self.window

    def key(self, *names):
        self.do("key", "--delay", "1", *names)

    def move(self, place):
        self.do("mousemove", *place)

    def click(self, place, button="1"):
        self.do("mousemove", *place, "click", button)

    def press(self, place, button="1"):
        self.do("mousemove", *place, "mousedown", button)

    def release(self, button="1"):
        self.do("mouseup", button)

    def cloth_at(self, place):
        """Whether something light is there; on dark ground that is cloth."""
        left, top = (v - CLOTH_BOX // 2 for v in place)
        cell = self.display.picture().part((left, top, left + CLOTH_BOX, top + CLOTH_BOX)).shrink(1, 1)[0]
        return min(cell) > CLOTH_LIGHT

    def grab(self, place):
        wait_for("cloth under the cursor", lambda: self.cloth_at(place))
        grabs = len(self.events("grab", 0))
        self.press(place)
        wait_for("a grab", lambda: self.events("grab", grabs + 1))

    def steps(self, count):
        """So many ticks of a paused window, hundreds of them: the same cloth on every machine. Waits for the last."""
        assert count % LONG_STEP == 0
        self.key(*["shift+Right"] * (count // LONG_STEP))
        self.tick += count
        self.wait_for_tick()

    def wait_for_tick(self):
        """A tick of whole hundreds is told when the step after it begins; what is waited for ends one after."""
        wait_for(f"tick {self.tick}", lambda: any(line.startswith(f"{self.tick - 1} hash") for line in self.lines()))

    def pull(self, place, notches):
        """Grabs in a paused window and pulls with the wheel, a tenth of a second each notch: towards the eye, where
        the cloth is drawn taut. Pushed together it would fold by the last bit of its numbers, which differ from
        processor to processor."""
        self.grab(place)
        for _ in range(notches):
            moves = len(self.events("move", 0))
            self.do("click", "5")
            wait_for("the hand to move", lambda: self.events("move", moves + 1))
            self.steps(LONG_STEP)

    # ---- what happened ----
    def lines(self):
        return self.record.read_text(encoding="utf-8").splitlines() if self.record.exists() else []

    def events(self, kind, count=1):
        """The recorded events of a kind when there are so many."""
        found = [line for line in self.lines() if f" {kind}" in line and line[:1].isdigit()]
        return found if len(found) >= count else None

    def parts(self):
        """The fabrics of each part of the recording, as (hash, factors, name)."""
        parts = []
        for line in self.lines():
            if line.startswith("part "):
                parts.append([])
            elif line.startswith("fabric "):
                parts[-1].append(line.split())
        return parts

    def pause_at_the_start(self):
        """Paused one tick after whole hundreds, and the cloth as the scene begins."""
        resets = len(self.events("reset", 0))
        hashes = len(self.events("hash", 0))
        wait_for("time to go", lambda: self.events("hash", hashes + 1))
        self.key("space")
        self.key("r")
        now = int(wait_for("the start", lambda: self.events("reset", resets + 1))[-1].split()[0])
        steps = (1 - now) % HASH_TICKS
        self.tick = now + steps
        if steps > 0:
            self.do("key", "--delay", "4", *["Right"] * steps)
            self.wait_for_tick()
        self.key("r")
        wait_for("the start", lambda: self.events("reset", resets + 2))

    # ---- the end ----
    def close(self):
        self.key("ctrl+q")
        return self.ended()

    def ended(self):
        out, err = self.program.communicate(timeout=PATIENCE)
        return self.program.returncode, out, err

    def kill(self):
        if self.program.poll() is None:
            self.program.send_signal(signal.SIGKILL)
            self.program.communicate()
        elif not self.program.stderr.closed:  # it ended before it was asked to
            print(f"the program ended with {self.program.returncode}:\n{self.program.communicate()[1]}")


class WindowTest(unittest.TestCase):
    """A test with a folder of its own."""

    updates = False  # references are made anew

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def open(self, *words, width=1280, height=720, **more):
        display = Display(self.folder, width, height)
        self.addCleanup(display.stop)
        window = Window(display, self.folder, *words, **more)
        self.addCleanup(window.kill)
        return window

    def looks_like(self, window, name, box=None, pulled=False, times=None):
        """Waits until the screen is the reference's picture; with --update-references makes it anew.

        @param times: where a small window writes how long things take, to be left out"""
        path = window_pictures.REFERENCES / (name + ".png")

        def screen():
            picture = window.display.picture().part(box) if box else window.display.picture()
            return window_pictures.without(picture, times) if times else picture

        if WindowTest.updates:
            window_pictures.write_reference(path, self.settled(screen))
        reference = window_pictures.read_reference(path)
        try:
            wait_for(name, lambda: window_pictures.alike(screen(), reference, pulled), PATIENCE / 2)
        except AssertionError:
            mean, strong = window_pictures.difference(screen(), reference)
            folder = pathlib.Path(os.environ.get("FUAI_PICTURES", tempfile.gettempdir()))
            window_pictures.write_reference(folder / (name + "-found.png"), screen())
            raise AssertionError(f"the window is not as {path}: mean {mean:.2f}, strong {strong:.3f}; "
                                 f"it is in {folder}/{name}-found.png") from None
        if "FUAI_PICTURES" in os.environ:
            mean, strong = window_pictures.difference(screen(), reference)
            print(f"{name}: mean {mean:.3f}, strong {strong:.4f}")

    @staticmethod
    def settled(screen):
        before, now = None, screen()
        while before is None or window_pictures.difference(before, now)[0] > STILL:
            time.sleep(SETTLED)
            before, now = now, screen()
        return now

    def replay(self, path):
        run = subprocess.run([PROGRAM, "--json", "replay", str(path)], capture_output=True, text=True, check=False)
        return run.returncode, json.loads(run.stdout)


def main():
    """unittest.main(), and --update-references."""
    words = [word for word in sys.argv if word != "--update-references"]
    WindowTest.updates = len(words) < len(sys.argv)
    unittest.main(argv=words)
