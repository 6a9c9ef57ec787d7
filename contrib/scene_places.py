# SPDX-License-Identifier: LGPL-2.1-or-later
"""Places of a scene that are far from its blocks, joints and excavations, and
faces of structured meshes there. Points are lists of coordinates [m]."""
import itertools
import math
import random

from scene_formula import Formula
from scene_domain import CannotExpress, domain_edges
from scene_moves import dip_normal
from scene_shapes import dot, number, parts_of_profile, prisms_of
from scene_tree import numbers_of, points_of

N_TRIED = 3000  # random places


def difference(a, b):
    """a - b."""
    return [x - y for x, y in zip(a, b)]


def norm(a):
    """Length of a vector."""
    return math.sqrt(dot(a, a))


def cross(a, b):
    """The vector product in 3D."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0]]


def is_inside_polygon(point, corners):
    """Whether a point of the plane is inside a polygon."""
    inside = False
    for a, b in zip(corners, corners[1:] + corners[:1]):
        if (a[1] > point[1]) != (b[1] > point[1]) and point[0] < (
                a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])):
            inside = not inside
    return inside


def distance_to_segment(p, a, b):
    """Distance of a point from a segment, in any dimension."""
    along = difference(b, a)
    place = dot(difference(p, a), along) / max(dot(along, along), 1e-300)
    place = min(1., max(0., place))
    return norm([x - y - place * u for x, y, u in zip(p, a, along)])


def polygon_normal(corners):
    """The unit normal of a plane polygon in 3D."""
    total = [0., 0., 0.]
    for a, b in zip(corners[1:], corners[2:]):
        n = cross(difference(a, corners[0]), difference(b, corners[0]))
        total = [t + c for t, c in zip(total, n)]
    length = norm(total)
    return [c / length for c in total]


class JointPlace:
    """Where a joint is."""

    def __init__(self, tree, name):
        part = f"Joints/{name}/"
        dim = int(tree.get("Dimension"))
        self.corners = points_of(tree.get(part + "Vertices"))
        self.extent = tree.get(part + "Extent", "infinite")
        self.radius = number(tree, part + "Radius")
        if self.extent == "polygon" and dim == 2:
            return
        if self.extent == "polygon":
            self.normal = polygon_normal(self.corners)
            self.point = self.corners[0]
            return
        self.point = numbers_of(tree.get(part + "Point")) or [0.] * dim
        normal = numbers_of(tree.get(part + "Normal")) or dip_normal(tree, part)
        self.normal = [c / norm(normal) for c in normal]

    def distance(self, p):
        """Distance of a point from the joint, or less [m]."""
        if self.extent == "polygon" and len(p) == 2:
            return distance_to_segment(p, *self.corners[:2])
        away = difference(p, self.point)
        height = abs(dot(away, self.normal))
        if self.extent == "infinite":
            return height
        if self.extent == "disc":
            beside = math.sqrt(max(0., dot(away, away) - height**2))
            return math.hypot(height, max(0., beside - self.radius))
        # a ball around the polygon's middle
        middle = [sum(c) / len(self.corners) for c in zip(*self.corners)]
        size = max(norm(difference(c, middle)) for c in self.corners)
        return max(height, norm(difference(p, middle)) - size)


def excavation_tests(tree):
    """Functions that say whether a point is in the excavations, at any time."""
    dim = int(tree.get("Dimension"))
    tests = []
    for name in tree.names("Excavations"):
        part = f"Excavations/{name}/"
        shape = tree.get(part + "Shape", "polygon")
        if shape == "formula":
            formula = Formula(tree.get(part + "Formula"))
            tests.append(lambda p, f=formula: f.at(p) > 0.)
        elif shape == "file":
            raise CannotExpress(f"the excavation '{name}' is in a file, so that "
                                "no place is known to be far from it")
        elif dim == 3 and shape != "box":
            for _, prism, _ in prisms_of(tree, name):
                tests.append(lambda p, s=prism: is_in_prism(p, s))
        elif shape == "box":
            corner = numbers_of(tree.get(part + "Corner"))
            size = numbers_of(tree.get(part + "Size"))
            tests.append(lambda p, c=corner, s=size: all(
                a <= x <= a + b for x, a, b in zip(p, c, s)))
        elif shape == "polygon":
            corners = points_of(tree.get(part + "Vertices"))
            tests.append(lambda p, c=corners: is_inside_polygon(p, c))
        elif shape == "circle":
            center = (numbers_of(tree.get(part + "Center")) or [0., 0.])[:2]
            radius = 1.1 * number(tree, part + "Radius")
            tests.append(lambda p, c=center, r=radius:
                         norm(difference(p, c)) < r)
        else:
            for _, corners, _ in parts_of_profile(tree, name):
                tests.append(lambda p, c=corners: is_inside_polygon(p, c))
    return tests


def is_in_prism(point, prism):
    """Whether a point is in a prism (scene_shapes.Prism)."""
    away = difference(point, prism.pivot)
    if not prism.begin <= dot(away, prism.along) <= prism.end:
        return False
    return is_inside_polygon((dot(away, prism.across), dot(away, prism.up)),
                             prism.corners)


def boundary_distance(tree):
    """A function that gives the distance of a point from the boundary of the
    domain; negative outside [m]."""
    if tree.get("Domain/Shape") == "file":
        raise CannotExpress("the mesh is in a file")
    if tree.get("Domain/Shape") == "polygon":
        corners = points_of(tree.get("Domain/Polygon"))

        def from_polygon(p):
            distance = min(distance_to_segment(p, a, b) for a, b in
                           zip(corners, corners[1:] + corners[:1]))
            return distance if is_inside_polygon(p, corners) else -distance
        return from_polygon
    corner = numbers_of(tree.get("Domain/Corner"))
    edges = domain_edges(tree)
    planes = []
    for i, edge in enumerate(edges):
        others = edges[:i] + edges[i + 1:]
        n = ([-others[0][1], others[0][0]] if len(edges) == 2
             else cross(*others))
        n = [c / norm(n) for c in n]
        n = n if dot(n, edge) > 0. else [-c for c in n]
        planes.append((n, dot(n, corner), dot(n, edge)))
    return lambda p: min(min(dot(n, p) - low, low + width - dot(n, p))
                         for n, low, width in planes)


def random_point(tree, rng):
    """A point of the domain's box or parallelepiped, or of its bounding box."""
    if tree.get("Domain/Shape") == "polygon":
        corners = points_of(tree.get("Domain/Polygon"))
        return [rng.uniform(min(axis), max(axis)) for axis in zip(*corners)]
    place = numbers_of(tree.get("Domain/Corner"))
    for edge in domain_edges(tree):
        share = rng.random()
        place = [p + share * e for p, e in zip(place, edge)]
    return place


