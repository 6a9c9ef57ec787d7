#!/usr/bin/env python3
"""Finds safety factors of random blocks whose exact factors are known.

usage: contrib/factors.py [--kinds incline,incline_3d] [--seeds 1-20] [--exact]
         [--tolerance 0] [--keyblock build/keyblock] [--keep FOLDER]
         [-- arguments for keyblock]

incline, incline_3d: a block slides on a plane through a square (box) of random
dip, place and friction: tan(friction) / tan(dip). The plane is given twice,
1 um apart, and crossed by three short strong joints at a few degrees, so that it
has to be cut into the mesh, which bends it; with --exact it stands alone. Exits with 1 if an exact factor lies outside its bracket by more than
--tolerance of it, or a run fails.
"""
import argparse
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path


def incline(seed, dim, is_exact):
    """The text of a scene and the exact factor."""
    rng = random.Random(f"incline {dim} {seed}")
    dip = rng.uniform(15, 50)
    factor = rng.uniform(1.05, 2.2)
    friction = math.degrees(math.atan(factor * math.tan(math.radians(dip))))
    foot = rng.uniform(1.5, 6.)
    turn = rng.uniform(-20, 20) if dim == 3 else 0.  # of the dip direction
    size = rng.uniform(0.4, 0.9) if dim == 2 else rng.uniform(0.8, 1.2)
    a, t = math.radians(dip), math.radians(turn)
    normal = [math.sin(a) * math.cos(t), math.sin(a) * math.sin(t), math.cos(a)]
    if dim == 2:
        normal = [math.sin(a), math.cos(a)]
    end = [10., 2., foot] if dim == 3 else [10., foot]
    edge = 2.6 * size if dim == 2 else 3. * size

    def joint(name, place, normal, friction, more=""):
        return (f"  subsection {name}\n    set Point = {', '.join(f'{x:.9g}' for x in place)}\n"
                f"    set Normal = {', '.join(f'{n:.12g}' for n in normal)}\n"
                f"    set Friction angle = {friction:.10g}\n{more}  end\n")

    def plane(name, shift):
        return joint(name, end[:-1] + [foot + shift], normal, friction)

    def crossing(i):
        """A short joint near the plane that no other one meets."""
        bend = math.radians(rng.choice([-1, 1]) * rng.uniform(3, 12))
        length = min(10., (10. - foot) / math.tan(a))
        x = length * (1 + i) / 4
        up = x * math.tan(a) + rng.uniform(-0.3, 0.3) * edge
        place = [10. - x * math.cos(t), 2. - x * math.sin(t), foot + up]
        n = [math.sin(a + bend) * math.cos(t), math.sin(a + bend) * math.sin(t),
             math.cos(a + bend)]
        if dim == 2:
            place, n = [10. - x, foot + up], [math.sin(a + bend), math.cos(a + bend)]
        return joint(f"strong {i}", place, n, 80.,
                     f"    set Extent = disc\n    set Radius = {0.1 * length:.4g}\n"
                     "    set Cohesion = 1e9\n    set Tensile strength = 1e8\n"
                     "    set Residual cohesion = 1e9\n")

    zeros = ["0"] * (dim - 1)
    names = "plane" if is_exact else "plane, again, strong 0, strong 1, strong 2"
    joints = plane("plane", 0.)
    if not is_exact:
        joints += plane("again", 1e-6) + "".join(crossing(i) for i in range(3))
    text = f"""set Dimension = {dim}
set Title = Incline of {dip:.4g} degrees, exact factor {factor:.6g}
subsection Domain
  set Size = {'10, 10' if dim == 2 else '10, 4, 10'}
  set Truncated boundaries = bottom
end
subsection Mesh
  set Generator = gmsh
  set Size = {size:.4g}
end
subsection Joints
  set Names = {names}
{joints}end
subsection Materials
  set Names = rock
  subsection rock
    set Young modulus = 10e9
    set Poisson ratio = 0.25
    set Density = 2500
  end
end
subsection Initial state
  set Gravity = {'; '.join(zeros + ['-9.81'])}
  set Equilibrium = static
end
subsection Supports
  set Names = bottom
  subsection bottom
    set Boundaries = bottom
  end
end
subsection Stages
  set Names = rest
  subsection rest
    set Kind = quasi-static
    set Unbalanced ratio = 1e-5
  end
end
subsection Safety factor
  set Blocks = all
  set Bracket = 0.001
end
subsection Output
  set Write VTU = false
end
"""
    return text, factor


KINDS = {"incline": lambda seed, exact: incline(seed, 2, exact),
         "incline_3d": lambda seed, exact: incline(seed, 3, exact)}


def main():
    arguments, rest = sys.argv[1:], []
    if "--" in arguments:
        at = arguments.index("--")
        arguments, rest = arguments[:at], arguments[at + 1:]
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    root = Path(__file__).resolve().parent.parent
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--seeds", default="1-20")
    parser.add_argument("--exact", action="store_true")
    parser.add_argument("--tolerance", type=float, default=0.)
    parser.add_argument("--keyblock", default=str(root / "build" / "keyblock"))
    parser.add_argument("--keep", default="")
    options = parser.parse_args(arguments)
    first, _, last = options.seeds.partition("-")
    folder = Path(options.keep or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    program = str(Path(options.keyblock).resolve())
    n_failures = 0
    for kind in options.kinds.split(","):
        for seed in range(int(first), int(last or first) + 1):
            text, factor = KINDS[kind](seed, options.exact)
            name = f"{kind}_{seed}"
            (folder / f"{name}.prm").write_text(text)
            result = subprocess.run([program, f"{name}.prm", "--output", name] + rest,
                                    cwd=folder, text=True, capture_output=True)
            if result.returncode != 0:
                last_line = (result.stderr.strip() or result.stdout.strip()).splitlines()[-1:]
                print(f"{kind} seed {seed}: exit {result.returncode}: {last_line}", flush=True)
                n_failures += 1
                continue
            summary = json.loads((folder / name / "summary.json").read_text())
            found = [f for block in summary["blocks"] for f in block.get("safety_factor", [])]
            if len(found) != 1:
                print(f"{kind} seed {seed}: {len(found)} blocks, not one", flush=True)
                n_failures += 1
                continue
            lower, upper = found[0].get("lower", 0.), found[0].get("upper", math.inf)
            off = max(lower - factor, factor - upper, 0.) / factor
            is_good = off <= options.tolerance
            n_failures += not is_good
            way = summary["mesh"]
            print(f"{kind} seed {seed}: exact {factor:.5f} in [{lower:.5f}, {upper:.5f}], off by "
                  f"{100 * off:.3f} %; joints moved by {way['largest_shift_in_cells']:.2g} cells"
                  f"{'' if is_good else '  <-- wrong'}", flush=True)
    sys.exit(1 if n_failures else 0)


if __name__ == "__main__":
    main()
