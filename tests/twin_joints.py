#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A roof block between two traces, of which one has a twin beside it.

Traces that are nearer to each other than cells are large share vertices of the
mesh; the block is there all the same, whole or in two parts where cells tell
the twins apart.

usage: twin_joints.py PROGRAM SHIFT
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SCENE = """set Dimension = 2
subsection Domain
  set Corner = -10, -10
  set Size = 20, 20
  set Truncated boundaries = all
end
subsection Mesh
  set Generator = gmsh
  set Size = 2
  set Size at excavation = 0.5
end
subsection Excavations
  set Names = room
  subsection room
    set Shape = box
    set Corner = -2, -2
    set Size = 4, 4
    set Stage = dig
  end
end
subsection Materials
  set Names = rock
  subsection rock
    set Young modulus = 1e10
    set Density = 2500
  end
end
subsection Supports
  set Names = out
  subsection out
    set Boundaries = all
  end
end
subsection Initial state
  set Gravity = 0; -9.81
  set Equilibrium = static
end
subsection Stages
  set Names = dig
  subsection dig
    set Kind = quasi-static
  end
end
subsection Joints
  set Names = a, b, twin
  subsection a
    set Vertices = -1.5, 2; 0, 4
  end
  subsection b
    set Vertices = 1.5, 2; 0, 4
  end
  subsection twin
    set Vertices = %.9g, 2; %.9g, 4
  end
end
"""

program, shift = sys.argv[1], float(sys.argv[2])
with tempfile.TemporaryDirectory() as folder:
    scene = pathlib.Path(folder) / "twin_joints.prm"
    scene.write_text(SCENE % (shift - 1.5, shift))
    run = subprocess.run([program, str(scene), "--validate"], cwd=folder,
                         capture_output=True, text=True, check=True)
exposed = [float(area) for area in re.findall(
    r"^ +[0-9]+  exposed +yes +([0-9.e+-]+)", run.stdout, re.M)]
print(run.stdout)
assert abs(sum(exposed) - 3) < 0.3, exposed
assert "left out: " not in run.stdout