def directions(dim):
    """Unit vectors to the neighbours of a cell in a grid."""
    for steps in itertools.product((-1, 0, 1), repeat=dim):
        if any(steps):
            yield [s / norm(steps) for s in steps]


def extent_of(block, dim):
    """About how long a finite block is that may be flat [m]."""
    volume = block["volume"]
    return max(volume**(1. / dim), (volume / block["width"])**(1. / (dim - 1)))


class Surroundings:
    """What is where in a scene: distances from joints, excavations, finite
    blocks and the boundary.

    `blocks`: those of a run's summary."""

    def __init__(self, tree, blocks):
        self.tree = tree
        self.dim = int(tree.get("Dimension"))
        self.joints = [JointPlace(tree, name) for name in tree.names("Joints")]
        self.is_dug = excavation_tests(tree)
        self.to_boundary = boundary_distance(tree)
        # (4/3: from the centroid of a triangle to its farthest corner)
        self.blocks = [(block["centroid"], 4. / 3. * extent_of(block, self.dim))
                       for block in blocks if "width" in block]

    def is_rock(self, p):
        """Whether a point is in the domain and in no excavation."""
        return self.to_boundary(p) > 0. and not any(test(p) for test in self.is_dug)

    def clear_radius(self, p):
        """Radius of a ball about a point without joints, excavations, finite
        blocks and boundary [m]; 0: there is none."""
        radius = self.to_boundary(p)
        for joint in self.joints:
            if radius <= 0.:
                return 0.
            radius = min(radius, joint.distance(p))
        for centroid, size in self.blocks:
            radius = min(radius, norm(difference(p, centroid)) - size)
        if radius <= 0. or any(test(p) for test in self.is_dug):
            return 0.
        while radius > 0. and not self.is_clear(p, radius):
            radius *= 0.8
            if radius < 1e-3 * self.to_boundary(p):
                return 0.
        return radius

    def is_clear(self, p, radius):
        """Whether no excavation is found on spheres about a point."""
        for part in (0.25, 0.5, 0.75, 1.):
            for direction in directions(self.dim):
                q = [x + part * radius * d for x, d in zip(p, direction)]
                if any(test(q) for test in self.is_dug):
                    return False
        return True

    def find_far(self):
        """(point, radius) of the largest clear ball about random places, or
        about centres of cells of a structured mesh."""
        rng = random.Random(1)
        best = ([], 0.)
        grid = (Grid(self.tree) if self.tree.get("Mesh/Generator") == "structured"
                else None)
        for _ in range(N_TRIED):
            p = grid.random_center(rng) if grid else random_point(self.tree, rng)
            if self.to_boundary(p) <= best[1]:
                continue
            radius = self.clear_radius(p)
            if radius > best[1]:
                best = (p, radius)
        if best[1] == 0.:
            raise CannotExpress("no place is far from all joints, blocks and "
                                "excavations")
        return best


