# SPDX-License-Identifier: LGPL-2.1-or-later
"""Excavations and bolts of a scene after a move (scene_moves.py). Profiles
(rectangle, horseshoe, cavern, circle) become polygons where a move turns them;
lengths in metres, angles in degrees."""
import math

from scene_domain import CannotExpress, domain_edges
from scene_tree import Section, numbers_of, points_of, text_of_points

PROFILES = ("rectangle", "horseshoe", "cavern", "circle")


def number(tree, path, default=0.):
    """The number of an entry."""
    text = tree.get(path)
    return float(text) if text.strip() else default


def is_profile(tree, name):
    """Whether the program draws the excavation's section as a polygon."""
    part = f"Excavations/{name}/"
    shape = tree.get(part + "Shape", "polygon")
    if shape != "circle":
        return shape in PROFILES
    return (int(tree.get("Dimension")) == 3 or number(tree, part + "Segments") > 0
            or bool(tree.get(part + "Bench levels").strip()))


def cell_at_excavations(tree):
    """Size of cells at excavations as the program counts chords; 0: unknown."""
    size = number(tree, "Mesh/Size at excavation")
    if size > 0.:
        return size
    if number(tree, "Mesh/Cells across blocks") > 0.:
        return 0.
    return number(tree, "Mesh/Size")


def number_of_chords(arc, cell):
    """Chords of a crown if the scene does not give them."""
    return 24 if cell == 0. else min(24, max(6, int(arc / (2. * cell))))


def rise_of(tree, part):
    """Rise of the arch of a rectangle (0), horseshoe or cavern."""
    half = 0.5 * number(tree, part + "Width")
    return {"rectangle": 0., "horseshoe": half}.get(
        tree.get(part + "Shape"), number(tree, part + "Rise"))


def crown_of(tree, part):
    """(radius, half angle) of the arch of a horseshoe or cavern; None: flat."""
    half, rise = 0.5 * number(tree, part + "Width"), rise_of(tree, part)
    if rise == 0.:
        return None
    radius = 0.5 * (half * half / rise + rise)
    return radius, math.asin(min(1., half / radius))


def chords_of(tree, name):
    """Number of chords (Segments) that the program takes for a profile; 0: it
    has no arch."""
    part = f"Excavations/{name}/"
    given = int(number(tree, part + "Segments"))
    cell = cell_at_excavations(tree)
    if tree.get(part + "Shape") == "circle":
        return (max(2, given) if given else
                number_of_chords(math.pi * number(tree, part + "Radius"), cell))
    crown = crown_of(tree, part)
    if crown is None:
        return 0
    return given or number_of_chords(2. * crown[1] * crown[0], cell)


def section_of(tree, name):
    """Corners of a profile's section, counterclockwise."""
    part = f"Excavations/{name}/"
    x, y = (numbers_of(tree.get(part + "Center")) or [0., 0.])[:2]
    chords = chords_of(tree, name)
    if tree.get(part + "Shape") == "circle":
        turn = math.pi / chords
        radius = number(tree, part + "Radius") * math.sqrt(turn / math.sin(turn))
        return [(x - radius * math.sin(i * turn), y + radius * math.cos(i * turn))
                for i in range(2 * chords)]
    half, height = 0.5 * number(tree, part + "Width"), number(tree, part + "Height")
    crown = crown_of(tree, part)
    if crown is None:
        return [(x - half, y), (x + half, y), (x + half, y + height),
                (x - half, y + height)]
    radius, angle = crown
    spring = height - rise_of(tree, part)
    angles = [angle * (1. - 2. * i / chords) for i in range(1, chords)]
    arch = [(x + radius * math.sin(a),
             y + height - radius * (1. - math.cos(a))) for a in angles]
    ends = ([(x + half, y + spring)], [(x - half, y + spring)])
    if spring <= 1e-12 * height:
        ends = ([], [])
    return [(x - half, y), (x + half, y)] + ends[0] + arch + ends[1]


def cut_out(polygon, low, high):
    """The part of a convex polygon between two elevations."""
    close = 1e-9 * math.dist(polygon[0], polygon[1])
    for level, sign in ((low, 1.), (high, -1.)):
        def height(p, level=level, sign=sign):
            return sign * (p[1] - level) if abs(p[1] - level) > close else 0.
        cut = []
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            ha, hb = height(a), height(b)
            if ha >= 0.:
                cut.append(a)
            if ha * hb < 0.:
                cut.append((a[0] + ha / (ha - hb) * (b[0] - a[0]), level))
        polygon = cut
    return polygon


