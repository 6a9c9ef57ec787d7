# SPDX-License-Identifier: LGPL-2.1-or-later
"""The domain of a scene, its boundaries and supports after a move
(scene_moves.Move)."""
from scene_tree import numbers_of, points_of, text_of_points

SIDES = {2: ["left", "right", "bottom", "top"],
         3: ["left", "right", "front", "back", "bottom", "top"]}


class CannotExpress(Exception):
    """Why a scene cannot express a relation."""


def unit(dim, axis):
    """The unit vector along an axis."""
    return [1. if i == axis else 0. for i in range(dim)]


def domain_edges(tree):
    """Edge vectors of a box or parallelepiped [m]."""
    if tree.get("Domain/Shape") == "box":
        size = numbers_of(tree.get("Domain/Size"))
        return [[length * c for c in unit(len(size), i)]
                for i, length in enumerate(size)]
    return points_of(tree.get("Domain/Edges"))


def move_box(tree, move, result):
    """Move a domain that is a box or a parallelepiped; names of sides change
    where the move mirrors."""
    corner = move.point(numbers_of(tree.get("Domain/Corner")))
    edges = [move.vector(edge) for edge in domain_edges(tree)]
    names = {}
    if move.mirrors:
        corner = [c + e for c, e in zip(corner, edges[0])]
        edges[0] = [-e for e in edges[0]]
        names = {"left": "right", "right": "left"}
        gradings = [g.strip() for g in tree.get("Mesh/Gradings").split(",")]
        if gradings[0] not in ("", "uniform"):
            gradings[0] = repr(1. / float(gradings[0]))
            result.set("Mesh/Gradings", ", ".join(gradings))
    result.set("Domain/Corner", corner)
    if move.turns or tree.get("Domain/Shape") != "box":
        result.set("Domain/Shape", "parallelepiped")
        result.set("Domain/Edges", text_of_points(edges))
        result.set("Domain/Size", "")
    return lambda name: [names.get(name, name)]


def edges_on_side(corners, side):
    """Numbers, from 1, of the edges of a polygon on a side of its bounding
    box."""
    axis, is_upper = divmod(SIDES[2].index(side), 2)
    values = [p[axis] for p in corners]
    limit = max(values) if is_upper else min(values)
    close = 1e-7 * (max(values) - min(values))
    n = len(corners)
    return [i + 1 for i in range(n) if abs(values[i] - limit) < close
            and abs(values[(i + 1) % n] - limit) < close]


def move_polygon(tree, move, result):
    """Move a domain that is a polygon; its sides are named by their edges."""
    corners = points_of(tree.get("Domain/Polygon"))
    moved = [move.point(p) for p in corners]
    n = len(corners)
    number = {i: i for i in range(1, n + 1)}
    if move.mirrors:
        # edge i runs from corner i to i + 1: of the reversed ones n - i does
        moved.reverse()
        number = {i: (n - i - 1) % n + 1 for i in range(1, n + 1)}
    result.set("Domain/Polygon", text_of_points(moved))

    def names(name):
        if name.startswith("id "):
            return [f"id {number[int(name[3:])]}"]
        if name in ("all", "none"):
            return [name]
        return [f"id {number[i]}" for i in edges_on_side(corners, name)]
    return names


def move_domain(tree, move, result):
    """Move the domain; returns a function from the name of a boundary to the
    names of the moved one."""
    shape = tree.get("Domain/Shape")
    if shape == "file":
        raise CannotExpress("the mesh is in a file")
    if shape == "polygon":
        return move_polygon(tree, move, result)
    return move_box(tree, move, result)


def move_boundaries(tree, result, names):
    """Rename the boundaries that supports, tractions and the domain name."""
    paths = ["Domain/Truncated boundaries"]
    for title in ("Supports", "Tractions"):
        paths += [f"{title}/{name}/Boundaries" for name in tree.names(title)]
    for path in paths:
        old = [part.strip() for part in tree.get(path).split(",") if part.strip()]
        new = [name for part in old for name in names(part)]
        result.set(path, ", ".join(dict.fromkeys(new)))


def normal_axes(tree, names):
    """Axes that the named sides of a box, or edges of a polygon, are across;
    None if one is oblique."""
    dim = int(tree.get("Dimension"))
    axes = set()
    for name in names:
        if name not in SIDES[dim]:
            return None
        axes.add(SIDES[dim].index(name) // 2)
    return axes if tree.get("Domain/Shape") in ("box", "polygon") else None


def move_directions(tree, move, result):
    """Directions of supports along axes: as rollers after a turn."""
    if not move.turns:
        return
    for name in tree.names("Supports"):
        path = f"Supports/{name}/Directions"
        directions = tree.get(path, "all")
        if directions in ("all", "normal"):
            continue
        boundaries = [part.strip() for part in
                      tree.get(f"Supports/{name}/Boundaries").split(",")
                      if part.strip()]
        axes = normal_axes(tree, boundaries)
        if axes is None or len(axes) != 1 or directions != "xyz"[min(axes)]:
            raise CannotExpress(f"the support '{name}' holds the axis "
                                f"{directions}, which is none after the turn")
        result.set(path, "normal")
