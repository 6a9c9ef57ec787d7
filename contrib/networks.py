#!/usr/bin/env python3
"""Meshes random joint networks around a tunnel and tabulates how well.

usage: contrib/networks.py [--kinds traces,discs,planes,lines,faces,polylines,sheets]
         [--numbers 20,50]
         [--seeds 1-5] [--least 0.05] [--run | --initial] [--residual 1e-9]
         [--ranks N]
         [--keyblock build/keyblock] [--keep FOLDER]
         [-- arguments for keyblock]

traces: 2D, a horseshoe 10 m wide in 80 m, two sets of traces of 3 to 20 m;
discs, planes: 3D, a tunnel of 6 m, 30 m long, in a cube of 40 m, three sets.
lines (2D), faces (3D): all that a mesh can stumble over: joints of every extent
through corners of excavations and of the domain, on their sides, ends on other
joints, at 1 degree to each other, twice at the same place or almost, tiny ones;
around a horseshoe, a box, a circle, two excavations, or none.
polylines (2D), sheets (3D): bent joints, lines with kinks and surfaces of triangles
with noise, across the same tunnels as traces and planes.
The stable step is compared with the cell size at the excavation over the
velocity of pressure waves. With --run the tunnel is dug until all is at rest
or blocks move off; with --initial one step is done, and no contact may slide or
open in the hydrostatic state before. Exits with 1 if a scene was refused or crashed, has a ratio
below --least, or a run a larger --residual of the energy ledger, a result
that is not finite, or contacts through the rock of a block.
"""
import json
import math
import random
import re
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from script_tools import make_parser, numbers, split_arguments

YOUNG, POISSON, DENSITY, GRAVITY = 15e9, 0.25, 2700., 9.81
VELOCITY = math.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY)
SIZE_AT_EXCAVATION = {2: 0.5, 3: 1.2}
SETS = [(60, 30), (55, 150), (25, 280)]  # dip, dip direction in 3D
NUMBERS = {"traces": [20, 50, 100, 200, 400], "discs": [5, 10, 20, 50, 100],
           "planes": [3, 5, 8, 12, 20], "lines": [5, 15, 40], "faces": [3, 8, 20],
           "polylines": [3, 10, 30], "sheets": [1, 3]}
KINDS_IN_2D = ("traces", "lines", "polylines")
CORNERS = {2: ((-40, -40), (80, 80)), 3: ((-20, 0, -20), (40, 40, 40))}


def text(values):
    return ", ".join(f"{v:.9g}" for v in values)


def section(name, entries):
    lines = "".join(f"  {e}\n" if not isinstance(e, str) or "\n" in e else f"  set {e}\n"
                    for e in entries)
    return f"subsection {name}\n{lines}end\n"


def traces(n, rng):
    """Ends of traces: two sets, dipping 60 degrees to +x and 35 to -x."""
    joints = []
    for i in range(n):
        dip = math.radians((60. if i % 2 == 0 else -35.) + rng.uniform(-10, 10))
        x, y, length = rng.uniform(-40, 40), rng.uniform(-40, 40), rng.uniform(3, 20)
        dx, dy = math.cos(dip) * length / 2, -math.sin(dip) * length / 2
        joints.append(["Extent = polygon",
                       f"Vertices = {text((x - dx, y - dy))}; {text((x + dx, y + dy))}"])
    return joints


def faces(n, rng, has_rim):
    joints = []
    for i in range(n):
        dip, direction = (v + rng.uniform(-10, 10) for v in SETS[i % 3])
        point = rng.uniform(-14, 14), rng.uniform(6, 34), rng.uniform(-12, 14)
        radius = rng.uniform(3, 10)
        joints.append([f"Point = {text(point)}", f"Dip = {dip:.9g}",
                       f"Dip direction = {direction % 360:.9g}"] +
                      (["Extent = disc", f"Radius = {radius:.9g}"] if has_rim else []))
    return joints


def polylines(n, rng):
    """Lines with kinks that wander about a direction, so that none crosses itself."""
    joints = []
    for _ in range(n):
        x, y = rng.uniform(-40, 40), rng.uniform(-40, 40)
        mean, spread = rng.uniform(0, math.pi), rng.uniform(0.05, 1.2)
        step = rng.uniform(1, 12)
        points = [(x, y)]
        for _ in range(rng.randint(1, 20)):
            angle = mean + rng.uniform(-spread, spread)
            x, y = x + step * math.cos(angle), y + step * math.sin(angle)
            points.append((x, y))
        joints.append(["Shape = polyline", "Vertices = " + "; ".join(text(p) for p in points)])
    return joints


