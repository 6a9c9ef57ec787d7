# SPDX-License-Identifier: LGPL-2.1-or-later
"""Relations that change names, orders and numbers only."""
import random

from scene_domain import SIDES, CannotExpress, move_boundaries
from scene_places import Grid
from scene_relations import Mapping, Variant
from scene_tree import list_of_names, points_of, text_of_points


def written(scene):
    """The scene with all of its entries, as a run writes it into used.prm."""
    return Variant(scene.tree)


# sections whose names others use, and the entries that do
USES = {"Joints": ["Safety factor/Joints", "Stages/NAME/Drained joints",
                   "Joints/NAME/Surface"],
        "Materials": ["Excavations/NAME/Backfill material"],
        "Bolts": [], "Shotcrete": [], "Supports": [], "Tractions": []}


def rename(tree, title, names):
    """Give the things of a section new names, everywhere."""
    section = tree.find(title)
    section.sections = {names.get(name, name): inner
                        for name, inner in section.sections.items()}
    tree.set(f"{title}/Names", ", ".join(
        names[name] for name in list_of_names(section.entries["Names"])))
    for path, value in list(tree.items()):
        parts = path.split("/")
        kind = path if len(parts) < 3 else f"{parts[0]}/NAME/{parts[-1]}"
        if kind in USES[title]:
            tree.set(path, ", ".join(names.get(name, name)
                                     for name in list_of_names(value)))
        elif (title == "Joints" and kind == "Materials/NAME/Region"
              and value.startswith("band ")):
            tree.set(path, renamed_band(value, names))


def renamed_band(value, names):
    """`band A B` with new names, of which A and B may have blanks."""
    words = value[len("band "):]
    for first in names:
        second = words[len(first):].strip()
        if words.startswith(first + " ") and second in names:
            return f"band {names[first]} {names[second]}"
    raise CannotExpress(f"the joints of '{value}' are not known")


def renamed(scene):
    """Joints, materials, bolts, shotcrete, supports and tractions have other
    names, in another alphabetical order."""
    tree = scene.tree.copy()
    back = {}
    for title in USES:
        old = tree.names(title)
        names = {name: f"N{999 - i:03d} {title[0].lower()}"
                 for i, name in enumerate(old)}
        if title == "Joints":
            surfaces = dict.fromkeys(tree.get(f"Joints/{name}/Surface")
                                     for name in old)
            names.update({surface: f"S{999 - i:03d}"
                          for i, surface in enumerate(filter(None, surfaces))
                          if surface not in names})
            back = {new: name for name, new in names.items()}
        if old:
            rename(tree, title, names)
    return Variant(tree, Mapping(names=back))


def reordered(scene):
    """Joints, bolts, shotcrete, supports and tractions in the reversed order."""
    if scene.summary.get("mesh", {}).get("merged_areas"):
        raise CannotExpress("joints share areas, where the first one rules")
    tree = scene.tree.copy()
    titles = [title for title in USES
              if title != "Materials" and len(tree.names(title)) > 1]
    if not titles:
        raise CannotExpress("no section lists two names whose order is free")
    for title in titles:
        tree.set(f"{title}/Names", ", ".join(reversed(tree.names(title))))
    return Variant(tree, keeps_mesh=scene.is_structured)


def joints_reversed(scene):
    """Normals point to the other side, and corners go the other way round."""
    tree = scene.tree.copy()
    if not tree.names("Joints"):
        raise CannotExpress("it has no joints")
    for name in tree.names("Joints"):
        joint = f"Joints/{name}/"
        corners = points_of(tree.get(joint + "Vertices"))
        normal = points_of(tree.get(joint + "Normal"))
        if corners:
            tree.set(joint + "Vertices", text_of_points(reversed(corners)))
        if normal:
            tree.set(joint + "Normal", [-c for c in normal[0]])
    return Variant(tree, keeps_mesh=scene.is_structured)


def grid_lines(scene, rng):
    """Lines of a UCD file of a structured mesh, with numbers of nodes and cells
    shuffled by `rng`; faces of the sides have the material 1, 2, ..."""
    grid, dim = Grid(scene.tree), scene.dim
    strides = [1]
    for n in grid.counts:
        strides.append(strides[-1] * (n + 1))
    indices = [[i // strides[a] % (n + 1) for a, n in enumerate(grid.counts)]
               for i in range(strides[-1])]
    order = list(range(len(indices)))
    rng.shuffle(order)
    number = {i: k + 1 for k, i in enumerate(order)}

    def node(index):
        return number[sum(i * s for i, s in zip(index, strides))]
    nodes = []
    for k, i in enumerate(order):
        p = (grid.vertex(indices[i]) + [0.])[:3]
        nodes.append(f"{k + 1} " + " ".join(repr(c) for c in p))
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    steps = ring if dim == 2 else ([s + (0,) for s in ring]
                                   + [s + (1,) for s in ring])
    elements = []
    for index in indices:
        if any(i == n for i, n in zip(index, grid.counts)):
            continue
        corners = [node([i + s for i, s in zip(index, step)]) for step in steps]
        elements.append(("quad" if dim == 2 else "hex", 0, corners))
        for axis in range(dim):
            for side in (0, 1):
                if index[axis] == side * (grid.counts[axis] - 1):
                    elements.append(side_face(index, axis, side, node))
    rng.shuffle(elements)
    return ([f"{len(nodes)} {len(elements)} 0 0 0"] + nodes +
            [f"{k + 1} {material} {kind} " + " ".join(map(str, corners))
             for k, (kind, material, corners) in enumerate(elements)])


def side_face(index, axis, side, node):
    """(kind, number of the side, nodes) of a cell's face on the boundary."""
    others = [a for a in range(len(index)) if a != axis]
    steps = [(0,), (1,)] if len(others) == 1 else [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = []
    for step in steps:
        place = list(index)
        place[axis] += side
        for a, s in zip(others, step):
            place[a] += s
        corners.append(node(place))
    return "line" if len(others) == 1 else "quad", 2 * axis + side + 1, corners


def renumbered(scene):
    """A structured mesh from a file, with nodes and cells in any order."""
    tree = scene.tree.copy()
    for entry in ("Refine at excavations", "Refine at joints",
                  "Refinement levels"):
        if tree.get(f"Mesh/{entry}"):
            raise CannotExpress("cells are refined, which an unordered file of "
                                "the coarse mesh does not show")
    if not scene.is_structured:
        raise CannotExpress("the program makes the mesh, and numbers it")
    lines = grid_lines(scene, random.Random(3))
    move_boundaries(tree, tree, lambda name: [
        f"id {SIDES[scene.dim].index(name) + 1}" if name in SIDES[scene.dim]
        else name])
    for path, value in {"Domain/Shape": "file", "Domain/File": "renumbered.ucd",
                        "Mesh/Generator": "file", "Domain/Size": "",
                        "Domain/Edges": "", "Mesh/Cells": "",
                        "Mesh/Gradings": ""}.items():
        tree.set(path, value)
    return Variant(tree, files={"renumbered.ucd": "\n".join(lines) + "\n"})


ORDER = {"written-out": written, "renamed": renamed, "reordered": reordered,
         "joints-reversed": joints_reversed, "renumbered": renumbered}
