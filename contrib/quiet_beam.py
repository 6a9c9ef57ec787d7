#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sends beams of waves against a quiet boundary and tells what comes back.

usage: contrib/quiet_beam.py [--beams P40,P60,S30,S60] [--width 20] [--cells 20]
         [--poisson 0.25] [--tolerance 0.01] [--keyblock build/keyblock] [--keep FOLDER]

Each beam is a packet of plane compression (P) or shear waves (S) at an angle to
the normal of the boundary [deg], WIDTH wavelengths wide and six long, with CELLS
cells per wavelength, in a rectangle of rock whose bottom is quiet and whose other
sides are free. When the packet has left, what is left of its energy is compared
with the closed form of plane waves: two reflected waves whose traction the
dashpots of Lysmer and Kuhlemeyer (1969) balance. Exits with 1 if they differ by
more than the tolerance. Four of them take a minute.
"""
import cmath
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

from script_tools import make_parser

LENGTH_OF_PACKET = 6  # wavelengths
DENSITY = 2500.
SHEAR_SPEED = 1000.


def pressure_speed(poisson):
    return SHEAR_SPEED * math.sqrt((2. - 2. * poisson) / (1. - 2. * poisson))


def stress_of(d, k, poisson):
    """Stress per strain of a plane wave along k that moves along d [Pa]."""
    mu = DENSITY * SHEAR_SPEED ** 2
    lame = 2. * mu * poisson / (1. - 2. * poisson)
    trace = d[0] * k[0] + d[1] * k[1]
    return [[lame * trace * (i == j) + mu * (d[i] * k[j] + d[j] * k[i])
             for j in range(2)] for i in range(2)]


def reflected_share(kind, angle, poisson):
    """Energy that plane waves bring back over what they bring, by closed form."""
    speed = {"P": pressure_speed(poisson), "S": SHEAR_SPEED}
    slowness = math.sin(angle) / speed[kind]

    def wave(which, up):
        """Direction, motion and speed of a wave; evanescent ones are complex."""
        x = slowness * speed[which]
        y = cmath.sqrt(1. - x * x) * (1. if up else -1.)
        k = (x, y)
        return k, (k if which == "P" else (-y, x)), speed[which]

    def traction(k, d, c):
        """On the boundary, of the wave and of the dashpots that it moves."""
        stress = stress_of(d, k, poisson)  # of u = d exp(i w (k x / c - t)), over i w
        dashpot = (DENSITY * SHEAR_SPEED, DENSITY * speed["P"])
        # outward normal (0, -1): traction -sigma_iy, equal to -C v with v = -i w d
        return [-stress[i][1] / c - dashpot[i] * d[i] for i in range(2)]

    incoming = traction(*wave(kind, False))
    a, b = (traction(*wave(which, True)) for which in "PS")
    determinant = a[0] * b[1] - a[1] * b[0]
    p = (-incoming[0] * b[1] + incoming[1] * b[0]) / determinant
    s = (-a[0] * incoming[1] + a[1] * incoming[0]) / determinant
    share = 0.
    for which, amplitude in (("P", p), ("S", s)):
        k = wave(which, True)[0]
        if abs(complex(k[1]).imag) < 1e-12:
            share += (abs(amplitude) ** 2 * speed[which] * complex(k[1]).real
                      / (speed[kind] * math.cos(angle)))
    return share


def scene_of(kind, angle, width, cells, poisson):
    """The scene, as text; it ends when the packet has left."""
    speed = pressure_speed(poisson) if kind == "P" else SHEAR_SPEED
    wavelength = float(cells)  # cells of 1 m
    half = (0.5 * LENGTH_OF_PACKET * wavelength, 0.5 * width * wavelength)
    k = (math.sin(angle), -math.cos(angle))
    d = k if kind == "P" else (-k[1], k[0])
    rise = half[0] * math.cos(angle) + half[1] * math.sin(angle) + 2. * wavelength
    spread = half[0] * math.sin(angle) + half[1] * math.cos(angle) + 2. * wavelength
    way = 2. * rise / math.cos(angle)
    height = math.ceil(2. * rise + 4. * wavelength)
    length = math.ceil(2. * spread + way * (math.sin(angle) + 0.3) + 4. * wavelength)
    along = f"({k[0]:.12g}*(x - {spread:.9g}) + {k[1]:.12g}*(y - {rise:.9g}))"
    across = f"({-k[1]:.12g}*(x - {spread:.9g}) + {k[0]:.12g}*(y - {rise:.9g}))"

    def window(what, reach):
        """From 1 in the middle down to 0 at REACH by a cosine."""
        return f"(1 + cos(pi*min(1, abs{what}/{reach:.9g})))/2"

    strain = (f"1e-6*cos(2*pi*{along}/{wavelength:.9g})*{window(along, half[0])}"
              f"*{window(across, half[1])}")
    stress = stress_of(d, k, poisson)
    out_of_plane = poisson * (stress[0][0] + stress[1][1])
    components = [stress[0][0], stress[1][1], out_of_plane, stress[0][1]]
    mu = DENSITY * SHEAR_SPEED ** 2
    return f"""set Dimension = 2