def sheet(rng):
    """The triangles of a noisy plane, ASCII STL."""
    dip, direction = math.radians(rng.uniform(10, 80)), rng.uniform(0, 2 * math.pi)
    along = [(math.sin(direction) * math.cos(dip), math.cos(direction) * math.cos(dip),
              -math.sin(dip)), (math.cos(direction), -math.sin(direction), 0.)]
    normal = (math.sin(direction) * math.sin(dip), math.cos(direction) * math.sin(dip),
              math.cos(dip))
    middle = rng.uniform(-10, 10), rng.uniform(8, 32), rng.uniform(-8, 10)
    n, step = rng.randint(1, 12), rng.uniform(2, 12)
    noise = rng.uniform(0, 0.3) * step
    points = {}
    for i in range(n + 1):
        for j in range(n + 1):
            h = rng.uniform(-noise, noise)
            points[i, j] = [m + (i - n / 2) * step * a + (j - n / 2) * step * b + h * c
                            for m, a, b, c in zip(middle, *along, normal)]
    lines = ["solid sheet"]
    for i in range(n):
        for j in range(n):
            a, b, c, d = (points[i, j], points[i + 1, j], points[i + 1, j + 1],
                          points[i, j + 1])
            for triangle in rng.choice([((a, b, c), (a, c, d)), ((a, b, d), (b, c, d))]):
                lines += ["facet normal 0 0 0", "outer loop"]
                lines += ["vertex " + " ".join(f"{x:.9g}" for x in p) for p in triangle]
                lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid sheet", ""])


def horseshoe():
    arch = [(5 * math.cos(a * math.pi / 12), 5 * math.sin(a * math.pi / 12)) for a in range(13)]
    return [(-5, -5), (5, -5)] + arch


def outlines(dim, rng):
    """Excavations as entries, and corners of theirs."""
    kind = rng.choice(["horseshoe", "box", "circle", "two", "none"] if dim == 2 else
                      ["box", "horseshoe", "two", "none"])
    if kind == "horseshoe":
        corners = horseshoe()
        vertices = "Vertices = " + "; ".join(text(p) for p in corners)
        if dim == 3:
            return ([["Shape = extruded polygon", vertices, "From = 5", "To = 35"]],
                    [(x, rng.choice([5, 20, 35]), z) for x, z in corners])
        return [[vertices]], corners
    if kind == "circle":
        return [["Shape = circle", "Center = 0, 0", "Radius = 5"]], [(5, 0), (0, 5), (-5, 0)]
    boxes = {"box": [((-3, 5, -3), (6, 30, 6))], "none": [],
             "two": [((-9, 5, -3), (6, 30, 6)), ((2, 0, -5), (7, 25, 10))]}[kind]
    if dim == 2:
        boxes = [((c[0], c[2]), (s[0], s[2])) for c, s in boxes]
    corners = [tuple(c + s * rng.choice([0, 1]) for c, s in zip(corner, size))
               for corner, size in boxes for _ in range(6)]
    return [["Shape = box", f"Corner = {text(c)}", f"Size = {text(s)}"] for c, s in boxes], corners