class Grid:
    """The vertices of a structured mesh."""

    def __init__(self, tree):
        if tree.get("Mesh/Generator") != "structured":
            raise CannotExpress("the mesh is not structured")
        self.corner = numbers_of(tree.get("Domain/Corner"))
        self.edges = domain_edges(tree)
        self.counts = [int(n) for n in tree.get("Mesh/Cells").split(",")]
        gradings = [g.strip() for g in tree.get("Mesh/Gradings").split(",")]
        if len(gradings) != len(self.counts):
            gradings = ["uniform"] * len(self.counts)
        self.places = [graded(n, 1. if g == "uniform" else float(g))
                       for n, g in zip(self.counts, gradings)]

    def vertex(self, index):
        """The vertex with these numbers along the edges."""
        p = self.corner
        for i, edge, places in zip(index, self.edges, self.places):
            p = [x + places[i] * e for x, e in zip(p, edge)]
        return p

    def random_center(self, rng):
        """The centre of a cell, at random."""
        cell = [rng.randrange(n) for n in self.counts]
        ends = [self.vertex(cell), self.vertex([i + 1 for i in cell])]
        return [0.5 * (a + b) for a, b in zip(*ends)]

    def quarter_points(self):
        """The centres of the 4 or 8 parts of each cell, cell by cell."""
        steps = list(itertools.product((0.25, 0.75), repeat=len(self.counts)))
        for cell in itertools.product(*(range(n) for n in self.counts)):
            low = self.vertex(cell)
            sides = [difference(self.vertex([i + (a == axis) for a, i in
                                             enumerate(cell)]), low)
                     for axis in range(len(cell))]
            points = []
            for step in steps:
                p = low
                for s, side in zip(step, sides):
                    p = [x + s * d for x, d in zip(p, side)]
                points.append(p)
            yield points

    def face(self, cell, axis, side):
        """Corners, in order, of a face of a cell: across edge number `axis`,
        on its lower (0) or upper (1) side."""
        index = list(cell)
        index[axis] += side
        others = [a for a in range(len(cell)) if a != axis]
        steps = [(0,), (1,)] if len(others) == 1 else [(0, 0), (1, 0), (1, 1),
                                                       (0, 1)]
        corners = []
        for step in steps:
            place = list(index)
            for a, s in zip(others, step):
                place[a] += s
            corners.append(self.vertex(place))
        return corners

    def cells_in_ball(self, center, radius):
        """Cells all of whose vertices are in a ball, the nearest first."""
        found = []
        for cell in itertools.product(*(range(n) for n in self.counts)):
            vertices = [self.vertex([c + s for c, s in zip(cell, step)])
                        for step in itertools.product((0, 1), repeat=len(cell))]
            far = max(norm(difference(v, center)) for v in vertices)
            if far < radius:
                found.append((far, cell))
        return [cell for _, cell in sorted(found)]


def graded(n, ratio):
    """Places from 0 to 1 of n cells whose lengths grow to `ratio` times."""
    if ratio == 1. or n == 1:
        return [i / n for i in range(n + 1)]
    growth = ratio**(1. / (n - 1))
    return [(growth**i - 1.) / (growth**n - 1.) for i in range(n + 1)]
