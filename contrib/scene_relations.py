# SPDX-License-Identifier: LGPL-2.1-or-later
"""Relations between a scene and scenes that must have the same factors.

A relation is a function from a scene to variants of it. It raises
CannotExpress with the reason if the scene cannot express it."""
from typing import Callable, NamedTuple

from scene_domain import CannotExpress, unit
from scene_formula import Formula
from scene_moves import Move, move_scene, turn_about
from scene_places import Grid
from scene_shapes import bolt_mover, chords_of, is_profile, move_excavations
from scene_tree import numbers_of
from scene_units import factor_of_lengths, factor_of_masses, scale


def same_place(p):
    """The place itself."""
    return p


class Mapping(NamedTuple):
    """From a variant back to its scene."""
    back: Callable = same_place  # a place of the scene by one of the variant [m]
    length: float = 1.  # lengths, forces and pressures of the variant over
    force: float = 1.   # those of the scene (forces per metre in 2D)
    pressure: float = 1.
    names: dict = {}  # the scene's names of joints by those of the variant


class Variant(NamedTuple):
    """A scene that must have the same factors as another one."""
    tree: object
    mapping: Mapping = Mapping()
    ranks: int = 1
    keeps_mesh: bool = True
    # (center, radius) of a ball [m] in which new blocks may be
    new_blocks: tuple = ()
    files: dict = {}  # texts of files beside it, by their names
    # part of the message with which the program refuses it if the scene cannot
    # express the relation, and the reason to print
    refusal: tuple = ()


class Scene:
    """A scene, what its run found, and the list of entries with their units."""

    def __init__(self, tree, summary, entries):
        self.tree = tree
        self.summary = summary
        self.entries = entries
        self.dim = int(tree.get("Dimension"))

    @property
    def is_structured(self):
        """Whether the mesh follows from Mesh/Cells."""
        return self.tree.get("Mesh/Generator") == "structured"

    @property
    def has_numbered_blocks(self):
        """Whether the blocks with factors are given by their numbers."""
        return self.tree.get("Safety factor/Blocks")[:1].isdigit()

    def stages(self):
        """Names of the stages at whose ends there are factors."""
        named = [name.strip() for name in
                 self.tree.get("Safety factor/Stages").split(",") if name.strip()]
        return named or self.tree.names("Stages")


def described(relation, text):
    """The relation with a sentence that says what it changes."""
    relation.__doc__ = text
    return relation


def sides_but_top(dim):
    """Boundaries that go on where the top is the surface of the ground."""
    return ", ".join(["left", "right"] + ["front", "back"] * (dim - 2) + ["bottom"])


def plain_tree(used):
    """The tree of used.prm without what has no influence on factors, and
    without what follows from other entries: the depth of the ground, and
    chords that follow from the size of cells."""
    tree = used.copy()
    dim = int(tree.get("Dimension"))
    depth = float(tree.get("Ground/Depth", "-1"))
    if depth >= 0. and tree.get("Domain/Shape") == "box":
        top = (numbers_of(tree.get("Domain/Corner"))[-1]
               + numbers_of(tree.get("Domain/Size"))[-1])
        if (abs(top - depth) < 1e-9 * top
                and tree.get("Domain/Truncated boundaries") == "all"):
            tree.set("Domain/Truncated boundaries", sides_but_top(dim))
    for path, value in {"Ground/Depth": "-1", "Check/Closed form": "none",
                        "Check/Joint": "", "Check/Quantity": "",
                        "Block theory/Report": "false",
                        "Output/Write VTU": "false", "Output/Folder": ""}.items():
        tree.set(path, value)
    for name in tree.names("Excavations"):
        if is_profile(tree, name) and chords_of(tree, name):
            tree.set(f"Excavations/{name}/Segments", chords_of(tree, name))
    for title in ("Monitors", "Study"):
        tree.sections.pop(title, None)
    return tree


def moved(scene, move, keeps_mesh):
    """The scene after a move."""
    tree = move_scene(scene.tree, move, move_excavations,
                      bolt_mover(scene.summary.get("bolts", [])))
    return Variant(tree, Mapping(back=move.back),
                   keeps_mesh=keeps_mesh and scene.is_structured)


def mirrored(scene):
    """x becomes -x."""
    matrix = [unit(scene.dim, i) for i in range(scene.dim)]
    matrix[0][0] = -1.
    return moved(scene, Move(matrix), True)


def turned(scene):
    """The scene turns by 30 degrees with gravity, supports and loads: in 2D
    counterclockwise, in 3D about the plumb line."""
    axis = None if scene.dim == 2 else [0., 0., 1.]
    return moved(scene, Move(turn_about(axis, 30.)), True)


def turned_obliquely(scene):
    """The same in 3D about an axis that is neither level nor plumb."""
    if scene.dim == 2:
        raise CannotExpress("it is in 2D")
    return moved(scene, Move(turn_about([1., 2., 3.], 30.)), True)


def shifted(distance, height=0.):
    """The relation that shifts scenes along the ground, or upwards [m]."""
    def relation(scene):
        identity = [unit(scene.dim, i) for i in range(scene.dim)]
        shift = ([distance, height] if scene.dim == 2 else
                 [distance, -0.5 * distance, height])
        return moved(scene, Move(identity, shift), True)
    return described(relation, f"The scene is shifted by {height:g} m upwards."
                     if height else
                     f"The scene is shifted by {distance:g} m along the ground.")


