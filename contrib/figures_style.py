# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours, units, axes and files that all figures of figures.py share."""
import math
import os.path
import sys

import numpy

try:
    import matplotlib
    matplotlib.use("Agg")
    from PIL import Image
    from matplotlib import patheffects, pyplot
    from matplotlib.colors import to_rgb
except ImportError as error:
    sys.exit(f"figures.py: Matplotlib or Pillow cannot be loaded ({error}); "
             "install the package python3-matplotlib and use the system's "
             "Python, /usr/bin/python3.")

from figures_run import fail

# Blocks are warm, joints cool, to stand out from each other and from the
# displacements, which render.py draws from green to blue.
BLOCK_COLOURS = ["#f08c00", "#d6226a", "#6a3fb5", "#8a4b22", "#bfa100",
                 "#e0402f", "#555555", "#d98cb3"]
ROCK_COLOURS = ["#f1eee6", "#dcd5c3", "#e3e7e0", "#cfd6d8"]  # by material
JOINT_COLOURS = ["#222222", "#1565c0", "#2e7d32", "#00909e", "#827717",
                 "#5c6bc0", "#78909c", "#26a69a"]
DASHES = ["-", (0, (5, 2)), (0, (1.5, 1.5)), (0, (6, 2, 1.5, 2))]
HIDDEN = "#9a9a92"  # of many blocks those that are hidden
LARGEST = 250000  # bytes of a picture; larger ones get fewer colours
NO_STEPS = "no step was taken, limit equilibrium alone judged the blocks"
NOTHING = 1e-12  # displacements below are rounding errors [m]
UNITS = {"m": (("m", 1.), ("mm", 1e-3), ("\N{MICRO SIGN}m", 1e-6)),
         "N": (("GN", 1e9), ("MN", 1e6), ("kN", 1e3), ("N", 1.)),
         "Pa": (("MPa", 1e6), ("kPa", 1e3), ("Pa", 1.)),
         "J": (("GJ", 1e9), ("MJ", 1e6), ("kJ", 1e3), ("J", 1.),
               ("mJ", 1e-3))}


def block_colour(run, number):
    """The colour of a finite block, the same in all figures.

    Of many blocks those that are hidden are grey."""
    named = sorted(run.named_blocks())
    if number not in named:
        return HIDDEN
    return BLOCK_COLOURS[named.index(number) % len(BLOCK_COLOURS)]


def pale(colour):
    """A paler shade of a colour, as its parts."""
    return tuple(0.35 * part + 0.65 for part in to_rgb(colour))


def block_line(run, number):
    """Options of the lines of a block: hollow where its colour is of two."""
    named = sorted(run.named_blocks())
    if number not in named or named.index(number) < len(BLOCK_COLOURS):
        return {}
    return {"path_effects": [
        patheffects.Stroke(linewidth=3.6,
                           foreground=block_colour(run, number)),
        patheffects.Stroke(linewidth=1.4, foreground="white")]}


def block_label(run, number):
    """Block and the names of its monitors."""
    names = [name for name in run.monitors("block")
             if run.block_at(name) == number]
    return f"block {number}" + (f" ({', '.join(names)})" if names else "")


def joint_style(run, name):
    """Colour and dashes of the set of a joint, the same in all figures."""
    place = run.group_of(name)
    return {"color": JOINT_COLOURS[place % len(JOINT_COLOURS)],
            "linestyle": DASHES[place % len(DASHES)]}


def key_of_joints(axes, run, names, **style):
    """Lines of the legend for joints, one for each set; as handles."""
    handles = {}
    for name in names:
        group = run.group_name(name)
        if group not in handles:
            line, = axes.plot([], [], label=group, **{
                **joint_style(run, name), **style})
            handles[group] = line
    return list(handles.values())


def fitting_unit(kind, values):
    """Name and size of the unit in which the largest value reads well."""
    values = numpy.abs(numpy.concatenate([numpy.ravel(v) for v in values]))
    values = values[numpy.isfinite(values)]
    largest = values.max() if values.size else 0.
    for name, size in UNITS[kind]:
        if float(f"{largest / size:.3g}") >= 1.:  # 1 mm, not 1e+03 um
            return name, size
    return UNITS[kind][-1]


