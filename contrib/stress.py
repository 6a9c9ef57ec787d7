#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run scenes made to break the program and write doc/stability.md.

usage: stress.py KEYBLOCK [--files N] [--only WORD]

Each case must end right, with a number that a closed form gives and an energy
residual below 1e-3, or be refused with a sentence and exit code 1. Then N
mutated scene files and N mutated mesh files (1000) must neither crash nor hang
the program. Exit code 1 if anything fails.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
LARGEST_RESIDUAL = 1e-3

Case = collections.namedtuple("Case", "name scene settings expected tolerance "
                              "value_of", defaults=(None,) * 5)
Result = collections.namedtuple("Result", "code message summary")


def run(keyblock, scene, settings, validate=False, seconds=3000):
    """Exit code, what it said, and the summary of a run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [keyblock, str(scene), "--output", f"{folder}/out"]
        for setting in settings:
            command += ["--set", setting]
        if validate:
            command.append("--validate")
        try:
            done = subprocess.run(command, capture_output=True, check=False,
                                  timeout=seconds, cwd=folder)
        except subprocess.TimeoutExpired:
            return Result("timeout", "", {})
        lines = done.stderr.decode(errors="replace").replace(
            f"{folder}/", "").replace(f"{scene.parent}/", "")
        lines = lines.strip().splitlines()
        summary = {}
        path = pathlib.Path(folder) / "out" / "summary.json"
        if done.returncode == 0 and path.exists():
            with open(path, encoding="utf-8") as file:
                summary = json.load(file)
        return Result(done.returncode, lines[-1] if lines else "", summary)


def check(name):
    """A number of the scene's own checks."""
    return lambda summary: summary["checks"][name]


def factor(summary):
    """The first safety factor."""
    return next(b["safety_factor"][0]["value"] for b in summary["blocks"]
                if b["safety_factor"])


def motion(summary):
    """Largest displacement of the last stage [m]."""
    return summary["stages"][-1]["max_displacement"]


def weight(summary):
    """What the joint `base` of a pile carries [N]."""
    return abs(summary["monitors"]["base.normal_force [N]"])


def acceleration(dip, friction):
    """Of a block on an incline [m/s2]; angles in degrees."""
    dip, friction = math.radians(dip), math.radians(friction)
    return 9.81 * (math.sin(dip) - math.cos(dip) * math.tan(friction))


PILE = """# Blocks of a brick-free wall of columns under their own weight.
set Dimension = 2
subsection Domain
  set Size = {width}, {height}
  set Truncated boundaries = bottom
end
subsection Mesh
  set Generator = structured
  set Cells = {cells_x}, {cells_y}
end
subsection Joints
  set Names = {names}
{joints}end
subsection Materials
  set Names = rock, bed
  subsection rock
    set Young modulus = 1e9
    set Density = 2500
  end
  subsection bed
    set Region = 1 - y
    set Model = rigid
  end
end
subsection Initial state
  set Gravity = 0; -9.81
end
subsection Stages
  set Names = rest
  subsection rest
    set Kind = quasi-static
    set Maximum steps = 60000
  end
end
subsection Monitors
  set Names = base
  subsection base
    set Kind = joint
    set Joint = h0
  end
end
subsection Output
  set Write VTU = false
end
"""


def pile(folder, columns, rows, cells=2):
    """A scene of columns x rows square blocks of 1 m on a rigid bed."""
    joints = {f"h{i}": f"    set Point = 0, {1 + i}\n    set Dip = 0\n"
              for i in range(rows)}
    joints.update({f"v{i}": f"    set Point = {1 + i}, 0\n    set Dip = 90\n"
                   for i in range(columns - 1)})
    text = PILE.format(
        width=columns, height=rows + 1, cells_x=cells * columns,
        cells_y=cells * (rows + 1), names=", ".join(joints),
        joints="".join(f"  subsection {name}\n{body}"
                       f"    set Friction angle = 35\n  end\n"
                       for name, body in joints.items()))
    path = folder / f"pile_{columns}_{rows}.prm"
    path.write_text(text, encoding="utf-8")
    return path