def check_scale(scene):
    """Refuse scenes with numbers in files, or with a length in a law."""
    tree = scene.tree
    for name in tree.names("Joints"):
        if (tree.get(f"Joints/{name}/Law") == "barton-bandis" and
                float(tree.get(f"Joints/{name}/Joint length", "0")) > 0.):
            raise CannotExpress("the law barton-bandis has a length of 0.1 m")
    if tree.get("Initial state/Measured points"):
        raise CannotExpress("the stress is fitted to a file of measured points")
    if tree.get("Domain/Shape") == "file":
        raise CannotExpress("the mesh is in a file")
    for name in tree.names("Supports"):
        if tree.get(f"Supports/{name}/History file"):
            raise CannotExpress(f"the support '{name}' moves by a file")
    for name in tree.names("Excavations"):
        if tree.get(f"Excavations/{name}/Shape") == "file":
            raise CannotExpress(f"the excavation '{name}' is in a file")


def lengths_times(ratio):
    """The relation that multiplies all lengths; gravity and densities stay, so
    that stresses and strengths grow with the lengths."""
    def relation(scene):
        check_scale(scene)
        factor_of = factor_of_lengths(ratio)
        mapping = Mapping(back=lambda p: [c / ratio for c in p], length=ratio,
                          force=factor_of((scene.dim - 2, 1, -2)),
                          pressure=factor_of((-1, 1, -2)))
        return Variant(scale(scene.tree, scene.entries, factor_of), mapping,
                       keeps_mesh=scene.is_structured)
    return described(relation, f"Lengths are multiplied by {ratio:g}; gravity and "
                     "densities stay.")


def stresses_times_10(scene):
    """Densities, strengths, moduli and stresses are ten times as large."""
    check_scale(scene)
    factor_of = factor_of_masses(10.)
    return Variant(scale(scene.tree, scene.entries, factor_of),
                   Mapping(force=10., pressure=10.))


ALL_SIZES = ("Size", "Size at excavation", "Size at joints", "Least size")


def cells_times(ratio, sizes=ALL_SIZES):
    """The relation that multiplies these sizes of cells."""
    def relation(scene):
        if scene.tree.get("Mesh/Generator") != "gmsh":
            raise CannotExpress("joints follow the cells of the mesh, whose "
                                "number cannot change a little")
        if float(scene.tree.get("Mesh/Size", "0")) == 0.:
            raise CannotExpress("sizes of cells are left to the program")
        tree = scene.tree.copy()
        given = [f"Mesh/{entry}" for entry in sizes
                 if float(tree.get(f"Mesh/{entry}", "0")) > 0.]
        if not given:
            raise CannotExpress("the scene gives no such size")
        for path in given:
            tree.set(path, ratio * float(tree.get(path)))
        return Variant(tree, keeps_mesh=False)
    names = "All sizes" if sizes == ALL_SIZES else " and ".join(sizes)
    return described(relation, f"{names} of cells are multiplied by {ratio:g}.")


def check_steps(scene):
    """Refuse formulas of excavations and materials whose outlines do not follow
    the cells: smaller cells would follow them in other steps."""
    grid = Grid(scene.tree)
    paths = ([f"Excavations/{name}/Formula" for name in scene.tree.names("Excavations")]
             + [f"Materials/{name}/Region" for name in scene.tree.names("Materials")])
    for path in paths:
        text = scene.tree.get(path)
        if text in ("", "all") or text.startswith(("id ", "band ")):
            continue
        formula = Formula(text)
        for points in grid.quarter_points():
            if len({formula.at(p) > 0. for p in points}) > 1:
                raise CannotExpress(f"smaller cells follow the outline of '{path}' "
                                    "in other steps")


def cells_halved(scene):
    """A structured mesh with twice as many cells along each edge."""
    if not scene.is_structured:
        raise CannotExpress("the mesh is not structured")
    if any(g.strip() not in ("", "uniform")
           for g in scene.tree.get("Mesh/Gradings").split(",")):
        raise CannotExpress("halved cells of a graded mesh are no graded mesh")
    check_steps(scene)
    tree = scene.tree.copy()
    cells = [2 * int(n) for n in tree.get("Mesh/Cells").split(",")]
    tree.set("Mesh/Cells", cells)
    return Variant(tree, keeps_mesh=False)


def on_ranks(number):
    """The relation that runs a scene on some ranks."""
    def relation(scene):
        return Variant(scene.tree, ranks=number)
    return described(relation, f"The scene runs on {number} ranks.")


def time_step_safety(value):
    """The relation that takes a fraction of the stable step."""
    def relation(scene):
        if float(scene.tree.get("Time stepping/Safety", "0.9")) == value:
            raise CannotExpress(f"the scene has {value} itself")
        tree = scene.tree.copy()
        tree.set("Time stepping/Safety", value)
        return Variant(tree)
    return described(relation, f"Steps are {value:g} of the stable step.")


PLACE = {"mirrored": mirrored, "turned": turned,
         "turned-obliquely": turned_obliquely,
         "shifted-5e5": shifted(5e5), "shifted-4e6": shifted(4e6),
         "raised": shifted(0., 1000.)}
SCALE = {"lengths-0.001": lengths_times(1e-3), "lengths-0.1": lengths_times(0.1),
         "lengths-10": lengths_times(10.), "lengths-1000": lengths_times(1e3),
         "stresses-10": stresses_times_10}
# relations that only steps can violate
OF_STEPS = ("safety-0.9", "safety-0.85")
NUMERICS = {"cells-0.9": cells_times(0.9), "cells-0.96": cells_times(0.96),
            "cells-1.04": cells_times(1.04), "cells-1.1": cells_times(1.1),
            "far-cells-0.96": cells_times(0.96, ("Size",)),
            "near-cells-0.93": cells_times(0.93, ("Size at excavation",
                                                  "Size at joints")),
            "cells-halved": cells_halved, "ranks-2": on_ranks(2),
            "ranks-4": on_ranks(4), "safety-0.9": time_step_safety(0.9),
            "safety-0.85": time_step_safety(0.85)}