def new_figure(rows=1, columns=1, size=(8.6, 4.8), **options):
    """Figure and array of axes with readable type."""
    with pyplot.rc_context({"font.size": 10.5, "axes.titlesize": 10.5}):
        figure, axes = pyplot.subplots(rows, columns, figsize=size, dpi=100,
                                       squeeze=False, layout="constrained",
                                       **options)
    for one in axes.flat:
        one.grid(color="0.92")
        one.set_axisbelow(True)
        for side in ("top", "right"):
            one.spines[side].set_visible(False)
    return figure, axes


def short_names(names):
    """Names without what all begin with, and that; as 1, 2 and stage."""
    common, _, _ = os.path.commonprefix(names).rpartition("_")
    if not common or len(names) < 2:
        return names, ""
    return [name[len(common) + 1:] for name in names], common


def put_stages(axes, run, kind, is_narrow=False):
    """Lines where stages end, their names below, and the axis' label.

    On a narrow axis names are shortened."""
    ends = list(range(1, len(run.stages) + 1))
    if kind != "stage":
        ends = run.stage_ends(kind)
        axes.set_xlabel({"time": "time [s]", "step": "step [-]"}[kind])
    else:
        names, common = (short_names(run.stages) if is_narrow else
                         (run.stages, ""))
        axes.set_xlim(0., len(names))
        axes.set_xticks([end - 0.5 for end in ends], names)
        axes.set_xlabel(common)
        axes.tick_params(axis="x", length=0)
        axes.grid(False, axis="x")
        if len("  ".join(names)) > (30 if is_narrow else 75):
            axes.tick_params(axis="x", rotation=90 if is_narrow else 30)
    for end in ends[:-1]:
        axes.axvline(end, color="0.8", linewidth=0.8, zorder=0)


def key_of_runs(axes, runs):
    """Lines of the legend that tell two runs apart."""
    if len(runs) > 1:
        for run, dashes in zip(runs, DASHES):
            axes.plot([], [], color="0.3", linestyle=dashes, label=run.label)


def put_legend(axes, **options):
    """Legend on the right of the axes, where it covers nothing."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=9,
                frameon=False, handlelength=2.6, **options)


def put_text(axes, place, text, **options):
    """A short text with a white rim, readable on any ground; save() leaves it
    out where it would lie on one that was put before.

    In SVG, where its letters are paths, it is the group label_TEXT."""
    rim = [patheffects.withStroke(linewidth=2.5, foreground="white")]
    axes.text(*place, text, ha="center", va="center", path_effects=rim,
              clip_on=True, gid=f"label_{text}", **options)


def hide_covered_labels(figure):
    """Leave out labels that would lie on others: those put first stay."""
    figure.draw_without_rendering()  # places depend on the layout
    for axes in figure.axes:
        kept = []
        for text in axes.texts:
            if not (text.get_gid() or "").startswith("label_"):
                continue
            box = text.get_window_extent()
            if any(box.overlaps(other) for other in kept):
                text.set_visible(False)
            else:
                kept.append(box)


def use_logarithm(axes, values, name):
    """A logarithmic axis if positive values differ by more than 30 times."""
    values = [v for v in values if math.isfinite(v) and v > 0.]
    if values and max(values) > 30. * min(values):
        axes.set(**{f"{name}scale": "log"})
        axis = getattr(axes, f"{name}axis")
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("")


def reduce_colours(path):
    """Write a large picture again with as many colours as its size permits."""
    with Image.open(path) as image:
        rgb = image.convert("RGB")
    for n_colours in (256, 128, 64, 32):
        if path.stat().st_size <= LARGEST:
            break
        # an octree keeps the colours of thin lines, the default loses them
        rgb.quantize(n_colours, Image.Quantize.FASTOCTREE,
                     dither=Image.Dither.NONE).save(path, optimize=True)
    print(f"{path}  {path.stat().st_size / 1000:.0f} kB")


def save(figure, path, dpi=100):
    """Write a figure as its ending says, PNG with few colours; say it."""
    hide_covered_labels(figure)
    try:
        with pyplot.rc_context({"svg.fonttype": "none", "pdf.fonttype": 42}):
            # the layout leaves too little room beside maps in true proportions
            figure.savefig(path, dpi=dpi, bbox_inches="tight", pad_inches=0.08)
        if path.suffix == ".png" and dpi <= 100:
            reduce_colours(path)
        else:
            print(f"{path}  {path.stat().st_size / 1000:.0f} kB")
    except OSError as error:
        fail(f"'{path}' cannot be written: {error.strerror or error}.")
    pyplot.close(figure)
