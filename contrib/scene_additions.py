# SPDX-License-Identifier: LGPL-2.1-or-later
"""Relations that add something irrelevant to a scene."""
import math
import random

from scene_formula import Formula
from scene_domain import CannotExpress
from scene_places import Grid, Surroundings, difference, directions, norm
from scene_relations import Variant, described
from scene_tree import text_of_points

BOLT = {"Area": 5e-4, "Yield force": 150e3, "Bond stiffness": 1e8,
        "Bond strength": 2e5, "Plate strength": 1e5}
WEAKENING = {"Friction angle": 30, "Kinetic friction angle": 15,
             "Cohesion": 1e4, "Residual cohesion": 0}
# fewer in structured meshes where so many have no room
N_SMALL_JOINTS, FEWEST_SMALL_JOINTS = 50, 10


def far_place(scene):
    """(point, radius) of a ball far from all blocks; found once a scene."""
    if not hasattr(scene, "far"):
        try:
            around = Surroundings(scene.tree, scene.summary["blocks"])
            scene.far = around.find_far()
        except (CannotExpress, ValueError) as reason:
            scene.far = CannotExpress(str(reason))
    if isinstance(scene.far, CannotExpress):
        raise scene.far
    return scene.far


def first_stage(scene):
    """Name of the first stage."""
    stages = scene.tree.names("Stages")
    if not stages:
        raise CannotExpress("it has no stages")
    return stages[0]


def oblique(dim, length):
    """A vector that lies along no axis."""
    v = [0.6, 0.3, 0.74][:dim]
    return [length * c / norm(v) for c in v]


def bolt_in_rock(scene):
    """A bolt in the rock far away, which crosses no joint."""
    center, radius = far_place(scene)
    half = oblique(scene.dim, 0.4 * radius)
    tree = scene.tree.copy()
    tree.add("Bolts", "added bolt", {
        **BOLT, "Stage": first_stage(scene),
        "Heads": difference(center, half),
        "Ends": [c + h for c, h in zip(center, half)]})
    return Variant(tree)


def with_later_stage(scene):
    """The tree with one more stage after the others, at whose end no factor is
    asked for."""
    first_stage(scene)
    tree = scene.tree.copy()
    tree.set("Safety factor/Stages", ", ".join(scene.stages()))
    tree.add("Stages", "added stage", {"Kind": "quasi-static",
                                       "Maximum steps": "1"})
    return tree


def bolt_through_block(scene):
    """A bolt through a block in a later stage."""
    around = Surroundings(scene.tree, scene.summary["blocks"])
    blocks = [b for b in scene.summary["blocks"] if "width" in b]
    blocks.sort(key=lambda b: "limit_equilibrium" not in b)
    for block in blocks:
        head, size = block["centroid"], block["volume"]**(1. / scene.dim)
        for direction in directions(scene.dim):
            end = [c + 1.7 * size * d for c, d in zip(head, direction)]
            middle = [c + 1.4 * size * d for c, d in zip(head, direction)]
            if all(around.is_rock(p) for p in (head, middle, end)):
                tree = with_later_stage(scene)
                tree.add("Bolts", "added bolt", {
                    **BOLT, "Stage": "added stage", "Heads": head, "Ends": end})
                return Variant(tree)
    raise CannotExpress("no finite block has rock behind it")


def water_later(scene):
    """Water up to the top of the domain in a later stage."""
    tree = with_later_stage(scene)
    tree.set("Stages/added stage/Water level", 1e4)
    return Variant(tree)


def shotcrete_later(scene):
    """Shotcrete on all excavations in a later stage."""
    names = scene.tree.names("Excavations")
    if not names:
        raise CannotExpress("it has no excavation")
    tree = with_later_stage(scene)
    tree.add("Shotcrete", "added shotcrete", {
        "Stage": "added stage", "Excavations": ", ".join(names),
        "Parts": "roof, walls, floor", "Thickness": 0.1, "Shear strength": 1e6})
    return Variant(tree, refusal=(
        "no free face of its excavations", "its excavations have no free face in "
        "rock that can be sprayed"))


