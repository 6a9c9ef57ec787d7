# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the VTU files that a run writes, with numpy alone.

So that a report needs neither VTK nor a display. Fields may be written at points
or at cells, as numbers of any kind, stress as a tensor or by its components;
points may be shared by cells or not: at_corners looks them up by name."""
import base64
import xml.etree.ElementTree
import zlib

import numpy

from .reading import ReportError

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1",
         "Int64": "<i8", "UInt32": "<u4", "UInt64": "<u8", "Int8": "i1",
         "Int16": "<i2", "UInt16": "<u2"}
COMPONENTS = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1),
              "yz": (1, 2), "xz": (0, 2)}  # in VTK's order


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


def plain_name(element):
    """The name of an array without its unit."""
    return (element.get("Name") or "").split(" (")[0]


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


def arrays_of(piece, names, *how):
    """Points, connectivity, offsets and named fields of a piece.

    Fields of points and of cells stand in two dictionaries of their own; without
    names all are read."""
    found = {"PointData": {}, "CellData": {}}
    for parent in piece:
        for element in parent.iter("DataArray"):
            name = plain_name(element)
            if parent.tag == "Points":
                into, name = found, "points"
            elif parent.tag == "Cells":
                into = found
            else:
                into = found.get(parent.tag, {})
                if names is not None and name not in names:
                    continue
            values = decode(element, *how)
            n = int(element.get("NumberOfComponents") or 1)
            into[name] = values.reshape(-1, n) if n > 1 else values
    return found


def read_pieces(path, names):
    """The pieces of a .vtu file, or of those that a .pvtu collects."""
    try:
        root, appended = parse(path)
        if path.suffix == ".pvtu":
            return [part for piece in root.iter("Piece") for part in
                    read_pieces(path.parent / piece.get("Source"), names)]
        header = TYPES[root.get("header_type", "UInt32")]
        return [arrays_of(piece, names, bool(root.get("compressor")), header,
                          appended)
                for piece in root.iter("Piece")]
    except (OSError, ValueError, KeyError, TypeError, zlib.error,
            xml.etree.ElementTree.ParseError) as error:
        why = getattr(error, "strerror", None) or error
        raise ReportError(f"'{path}' cannot be read ({why}).") from None


def at_corners(piece, name, order):
    """Values (cells, n, ...) of a field at the corners of cells.

    `order` (cells, n) are the points of the cells. What is written by cells is
    the same at all corners; KeyError if there is no such field."""
    if name in piece["PointData"]:
        return piece["PointData"][name][order]
    values = piece["CellData"][name]
    return numpy.repeat(values[:, None], order.shape[1], axis=1)


def at_cells(piece, name, first):
    """A value of a field for each cell, which begins with the point `first`."""
    if name in piece["CellData"]:
        return piece["CellData"][name]
    return piece["PointData"][name][first]


def names_of(piece):
    """Names of all fields of a piece."""
    return [*piece["PointData"], *piece["CellData"]]


def read_cells(path, names=None, optional=()):
    """Corners (cells, n, 3) and fields at them (cells, n, ...) of a grid.

    Without names all fields; of those asked for every one has to be there but
    those that are optional."""
    corners, fields = [], {}
    wanted = None if names is None else [*names, *optional]
    try:
        for piece in read_pieces(path, wanted):
            n_cells = len(piece.get("offsets", ()))
            if not n_cells:
                continue
            order = piece["connectivity"].reshape(n_cells, -1)
            corners.append(piece["points"].reshape(-1, 3)[order] + 0.)
            shown = names_of(piece)
            if names is not None:
                shown = [*names, *(n for n in optional if n in shown)]
            for name in shown:
                fields.setdefault(name, []).append(
                    at_corners(piece, name, order))
    except (KeyError, IndexError, ValueError) as error:
        raise ReportError(f"'{path}' is damaged ({error}).") from None
    if not corners:
        return numpy.empty((0, 0, 3), numpy.float32), {}
    return numpy.concatenate(corners), {
        name: numpy.concatenate(values) for name, values in fields.items()}


def split_stress(fields):
    """Fields with the stress by its components, stress_xx and so on."""
    fields = dict(fields)
    stress = fields.pop("stress", None)
    if stress is None:
        return fields
    if stress.shape[-1] == 9:
        places = {name: 3 * a + b for name, (a, b) in COMPONENTS.items()}
    else:
        places = {name: k for k, name in enumerate(COMPONENTS)}
    for name, place in places.items():
        if place < stress.shape[-1]:
            fields[f"stress_{name}"] = stress[..., place]
    return fields


def stress_of(fields):
    """Stress (..., 3, 3) by the fields of a grid, or None without any."""
    fields = split_stress(fields)
    if "stress_xx" not in fields:
        return None
    stress = numpy.zeros((*fields["stress_xx"].shape, 3, 3))
    for name, (a, b) in COMPONENTS.items():
        if f"stress_{name}" in fields:
            stress[..., a, b] = stress[..., b, a] = fields[f"stress_{name}"]
    return stress


STRESS = ("stress", *(f"stress_{name}" for name in COMPONENTS))


def largest_pressure(fields):
    """Major principal stress of cells, pressed: +, or None without stress."""
    stress = stress_of({name: values[:, 0] for name, values in fields.items()
                        if name in STRESS})
    return None if stress is None else -numpy.linalg.eigvalsh(stress)[:, 0]


def read_polygons(path, names):
    """Polygons of different numbers of corners, and a value each by field."""
    polygons, fields = [], {name: [] for name in names}
    for piece in read_pieces(path, names):
        if not len(piece.get("offsets", ())):
            continue
        points = piece["points"].reshape(-1, 3)
        parts = numpy.split(piece["connectivity"].astype(int),
                            piece["offsets"][:-1].astype(int))
        polygons += [points[part] for part in parts]
        first = numpy.array([part[0] for part in parts])
        for name in names:
            if name in names_of(piece):
                fields[name] += list(at_cells(piece, name, first))
    return polygons, fields