subsection Domain
  set Corner = 0, 0
  set Size = {length}, {height}
  set Truncated boundaries = none
end
subsection Mesh
  set Cells = {length}, {height}
end
subsection Materials
  set Names = rock
  subsection rock
    set Young modulus = {2. * mu * (1. + poisson):.12g}
    set Poisson ratio = {poisson:.12g}
    set Density = {DENSITY:.12g}
  end
end
subsection Initial state
  set Velocity = {'; '.join(f'{-speed * x:.12g}*{strain}' for x in d)}
  set Stress = {'; '.join(f'{x:.12g}*{strain}' for x in components)}
end
subsection Supports
  set Names = bottom
  subsection bottom
    set Boundaries = bottom
    set Kind = quiet
  end
end
subsection Stages
  set Names = pass
  subsection pass
    set Duration = {way / speed:.9g}
  end
end
subsection Output
  set Write VTU = false
  set History interval = 50
end
"""


def run(options, beam, folder):
    """Energy that is left, over that of the packet."""
    scene = folder / f"{beam}.prm"
    kind, angle = beam[0], math.radians(float(beam[1:]))
    scene.write_text(scene_of(kind, angle, options.width, options.cells, options.poisson),
                     encoding="utf-8")
    output = folder / beam
    result = subprocess.run([options.keyblock, str(scene), "--output", str(output)],
                            text=True, capture_output=True, check=False)
    if result.returncode != 0:
        sys.exit(f"{beam}: exit {result.returncode}: {result.stderr.strip()}")
    energy = json.loads((output / "summary.json").read_text(encoding="utf-8"))["energy"]
    return (energy["kinetic"] + energy["elastic"]) / energy["start"]


def main():
    parser = make_parser(__doc__)
    parser.add_argument("--beams", default="P40,P60,S30,S60")
    parser.add_argument("--width", type=float, default=20.)
    parser.add_argument("--cells", type=int, default=20)
    parser.add_argument("--poisson", type=float, default=0.25)
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--keep", default="")
    options = parser.parse_args()
    folder = Path(options.keep or tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    is_good = True
    for beam in options.beams.split(","):
        exact = reflected_share(beam[0], math.radians(float(beam[1:])), options.poisson)
        found = run(options, beam, folder)
        is_within = abs(found - exact) <= options.tolerance
        is_good = is_good and is_within
        print(f"{beam}: {found:.4f} of the energy comes back, closed form {exact:.4f}"
              f"{'' if is_within else '  <-- wrong'}", flush=True)
    sys.exit(0 if is_good else 1)


if __name__ == "__main__":
    main()
