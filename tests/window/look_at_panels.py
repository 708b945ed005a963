"""Takes pictures of every panel, menu, tooltip and message, in both languages and themes, for people to look at. No test.

    FUAI_PROGRAM=build/ci/bin/fuai python3 tests/window/look_at_panels.py FOLDER [TOUR ...]

FOLDER gets a sheet of each look: English dark, Japanese dark, English light, Japanese light. Tours: panels, compare,
device, replay (1280 x 720, both languages and themes), scenes, sizes (whole windows). Without a name all of them, some
minutes. Where a menu stands is asked of its language; a look that shows something else than its name is a fault of the
places below.

SPDX-License-Identifier: Apache-2.0
"""
import itertools
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

from window_driver import PATIENCE, PROGRAM, Display, Window, wait_for
from window_pictures import Picture, chunk

# What a window shows is looked at after so long: nothing is measured, and a picture is drawn in a quarter of it.
REST = 0.9  # seconds
WIDE = (1280, 720)
KINDS = [(language, theme) for theme in ("dark", "light") for language in ("en", "ja")]
LEFT, RIGHT, BELOW = (0, 0, 316, 720), (932, 0, 1280, 720), (0, 640, 1280, 720)
ALL, VIEW, UPPER = (0, 0, *WIDE), (316, 24, 932, 652), (0, 0, 640, 400)
# Middles of the names in the menu bar: File, Edit, View; the two lists of the bar.
MENUS = {"en": (20, 55, 92), "ja": (32, 80, 117)}
LISTS = {"en": (270, 480), "ja": (300, 520)}
NOWHERE = (160, 640)
FACTS = {"composition": (60, 88), "symbol": (12, 185), "value": (120, 147)}
SCENES = ("hanging_sheet", "hanging_strip", "taut_patch", "yank", "shake", "bending", "corner_drape", "grasp_and_lift",
          "table_edge", "drape_tester")
HEAT_MAPS = ("warp-strain", "weft-strain", "shear-angle", "warp-curvature", "weft-curvature", "warp-moment",
             "weft-moment", "warp-tension", "weft-tension", "shear-force", "energy", "speed")


def write_png(path, picture):
    rows = b""
    for row in picture.rows:
        line = bytearray(3 * picture.width)
        for channel in range(3):
            line[channel::3] = row[2 - channel::4]
        rows += b"\0" + line
    header = struct.pack(">IIBBBBB", picture.width, picture.height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 6)) +
                     chunk(b"IEND", b""))


def sheet_of(parts):
    """All of a size, side by side where they are tall, above each other where they are wide, else two by two."""
    width, height = parts[0].width, parts[0].height
    columns = len(parts) if height > 1.6 * width else 1 if width > 3 * height else 2
    empty = bytes(4 * width)
    rows = []
    for first in range(0, len(parts), columns):
        line = parts[first:first + columns]
        for y in range(height):
            rows.append(b"".join(part.rows[y] for part in line) + empty * (columns - len(line)))
    return Picture(columns * width, len(rows), rows)


class Look:
    """A window that is looked at, and the pictures of its kind."""

    def __init__(self, display, *words, **more):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.window = Window(display, self.folder, *words, **more)
        self.pictures = {}

    def take(self, name, box=ALL):
        time.sleep(REST)
        self.pictures[name] = self.window.display.picture().part(box)

    def at(self, place, name, box=ALL):
        """With the cursor there: what its tooltip says."""
        self.window.move(place)
        self.take(name, box)

    def open(self, place):
        """A menu or a list: the cursor must stay until the press is seen."""
        self.window.click(place)
        time.sleep(REST)

    def close(self):
        """A menu or a list: by a click where nothing is."""
        self.open(NOWHERE)

    def scroll(self, place, notches):
        self.window.move(place)
        time.sleep(REST)
        self.window.do("click", "--repeat", notches, "--delay", "30", "5")
        time.sleep(REST)

    def let_go_on(self, seconds):
        hashes = len(self.window.events("hash", 0))
        wait_for("time to go", lambda: self.window.events("hash", hashes + round(10 * seconds)))

    def pull(self, place, by, steps):
        """Drags the cloth, and holds it there."""
        self.window.grab(place)
        for i in range(1, steps + 1):
            self.window.move(tuple(round(p + d * i / steps) for p, d in zip(place, by)))
            time.sleep(0.1)

    def end(self):
        self.window.kill()
        shutil.rmtree(self.folder)