def mesh_scene(folder, name, points, cells):
    """A scene on a mesh file (UCD) with these points and quadrilaterals."""
    lines = [f"{len(points)} {len(cells)} 0 0 0"]
    lines += [f"{i + 1} {x} {y} 0" for i, (x, y) in enumerate(points)]
    lines += [f"{i + 1} 1 quad " + " ".join(str(v + 1) for v in cell)
              for i, cell in enumerate(cells)]
    (folder / f"{name}.ucd").write_text("\n".join(lines) + "\n",
                                        encoding="utf-8")
    path = folder / f"{name}.prm"
    path.write_text(f"""set Dimension = 2
subsection Domain
  set Shape = file
  set File = {name}.ucd
end
subsection Mesh
  set Generator = file
end
subsection Materials
  set Names = rock
end
subsection Supports
  set Names = base
  subsection base
    set Region = 1e-6 - y
  end
end
subsection Initial state
  set Gravity = 0; -9.81
end
subsection Stages
  set Names = go
  subsection go
    set Maximum steps = 100
  end
end
""", encoding="utf-8")
    return path


def cases(folder):
    """All of them; without an expected value a case must be refused."""
    verification = ROOT / "prm" / "verification"
    incline = verification / "incline_30.prm"
    sliding = ROOT / "prm" / "tutorial" / "sliding_block.prm"
    fall = verification / "factor_incline.prm"
    box = ROOT / "prm" / "benchmark" / "elastic_2d.prm"
    exact = acceleration(40., 30.)
    dip = "Initial state/Gravity=9.81*sin({0}*pi/180); -9.81*cos({0}*pi/180)"
    columns, rows = 25, 40

    def slides(name, settings, scene=incline, tolerance=2e-3):
        return Case(name, scene, settings, exact, tolerance,
                    check("acceleration"))

    def holds_at(name, angle, friction, settings=()):
        ratio = (math.tan(math.radians(friction))
                 / math.tan(math.radians(angle)))
        return Case(name, fall,
                    (dip.format(angle), "Joints/base/Friction angle="
                     f"{friction}", "Stages/rest/Friction angle override="
                     f"{max(84.2894, angle + 5)}") + settings,
                    ratio, 1e-3, factor)

    for contrast, n_steps in (("1e4", 60000), ("1e6", 1000000)):
        soft = f"Materials/soft/Young modulus={1e12 / float(contrast)}"
        yield Case(f"blocks {contrast} times as stiff as the rock beneath",
                   pile(folder, 2, 2),
                   ("Materials/Names=rock, bed, soft", soft,
                    "Materials/soft/Region=(2-y)*(y-1)",
                    "Materials/soft/Density=2500",
                    "Materials/rock/Young modulus=1e12",
                    f"Stages/rest/Maximum steps={n_steps}"),
                   4 * 2500. * 9.81, 1e-3, weight)
    flat = "Mesh/Cells=8, 160"
    yield holds_at("cells with sides 100 : 1", 40., 30., (flat,))
    yield holds_at("two cells in the block", 40., 30., ("Mesh/Cells=4, 4",))
    yield Case("1e6 steps at 0.99 of the bound", box,
               ("Mesh/Cells=4, 4", "Domain/Size=4, 4",
                "Time stepping/Safety=0.99", "Stages/run/Maximum steps=1000000",
                "Output/History interval=100000"), 0., 1., motion)
    yield holds_at("friction 80 degrees, dip 60", 60., 80.)
    yield holds_at("friction 80 degrees, dip 75", 75., 80.)
    yield holds_at("friction 1 degree, dip 2", 2., 1.)
    yield holds_at("friction 45 degrees, dip 45.0", 45., 45.)
    yield Case(f"{columns * rows} blocks in columns: weight on the bed",
               pile(folder, columns, rows), (),
               columns * rows * 2500. * 9.81, 1e-3, weight)
    yield slides("chatter: sudden gravity, hardly damped",
                 ("Stages/rest/Maximum steps=1",
                  "Stages/slide/Damping ratio=0.02"), tolerance=5e-3)
    yield slides("ramp of gravity in one step",
                 ("Stages/rest/Maximum steps=1",))
    yield Case("two blocks that overlap by a tenth",
               mesh_scene(folder, "overlap",
                          [(0, 0), (1, 0), (1, 1), (0, 1),
                           (0, .9), (1, .9), (1, 2), (0, 2)],
                          [(0, 1, 2, 3), (4, 5, 6, 7)]),
               ("Stages/go/Maximum steps=3000",), 0., 1e-3, motion)
    yield Case("two blocks that share a corner only",
               mesh_scene(folder, "corner",
                          [(0, 0), (1, 0), (1, 1), (0, 1),
                           (2, 1), (2, 2), (1, 2)],
                          [(0, 1, 2, 3), (2, 4, 5, 6)]), (), 0., 1., motion)
    yield Case("redundant contacts: four blocks around a point",
               pile(folder, 2, 2), (), 4 * 2500. * 9.81, 1e-3, weight)
    yield holds_at("joint in single precision", 40., 30.,
                   ("Joints/base/Point=0.1000000015, 2.98e-9",))
    yield slides("joint that misses the nodes by 1e-9",
                 ("Joints/base/Point=0, 1e-9",))
    yield holds_at("near-coincident joints", 40., 30.,
                   ("Joints/Names=base, twin", "Joints/twin/Point=0, 1e-9",
                    "Joints/twin/Dip=0", "Joints/twin/Friction angle=30"))
    yield Case("column of sheared cells (85 degrees)",
               mesh_scene(folder, "sheared",
                          [(0, 0), (1, 0), (12, 1), (11, 1)],
                          [(0, 1, 2, 3)]), (), 0., 1., motion)
    yield Case("cell turned inside out",
               mesh_scene(folder, "inverted",
                          [(0, 0), (1, 0), (0.2, 0.2), (0, 1)],
                          [(0, 2, 1, 3)]), ())
    yield Case("cell without area",
               mesh_scene(folder, "flat", [(0, 0), (1, 0), (2, 0), (3, 0)],
                          [(0, 1, 2, 3)]), ())
    yield Case("point of a mesh that is not a number",
               mesh_scene(folder, "nan",
                          [(0, 0), (1, 0), ("nan", 1), (0, 1)],
                          [(0, 1, 2, 3)]), ())
    for entry in ("Materials/rock/Density", "Materials/rock/Young modulus",
                  "Joints/base/Friction angle", "Time stepping/Safety",
                  "Stages/slide/Duration"):
        for value in ("nan", "inf", "-1"):
            if (entry, value) == ("Joints/base/Friction angle", "-1"):
                continue
            yield Case(f"{entry} = {value}", incline, (f"{entry}={value}",))
    yield Case("gravity that is not a number", incline,
               ("Initial state/Gravity=sqrt(-1); 0",))
    yield Case("velocity that is not a number", incline,
               ("Initial state/Velocity=log(-1); 0",))
    yield Case("friction angle of 90 degrees", incline,
               ("Joints/base/Friction angle=90",))