def awkward_joints(dim, n, rng, corners):
    """Joints as entries: places that others have, and random ones."""
    low, size = CORNERS[dim]
    places = list(corners) + [tuple(c + s * rng.choice([0, 1]) for c, s in zip(low, size))
                              for _ in range(3)]
    directions, joints = [], []
    for _ in range(n):
        inside = tuple(c + s * rng.uniform(0.1, 0.9) for c, s in zip(low, size))
        on_side = list(inside)
        axis = rng.randrange(dim)
        on_side[axis] = low[axis] + size[axis] * rng.choice([0, 1])
        point = rng.choice([inside, inside, inside, tuple(on_side), rng.choice(places)])
        if rng.random() < 0.15:  # almost there
            point = tuple(c + rng.choice([1e-9, 1e-6, 5e-4, 0.01]) for c in point)
        if directions and rng.random() < 0.25:  # parallel or almost
            dip, direction = rng.choice(directions)
            dip += rng.choice([0., 0., 1., -1., 1e-5])
        else:
            dip = rng.choice([0., 90., 45., rng.uniform(0, 90), rng.uniform(0, 90)])
            direction = rng.choice([0., 90., 180., rng.uniform(0, 360)])
        dip = min(90., abs(dip))
        directions.append((dip, direction))
        length = rng.choice([0.2, rng.uniform(2, 30), rng.uniform(2, 30)])
        a, b = math.radians(dip), math.radians(direction)
        if dim == 2:
            sign = 1 if direction < 180 else -1
            along = [(sign * math.cos(a), -math.sin(a))]
        else:  # dip vector and strike
            along = [(math.sin(b) * math.cos(a), math.cos(b) * math.cos(a), -math.sin(a)),
                     (math.cos(b), -math.sin(b), 0.)]
        extent = rng.choice(["infinite", "disc", "polygon", "polygon"])
        if extent == "polygon":
            start = 0. if rng.random() < 0.5 else -length / 2  # the place is an end or the middle
            width = rng.uniform(0.2, 1.) * length
            ends = [tuple(p + start * u for p, u in zip(point, along[0])),
                    tuple(p + (start + length) * u for p, u in zip(point, along[0]))]
            if dim == 3:
                ends += [tuple(p + width * v for p, v in zip(e, along[1])) for e in reversed(ends)]
            places += ends
            joints.append(["Extent = polygon", "Vertices = " + "; ".join(text(p) for p in ends)])
        else:
            angles = ([f"Dip = {dip:.9g}", f"Dip direction = {direction:.9g}"] if dim == 3 else
                      [f"Normal = {text((-along[0][1], along[0][0]))}"])
            joints.append([f"Point = {text(point)}", f"Extent = {extent}"] + angles +
                          ([f"Radius = {length / 2:.9g}"] if extent == "disc" else []))
            places.append(point)
    return joints


def scene(kind, n, seed, folder):
    """The text of a scene file; its surfaces are written into the folder."""
    rng = random.Random(f"{kind} {n} {seed}")
    dim = 2 if kind in KINDS_IN_2D else 3
    excavations = None
    if kind in ("lines", "faces"):
        excavations, corners = outlines(dim, rng)
        joints = awkward_joints(dim, n, rng, corners)
    elif kind == "sheets":
        joints = []
        for i in range(n):
            name = f"sheet_{n}_{seed}_{i}.stl"
            (folder / name).write_text(sheet(rng))
            joints.append(["Shape = file", f"File = {name}"])
    elif kind == "polylines":
        joints = polylines(n, rng)
    else:
        joints = traces(n, rng) if dim == 2 else faces(n, rng, kind == "discs")
    if dim == 2:
        corner, size = CORNERS[2]
        top = 40.
        excavation = ["Vertices = " + "; ".join(text(p) for p in horseshoe())]
        mesh = ["Size = 3", "Size at joints = 1", "Grading distance = 20"]
        sides = "left, right"
    else:
        corner, size = CORNERS[3]
        top = 20.
        excavation = ["Shape = box", "Corner = -3, 5, -3", "Size = 6, 30, 6"]
        mesh = ["Size = 4", "Grading distance = 15"]
        sides = "left, right, front, back"
    above = 5e6 - DENSITY * GRAVITY * top
    down = ["0"] * (dim - 1)

    def group(name, title, items):
        names = ", ".join(n for n, _ in items)
        inner = "".join(section(n, e) for n, e in items)
        return f"subsection {title}\n  set Names = {names}\n{inner}end\n"

    return (
        f"set Dimension = {dim}\nset Title = {n} random {kind}, seed {seed}\n"
        + section("Domain", [f"Corner = {text(corner)}", f"Size = {text(size)}",
                             "Truncated boundaries = all"])
        + section("Mesh", ["Generator = gmsh",
                           f"Size at excavation = {SIZE_AT_EXCAVATION[dim]}"] + mesh)
        + section("Initial state", [
            f"Gravity = {'; '.join(down + [str(-GRAVITY)])}",
            f"Surface elevation = {top}", f"Surface stress = {above:.9g}",
            f"Vertical stress gradient = {DENSITY * GRAVITY:.9g}",
            "Lateral ratios = 1", "Equilibrium = static"])
        + group("", "Materials", [("rock", [f"Young modulus = {YOUNG}",
                                            f"Poisson ratio = {POISSON}",
                                            f"Density = {DENSITY}"])])
        + group("", "Supports", [("bottom", ["Boundaries = bottom"]),
                                 ("sides", [f"Boundaries = {sides}", "Directions = normal"])])
        + group("", "Tractions", [("top", ["Boundaries = top",
                                           f"Traction = {'; '.join(down + [f'{-above:.9g}'])}"])])
        + group("", "Stages", [("dig", ["Kind = quasi-static", "Unbalanced ratio = 1e-4",
                                        "Ramp unbalance = 5e-3", "Maximum steps = 30000"])])
        + section("Output", ["Write VTU = false", "History interval = 50"])
        + group("", "Excavations", [(f"tunnel {i}", e + ["Stage = dig"]) for i, e in
                                    enumerate([excavation] if excavations is None
                                              else excavations)])
        + group("", "Joints", [(f"j{i}", entries + ["Friction angle = 30"])
                               for i, entries in enumerate(joints)]))


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run(program, folder, kind, n, seed, full, initial, arguments, ranks):
    """(reason of failure or None, ratio of the step, seconds of CPU, summary)"""
    name = f"{kind}_{n}_{seed}"
    (folder / f"{name}.prm").write_text(scene(kind, n, seed, folder))
    before = cpu_of_children()
    command = [program, "--output", str(folder / name), f"{name}.prm"] + arguments
    if initial:
        command += ["--set", "Stages/dig/Maximum steps=1"]
    elif not full:
        command.insert(1, "--validate")
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks)] + command
    result = subprocess.run(command, cwd=folder, text=True, capture_output=True)
    cpu = cpu_of_children() - before
    if result.returncode != 0:
        last = (result.stderr.strip() or result.stdout.strip()).splitlines()
        return f"exit {result.returncode}: {last[-1] if last else ''}", 0., cpu, None
    failed = re.search(r".*cannot bear.*", result.stdout)
    if initial and failed:
        return failed.group(), 0., cpu, None
    step = next(float(line.split()[3]) for line in result.stdout.splitlines()
                if "stable time step" in line)
    dim = 2 if kind in KINDS_IN_2D else 3
    summary = None
    if full:
        summary = json.loads((folder / name / "summary.json").read_text())
    return None, step * VELOCITY / SIZE_AT_EXCAVATION[dim], cpu, summary