def menus(look, language):
    for name, x in zip(("file", "edit", "view"), MENUS[language]):
        look.open((x, 11))
        look.take(f"menu-{name}", UPPER)
        if name == "view":
            look.at((x + 40, 213), "menu-letters", UPPER)
        look.close()
    for name, x, y in zip(("scenes", "heat-maps"), LISTS[language], (130, 130)):
        look.open((x, 11))
        look.at((x - 20, y), f"list-{name}", (0, 0, 960, 400))
        look.close()


def fabric_page(look):
    for name, place in FACTS.items():
        look.at(place, f"fabric-{name}", UPPER)
    look.window.move(Window.MIDDLE)
    look.take("fabric", LEFT)
    look.scroll((150, 300), 20)
    look.at((12, 340), "fabric-scrolled", LEFT)
    look.window.key("u")
    look.take("fabric-si", LEFT)
    look.window.key("u")
    look.open((157, 65))
    look.at((80, 166), "fabrics", (0, 0, 640, 500))
    look.window.do("type", "wool")
    look.take("fabrics-searched", (0, 0, 640, 500))
    look.window.do("type", "xyz")
    look.take("fabrics-none", (0, 0, 640, 500))
    look.close()
    look.window.do("mousemove", 82, 423, "mousedown", 1, "mousemove", 110, 423)
    time.sleep(REST)
    look.window.release()
    look.take("fabric-changed", LEFT)
    look.window.key("ctrl+z")


def plots(look):
    look.take("plots-empty", RIGHT)
    look.window.key("space")
    look.pull((640, 400), (120, -80), 15)
    look.let_go_on(0.5)
    look.window.key("space")
    look.take("grab")
    look.take("plots-instrument", RIGHT)
    look.window.key("u")
    look.take("plots-si", RIGHT)
    look.window.key("u")
    look.window.release()
    look.at((1120, 460), "plots-tooltip", (760, 300, 1280, 720))
    look.window.click((1120, 460))
    look.take("plots-cloth", RIGHT)
    look.window.click((1120, 460))


def heat_maps(look):
    for name in HEAT_MAPS:
        look.window.key("h")
        look.take("heat-" + name, (632, 0, 932, 330))
        if name in ("warp-moment", "energy"):
            look.window.key("u")
            look.take(f"heat-{name}-si", (632, 0, 932, 330))
            look.window.key("u")
    look.take("heat-whole")
    look.window.key("h")


def panels(look, language):
    look.let_go_on(1.5)
    look.take("start")
    look.window.key("space")
    look.take("bar", BELOW)
    menus(look, language)
    fabric_page(look)
    plots(look)
    heat_maps(look)
    for x, name in ((30, "play"), (90, "back"), (300, "speed"), (400, "moves"), (800, "past")):
        look.at((x, 672), "bar-" + name, (0, 560, 1280, 720))
    look.window.move(Window.MIDDLE)
    look.window.key("F1")
    look.take("help")
    look.window.key("F1", "ctrl+o")
    look.take("open")
    look.window.key("ctrl+o")
    broken = look.folder / "broken.fabric.toml"
    broken.write_text('format = "fuai-fabric/1"\nname = ', encoding="utf-8")
    look.window.display.client.drop(int(look.window.window), [broken], Window.MIDDLE, PATIENCE)
    look.take("broken-file")
    look.window.key("F12", "ctrl+s", "F10")
    look.take("saved")
    look.window.key("F10")


def compare(look, language):
    look.let_go_on(1.5)
    look.pull((640, 230), (60, -60), 12)
    look.let_go_on(0.5)
    look.window.key("space")
    look.take("compare-2")
    look.window.release()
    look.take("compare-2-table", RIGHT)
    look.at((948, 117), "compare-2-name", (760, 0, 1280, 500))
    look.at((1180, 173), "compare-2-number", (760, 0, 1280, 500))
    look.window.key("c", "c")
    look.take("compare-4")
    look.take("compare-4-table", RIGHT)
    look.window.key("h")
    look.take("compare-4-heat")
    look.window.move((160, 40))
    look.take("compare-4-left", LEFT)
    look.scroll((1100, 300), 40)
    look.take("compare-4-scrolled", RIGHT)


