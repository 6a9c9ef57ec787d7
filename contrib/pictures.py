#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the verification scenes and draw a small picture of each.

usage: xvfb-run -a contrib/pictures.py [SCENE ...] [--keyblock PROGRAM]
         [--outputs FOLDER] [--reuse]

Writes doc/pictures/NAME.png for all scenes of prm/tutorial and
prm/verification or for those named (tutorial_NAME if both folders have it), and
NAME_fit.png where measured stresses are inverted. Needs the packages
python3-vtk9, python3-matplotlib (also for the
Python Imaging Library it brings), xvfb and xauth; runs take some two minutes.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

try:
    from PIL import Image
except ImportError as error:
    sys.exit(f"pictures.py: the Python Imaging Library cannot be loaded "
             f"({error}); install the package python3-matplotlib and use the "
             "system's Python, /usr/bin/python3.")

from render import COLOURS, RED, View, draw

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIZE = (480, 400)
N_COLOURS = 48
LARGEST = 25000  # bytes of a picture

# What is shown of scenes whose names begin so; the longest beginning counts.
# Exaggeration 0 is automatic, time index -1 the last state.
SCENES = {
    "": {"exaggeration": 0.},
    "sliding_block": {"exaggeration": 1.},
    "incline_": {"exaggeration": 1.},
    "incline_3d": {"exaggeration": 1., "eye": (0.5, -1., 0.35)},
    "newmark": {"field": "displacement_x"},
    "crossing": {"exaggeration": 1., "tilt": 40.},
    "corner": {"exaggeration": 1., "tilt": 40.},
    "cohesive_incline": {"exaggeration": 0., "tilt": 30.},
    "resting": {"exaggeration": 0., "tilt": 20.},
    "toppling_": {"exaggeration": 1., "tilt": 24.3},
    "toppling_stays_friction": {"exaggeration": 1., "tilt": 29.5},
    "toppling_slides_friction": {"exaggeration": 0., "tilt": 30.5},
    "toppling_stays_slender": {"exaggeration": 1., "tilt": 21.3},
    "toppling_topples_slender": {"exaggeration": 0., "tilt": 22.3},
    "toppling_slides_and_topples_steep": {"exaggeration": 1., "tilt": 40.},
    "toppling_topples_steep": {"exaggeration": 1., "tilt": 40.},
    "roof_block_falls": {"exaggeration": 1., "box": (-6., -4., 6., 8.)},
    "roof_block_stays": {"exaggeration": 0., "box": (-4.5, 0., 4.5, 8.)},
    "bar_impact": {"field": "velocity_x", "time_index": 2, "stretch": 2.},
    "bond_break": {"stretch": 2.},
    "oblique_impact": {"field": "velocity_y", "time_index": 1,
                       "exaggeration": 0.},
    "friction_rod": {"exaggeration": 0., "stretch": 4.},
    "rotation": {"field": "velocity", "time_index": 1},
    "first_tunnel": {"exaggeration": 0., "box": (-20., -10., 20., 25.),
                     "mesh": "off"},
    "joint_network": {"field": "block"},
    "cavern_at_depth": {"field": "stress_yy", "mesh": "off"},
    "slope_crack": {"field": "block"},
    "tutorial_roof_wedge": {"exaggeration": 0., "eye": (-0.6, -1., 0.5),
                            "mesh": "off"},
    "blocks_": {"field": "block"},
    "blocks_cube_": {"field": "block", "explode": 0.4},
    "blocks_planes_": {"field": "block", "explode": 0.8},
    "blocks_sets_3d": {"field": "block", "explode": 0.3},
    "blocks_tunnel_": {"field": "block", "box": (-8., -5., 8., 11.)},
    "kirsch": {"field": "stress_xx", "box": (-4., -4., 4., 4.),
               "exaggeration": 0.},
    "kirsch_refined": {"field": "stress_xx", "box": (0., 0., 5., 5.),
                       "exaggeration": 1., "mesh": "on"},
    "salencon": {"field": "plastic_strain", "box": (0., 0., 3., 3.),
                 "exaggeration": 0., "mesh": "off"},
    "footing": {"exaggeration": 0., "box": (0., -1.2, 2., 0.05)},
    "geostress": {"field": "stress_xx", "exaggeration": 0.},
    "order_": {"exaggeration": 0., "box": (-10., -8., 10., 8.)},
    "order_left_first": {"exaggeration": 0., "time_index": 1,
                         "box": (-10., -8., 10., 8.)},
    "order_stepped": {"exaggeration": 0., "time_index": 1,
                      "box": (-10., -8., 10., 8.)},
}
# Entries of runs that are changed for the picture: here ten turns would end
# where they began, so that the state after 300 degrees is written as well.
CHANGES = {"rotation": ["Output/VTU count=12"],
           "first_tunnel": ["Safety factor/Blocks=none"],
           "road_wedge": ["Safety factor/Blocks=none"]}


