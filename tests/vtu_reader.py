# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the VTU files of a run with Python alone."""
import pathlib
import struct
import xml.etree.ElementTree
import zlib

FORMATS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}
SECTIONS = ("FieldData", "PointData", "CellData", "Points", "Cells")


class VtuFile:
    """The elements of a VTU or PVTU file, and the numbers that they stand for."""

    def __init__(self, path):
        """Read the elements."""
        self.head, _, rest = pathlib.Path(path).read_bytes().partition(
            b"<AppendedData")
        self.appended = rest[rest.find(b"_") + 1:]
        self.root = xml.etree.ElementTree.fromstring(self.head + b"</VTKFile>")
        assert self.root.get("compressor") == "vtkZLibDataCompressor"

    def numbers(self, element, kind=None):
        """The numbers of an element, one after the other."""
        kind = kind or element.get("type")
        if element.get("format") == "ascii":
            convert = float if kind.startswith("Float") else int
            return tuple(map(convert, element.text.split()))
        begin = int(element.get("offset"))
        n_parts, *_ = struct.unpack_from("<I", self.appended, begin)
        sizes = struct.unpack_from(f"<{3 + n_parts}I", self.appended, begin)[3:]
        begin += 4 * (3 + n_parts)
        raw = b""
        for size in sizes:
            raw += zlib.decompress(self.appended[begin:begin + size])
            begin += size
        number = FORMATS[kind]
        return struct.unpack(
            f"<{len(raw) // struct.calcsize('<' + number)}{number}", raw)

    def text_list(self, element):
        """The texts of an element."""
        texts = bytes(self.numbers(element, "UInt8")).decode().split("\0")
        assert texts.pop() == ""
        assert len(texts) == int(element.get("NumberOfTuples"))
        return texts

    def values(self):
        """All numbers and texts of the file by SECTION/NAME."""
        return {f"{section.tag}/{element.get('Name')}":
                self.text_list(element) if element.tag == "Array"
                else self.numbers(element)
                for section in self.root.iter() if section.tag in SECTIONS
                for element in section}


class Grid(VtuFile):
    """A VTU file: points, cells as lists of points, and named arrays.

    An array holds a number by point or cell, or a tuple of its components; a
    text list what ids stand for."""

    def __init__(self, path):
        """Read all of it."""
        super().__init__(path)
        root = self.root
        piece, = root.iter("Piece")
        self.n_points = int(piece.get("NumberOfPoints"))
        self.n_cells = int(piece.get("NumberOfCells"))
        self.at_points = self.arrays(piece.find("PointData"), self.n_points)
        self.at_cells = self.arrays(piece.find("CellData"), self.n_cells)
        self.points, = self.arrays(piece.find("Points"),
                                   self.n_points).values()
        lists = {e.get("Name"): self.numbers(e) for e in piece.find("Cells")}
        begins = (0, *lists["offsets"])
        self.cells = [lists["connectivity"][a:b] for a, b in
                      zip(begins, lists["offsets"])]
        self.cell_types = lists["types"]
        assert len(self.cells) == len(self.cell_types) == self.n_cells
        self.types = {e.get("Name"): e.get("type")
                      for e in root.iter("DataArray")}
        self.texts = {element.get("Name"): self.text_list(element)
                      for element in root.iter("Array")}

    def arrays(self, parent, n):
        """The arrays of points or of cells, n entries each, by name."""
        found = {}
        for element in parent:
            numbers = self.numbers(element)
            width = int(element.get("NumberOfComponents"))
            assert len(numbers) == n * width, element.get("Name")
            found[element.get("Name")] = (
                list(numbers) if width == 1 else
                [numbers[width * i:width * (i + 1)] for i in range(n)])
        return found

    def called(self, ids):
        """The names that the ids of an array at points or cells stand for."""
        names = self.texts[f"{ids} names"]
        values = self.at_points.get(ids) or self.at_cells[ids]
        return [names[i] for i in values]