def device(look, language):
    look.let_go_on(1.0)
    look.window.key("space")
    look.take("device")
    look.window.key("2")
    look.take("device-felt")


def no_device(look, language):
    look.let_go_on(0.5)
    look.take("device-missing")


def replay(look, language):
    look.let_go_on(0.5)
    look.window.key("space")
    look.take("replay")
    look.window.key("space")
    time.sleep(3.0)
    look.take("replay-over")


def recording(folder):
    """Of a hand that pulls."""
    display = Display(folder)
    window = Window(display, folder)
    wait_for("time to go", lambda: window.events("hash", 2))
    window.grab(Window.MIDDLE)
    window.move((700, 300))
    hashes = len(window.events("hash"))
    wait_for("time to go on", lambda: window.events("hash", hashes + 5))
    window.close()
    display.stop()
    return window.record


def in_all_kinds(folder, tour, *words, **more):
    scratch = pathlib.Path(tempfile.mkdtemp())
    display = Display(scratch)
    kinds = []
    for language, theme in KINDS:
        look = Look(display, "--language", language, "--theme", theme, *words, **more)
        try:
            tour(look, language)
        finally:
            look.end()
            kinds.append(look.pictures)
    display.stop()
    shutil.rmtree(scratch)
    for name in kinds[0]:
        write_png(folder / f"{name}.png", sheet_of([pictures[name] for pictures in kinds]))


def replay_tour(folder):
    scratch = pathlib.Path(tempfile.mkdtemp())
    in_all_kinds(folder, replay, "--replay", str(recording(scratch)))
    shutil.rmtree(scratch)


def scenes(folder):
    scratch = pathlib.Path(tempfile.mkdtemp())
    display = Display(scratch)
    for i, scene in enumerate(SCENES):
        language, theme = KINDS[i % len(KINDS)]
        look = Look(display, "--language", language, "--theme", theme, "--moves",
                    cloth=("cupro-woven-su1098", "--scene", scene))
        look.let_go_on(1.0)
        look.take("scene")
        look.end()
        write_png(folder / f"scene-{scene}.png", look.pictures["scene"])
    display.stop()
    shutil.rmtree(scratch)


def sizes(folder):
    """Without a window: a picture of 3840 x 2160 takes seconds on a processor."""
    for width, height, scale in [(3840, 2160, 100), (3840, 2160, 200), (1920, 1080, 100), (900, 600, 100), (640, 480, 100)]:
        for (language, theme), fabrics in itertools.product(KINDS[:1] + KINDS[3:], (FOUR[:1], FOUR)):
            name = folder / f"size-{width}x{height}-{scale}-{language}-{len(fabrics)}.png"
            subprocess.run([PROGRAM, "view", *fabrics, *Window.CLOTH[1:], "--headless", "--seconds", "0.5s", "--language",
                            language, "--theme", theme, "--scale", str(scale), "--width", str(width), "--height",
                            str(height), "--heat-map", "warp-moment", "--screenshot", str(name)], check=True,
                           stdout=subprocess.DEVNULL)


FOUR = ("cupro-woven-su1098", "wool-tropical", "graded-10", "polyester-faille")
TWO = ("wool-tropical", "graded-10", *Window.CLOTH[1:])
TOURS = {"panels": lambda folder: in_all_kinds(folder, panels),
         "compare": lambda folder: in_all_kinds(folder, compare, cloth=TWO),
         "device": lambda folder: (in_all_kinds(folder, device, "--device", "simulated:touch", cloth=TWO),
                                   in_all_kinds(folder, no_device, "--device", "forcedimension")),
         "replay": replay_tour, "scenes": scenes, "sizes": sizes}


def main():
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= set(TOURS):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for tour in sys.argv[2:] or TOURS:
        TOURS[tour](folder)


if __name__ == "__main__":
    main()
