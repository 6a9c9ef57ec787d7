# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rewrites VTU files of a run in another layout, to see that readers bear it.

Points are shared by the cells of a block, block, material and stress are of cells,
numbers of blocks are integers, stress is a tensor of nine components, all is ASCII.
"""
import array
import base64
import xml.etree.ElementTree
import zlib

KINDS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}
ORDER = ("xx", "xy", "xz", "xy", "yy", "yz", "xz", "yz", "zz")


def numbers(element):
    """The numbers of a compressed binary DataArray with 32 bit headers."""
    text = "".join(element.text.split())
    if element.get("format") == "ascii":
        return [float(word) for word in element.text.split()]
    n_parts, = array.array("I", base64.b64decode(text[:8])[:4])
    head = 4 * ((4 * (3 + n_parts) + 2) // 3)
    sizes = array.array("I", base64.b64decode(text[:head]))[3:]
    packed, raw, begin = base64.b64decode(text[head:]), b"", 0
    for size in sizes:
        raw += zlib.decompress(packed[begin:begin + size])
        begin += size
    return list(array.array(KINDS[element.get("type")], raw))


def rows(values, n):
    """Values in groups of n."""
    return [tuple(values[i:i + n]) for i in range(0, len(values), n)]


def data_array(name, kind, values, n=1):
    """A DataArray in ASCII, of rows or numbers."""
    flat = [x for row in values for x in row] if n > 1 else values
    text = " ".join(repr(x) for x in flat)
    return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{n}" '
            f'format="ascii">{text}</DataArray>')


def rewrite(path):
    """Write a file of the rock again in the other layout."""
    tree = xml.etree.ElementTree.parse(path)
    piece = next(tree.getroot().iter("Piece"))
    arrays = {e.get("Name") or "points": e for e in piece.iter("DataArray")}
    fields = {name: rows(numbers(e), int(e.get("NumberOfComponents") or 1))
              for name, e in arrays.items()}
    n_cells = len(fields["offsets"])
    order = rows([i for i, in fields["connectivity"]],
                 len(fields["connectivity"]) // n_cells)
    shared, kept, cells = {}, [], []
    for cell in order:
        cells.append([])
        for i in cell:
            key = (fields["points"][i], fields["block"][i],
                   fields["displacement"][i])
            if key not in shared:
                shared[key] = len(kept)
                kept.append(i)
            cells[-1].append(shared[key])
    first = [cell[0] for cell in order]
    of_cell = [data_array("block", "Int32", [int(fields["block"][i][0])
                                             for i in first]),
               data_array("material", "Int32", [int(fields["material"][i][0])
                                                for i in first]),
               data_array("stress", "Float64", [
                   tuple(fields.get(f"stress_{name}", {i: (0.,)})[i][0]
                         for name in ORDER) for i in first], 9)]
    of_point = [data_array(name, "Float32", [fields[name][i] for i in kept], 3)
                for name in ("displacement", "velocity")]
    path.write_text(
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
        'byte_order="LittleEndian"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="{len(kept)}" NumberOfCells="{n_cells}">'
        f'<Points>{data_array("", "Float32", [fields["points"][i] for i in kept], 3)}'
        "</Points><Cells>"
        + data_array("connectivity", "Int64", cells, len(order[0]))
        + data_array("offsets", "Int64", [int(i) for i, in fields["offsets"]])
        + data_array("types", "UInt8", [int(i) for i, in fields["types"]])
        + f'</Cells><PointData>{"".join(of_point)}</PointData><CellData>'
        f'{"".join(of_cell)}</CellData></Piece></UnstructuredGrid></VTKFile>\n')
    return len(kept), len(fields["points"])