def parts_of_profile(tree, name):
    """(name, corners, stage) of a profile and its benches."""
    part = f"Excavations/{name}/"
    levels = numbers_of(tree.get(part + "Bench levels"))
    stages = [s.strip() for s in tree.get(part + "Bench stages").split(",")
              if s.strip()]
    section = section_of(tree, name)
    high = max(p[1] for p in section) + 1.
    bounds = [high] + levels + [min(p[1] for p in section) - 1.]
    stages = [tree.get(part + "Stage", "start")] + stages
    return [(name if i == 0 else f"{name} bench {i}",
             cut_out(section, bounds[i + 1], bounds[i]) if levels else section,
             stage)
            for i, stage in enumerate(stages)]


def backfill_of(tree, name):
    """The entries of an excavation's fill."""
    part = f"Excavations/{name}/"
    return {entry: tree.get(part + entry)
            for entry in ("Backfill stage", "Backfill material")
            if tree.get(part + entry)}


class Prism:
    """A prism in 3D: corners of its section, and ends along its axis.

    A point of it is `pivot + u * across + v * up + w * along`, for the corners
    (u, v) and w from `begin` to `end`; the axes are unit vectors."""

    def __init__(self, corners, begin, end, trend, plunge, pivot):
        t, f = math.radians(trend), math.radians(plunge)
        self.corners, self.begin, self.end = corners, begin, end
        self.pivot = pivot
        self.along = [math.sin(t) * math.cos(f), math.cos(t) * math.cos(f),
                      -math.sin(f)]
        self.across = [math.cos(t), -math.sin(t), 0.]
        self.up = [math.sin(t) * math.sin(f), math.cos(t) * math.sin(f),
                   math.cos(f)]

    def moved(self, move):
        """The entries of the extruded polygon after a move."""
        along = move.vector(self.along)
        begin, end = self.begin, self.end
        if along[2] > 1e-12 or (abs(along[2]) <= 1e-12 and along[1] < -1e-12):
            along, begin, end = [-a for a in along], -end, -begin
        plunge = math.degrees(math.asin(max(-1., min(1., -along[2]))))
        is_plumb = math.hypot(along[0], along[1]) < 1e-12
        trend = 0. if is_plumb else math.degrees(math.atan2(along[0], along[1]))
        frame = Prism([], 0., 0., trend, plunge, None)
        corners, offset = [], 0.
        for u, v in self.corners:
            place = move.point([p + u * a + v * b for p, a, b in
                                zip(self.pivot, self.across, self.up)])
            corners.append((dot(place, frame.across), dot(place, frame.up)))
            offset = dot(place, frame.along)
        if area_of(corners) < 0.:
            corners.reverse()
        return {"Shape": "extruded polygon", "Vertices": text_of_points(corners),
                "From": begin + offset, "To": end + offset,
                "Trend": trend % 360., "Plunge": plunge}


def dot(a, b):
    """The scalar product."""
    return sum(x * y for x, y in zip(a, b))


def area_of(corners):
    """Twice the area of a polygon, positive if it is counterclockwise."""
    return sum(a[0] * b[1] - a[1] * b[0]
               for a, b in zip(corners, corners[1:] + corners[:1]))


def prisms_of(tree, name):
    """(name, prism, stage) of an excavation in 3D."""
    part = f"Excavations/{name}/"
    shape = tree.get(part + "Shape")
    stage = tree.get(part + "Stage", "start")
    if shape == "box":
        x, y, z = numbers_of(tree.get(part + "Corner"))
        a, b, c = numbers_of(tree.get(part + "Size"))
        corners = [(x, z), (x + a, z), (x + a, z + c), (x, z + c)]
        return [(name, Prism(corners, y, y + b, 0., 0., [0.] * 3), stage)]
    ends = [number(tree, part + entry)
            for entry in ("From", "To", "Trend", "Plunge")]
    if shape == "extruded polygon":
        corners = points_of(tree.get(part + "Vertices"))
        return [(name, Prism(corners, *ends, [0.] * 3), stage)]
    x, z = (numbers_of(tree.get(part + "Center")) or [0., 0.])[:2]
    return [(new, Prism([(u - x, v - z) for u, v in corners], *ends, [x, 0., z]),
             when)
            for new, corners, when in parts_of_profile(tree, name)]