def judge(case, result):
    """Whether the case ended as it must, what it gave, and its residual."""
    if case.expected is None:
        refused = result.code in (1, 2) and len(result.message) > 20
        return refused, f"refused: {result.message}" if refused else (
            f"exit code {result.code}"), math.nan
    if result.code != 0:
        return False, f"exit code {result.code}: {result.message}", math.nan
    value = case.value_of(result.summary)
    residual = abs(result.summary["energy"]["relative_residual"])
    scale = abs(case.expected) or 1.
    is_right = (abs(value - case.expected) <= case.tolerance * scale
                and residual < LARGEST_RESIDUAL)
    asked = (f"{case.expected:.6g}" if case.expected else
             f"below {case.tolerance:g} m")
    return is_right, f"{value:.6g} ({asked})", residual


def mutate(text, generator):
    """A file with some bytes, numbers or lines changed."""
    text = bytearray(text)
    for _ in range(generator.choice((1, 1, 2, 4, 16))):
        if not text:
            break
        at = generator.randrange(len(text))
        kind = generator.randrange(7)
        if kind == 0:
            text[at] = generator.randrange(256)
        elif kind == 1:
            del text[at:at + generator.randrange(1, 40)]
        elif kind == 2:
            lines = bytes(text).split(b"\n")
            generator.shuffle(lines)
            text = bytearray(b"\n".join(lines))
        elif kind == 3:
            digits = [i for i, c in enumerate(text) if chr(c).isdigit()]
            if digits:
                text[generator.choice(digits)] = ord(
                    generator.choice("0123456789-e."))
        elif kind == 4:
            text[at:at] = generator.choice(
                (b"nan", b"-1", b"1e400", b"4294967296", b"end\n", b"\0",
                 b"set ", b"subsection x\n", b"\xff\xfe", b"%n%s"))
        elif kind == 5:
            del text[at:]
        else:
            piece = text[at:at + generator.randrange(1, 200)]
            text[at:at] = piece
    return bytes(text)


