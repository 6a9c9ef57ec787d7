#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bent joints against planes: the same blocks have to come out.

usage: surfaces.py KEYBLOCK PRM FOLDER CASE

CASE is the name of a function below, which writes two scenes, or one with two
sets of entries, and compares volumes and limit equilibrium of their blocks.
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

KEYBLOCK, PRM, FOLDER = (pathlib.Path(a).resolve() for a in sys.argv[1:4])


def blocks(scene, name, settings):
    """Blocks of a scene, largest first, and what was printed."""
    output = FOLDER / name
    command = [str(KEYBLOCK), str(scene), "--output", str(output)]
    for entry in settings:
        command += ["--set", entry]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    print(run.stdout[-3000:], run.stderr)
    assert run.returncode == 0, run.returncode
    summary = json.loads((output / "summary.json").read_text(encoding="utf-8"))
    return sorted(summary["blocks"], key=lambda b: -b["volume"]), run.stdout


def close(a, b, tolerance, what):
    assert abs(a - b) <= tolerance * abs(b), f"{what}: {a} is not {b}"


def same(found, expected, tolerance=1e-9):
    """As many blocks, with the same volumes, modes and factors."""
    assert len(found) == len(expected) > 0, f"{len(found)} blocks, not {len(expected)}"
    for a, b in zip(found, expected):
        assert ("exact_volume" in a) == ("exact_volume" in b)
        close(a.get("exact_volume", a["volume"]), b.get("exact_volume", b["volume"]),
              tolerance, "volume")
        assert a["removable"] == b["removable"]
        for x, y in zip(a.get("limit_equilibrium", []), b.get("limit_equilibrium", [])):
            print(x, y)
            assert x["outcome"] == y["outcome"] and x["mode"].split(" ")[0] == \
                y["mode"].split(" ")[0], f"{x} is not {y}"
            close(x.get("value", 1.), y.get("value", 1.), tolerance, "factor")


def stl(triangles):
    """ASCII STL of triangles, each three points."""
    lines = ["solid surface"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{x:.17g}" for x in p) for p in triangle]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid surface", ""])