def main():
    arguments, rest = split_arguments()
    parser = make_parser(__doc__)
    parser.add_argument("--kinds", default="traces,discs,planes")
    parser.add_argument("--numbers", type=numbers)
    parser.add_argument("--seeds", default="1-5", type=numbers)
    parser.add_argument("--least", type=float, default=0.)
    parser.add_argument("--run", action="store_true")
    parser.add_argument("--initial", action="store_true")
    parser.add_argument("--residual", type=float, default=1e-9)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--keep", default="")
    options = parser.parse_args(arguments)
    folder = Path(options.keep or tempfile.mkdtemp()).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    program = str(Path(options.keyblock).resolve())
    n_failures = 0
    print("kind     joints  meshed  ratio of steps: median  worst (seed)   CPU [s]: median  most")
    for kind in options.kinds.split(","):
        for n in options.numbers or NUMBERS[kind]:
            ratios, times = [], []
            for seed in options.seeds:
                reason, ratio, cpu, summary = run(program, folder, kind, n, seed,
                                                  options.run, options.initial, rest,
                                                  options.ranks)
                if not reason and ratio < options.least:
                    reason = f"ratio {ratio:.3g} is below {options.least}"
                if reason:
                    n_failures += 1
                    print(f"  {kind} {n} seed {seed}: {reason}")
                    continue
                ratios.append((ratio, seed))
                times.append(cpu)
                if summary:
                    residual = summary["energy"]["relative_residual"]
                    stage = summary["stages"][-1]
                    print(f"  {kind} {n} seed {seed}: {stage['steps']} steps, unbalanced "
                          f"{stage['unbalanced_ratio']:.2g}, residual {residual:.2g}, moved "
                          f"{stage['max_displacement']:.3g} m; {stage.get('remark', 'at rest')}")
                    if not (abs(residual) < options.residual and
                            math.isfinite(stage["max_displacement"])):
                        n_failures += 1
                    if stage["contacts_through_rock"] > 0:
                        n_failures += 1
                        print(f"    {stage['contacts_through_rock']} contacts through rock")
            if ratios:
                worst = min(ratios)
                print(f"{kind:8s} {n:6d}  {len(ratios)}/{len(options.seeds)}  "
                      f"{statistics.median(r for r, _ in ratios):22.3f}  "
                      f"{worst[0]:.3f} ({worst[1]})  {statistics.median(times):20.2f}  "
                      f"{max(times):.2f}", flush=True)
    sys.exit(1 if n_failures else 0)


if __name__ == "__main__":
    main()