def fuzz(keyblock, kind, n_files, folder):
    """How mutated files end: a count by exit code, and what went wrong."""
    generator = random.Random(f"keyblock {kind}")
    if kind == "scene":
        seeds = [p for p in sorted((ROOT / "prm").glob("*/*.prm"))
                 if p.parent.name in ("tutorial", "verification")
                 and "structured" in p.read_text(encoding="utf-8")]
    else:
        seeds = sorted((ROOT / "prm" / "verification").glob("*.ucd"))
        small = mesh_scene(folder, "square",
                           [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1),
                            (0, 2), (1, 2), (2, 2)],
                           [(0, 1, 4, 3), (1, 2, 5, 4), (3, 4, 7, 6),
                            (4, 5, 8, 7)])
        seeds += [small.with_suffix(".ucd")] * 9

    def one(index):
        seed = seeds[index % len(seeds)]
        text = mutate(seed.read_bytes(), random.Random(first + index))
        path = folder / f"mutant_{index}"
        if kind == "scene":
            scene = path.with_suffix(".prm")
            scene.write_bytes(text)
        else:
            path.with_suffix(".ucd").write_bytes(text)
            scene = path.with_suffix(".prm")
            scene.write_text(small.read_text(encoding="utf-8").replace(
                "square.ucd", f"mutant_{index}.ucd"), encoding="utf-8")
        result = run(keyblock, scene, (), validate=True, seconds=60)
        if result.code in (0, 1, 2):
            for suffix in (".prm", ".ucd"):
                path.with_suffix(suffix).unlink(missing_ok=True)
        else:
            kept = pathlib.Path(f"mutant_{kind}_{index}.txt").resolve()
            kept.write_bytes(text)
            print(f"{kept}: {result.code} {result.message}", flush=True)
        return result.code

    first = generator.randrange(10 ** 9)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return collections.Counter(pool.map(one, range(n_files)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("keyblock")
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    keyblock = str(pathlib.Path(options.keyblock).resolve())
    n_wrong = 0
    lines = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for case in cases(folder):
            if options.only not in case.name:
                continue
            is_right, found, residual = judge(
                case, run(keyblock, case.scene, case.settings))
            n_wrong += not is_right
            lines.append(f"| {case.name} | {found} | "
                         f"{'' if math.isnan(residual) else f'{residual:.1e}'}"
                         f" | {'yes' if is_right else 'NO'} |")
            print(lines[-1], flush=True)
        counts = {}
        for kind in ("scene", "mesh"):
            if options.files > 0:
                counts[kind] = fuzz(keyblock, kind, options.files, folder)
                n_wrong += sum(n for code, n in counts[kind].items()
                               if code not in (0, 1, 2))
                print(kind, dict(counts[kind]), flush=True)
    if options.only == "":
        write(lines, counts)
    return 1 if n_wrong else 0


def write(lines, counts):
    """doc/stability.md."""
    with open(ROOT / "doc" / "stability.md", "w", encoding="utf-8") as out:
        out.write("# Stability\n\nWritten by `contrib/stress.sh`; do not "
                  "edit. Scenes made to break the program: each must give "
                  "what a closed form says (in brackets) with an energy "
                  "residual below 1e-3, or be refused with a sentence.\n\n"
                  "| case | result | energy residual | as it must |\n"
                  "|---|---|---|---|\n" + "\n".join(lines) + "\n\n")
        if counts:
            out.write("## Mutated files\n\nFiles with bytes, numbers and "
                      "lines changed, read with `--validate`. A signal or a "
                      "run of more than a minute is a failure.\n\n| kind | "
                      "accepted | refused (exit 1) | failed in the "
                      "computation (exit 2) | crashed or hung |\n"
                      "|---|---|---|---|---|\n")
            for kind, count in counts.items():
                bad = sum(n for code, n in count.items()
                          if code not in (0, 1, 2))
                out.write(f"| {kind} | {count[0]} | {count[1]} | {count[2]} "
                          f"| {bad} |\n")


if __name__ == "__main__":
    sys.exit(main())