def faces_at(scene, number):
    """Corners of small joints far away: cell faces of a structured mesh, else
    none."""
    center, radius = far_place(scene)
    grid = Grid(scene.tree)
    cells = grid.cells_in_ball(center, radius)
    # every second cell, so that the faces bound no block
    chosen = [c for c in cells if all(i % 2 == 0 for i in c)] or cells[:1]
    if len(chosen) < min(number, FEWEST_SMALL_JOINTS):
        raise CannotExpress("too few whole cells are far away")
    return [grid.face(cell, scene.dim - 1, 0) for cell in chosen[:number]]


def small_joints(scene, number):
    """Entries of small joints in the rock far away."""
    if scene.is_structured:
        return [{"Extent": "polygon", "Vertices": text_of_points(corners)}
                for corners in faces_at(scene, number)]
    if scene.tree.get("Mesh/Generator") == "file":
        raise CannotExpress("the mesh is in a file, and joints follow its cells")
    center, radius = far_place(scene)
    rng = random.Random(2)
    if number == 1:
        return [{"Extent": "disc", "Point": center, "Radius": 0.3 * radius,
                 "Normal": oblique(scene.dim, 1.)}]
    joints = []
    per_side = math.ceil(number**(1. / scene.dim))
    step = 2. * radius / math.sqrt(scene.dim) / per_side
    for i in range(number):
        index = [i // per_side**k % per_side for k in range(scene.dim)]
        point = [c + (k + 0.5 - per_side / 2.) * step
                 for c, k in zip(center, index)]
        normal = [rng.gauss(0., 1.) for _ in range(scene.dim)]
        joints.append({"Extent": "disc", "Point": point, "Radius": 0.3 * step,
                       "Normal": normal})
    return joints


def joints_far(number, strength):
    """The relation that adds small joints in the rock far away."""
    def relation(scene):
        tree = scene.tree.copy()
        for i, entries in enumerate(small_joints(scene, number)):
            tree.add("Joints", f"added joint {i + 1}", {**entries, **strength})
        tree.set("Joints/Resolved", "true")
        return Variant(tree, keeps_mesh=scene.is_structured)
    what = "A small joint" if number == 1 else f"{number} small joints"
    return described(relation, what + " far away" + (
        ", which weakens as it slips." if strength is WEAKENING else "."))


def simplex(scene):
    """Corners of the faces of a triangle or tetrahedron far away."""
    center, radius = far_place(scene)
    if scene.dim == 2:
        corners = [[0.1, 1.], [-0.9, -0.4], [0.8, -0.6]]
    else:
        corners = [[0.1, 0., 1.], [-0.8, -0.3, -0.4], [0.8, -0.4, -0.3],
                   [0., 0.9, -0.4]]
    corners = [[c + 0.6 * radius * x for c, x in zip(center, corner)]
               for corner in corners]
    return [corners[:i] + corners[i + 1:] for i in range(len(corners))]


def block_far(scene):
    """A block of joints far away, in the rock."""
    center, radius = far_place(scene)
    if scene.is_structured:
        grid = Grid(scene.tree)
        cells = grid.cells_in_ball(center, radius)
        if not cells:
            raise CannotExpress("no whole cell is far away")
        faces = [grid.face(cells[0], axis, side) for axis in range(scene.dim)
                 for side in (0, 1)]
    elif scene.tree.get("Mesh/Generator") == "file":
        raise CannotExpress("the mesh is in a file, and joints follow its cells")
    else:
        faces = simplex(scene)
    tree = scene.tree.copy()
    for i, corners in enumerate(faces):
        tree.add("Joints", f"added joint {i + 1}",
                 {"Extent": "polygon", "Vertices": text_of_points(corners),
                  "Friction angle": 30})
    tree.set("Joints/Resolved", "true")
    return Variant(tree, keeps_mesh=scene.is_structured,
                   new_blocks=(center, radius))


def material_at(tree, place):
    """Name of the material at a place."""
    found = ""
    for name in tree.names("Materials"):
        region = tree.get(f"Materials/{name}/Region", "all")
        if region.startswith(("id ", "band ")):
            raise CannotExpress(f"the material '{name}' is where '{region}' is")
        if tree.get(f"Materials/{name}/Stage"):
            raise CannotExpress(f"the material '{name}' comes with a stage")
        if region == "all" or Formula(region).at(place) > 0.:
            found = name
    if not found:
        raise CannotExpress("the place far away has no material")
    return found


def ball(center, radius):
    """A formula that is positive in a ball."""
    terms = "+".join(f"({x}-({c!r}))^2" for x, c in zip("xyz", center))
    return f"{radius!r}^2-({terms})"


def material_far(changes):
    """The relation that adds a material in a ball far away, equal to that of
    the rock there but for its name and these changes."""
    def relation(scene):
        center, radius = far_place(scene)
        if scene.is_structured and not Grid(scene.tree).cells_in_ball(center,
                                                                      radius):
            raise CannotExpress("no whole cell is far away")
        tree = scene.tree.copy()
        own = tree.find(f"Materials/{material_at(tree, center)}")
        entries = dict(own.entries) if own is not None else {}
        if changes and entries.get("Model", "elastic") != "elastic":
            raise CannotExpress("the rock far away is not elastic")
        tree.add("Materials", "added material",
                 {**entries, **changes, "Region": ball(center, radius)})
        return Variant(tree, refusal=(
            "No cell lies in the region", "no cell is far away"))
    return described(relation, "Another material in a ball far away, like the "
                     "rock there" + (" until it yields." if changes else "."))


def unused_set(scene):
    """A set of joints that makes none."""
    tree = scene.tree.copy()
    tree.add("Joint sets", "added set", WEAKENING)
    return Variant(tree)


def unused_table(scene):
    """A table of joints, where all joints are listed without it."""
    tree = scene.tree.copy()
    tree.set("Joints/File", "unused.csv")
    tree.set("Joints/Resolved", "true")
    rows = ["name,dip,dip direction,x,y" + ",z" * (scene.dim - 2),
            "unused joint,45,90" + ",0" * scene.dim]
    return Variant(tree, files={"unused.csv": "\n".join(rows) + "\n"})


def place_columns(tree, name):
    """The columns of a table that say where a joint is, with their values."""
    joint = f"Joints/{name}/"
    axes = "xyz"[:int(tree.get("Dimension"))]
    if tree.get(joint + "Extent", "infinite") == "polygon":
        corners = tree.get(joint + "Vertices")
        return {"vertices": f'"{corners}"'}
    columns = dict(zip(axes, tree.get(joint + "Point").split(",")))
    normal = tree.get(joint + "Normal")
    if normal:
        columns.update(zip([f"normal {a}" for a in axes], normal.split(",")))
    else:
        columns.update({"dip": tree.get(joint + "Dip", "0"),
                        "dip direction": tree.get(joint + "Dip direction", "90")})
    return columns


def overridden_table(scene):
    """The joints are in a table, with another strength, which their sections
    override."""
    tree = scene.tree.copy()
    names = tree.names("Joints")
    if not names:
        raise CannotExpress("it has no joints")
    if tree.get("Joint sets/Names") or any(
            tree.get(f"Joints/{name}/Surface") for name in names):
        raise CannotExpress("its joints come from sets or surfaces, which would "
                            "be used again")
    places = [place_columns(tree, name) for name in names]
    if any(set(place) != set(places[0]) for place in places):
        raise CannotExpress("its joints have no columns in common")
    rows = ["name,friction angle," + ",".join(places[0])]
    rows += [f'"{name}",1,' + ",".join(place[c] for c in places[0])
             for name, place in zip(names, places)]
    for name in names:
        for entry in ("Point", "Normal", "Vertices", "Dip", "Dip direction"):
            tree.remove(f"Joints/{name}/{entry}")
        if tree.get(f"Joints/{name}/Extent") != "disc":
            tree.remove(f"Joints/{name}/Radius")
    for path, value in {"Names": "", "File": "overridden.csv",
                        "Resolved": "false"}.items():
        tree.set(f"Joints/{path}", value)
    return Variant(tree, files={"overridden.csv": "\n".join(rows) + "\n"})


IRRELEVANT = {
    "bolt-in-rock": bolt_in_rock, "bolt-later": bolt_through_block,
    "water-later": water_later, "shotcrete-later": shotcrete_later,
    "joint-far": joints_far(1, {"Friction angle": 30}),
    "weakening-joint-far": joints_far(1, WEAKENING),
    "joints-far-50": joints_far(N_SMALL_JOINTS, {"Friction angle": 30}),
    "block-far": block_far, "material-far": material_far({}),
    "plastic-material-far": material_far({
        "Model": "mohr_coulomb", "Cohesion": 1e12, "Friction angle": 0}),
    "unused-table": unused_table, "overridden-table": overridden_table,
    "unused-set": unused_set}
