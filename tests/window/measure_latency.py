"""Measures for docs/viewer.md: start to the first moving picture, input to picture, ticks a second, what a pause costs.
No test.

    FUAI_PROGRAM=build/release/bin/fuai python3 tests/window/measure_latency.py

Input to picture: the paused view is turned by the mouse, and the frame buffer of the virtual display is looked at
until it shows it. Against the time from picture to picture that is a number of pictures.

SPDX-License-Identifier: Apache-2.0
"""
import json
import mmap
import os
import pathlib
import random
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from window_driver import PROGRAM, Display, wait_for

WIDTH, HEIGHT = 1280, 720
TURNS = 40
REST = 10.0  # seconds of pause
CLOTH_COLOURS = 100  # in the rows that are looked at: a shaded cloth, no empty window


class Watch:
    """A part of the frame buffer, as fast as it can be read."""

    def __init__(self, display):
        with open(display.buffer / "Xvfb_screen0", "rb") as file:
            self.pixels = mmap.mmap(file.fileno(), 0, prot=mmap.PROT_READ)
        self.offset = len(self.pixels) - 4 * WIDTH * HEIGHT

    def middle(self):
        """Rows across the cloths, without the places where times stand, and above the cursor, which the server draws."""
        rows = range(120, 500, 20)
        return b"".join(self.pixels[self.offset + 4 * (WIDTH * y + 330):self.offset + 4 * (WIDTH * y + 930)] for y in rows)

    def change(self, since, patience=20.0):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            now = self.middle()
            if now != since:
                return now, time.monotonic()
            time.sleep(0.0005)
        raise AssertionError("the picture does not change")


def program(display, folder, *words):
    environment = {"DISPLAY": display.name, "LIBGL_ALWAYS_SOFTWARE": "1", "XDG_CONFIG_HOME": str(folder),
                   "PATH": "/usr/bin:/bin", "HOME": str(folder)}
    return environment, subprocess.Popen([PROGRAM, "--json", "view", *words], env=environment, stdout=subprocess.PIPE,
                                         stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, text=True)


def do(environment, *words):
    subprocess.run(["xdotool", *map(str, words)], env=environment, check=False, capture_output=True)


def last_tick(record):
    return int([line for line in record.read_text().splitlines() if " hash " in line][-1].split()[0])


def cpu_seconds(pid):
    """User and system, of all threads."""
    words = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def cost(pid):
    before = cpu_seconds(pid)
    time.sleep(REST)
    return cpu_seconds(pid) - before


def measure(*words):
    folder = pathlib.Path(tempfile.mkdtemp())
    display = Display(folder)
    try:
        watch = Watch(display)
        start = time.monotonic()
        record = folder / "r.fuai-view"
        environment, view = program(display, folder, "--record", record, *words)
        first, shown = watch.middle(), 0.0
        while len(set(first[i:i + 4] for i in range(0, len(first), 4))) < CLOTH_COLOURS:
            first, shown = watch.change(first)
        _, moved = watch.change(first)
        window = wait_for("the window", lambda: subprocess.run(
            ["xdotool", "search", "--name", "^fuai$"], env=environment, capture_output=True, text=True,
            check=False).stdout.split())[0]
        do(environment, "windowfocus", window)
        ticks, began = last_tick(record), time.monotonic()
        time.sleep(5.0)
        rate = (last_tick(record) - ticks) / (time.monotonic() - began)
        playing = cost(view.pid)
        do(environment, "key", "space")
        time.sleep(2.0)
        paused = cost(view.pid)
        do(environment, "mousemove", 880, 600, "mousedown", 3)
        time.sleep(1.5)
        times = []
        place = 880
        for _ in range(TURNS):
            place = 860 if place == 880 else 880
            time.sleep(random.uniform(0.3, 0.5))  # any moment between two pictures
            before = watch.middle()
            sent = time.monotonic()
            do(environment, "mousemove", place, 600)
            times.append(1e3 * (watch.change(before)[1] - sent))
        do(environment, "mouseup", 3, "key", "ctrl+q")
        result = json.loads(view.communicate(timeout=60)[0])
        picture = result["picture_ms"]
        print(f"{' '.join(words) or 'no words'}: first picture after {shown - start:.2f} s, moving after "
              f"{moved - start:.2f} s; input to picture {statistics.median(times):.0f} ms (most {max(times):.0f}), a "
              f"picture takes {picture:.0f} ms: {statistics.median(times) / picture:.2f} pictures (most "
              f"{max(times) / picture:.2f}); {rate:.0f} ticks a second; in {REST:.0f} s {playing:.2f} s of "
              f"the processor while it plays, {paused:.2f} s paused")
    finally:
        display.stop()
        shutil.rmtree(folder)


if __name__ == "__main__":
    measure(*sys.argv[1:])