def moved_in_2d(tree, name, move):
    """(name, entries) of an excavation in 2D after a move."""
    part = f"Excavations/{name}/"
    shape = tree.get(part + "Shape", "polygon")
    stage = tree.get(part + "Stage", "start")
    if shape == "circle" and not is_profile(tree, name):
        center = numbers_of(tree.get(part + "Center")) or [0., 0.]
        return [(name, {"Shape": "circle", "Center": move.point(center[:2]),
                        "Radius": tree.get(part + "Radius"), "Stage": stage})]
    if shape == "box":
        x, y = numbers_of(tree.get(part + "Corner"))
        a, b = numbers_of(tree.get(part + "Size"))
        parts = [(name, [(x, y), (x + a, y), (x + a, y + b), (x, y + b)], stage)]
    elif shape == "polygon":
        parts = [(name, points_of(tree.get(part + "Vertices")), stage)]
    else:
        parts = parts_of_profile(tree, name)
    moved = []
    for new, corners, when in parts:
        corners = [move.point(p) for p in corners]
        if move.mirrors:
            corners.reverse()
        moved.append((new, {"Shape": "polygon", "Stage": when,
                            "Vertices": text_of_points(corners)}))
    return moved


def moved_excavation(tree, name, move):
    """(name, entries) of the excavation, and of its benches, after a move."""
    part = f"Excavations/{name}/"
    shape = tree.get(part + "Shape", "polygon")
    if shape == "formula":
        return [(name, {"Shape": shape, "Stage": tree.get(part + "Stage", "start"),
                        "Formula": move.scalar_formula(
                            tree.get(part + "Formula"))})]
    if shape == "file":
        raise CannotExpress(f"the excavation '{name}' is in a file")
    if move.dim == 2:
        return moved_in_2d(tree, name, move)
    return [(new, {**prism.moved(move), "Stage": when})
            for new, prism, when in prisms_of(tree, name)]


def shifted_box(tree, name, move):
    """The entries of a box that is not turned."""
    part = f"Excavations/{name}/"
    corner = numbers_of(tree.get(part + "Corner"))
    size = numbers_of(tree.get(part + "Size"))
    ends = [move.point(corner),
            move.point([c + s for c, s in zip(corner, size)])]
    return {"Shape": "box", "Stage": tree.get(part + "Stage", "start"),
            "Corner": [min(pair) for pair in zip(*ends)],
            "Size": tree.get(part + "Size")}


def move_excavations(tree, move, result):
    """Put the moved excavations into `result`. Those that are not turned keep
    their shape if it is a box."""
    if not tree.names("Excavations"):
        return
    names = []
    result.sections["Excavations"] = Section()
    for name in tree.names("Excavations"):
        shape = tree.get(f"Excavations/{name}/Shape", "polygon")
        if shape == "box" and not move.turns:
            moved = [(name, shifted_box(tree, name, move))]
        else:
            moved = moved_excavation(tree, name, move)
        for new, entries in moved:
            names.append(new)
            for entry, value in {**entries, **backfill_of(tree, name)}.items():
                result.set(f"Excavations/{new}/{entry}", value)
    result.set("Excavations/Names", ", ".join(names))


def bolt_mover(bolts):
    """A function that moves sets of bolts.

    `bolts`: those of a run's summary, by which patterns that a turn cannot
    express are written out as single bolts."""
    def move_bolts(tree, move, result):
        for name in tree.names("Bolts"):
            part = f"Bolts/{name}/"
            if not tree.get(part + "Excavations"):
                continue
            is_inclined = number(tree, part + "Inclination") != 0.
            if move.dim == 3 and (move.turns or (move.mirrors and is_inclined)):
                own = [bolt for bolt in bolts if bolt["set"] == name]
                if not own:
                    raise CannotExpress(f"the pattern '{name}' has no bolts")
                write_out(own, move, part, result)
            elif move.mirrors:
                result.set(part + "Inclination",
                           -number(tree, part + "Inclination"))
    return move_bolts


def write_out(bolts, move, part, result):
    """Single bolts in the place of a pattern."""
    for entry in ("Excavations", "Parts", "Region", "Length", "Inclination",
                  "Direction", "Axis"):
        result.remove(part + entry)
    result.set(part + "Heads",
               text_of_points([move.point(bolt["head"]) for bolt in bolts]))
    result.set(part + "Ends",
               text_of_points([move.point(bolt["end"]) for bolt in bolts]))


def longest_side(tree):
    """The longest side of the domain [m]."""
    if tree.get("Domain/Shape") == "polygon":
        corners = points_of(tree.get("Domain/Polygon"))
        return max(max(axis) - min(axis) for axis in zip(*corners))
    return max(math.sqrt(dot(edge, edge)) for edge in domain_edges(tree))