STEP_HEAD = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('faces'),'2;1');
FILE_NAME('faces','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1 = APPLICATION_CONTEXT('core data for automotive mechanical design processes');
#2 = PRODUCT_CONTEXT('',#1,'mechanical');
#3 = PRODUCT('faces','faces','',(#2));
#4 = PRODUCT_DEFINITION_FORMATION('','',#3);
#5 = PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');
#6 = PRODUCT_DEFINITION('design','',#4,#5);
#7 = PRODUCT_DEFINITION_SHAPE('','',#6);
#8 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );
#9 = ( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) );
#10 = ( NAMED_UNIT(*) SI_UNIT($,.STERADIAN.) SOLID_ANGLE_UNIT() );
#11 = UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#8,'','');
#12 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#11))
GLOBAL_UNIT_ASSIGNED_CONTEXT((#8,#9,#10)) REPRESENTATION_CONTEXT('','') );
"""


def step(polygons):
    """STEP of plane faces, each with vertices of its own, in millimetres."""
    lines = []

    def add(text):
        lines.append(f"#{len(lines) + 13} = {text};")
        return f"#{len(lines) + 12}"

    def triple(kind, values):
        return add(f"{kind}('',({','.join(f'{x:.17E}' for x in values)}))")

    def minus(a, b):
        return [x - y for x, y in zip(a, b)]

    def unit(a):
        return [x / math.hypot(*a) for x in a]

    def cross(a, b):
        return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]

    faces = []
    for polygon in polygons:
        corners = [[1000. * x for x in p] for p in polygon]
        along = unit(minus(corners[1], corners[0]))
        normal = unit(cross(along, minus(corners[2], corners[0])))
        points = [triple("CARTESIAN_POINT", p) for p in corners]
        vertices = [add(f"VERTEX_POINT('',{p})") for p in points]
        edges = []
        for i, corner in enumerate(corners):
            j = (i + 1) % len(corners)
            way = triple("DIRECTION", unit(minus(corners[j], corner)))
            vector = add(f"VECTOR('',{way},1.)")
            line = add(f"LINE('',{points[i]},{vector})")
            edge = add(f"EDGE_CURVE('',{vertices[i]},{vertices[j]},{line},.T.)")
            edges.append(add(f"ORIENTED_EDGE('',*,*,{edge},.T.)"))
        loop = add(f"EDGE_LOOP('',({','.join(edges)}))")
        bound = add(f"FACE_BOUND('',{loop},.T.)")
        axes = triple("DIRECTION", normal), triple("DIRECTION", along)
        place = add(f"AXIS2_PLACEMENT_3D('',{points[0]},{axes[0]},{axes[1]})")
        plane = add(f"PLANE('',{place})")
        faces.append(add(f"ADVANCED_FACE('',({bound}),{plane},.T.)"))
    shell = add(f"OPEN_SHELL('',({','.join(faces)}))")
    model = add(f"SHELL_BASED_SURFACE_MODEL('',({shell}))")
    shape = add(f"MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',({model}),#12)")
    add(f"SHAPE_DEFINITION_REPRESENTATION(#7,{shape})")
    return STEP_HEAD + "\n".join(lines + ["ENDSEC;", "END-ISO-10303-21;", ""])


def plane_square(point, dip, direction, half, pieces):
    """Triangles of a square on a plane, in pieces x pieces parts."""
    a, b = math.radians(dip), math.radians(direction)
    down = (math.sin(b) * math.cos(a), math.cos(b) * math.cos(a), -math.sin(a))
    strike = (math.cos(b), -math.sin(b), 0.)

    def place(i, j):
        u, v = (2. * i / pieces - 1.) * half, (2. * j / pieces - 1.) * half
        return [p + u * d + v * s for p, d, s in zip(point, down, strike)]

    triangles = []
    for i in range(pieces):
        for j in range(pieces):
            a, b, c, d = place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def msh(points, cells, groups):
    """MSH 2.2; groups: {name: (dimension, number, elements)}, cells being the last."""
    kinds = {(1, 2): 1, (2, 4): 3, (3, 8): 5}
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(groups))]
    lines += [f'{d} {n} "{name}"' for name, (d, n, _) in groups.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{i + 1} " + " ".join(f"{x:.17g}" for x in p) for i, p in enumerate(points)]
    elements = [(d, n, e) for d, n, list_ in groups.values() for e in list_]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{i + 1} {kinds[d, len(e)]} 2 {n} {n} " + " ".join(str(v + 1) for v in e)
              for i, (d, n, e) in enumerate(elements)]
    return "\n".join(lines + ["$EndElements", ""])


def grid(sizes):
    """Points and cells of unit squares or cubes, corners as Gmsh orders them."""
    dim = len(sizes)
    counts = [s + 1 for s in sizes] + [1] * (3 - dim)

    def number(x):
        x = list(x) + [0] * (3 - dim)
        return (x[2] * counts[1] + x[1]) * counts[0] + x[0]

    points = [(x, y, z) for z in range(counts[2]) for y in range(counts[1])
              for x in range(counts[0])]
    around = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = around if dim == 2 else [(*c, z) for z in (0, 1) for c in around]
    origins = [p for p in points if all(p[d] < sizes[d] for d in range(dim))]
    cells = [[number([o[d] + c[d] for d in range(dim)]) for c in corners] for o in origins]
    return points, cells, number


def scene_in_file(dim, joints, gravity):
    """A corner block on faces of a mesh file, tilted so that it slides to +x."""
    names = ", ".join(joints)
    bodies = "".join(f"subsection {name}\n" + "".join(f"set {e}\n" for e in entries) + "end\n"
                     for name, entries in joints.items())
    truncated = "id ground"
    return f"""set Dimension = {dim}
subsection Domain
set Shape = file
set File = grid_{dim}.msh
set Truncated boundaries = {truncated}
end
subsection Mesh
set Generator = file
end
subsection Joints
set Names = {names}
{bodies}end
subsection Materials
set Names = rock
end
subsection Supports
set Names = ground
subsection ground
set Boundaries = {truncated}
end
end
subsection Initial state
set Gravity = {gravity}
end
subsection Stages
set Names = rest
subsection rest
set Kind = quasi-static
set Unbalanced ratio = 1e-3
end
end
subsection Safety factor
set Blocks = all
set Bracket = 0.1
end
"""


def mapped(point, dim):
    """A grid's point in a sheared grid, so that no face is along an axis."""
    x, y, z = point
    if dim == 2:
        return x + 0.2 * y, y - 0.1 * x, 0.
    return x + 0.2 * z, y + 0.1 * x, z - 0.1 * y - 0.05 * x


def physical_groups(dim):
    """Faces between the cells of a block and the rest as a group, or as planes."""
    sizes, low = ((8, 4), (4, 2)) if dim == 2 else ((4, 3, 3), (2, 1, 1))
    points, cells, number = grid(sizes)
    faces, ground, planes = [], [], {}
    around = [(0,), (1,)] if dim == 2 else [(0, 0), (1, 0), (1, 1), (0, 1)]
    for axis in range(dim):
        others = [d for d in range(dim) if d != axis]

        def at(values, place, axis=axis, others=others):
            x = [place] * dim
            for d, value in zip(others, values):
                x[d] = value
            return x

        for list_, place, start in ((faces, low[axis], low), (ground, 0, [0] * dim)):
            spans = [[]]
            for d in others:
                spans = [s + [i] for s in spans for i in range(start[d], sizes[d])]
            for origin in spans:
                list_.append([number(at([o + c for o, c in zip(origin, corner)], place))
                              for corner in around])
        ends = [[(low, sizes)[c][d] for c, d in zip(corner, others)] for corner in around]
        corners = [mapped((at(e, low[axis]) + [0])[:3], dim)[:dim] for e in ends]
        planes[f"plane {axis}"] = ["Extent = polygon", "Vertices = " + "; ".join(
            ", ".join(f"{x:.17g}" for x in p) for p in corners)]
    points = [mapped(p, dim) for p in points]
    FOLDER.mkdir(parents=True, exist_ok=True)
    # every other face turned round: its sides must not matter
    faces = [f if i % 2 else f[::-1] for i, f in enumerate(faces)]
    (FOLDER / f"grid_{dim}.msh").write_text(
        msh(points, cells, {"slip": (dim - 1, 7, faces), "ground": (dim - 1, 9, ground),
                              "rock": (dim, 8, cells)}),
        encoding="utf-8")
    gravity = "3; -9" if dim == 2 else "3; 1; -9"
    results = []
    for name, joints in (("planes", planes), ("group", {"slip": ["Shape = physical group"]}),
                         ("number", {"fault": ["Shape = physical group", "Group = 7"]})):
        scene = FOLDER / f"{name}_{dim}.prm"
        scene.write_text(scene_in_file(dim, joints, gravity), encoding="utf-8")
        results.append(blocks(scene, f"{name}_{dim}", [])[0])
    for found in results[1:]:
        same(found, results[0])
    # what used.prm says is the same scene, whose file it finds from its own folder
    same(blocks(FOLDER / f"number_{dim}" / "used.prm", f"again_{dim}", [])[0], results[0])


def physical_groups_2d():
    physical_groups(2)


def physical_groups_3d():
    physical_groups(3)


def areas(block):
    """Areas of a block's joints, of the parts of a bent one together."""
    sums = {}
    for name, area in block.get("exact_joint_areas", {}).items():
        surface = name.split("_")[0]
        sums[surface] = sums.get(surface, 0.) + area
    return sums


def roof_wedge():
    """A wedge of the roof whose three planes come from one file each."""
    scene = PRM / "tutorial" / "roof_wedge.prm"
    with open(PRM / "tutorial" / "roof_wedge.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    FOLDER.mkdir(parents=True, exist_ok=True)
    common = ["Mesh/Cells across blocks=0", "Mesh/Size=3", "Mesh/Size at excavation=1.5",
              "Stages/dig/Kind=dynamic", "Stages/dig/Duration=1e-9",
              "Stages/dig/Unbalanced ratio=0", "Stages/dig/Maximum steps=1",
              "Initial state/Equilibrium=none", "Safety factor/Wanted=0.01",
              "Safety factor/Lowest=0.009", "Output/Write VTU=false", "Joints/File="]
    planes, surfaces, shapes = [], [], []
    for row in rows:
        name = row["name"]
        point = [float(row[axis]) for axis in "xyz"]
        dip, direction = float(row["dip"]), float(row["dip direction"])
        strength = f"Joints/{name}/Friction angle={row['friction angle']}"
        planes += [strength, f"Joints/{name}/Dip={dip}",
                   f"Joints/{name}/Dip direction={direction}",
                   f"Joints/{name}/Point={point[0]}, {point[1]}, {point[2]}"]
        # one in parts, which lie in one plane
        pieces = 3 if name == "J2" else 1
        (FOLDER / f"{name}.stl").write_text(
            stl(plane_square(point, dip, direction, 60., pieces)), encoding="utf-8")
        (FOLDER / f"{name}.step").write_text(
            step(plane_square(point, dip, direction, 60., pieces)), encoding="utf-8")
        for list_, suffix in (surfaces, "stl"), (shapes, "step"):
            list_ += [strength, f"Joints/{name}/Shape=file",
                      f"Joints/{name}/File={FOLDER / name}.{suffix}"]
    names = ["Joints/Names=" + ", ".join(row["name"] for row in rows)]
    expected = blocks(scene, "planes", common + names + planes)[0]
    whole = sum(b["volume"] for b in expected)
    for label, settings, tolerance in (("surfaces", surfaces, 1e-9),
                                       ("shapes", shapes, 1e-8)):
        found = blocks(scene, label, common + names + settings)[0]
        assert len(found) == len(expected)
        close(sum(b["volume"] for b in found), whole, 1e-9, "volume of all blocks")
        # the mesh around them is another one, by rounding
        found, wanted = ([b for b in list_ if "exact_volume" in b]
                         for list_ in (found, expected))
        same(found, wanted, tolerance)
        for one, other in zip(found, wanted):
            assert areas(one).keys() == areas(other).keys()
            for name in areas(one):
                close(areas(one)[name], areas(other)[name], tolerance, f"area of {name}")


def trough():
    """The triangles of a curved fault as STEP faces that share no edge in the
    file: the plane facets are those of the STL file."""
    numbers = [float(x) for line in
               (PRM / "verification" / "trough.stl").read_text("utf-8").splitlines()
               if "vertex" in line for x in line.split()[1:]]
    points = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
    triangles = [points[i:i + 3] for i in range(0, len(points), 3)]
    FOLDER.mkdir(parents=True, exist_ok=True)
    (FOLDER / "trough.step").write_text(step(triangles), encoding="utf-8")
    scene = PRM / "verification" / "trough.prm"
    common = ["Mesh/Size=1", "Stages/rest/Kind=dynamic", "Stages/rest/Duration=1e-9",
              "Stages/rest/Unbalanced ratio=0", "Safety factor/Blocks=none"]
    blocks(scene, "triangles", common)
    blocks(scene, "shapes", common + [f"Joints/fault/File={FOLDER / 'trough.step'}"])
    facets = []
    for name in ("triangles", "shapes"):
        with open(FOLDER / name / "joints.csv", encoding="utf-8") as file:
            facets.append(sorted(
                sorted(tuple(float(x) for x in p.split(","))
                       for p in row["vertices (m)"].split(";"))
                for row in csv.DictReader(file)))
    assert len(facets[0]) == len(facets[1]) == 12
    for a, b in zip(*facets):
        assert len(a) == len(b) == 4
        for p, q in zip(a, b):
            assert math.dist(p, q) < 1e-8, f"{p} is not {q}"


def small_parts():
    """Exact meshes keep all plane parts of a bent joint. Those that coarse cells lose are told
    where joints are cut into a mesh, as beside planes a hair apart."""
    scene = PRM / "verification" / "trough.prm"
    common = ["Stages/rest/Kind=dynamic", "Stages/rest/Duration=1e-9",
              "Stages/rest/Unbalanced ratio=0", "Safety factor/Blocks=none"]
    hair = ["Joints/Names=fault, a, b", "Joints/a/Normal=1, 0, 0", "Joints/a/Point=5, 0, 0",
            "Joints/b/Normal=1, 0, 0", "Joints/b/Point=5.0002, 0, 0"]
    for size, others in (3., []), (0.6, []), (3., hair), (2., hair):
        name = f"size_{size}_{len(others)}"
        printed = blocks(scene, name, common + others + [
            f"Mesh/Size={size}", f"Mesh/Least size={size}"])[1]
        summary = json.loads((FOLDER / name / "summary.json").read_text("utf-8"))
        lost = summary["mesh"].get("plane_parts_lost", {}).get("fault", 0)
        sentence = f"{lost} of the 12 plane parts of the joint 'fault' are too small"
        assert (sentence in printed) == (lost > 0)
        assert (lost > 0) == bool(others), f"{lost} lost with cells of {size} m"


def touching_solids():
    """No chords are told of plane solids from files that touch and are dug at the start."""
    def solid(low, high):
        around = [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)]
        rings = [[tuple((a + b) / 2. + s * (b - a) / 2. for a, b, s in
                        zip(low, high, (*p, end))) for p in around] for end in (-1., 1.)]
        faces = [(ring[0], *ring[i:i + 2]) for ring in (rings[0][::-1], rings[1])
                 for i in range(1, len(around) - 1)]
        for i, (a, b) in enumerate(zip(*rings)):
            j = (i + 1) % len(around)
            faces += [(a, rings[0][j], rings[1][j]), (a, rings[1][j], b)]
        return stl(faces)

    FOLDER.mkdir(parents=True, exist_ok=True)
    shapes = {"left": solid((-4, -4, -4), (0, 4, 4)), "right": solid((0, -4, -2), (4, 4, 4))}
    text = ["set Dimension = 3", "subsection Domain", "set Corner = -15, -15, -15",
            "set Size = 30, 30, 30", "end", "subsection Mesh", "set Generator = gmsh",
            "set Size = 5", "set Size at excavation = 2", "end", "subsection Materials",
            "set Names = rock", "end", "subsection Excavations",
            "set Names = " + ", ".join(shapes)]
    for name, shape in shapes.items():
        (FOLDER / f"{name}.stl").write_text(shape, encoding="utf-8")
        text += [f"subsection {name}", "set Shape = file", f"set File = {name}.stl", "end"]
    scene = FOLDER / "solids.prm"
    scene.write_text("\n".join(text + ["end", ""]), encoding="utf-8")
    run = subprocess.run([str(KEYBLOCK), "--validate", str(scene)],
                         capture_output=True, text=True, check=False)
    print(run.stdout, run.stderr)
    assert run.returncode == 0, run.returncode
    assert "Cells leave the surface" not in run.stdout


if __name__ == "__main__":
    globals()[sys.argv[4]]()
