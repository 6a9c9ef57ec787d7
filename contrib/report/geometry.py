# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces of the rock in the states of a run: what can be seen of it.

Cells of all states are brought together; a cell or face has, as the bits of one
number, the states in which it is seen. Coordinates are those before any motion,
displacements stand beside them."""
import numpy

from .reading import ReportError
from .vtu import STRESS, largest_pressure, read_cells, read_polygons

# corners of the faces of a quadrilateral and of a hexahedron, seen from outside
FACES = {4: ((0, 1), (1, 2), (2, 3), (3, 0)),
         8: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
             (2, 3, 7, 6), (3, 0, 4, 7))}
FREE, HULL, JOINT = 0, 1, 2  # kinds of faces
SALT = numpy.random.RandomState(1).randint(1, 2**62, 512, numpy.int64)


def keys_of(rows):
    """A number for each row, equal for equal rows (in all likelihood)."""
    words = numpy.ascontiguousarray(rows).view(numpy.uint32).reshape(
        len(rows), -1).astype(numpy.uint64)
    salt = (2 * SALT[:words.shape[1]] + 1).astype(numpy.uint64)
    mixed = words * salt
    mixed ^= mixed >> numpy.uint64(29)
    return (mixed * salt).sum(axis=1, dtype=numpy.uint64)


def unique_rows(rows):
    """Indices of the first of equal rows, and which one each row is."""
    _, first, number = numpy.unique(keys_of(rows), return_index=True,
                                    return_inverse=True)
    return first, number.ravel()


DOWN = numpy.array([0., 1e-3, -1.])  # not quite, so that north is upwards


def is_shaft(places, along):
    """Whether what is dug is higher by half than it is long."""
    return numpy.ptp(places[:, 2]) > 1.5 * numpy.ptp(places @ along)


class Geometry:
    """Cells, half-faces and displacements of a run."""

    def __init__(self, run):
        """Read the states and find the half-faces of all cells."""
        self.run = run
        if not run.states:
            raise ReportError(run.why_no_states)
        self.read_states()
        self.number_vertices()
        self.find_faces()
        self.find_joints()
        self.find_seen()

    def read_states(self):
        """Corners, blocks and displacements of the cells of all states."""
        names = ["displacement", "block", "material"]
        states = [read_cells(rock, names, STRESS)
                  for _, _, rock, _ in self.run.states]
        states = [(corners.astype(numpy.float32), fields)
                  for corners, fields in states]  # as those of the joints
        states = [state for state in states if len(state[0])]
        if not states:
            raise ReportError("There are no pictures, as the files of the "
                              "rock have no cells.")
        keys = [keys_of(corners.reshape(len(corners), -1))
                for corners, _ in states]
        _, first, number = numpy.unique(numpy.concatenate(keys),
                                        return_index=True, return_inverse=True)
        self.corners = numpy.concatenate([c for c, _ in states])[first]
        block = numpy.concatenate([f["block"][:, 0] for _, f in states])
        self.block = block[first].astype(int)
        self.material = numpy.concatenate(
            [f["material"][:, 0] for _, f in states])[first].astype(int)
        pressures = [largest_pressure(f) for _, f in states]
        self.pressure = None  # major principal stress (states, cells)
        if not any(p is None for p in pressures):
            self.pressure = numpy.full((len(states), len(self.corners)),
                                       numpy.nan, numpy.float32)
        shape = len(states), *self.corners.shape
        self.moved = numpy.full(shape, numpy.nan, numpy.float32)
        begin = 0
        for k, (corners, fields) in enumerate(states):
            mine = number.ravel()[begin:begin + len(corners)]
            self.moved[k, mine] = fields["displacement"]
            if self.pressure is not None:
                self.pressure[k, mine] = pressures[k]
            begin += len(corners)
        self.is_there = ~numpy.isnan(self.moved[:, :, 0, 0])
        finite = self.run.finite_blocks()
        self.is_finite = numpy.isin(self.block, finite)

    def number_vertices(self):
        """A number for each place, so that sides of a joint share theirs."""
        places = self.corners.reshape(-1, 3)
        first, number = unique_rows(places)
        self.places = places[first]
        self.vertex = number.reshape(self.corners.shape[:2])

    def find_faces(self):
        """Half-faces: cell, corners, cell on the other side, place of face."""
        local = numpy.array(FACES[self.corners.shape[1]])
        n_cells = len(self.vertex)
        corner = numpy.broadcast_to(local, (n_cells, *local.shape))
        corner = corner.reshape(-1, local.shape[1])
        cell = numpy.repeat(numpy.arange(n_cells), len(local))
        vertices = self.vertex[cell[:, None], corner]
        key = numpy.sort(vertices, axis=1).astype(numpy.uint32)
        _, face = unique_rows(key)
        order = numpy.argsort(face, kind="stable")
        other = numpy.full(len(face), -1)
        same = face[order[1:]] == face[order[:-1]]
        a, b = order[:-1][same], order[1:][same]
        other[a], other[b] = cell[b], cell[a]
        self.face_cell, self.face_corner = cell, corner
        self.face_other, self.face_vertices = other, vertices
        self.face_key = keys_of(key)
        alone = numpy.flatnonzero(other < 0)
        self.face_kind = numpy.full(len(face), FREE, numpy.uint8)
        self.face_kind[alone[self.is_on_hull(vertices[alone])]] = HULL
        self.leave_hanging(alone)
        differs = other >= 0
        differs[differs] = self.block[cell[differs]] != self.block[
            other[differs]]
        self.face_differs = differs

    def is_on_hull(self, vertices):
        """Whether faces lie on the outer boundary where the rock goes on.

        The sides that Truncated boundaries names, of a box or parallelepiped
        or else of the box around the cells; all where it names groups of a
        mesh file, which are not known here."""
        wanted = self.run.entries.get("Domain/Truncated boundaries", "all")
        wanted = {word.strip() for word in wanted.split(",")}
        sides = self.sides_of_box(vertices)
        if not wanted <= {"all", "none", *sides}:
            wanted = {"all"}
        return sum((on_side for name, on_side in sides.items()
                    if wanted & {"all", name}), numpy.zeros(len(vertices), bool))

    def sides_of_box(self, vertices):
        """Which faces lie on each side, by its name, of the domain or of the box
        around the cells."""
        entries, n = self.run.entries, 2 if self.run.is_plane else 3
        names = (["left", "right", "bottom", "top"] if n == 2 else
                 ["left", "right", "front", "back", "bottom", "top"])
        corner = numpy.array(self.run.numbers("Domain/Corner"))
        edges = numpy.array(self.run.numbers("Domain/Edges"))
        size = self.run.numbers("Domain/Size")
        if entries.get("Domain/Shape") == "box" and len(size) == n:
            edges = numpy.diag(size)
        elif entries.get("Domain/Shape") != "parallelepiped" or len(
                edges) != n * n:
            low = self.places.min(axis=0)[:n]
            corner = low
            edges = numpy.diag(numpy.maximum(
                self.places.max(axis=0)[:n] - low, 1e-30))
        share = (self.places[vertices][:, :, :n] - corner[:n]) @ numpy.linalg.inv(
            edges.reshape(n, n))
        return {name: (abs(share[:, :, k // 2] - k % 2) < 1e-5).all(axis=1)
                for k, name in enumerate(names)}

    def leave_hanging(self, alone):
        """Faces between cells of different size are no free faces."""
        alone = alone[self.face_kind[alone] == FREE]
        if not len(alone):
            return
        step = 1e-5 * numpy.ptp(self.places, axis=0).max()

        def rounded(points):
            return keys_of(numpy.rint(points / step).astype(numpy.int32))

        vertices = self.face_vertices[alone]
        centres = rounded(self.places[vertices].mean(axis=1))
        corners = rounded(self.places[vertices].reshape(-1, 3)).reshape(
            vertices.shape)
        is_coarse = numpy.isin(centres, corners)
        is_fine = numpy.isin(corners, centres[is_coarse]).any(axis=1)
        self.face_kind[alone[is_coarse | is_fine]] = JOINT

    def find_joints(self):
        """The joint of each half-face, -1 for none, from the interface."""
        self.face_joint = numpy.full(len(self.face_cell), -1)
        known = {place.tobytes(): i for i, place in enumerate(self.places)}
        for *_, path in self.run.states:
            if path is None or not path.exists():
                continue
            corners, fields = read_cells(path, ["joint"])
            if not len(corners):
                continue
            corners = corners.astype(numpy.float32)
            vertices = numpy.array([known.get(point.tobytes(), 0) for point in
                                    corners.reshape(-1, 3)])
            vertices = vertices.reshape(corners.shape[:2])
            keys = keys_of(numpy.sort(vertices, axis=1).astype(numpy.uint32))
            # at the tips of joints, where sides are one, 0 is written
            joint = fields["joint"].max(axis=1).astype(int)
            order = numpy.argsort(keys)
            at = numpy.searchsorted(keys[order], self.face_key)
            at = numpy.minimum(at, len(keys) - 1)
            hit = keys[order][at] == self.face_key
            self.face_joint[hit] = joint[order][at][hit]
        if self.run.is_plane:
            self.find_welded_joints()

    def find_welded_joints(self):
        """Joints between blocks that are welded: the nearest trace (2D)."""
        faces = numpy.flatnonzero(self.face_differs & (self.face_joint < 0))
        ends = self.places[self.face_vertices[faces]][:, :, :2].astype(float)
        middle = ends.mean(axis=1)
        nearest = 0.25 * numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        for trace, joint in zip(*self.joint_polygons()):
            if len(trace) != 2:
                continue
            start, along = trace[0, :2], trace[1, :2] - trace[0, :2]
            share = (middle - start) @ along / max(along @ along, 1e-30)
            foot = start + numpy.clip(share, 0., 1.)[:, None] * along
            far = numpy.linalg.norm(middle - foot, axis=1)
            closer = far < nearest
            self.face_joint[faces[closer]] = joint
            nearest[closer] = far[closer]

    def find_seen(self):
        """States in which half-faces are free, and those to be drawn.

        Of finite blocks all outer faces are drawn, of other rock the free; in
        3D not the bare sides of the domain, as the ground around a shaft,
        where something is dug."""
        there, cell, other = self.is_there, self.face_cell, self.face_other
        is_dug = numpy.ones(len(cell), bool)
        alone = numpy.flatnonzero(~self.is_finite[cell] & (other < 0)
                                  & (self.face_kind == FREE))
        if not self.run.is_plane and self.run.digs():
            is_dug[alone] = ~numpy.any([*self.sides_of_box(
                self.face_vertices[alone]).values()], axis=0)
        self.free_in = numpy.zeros(len(cell), numpy.uint32)
        self.seen_in = numpy.zeros(len(cell), numpy.uint32)
        finite = self.is_finite[cell]
        for k, present in enumerate(there):
            beside = (other >= 0) & present[other]
            free = present[cell] & ~beside & is_dug & (self.face_kind == FREE)
            outer = present[cell] & finite & (
                ~beside | self.face_differs) & (self.face_kind != JOINT)
            bit = numpy.uint32(1 << k)
            self.free_in[free] |= bit
            self.seen_in[free | outer] |= bit

    def normals(self, faces):
        """Outward normals of half-faces times their areas (or lengths)."""
        points = self.places[self.face_vertices[faces]].astype(float)
        if points.shape[1] == 2:
            along = points[:, 1] - points[:, 0]
            return numpy.column_stack([along[:, 1], -along[:, 0],
                                       numpy.zeros(len(faces))])
        return 0.5 * numpy.cross(points[:, 2] - points[:, 0],
                                 points[:, 3] - points[:, 1])

    def free_normal(self, number, since=-1):
        """Mean outward normal of the free faces of a block, and their area.

        In the first state from stage `since` (-1: the start) on; a block that
        fell before that state was written had these faces as well. None if it
        has none; the normal is None if they cancel."""
        mine = numpy.flatnonzero((self.block[self.face_cell] == number)
                                 & (self.face_kind == FREE))
        other = self.face_other[mine]
        alone = other < 0
        for (_, stage, *_), there in zip(self.run.states, self.is_there):
            free = alone | (~there[other] & ~self.is_finite[other])
            if stage >= since and free.any():
                normals = self.normals(mine[free])
                total = normals.sum(axis=0)
                size = numpy.linalg.norm(total)
                area = numpy.linalg.norm(normals, axis=1).sum()
                return (total / size if size > 1e-3 * area else None), area
        return None

    def displacement(self, number):
        """Largest displacement of a block in each state, None where it is not."""
        mine = self.moved[:, self.block == number].reshape(
            len(self.moved), -1, 3)
        largest = [numpy.linalg.norm(state, axis=1) for state in mine]
        return [float(numpy.nanmax(s)) if len(s) and not numpy.isnan(s).all()
                else None for s in largest]

    def box_of_interest(self):
        """Least and greatest coordinates about what is dug and could fall."""
        shown = (self.free_in > 0)
        exposed = [n for n in self.run.finite_blocks()
                   if "exposed_stage" in self.run.blocks[n]]
        shown |= numpy.isin(self.block[self.face_cell], exposed)
        if not shown.any():
            shown |= self.seen_in > 0
        if not shown.any():
            shown[:] = True
        points = self.places[self.face_vertices[shown]].reshape(-1, 3)
        low, high = points.min(axis=0), points.max(axis=0)
        margin = 0.15 * (high - low).max()
        whole = self.places.min(axis=0), self.places.max(axis=0)
        return (numpy.maximum(low - margin, whole[0]),
                numpy.minimum(high + margin, whole[1]))

    def joint_polygons(self):
        """Polygons (2D: lines) of joints.vtu, and the joint of each."""
        path = self.run.folder / "joints.vtu"
        if not path.exists():
            return [], []
        try:
            polygons, fields = read_polygons(path, ["joint"])
        except ReportError:
            return [], []
        return polygons, [int(j) for j in fields["joint"]]

    def place_inside(self):
        """A place in what is dug, and the direction in which it is longest.

        Of a shaft, higher than long by half, that is down from its top."""
        dug = self.is_there[0] & ~self.is_there[-1] & ~self.is_finite
        if not dug.any():
            return None
        centres = self.corners[dug].mean(axis=1).astype(float)
        middle = centres.mean(axis=0)
        around = centres - middle
        around[:, 2] = 0.
        along = numpy.linalg.svd(around[::max(1, len(around) // 5000)],
                                 full_matrices=False)[2][0]
        if is_shaft(centres, along):
            along, around = DOWN, centres - middle
        back = centres[(around @ along).argmin()]
        nearest = middle + (around @ along).min() * 0.85 * along
        place = centres[numpy.linalg.norm(centres - nearest, axis=1).argmin()]
        return (place if len(centres) > 1 else back), along
