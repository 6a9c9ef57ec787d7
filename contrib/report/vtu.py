# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the VTU files that a run writes, with numpy alone.

So that a report needs neither VTK nor a display."""
import base64
import xml.etree.ElementTree
import zlib

import numpy

from .reading import ReportError

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1",
         "Int64": "<i8", "UInt32": "<u4", "UInt64": "<u8", "Int8": "i1"}


def decode(element, is_compressed, header):
    """The numbers of a DataArray."""
    kind = numpy.dtype(TYPES[element.get("type")])
    text = element.text or ""
    if element.get("format") == "ascii":
        return numpy.array(text.split(), dtype=float).astype(kind)
    text = "".join(text.split())
    if not text:
        return numpy.empty(0, kind)
    size = numpy.dtype(header).itemsize

    def after(n_words):
        return 4 * ((size * n_words + 2) // 3)

    if not is_compressed:
        return numpy.frombuffer(base64.b64decode(text)[size:], kind)
    n_parts = numpy.frombuffer(base64.b64decode(text[:after(1)])[:size],
                               header)[0]
    head = after(3 + int(n_parts))
    sizes = numpy.frombuffer(base64.b64decode(text[:head]), header)[3:]
    packed, raw, begin = base64.b64decode(text[head:]), [], 0
    for length in sizes.astype(int):
        raw.append(zlib.decompress(packed[begin:begin + length]))
        begin += length
    return numpy.frombuffer(b"".join(raw), kind)


def arrays_of(piece, names, is_compressed, header):
    """Points, connectivity, offsets and the named fields of a piece."""
    found = {}
    for parent in piece:
        for element in parent.iter("DataArray"):
            name = ("points" if parent.tag == "Points" else
                    element.get("Name"))
            if name in names or name in ("points", "connectivity", "offsets"):
                values = decode(element, is_compressed, header)
                n = int(element.get("NumberOfComponents") or 1)
                found[name] = values.reshape(-1, n) if n > 1 else values
    return found


def read_pieces(path, names):
    """The pieces of a .vtu file, or of those that a .pvtu collects."""
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
        if path.suffix == ".pvtu":
            return [part for piece in root.iter("Piece") for part in
                    read_pieces(path.parent / piece.get("Source"), names)]
        header = TYPES[root.get("header_type", "UInt32")]
        return [arrays_of(piece, names, bool(root.get("compressor")), header)
                for piece in root.iter("Piece")]
    except (OSError, ValueError, KeyError, TypeError, zlib.error,
            xml.etree.ElementTree.ParseError) as error:
        why = getattr(error, "strerror", None) or error
        raise ReportError(f"'{path}' cannot be read ({why}).") from None


def read_cells(path, names):
    """Corners (cells, n, 3) and fields at them (cells, n, ...) of a grid."""
    corners, fields = [], {name: [] for name in names}
    try:
        for piece in read_pieces(path, names):
            n_cells = len(piece.get("offsets", ()))
            if not n_cells:
                continue
            order = piece["connectivity"].reshape(n_cells, -1)
            corners.append(piece["points"].reshape(-1, 3)[order] + 0.)
            for name in names:
                fields[name].append(piece[name][order])
    except (KeyError, IndexError, ValueError) as error:
        raise ReportError(f"'{path}' is damaged ({error}).") from None
    if not corners:
        return numpy.empty((0, 0, 3), numpy.float32), {}
    return numpy.concatenate(corners), {
        name: numpy.concatenate(values) for name, values in fields.items()}


def read_polygons(path, names):
    """Polygons of different numbers of corners, and a value each by field."""
    polygons, fields = [], {name: [] for name in names}
    for piece in read_pieces(path, names):
        if not len(piece.get("offsets", ())):
            continue
        points = piece["points"].reshape(-1, 3)
        for part in numpy.split(piece["connectivity"], piece["offsets"][:-1]):
            polygons.append(points[part.astype(int)])
        for name in names:
            fields[name] += list(piece.get(name, []))
    return polygons, fields
