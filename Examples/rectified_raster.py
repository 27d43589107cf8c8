# SPDX-License-Identifier: BSD-3-Clause
"""A raster with gaps: people of an island, as a GeoTIFF whose sea is nodata."""
import struct

import numpy as np

NODATA = -9999.0
CELL = 1000.0  # metres


def island(columns=240, rows=160):
    """People per square kilometre of an island with bays, a lake and three towns, in rows from north to
    south; NODATA at sea."""
    x, y = np.meshgrid((np.arange(columns) + 0.5) / rows, (np.arange(rows) + 0.5) / rows)
    x, y = x - columns / rows / 2, 0.5 - y
    angle = np.arctan2(y, x)
    coast = 1 + 0.16 * np.cos(3 * angle + 0.7) + 0.1 * np.sin(5 * angle) + 0.05 * np.cos(11 * angle)
    land = np.hypot(x / 1.45, y) < 0.32 * coast
    land &= np.hypot((x - 0.08) / 1.5, y - 0.1) > 0.045  # a lake
    people = 40 + 50 * x
    for (at_x, at_y), width, most in (((-0.22, -0.06), 0.08, 320), ((0.3, -0.02), 0.06, 250),
                                      ((0.02, -0.17), 0.05, 200)):
        people += most * np.exp(-((x - at_x) ** 2 + (y - at_y) ** 2) / (2 * width ** 2))
    return np.where(land, people, NODATA)


def write_geotiff(path, values, nodata=NODATA, corner=(400000.0, 5600000.0), cell=CELL):
    """Rows from north to south as 32-bit floats, in metres of UTM zone 32N. Without nodata (None), the
    file names no such value."""
    rows, columns = values.shape
    data = np.ascontiguousarray(values, "<f4").tobytes()
    keys = (1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32632)
    short, long, text, double = 3, 4, 2, 12  # types of TIFF
    tags = [(256, long, [columns]), (257, long, [rows]), (258, short, [32]), (259, short, [1]),
            (262, short, [1]), (273, long, [0]), (277, short, [1]), (278, long, [rows]),
            (279, long, [len(data)]), (339, short, [3]), (33550, double, [cell, cell, 0.0]),
            (33922, double, [0.0, 0.0, 0.0, *corner, 0.0]), (34735, short, keys)]
    if nodata is not None:
        tags.append((42113, text, b"%g\0" % nodata))
    end = 8 + 2 + 12 * len(tags) + 4  # of the directory
    packed, further = [], b""
    for number, kind, value in tags:
        content = bytes(value) if kind == text else struct.pack(
            "<%d%s" % (len(value), {short: "H", long: "I", double: "d"}[kind]), *value)
        count = len(value)
        if len(content) > 4:
            further, content = further + content + b"\0" * (len(content) % 2), struct.pack(
                "<I", end + len(further))
        packed.append(struct.pack("<HHI", number, kind, count) + content.ljust(4, b"\0"))
    packed[5] = packed[5][:8] + struct.pack("<I", end + len(further))  # where the data begin
    with open(path, "wb") as file:
        file.write(b"II*\0" + struct.pack("<IH", 8, len(tags)) + b"".join(packed) + b"\0\0\0\0" +
                   further + data)
