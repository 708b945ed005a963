"""What xdotool cannot do, by Xlib itself: files dropped as a file manager does (XDND version 5, the source's side), a
window asked to close.

SPDX-License-Identifier: Apache-2.0
"""
import ctypes
import os
import pathlib
import select
import time

CLIENT_MESSAGE, SELECTION_NOTIFY, SELECTION_REQUEST = 33, 31, 30
PROPERTY_REPLACE, ATOM_ATOM = 0, 4
VERSION = 5


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("window", ctypes.c_ulong), ("message", ctypes.c_ulong),
                ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class SelectionRequest(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("owner", ctypes.c_ulong), ("requestor", ctypes.c_ulong),
                ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong), ("property", ctypes.c_ulong),
                ("time", ctypes.c_ulong)]


class SelectionNotify(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int),
                ("display", ctypes.c_void_p), ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong),
                ("target", ctypes.c_ulong), ("property", ctypes.c_ulong), ("time", ctypes.c_ulong)]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("message", ClientMessage), ("request", SelectionRequest),
                ("notify", SelectionNotify), ("room", ctypes.c_long * 24)]


def load_xlib():
    x = ctypes.CDLL("libX11.so.6")
    x.XOpenDisplay.restype = ctypes.c_void_p
    x.XOpenDisplay.argtypes = [ctypes.c_char_p]
    x.XDefaultRootWindow.restype = x.XCreateSimpleWindow.restype = x.XInternAtom.restype = ctypes.c_ulong
    x.XDefaultRootWindow.argtypes = x.XCloseDisplay.argtypes = [ctypes.c_void_p]
    x.XFlush.argtypes = x.XPending.argtypes = x.XConnectionNumber.argtypes = [ctypes.c_void_p]
    x.XInternAtom.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
    x.XCreateSimpleWindow.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_int, ctypes.c_uint,
                                      ctypes.c_uint, ctypes.c_uint, ctypes.c_ulong, ctypes.c_ulong]
    x.XSetSelectionOwner.argtypes = [ctypes.c_void_p] + 3 * [ctypes.c_ulong]
    x.XNextEvent.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    x.XSendEvent.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_int, ctypes.c_long, ctypes.c_void_p]
    x.XChangeProperty.argtypes = [ctypes.c_void_p, ctypes.c_ulong, ctypes.c_ulong, ctypes.c_ulong, ctypes.c_int,
                                  ctypes.c_int, ctypes.c_char_p, ctypes.c_int]
    return x


class XClient:
    def __init__(self, display):
        self.x = load_xlib()
        self.display = self.x.XOpenDisplay(display.encode())
        if not self.display:
            raise OSError(f"cannot open display {display}")
        root = self.x.XDefaultRootWindow(self.display)
        self.window = self.x.XCreateSimpleWindow(self.display, root, 0, 0, 1, 1, 0, 0, 0)

    def atom(self, name):
        return self.x.XInternAtom(self.display, name.encode(), 0)

    def ask_to_close(self, target):
        """As the cross of a window does."""
        self.send(target, "WM_PROTOCOLS", self.atom("WM_DELETE_WINDOW"), 0)

    def send(self, target, name, *data):
        event = Event()
        event.message = ClientMessage(CLIENT_MESSAGE, 0, 1, self.display, target, self.atom(name), 32,
                                      (ctypes.c_long * 5)(*data))
        self.x.XSendEvent(self.display, target, 0, 0, ctypes.byref(event))
        self.x.XFlush(self.display)

    def answer(self, request, text):
        """Hands the list of files over where it is asked for."""
        self.x.XChangeProperty(self.display, request.requestor, request.property, request.target, 8,
                               PROPERTY_REPLACE, text, len(text))
        event = Event()
        event.notify = SelectionNotify(SELECTION_NOTIFY, 0, 1, self.display, request.requestor, request.selection,
                                       request.target, request.property, request.time)
        self.x.XSendEvent(self.display, request.requestor, 0, 0, ctypes.byref(event))
        self.x.XFlush(self.display)

    def wait(self, name, text, end):
        """Until the target sends a message; answers what it asks for meanwhile."""
        wanted = self.atom(name)
        while time.monotonic() < end:
            while self.x.XPending(self.display):
                event = Event()
                self.x.XNextEvent(self.display, ctypes.byref(event))
                if event.type == SELECTION_REQUEST:
                    self.answer(event.request, text)
                elif event.type == CLIENT_MESSAGE and event.message.message == wanted:
                    return list(event.message.data)
            select.select([self.x.XConnectionNumber(self.display)], [], [], 0.2)
        raise AssertionError(f"the window sent no {name}")

    def drop(self, target, paths, place, patience):
        """Drops files on a window, and returns when it has taken them. @param place in pixels of the screen"""
        end = time.monotonic() + patience
        text = "".join(pathlib.Path(os.path.abspath(p)).as_uri() + "\r\n" for p in paths).encode()
        self.x.XSetSelectionOwner(self.display, self.atom("XdndSelection"), self.window, 0)
        self.send(target, "XdndEnter", self.window, VERSION << 24, self.atom("text/uri-list"), 0, 0)
        self.send(target, "XdndPosition", self.window, 0, place[0] << 16 | place[1], 0, self.atom("XdndActionCopy"))
        if not self.wait("XdndStatus", text, end)[1] & 1:
            raise AssertionError("the window takes no files")
        self.send(target, "XdndDrop", self.window, 0, 0, 0, 0)
        self.wait("XdndFinished", text, end)

    def close(self):
        self.x.XCloseDisplay(self.display)
