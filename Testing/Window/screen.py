# SPDX-License-Identifier: BSD-3-Clause
"""A screen of its own for a program with a window: Xvfb, whose picture is read from its frame buffer file."""
import contextlib
import os
import pathlib
import struct
import subprocess
import tempfile
import zlib

import numpy as np


class Screen:
    def __init__(self, name, folder):
        self.name, self.folder = name, pathlib.Path(folder)

    def pixels(self):
        """What the screen shows: shape (height, width, 3). The file is of the kind that xwd writes."""
        data = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", data[:100])
        width, height, bits, stride, colours = header[4], header[5], header[11], header[12], header[19]
        assert bits == 32, bits
        rows = np.frombuffer(data, np.uint8, height * stride, header[0] + 12 * colours).reshape(height, stride)
        return rows[:, :4 * width].reshape(height, width, 4)[:, :, 2::-1]

    def save(self, path, box=None):
        """Writes a PNG file of the screen, or of the box (x, y, width, height) of it."""
        pixels = self.pixels()
        if box:
            x, y, width, height = box
            pixels = pixels[y:y + height, x:x + width]
        height, width, _ = pixels.shape
        lines = np.zeros((height, 1 + 3 * width), np.uint8)
        lines[:, 1:] = pixels.reshape(height, -1)
        chunk = lambda kind, body: (  # noqa: E731
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))
        pathlib.Path(path).write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(lines.tobytes(), 9)) + chunk(b"IEND", b""))


@contextlib.contextmanager
def screen(width=1600, height=1000):
    """A Screen; programs find it by DISPLAY=screen.name."""
    with tempfile.TemporaryDirectory() as folder:
        reading, writing = os.pipe()
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{width}x{height}x24", "-fbdir", folder,
             "-nolisten", "tcp", "-noreset"], pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        try:
            with os.fdopen(reading) as pipe:
                number = pipe.readline().strip()
            if not number:
                raise RuntimeError("Xvfb does not start")
            yield Screen(":" + number, folder)
        finally:
            server.terminate()
            server.wait()