def read_arguments():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE",
                        help="names without folder and .prm (default: all)")
    parser.add_argument("--keyblock", default=str(ROOT / "build/keyblock"),
                        help="the program (default: build/keyblock)")
    parser.add_argument("--outputs", help="folder of the outputs of the runs, "
                        "one folder NAME for each (default: a temporary one)")
    parser.add_argument("--reuse", action="store_true",
                        help="draw outputs that exist without running again")
    return parser.parse_args()


def find_scenes(names):
    """Files by name of the scenes called so, or of all of them; of two scenes
    with one name that of the tutorial is called tutorial_NAME."""
    files = {}
    for folder in ("verification", "tutorial"):
        for path in sorted((ROOT / "prm" / folder).glob("*.prm")):
            files[f"{folder}_{path.stem}" if path.stem in files
                  else path.stem] = path
    for name in names:
        if name not in files:
            sys.exit(f"pictures.py: there is no scene '{name}' in "
                     "prm/tutorial and prm/verification; leave out folder and "
                     "'.prm'.")
    return {name: files[name] for name in names or files}


def run(program, scene, folder, name):
    """Run a scene with pictures of its states written."""
    command = [program, str(scene), "--output", str(folder)]
    for change in ["Output/Write VTU=true", *CHANGES.get(name, [])]:
        command += ["--set", change]
    try:
        done = subprocess.run(command, capture_output=True, text=True)
    except OSError as error:
        sys.exit(f"pictures.py: '{program}' cannot be run ({error.strerror}); "
                 "build it, or name it by --keyblock.")
    if done.returncode != 0:
        sys.exit(f"pictures.py: the scene '{scene.stem}' ended with code "
                 f"{done.returncode}: {done.stderr.strip()}")


def view_of(name):
    """What the picture of a scene shows."""
    fitting = [start for start in SCENES if name.startswith(start)]
    return View(size=SIZE, **SCENES[max(fitting, key=len)])


def make_palette():
    """Picture whose palette has shades of the field, of grey and of red."""
    shades = [[(1. - w) * a[k] + w * b[k] for k in range(3)]
              for a, b in zip(COLOURS, COLOURS[1:])
              for w in (0., 0.15, 0.3, 0.45, 0.6, 0.75, 0.9)] + [COLOURS[-1]]
    shades += [[v / 7.] * 3 for v in range(8)]
    shades += [[1. - w * (1. - v) for v in RED] for w in (0.5, 1.)]
    shades += [[0.5 * v for v in RED]]
    flat = [round(255 * v) for shade in shades for v in shade]
    image = Image.new("P", (1, 1))
    image.putpalette(flat + flat[-3:] * (256 - len(shades)))
    return image


def reduce_colours(path, is_field):
    """Write a picture again with few colours; its size in bytes."""
    with Image.open(path) as image:
        rgb = image.convert("RGB")
    if is_field:
        reduced = rgb.quantize(palette=make_palette(),
                               dither=Image.Dither.NONE)
    else:
        reduced = rgb.quantize(N_COLOURS, Image.Quantize.MAXCOVERAGE)
    reduced.save(path, optimize=True)
    return path.stat().st_size


def plot_fit(folder, picture):
    """Measured against fitted stresses of a run."""
    program = ROOT / "contrib" / "plot_geostress.py"
    done = subprocess.run([sys.executable, str(program),
                           str(folder / "geostress.csv"), str(picture)])
    if done.returncode != 0:
        sys.exit(f"pictures.py: '{picture}' was not plotted.")


def main():
    """Run and draw the scenes one by one."""
    arguments = read_arguments()
    scenes = find_scenes(arguments.scenes)
    outputs = pathlib.Path(arguments.outputs or tempfile.mkdtemp())
    pictures = ROOT / "doc" / "pictures"
    pictures.mkdir(exist_ok=True)
    sizes = {}
    for name, scene in scenes.items():
        folder, view = outputs / name, view_of(name)
        if not (arguments.reuse and (folder / "solution.pvd").exists()):
            run(arguments.keyblock, scene, folder, name)
        picture = pictures / f"{name}.png"
        draw(folder / "solution.pvd", picture, view)
        sizes[picture] = reduce_colours(picture, view.field != "block")
        if (folder / "geostress.csv").exists():
            picture = pictures / f"{name}_fit.png"
            plot_fit(folder, picture)
            sizes[picture] = reduce_colours(picture, False)
    for picture, size in sizes.items():
        if size > LARGEST:
            print(f"{picture.relative_to(ROOT)}: {size} bytes, too large")
    print(f"{len(sizes)} pictures, {sum(sizes.values())} bytes")


if __name__ == "__main__":
    main()
