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


def parse(path):
    """The root of a VTK file and the bytes appended to it, from _ on."""
    head, mark, rest = path.read_bytes().partition(b"<AppendedData")
    if mark:
        head += b"</VTKFile>"
    return (xml.etree.ElementTree.fromstring(head),
            memoryview(rest)[rest.find(b"_") + 1:])


def decode_appended(element, kind, is_compressed, header, appended):
    """The numbers of a DataArray that stand at the end of the file."""
    data = appended[int(element.get("offset")):]
    header = numpy.dtype(header)
    first = int(numpy.frombuffer(data, header, 1)[0])
    if not is_compressed:
        return numpy.frombuffer(
            data[header.itemsize:header.itemsize + first], kind)
    sizes = numpy.frombuffer(data, header, 3 + first)[3:].astype(int)
    begin, raw = (3 + first) * header.itemsize, []
    for length in sizes:
        raw.append(zlib.decompress(data[begin:begin + length]))
        begin += length
    return numpy.frombuffer(b"".join(raw), kind)


def decode(element, is_compressed, header, appended=b""):
    """The numbers of a DataArray."""
    kind = numpy.dtype(TYPES[element.get("type")])
    if element.get("format") == "appended":
        return decode_appended(element, kind, is_compressed, header, appended)
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


def plain_name(element):
    """The name of an array without its unit."""
    return (element.get("Name") or "").split(" (")[0]


def arrays_of(piece, names, *how):
    """Points, connectivity, offsets and the named fields of a piece; `at_cells`
    are the names of those at cells."""
    found, at_cells = {}, set()
    for parent in piece:
        for element in parent.iter("DataArray"):
            name = "points" if parent.tag == "Points" else plain_name(element)
            if name in names or name in ("points", "connectivity", "offsets"):
                values = decode(element, *how)
                n = int(element.get("NumberOfComponents") or 1)
                found[name] = values.reshape(-1, n) if n > 1 else values
                if parent.tag == "CellData":
                    at_cells.add(name)
    return {**found, "at_cells": at_cells}


def read_pieces(path, names):
    """The pieces of a .vtu file, or of those that a .pvtu collects."""
    try:
        root, appended = parse(path)
        if path.suffix == ".pvtu":
            return [part for piece in root.iter("Piece") for part in
                    read_pieces(path.parent / piece.get("Source"), names)]
        header = TYPES[root.get("header_type", "UInt32")]
        return [arrays_of(piece, names, bool(root.get("compressor")), header,
                          appended) for piece in root.iter("Piece")]
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
                values = piece[name]
                fields[name].append(
                    numpy.stack([values] * order.shape[1], axis=1)
                    if name in piece["at_cells"] else values[order])
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
