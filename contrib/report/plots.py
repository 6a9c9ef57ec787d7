# SPDX-License-Identifier: LGPL-2.1-or-later
"""Orientations of joints, factors by stage, and energies, as SVG."""
import math

import numpy

from .style import (DASHES, GROUP_COLOURS, MARKERS, as_svg, beside,
                    new_figure, plain, pyplot)
from .tables import STATES, is_least, size_alone
from .words import count


def project(trend, plunge):
    """A direction in equal-angle projection, lower hemisphere; east, north."""
    trend, plunge = numpy.radians(trend), numpy.radians(plunge)
    radius = numpy.tan(numpy.pi / 4. - plunge / 2.)
    return radius * numpy.sin(trend), radius * numpy.cos(trend)


def great_circle(dip, direction):
    """The points of a plane's great circle, as east and north."""
    rake = numpy.radians(numpy.linspace(0., 180., 91))
    dip, strike = math.radians(dip), math.radians(direction - 90.)
    east = (numpy.cos(rake) * math.sin(strike)
            + numpy.sin(rake) * math.cos(dip) * math.cos(strike))
    north = (numpy.cos(rake) * math.cos(strike)
             - numpy.sin(rake) * math.cos(dip) * math.sin(strike))
    down = numpy.sin(rake) * math.sin(dip)
    return east / (1. + down), north / (1. + down)


def mean_plane(planes):
    """Dip and dip direction of the mean of planes, by their normals' tensor."""
    dips, azimuths = numpy.radians(numpy.array(planes)).T
    normals = numpy.column_stack([numpy.sin(dips) * numpy.sin(azimuths),
                                  numpy.sin(dips) * numpy.cos(azimuths),
                                  numpy.cos(dips)])
    normal = numpy.linalg.eigh(normals.T @ normals)[1][:, -1]
    normal *= 1. if normal[2] >= 0. else -1.
    return (math.degrees(math.acos(min(1., normal[2]))),
            math.degrees(math.atan2(normal[0], normal[1])) % 360.)


def planes_of_groups(run):
    """Name of each group of joints, and dip and dip direction of its joints."""
    names, group = run.joint_groups()
    planes = [run.orientation(row) for row in run.joints]
    return [(name, [p for p, g in zip(planes, group) if g == k and p])
            for k, name in enumerate(names)]


def stereonet(run):
    """Poles and great circles of the joints by group (3D), or None."""
    groups = [(n, p) for n, p in planes_of_groups(run) if p]
    if not groups:
        return None
    figure, axes = new_figure((6.4, 4.4))
    axes.set(aspect="equal", xlim=(-1.12, 1.12), ylim=(-1.12, 1.12))
    axes.axis("off")
    for dip in range(10, 90, 10):  # a faint net
        for direction in (90., 270.):
            axes.plot(*great_circle(dip, direction), color="0.9",
                      linewidth=0.6)
    turn = numpy.linspace(0., 2. * numpy.pi, 181)
    for half in range(10, 90, 10):  # small circles about north and south
        radius, centre = math.tan(math.radians(half)), 1. / math.cos(
            math.radians(half))
        for side in (1., -1.):
            x, y = radius * numpy.cos(turn), side * centre + radius * numpy.sin(
                turn)
            inside = x**2 + y**2 <= 1.
            axes.plot(numpy.where(inside, x, numpy.nan),
                      numpy.where(inside, y, numpy.nan), color="0.9",
                      linewidth=0.6)
    axes.plot(numpy.sin(turn), numpy.cos(turn), color="0.3", linewidth=1.)
    for name, x, y in (("N", 0, 1.07), ("E", 1.07, 0), ("S", 0, -1.07),
                       ("W", -1.07, 0)):
        axes.text(x, y, name, ha="center", va="center")
    for k, (name, planes) in enumerate(groups):
        colour = GROUP_COLOURS[k % 8]
        dip, direction = mean_plane(planes)
        circles = planes if len(planes) <= 3 else [(dip, direction)]
        for plane in circles:
            axes.plot(*great_circle(*plane), color=colour, linewidth=1.4,
                      linestyle=DASHES[k % 8])
        poles = numpy.array(planes)
        axes.plot(*project(poles[:, 1] + 180., 90. - poles[:, 0]),
                  MARKERS[k % 8], color=colour, markeredgecolor="white",
                  markeredgewidth=0.5,
                  markersize=6 if len(planes) < 50 else 3.5, linestyle="none")
        many = f", {len(planes)} joints, mean" if len(planes) > 1 else ":"
        axes.plot([], [], marker=MARKERS[k % 8], color=colour,
                  linestyle=DASHES[k % 8], label=f"{name}{many} "
                  f"{dip:.0f}°/{direction:03.0f}°")
    beside(axes, title="poles and great circles\n(dip/dip direction)",
           title_fontsize=9)
    return as_svg(figure, "Stereonet of the joints")


def mean_angle(angles):
    """The mean of directions without sense, in degrees from -90 to 90."""
    twice = numpy.radians(2. * numpy.array(angles))
    return 0.5 * math.degrees(math.atan2(numpy.sin(twice).sum(),
                                         numpy.cos(twice).sum()))


def rose(run):
    """How the traces of joints dip, by group (2D), or None."""
    groups = [(n, p) for n, p in planes_of_groups(run) if p]
    if not groups:
        return None
    figure, axes = new_figure((6.4, 3.6), subplot_kw={"projection": "polar"})
    width = 10.
    edges = numpy.arange(-90., 90.1, width)
    below = numpy.zeros(len(edges) - 1)
    for k, (name, planes) in enumerate(groups):
        # the angle of the trace with +x; one that dips to +x (090) falls
        angles = [-dip * math.sin(math.radians(d)) / max(
            abs(math.sin(math.radians(d))), 1e-9) for dip, d in planes]
        angles = [a - 180. if a >= 90. else a for a in angles]
        counts = numpy.histogram(angles, edges)[0]
        middle = numpy.radians(0.5 * (edges[1:] + edges[:-1]))
        for turn in (0., math.pi):
            axes.bar(middle + turn, counts, math.radians(width), below,
                     color=GROUP_COLOURS[k % 8], edgecolor="white",
                     linewidth=0.5, label=None if turn else
                     f"{name}" + (f", {len(planes)} joints" if len(planes) > 1
                                  else "") + f" ({mean_angle(angles):+.0f}°)")
        below = below + counts
    axes.set_thetagrids(range(0, 360, 30), [
        f"{a:+d}°" if a else "0°" for a in (0, 30, 60, 90, -60, -30) * 2])
    axes.tick_params(labelsize=8)
    axes.set_rlabel_position(75)
    axes.yaxis.set_major_locator(pyplot.MaxNLocator(3, integer=True))
    axes.grid(color="0.88")
    axes.legend(loc="upper left", bbox_to_anchor=(1.15, 1.0), fontsize=9,
                frameon=False, title="number of traces by angle with x",
                title_fontsize=9)
    return as_svg(figure, "Rose of the joints' traces")


def factor_curves(run, rows, most=10):
    """Blocks with factors to show, the most dangerous first; and others."""
    curves = []
    for row in rows:
        found = run.blocks[row["block"]].get("safety_factor", [])
        points = [(run.stages.index(r["stage"]), r) for r in found
                  if r.get("stage") in run.stages]
        if any(r.get("outcome") == "value" for _, r in points):
            curves.append((row, points))
    return curves[:most], len(curves) - min(len(curves), most)


def has_size(result):
    """Whether a result has a place of its own on the axis of factors."""
    return result.get("outcome") == "value" or is_least(result)


def factors(run, rows):
    """Factors by stage with brackets; a figure and what it leaves out."""
    curves, left = factor_curves(run, rows)
    if not curves:
        return None, "No search has found a factor between two bounds."
    values = [size_alone(r) for _, points in curves for _, r in points
              if has_size(r)]
    figure, axes = new_figure((9., 4.2))
    plain(axes)
    is_wide = max(values) > 6. * max(min(values), 1e-3)
    low, high = ((0.7 * min(min(values), 1.), 1.5 * max(values)) if is_wide
                 else (0., 1.2 * max(max(values), 1.)))
    axes.set_yscale("log" if is_wide else "linear")
    for k, (row, points) in enumerate(curves):
        shift = 0.05 * (k - 0.5 * (len(curves) - 1))
        style = {"color": STATES[row["state"]][0] if len(curves) == 1 else
                 GROUP_COLOURS[k % 8], "marker": MARKERS[k % 8]}
        known = [(s, r) for s, r in points if has_size(r)]
        y = numpy.array([size_alone(r) for _, r in known])
        is_open = numpy.array([is_least(r) for _, r in known])
        bounds = numpy.array([[v - r.get("lower", v), r.get("upper", v) - v]
                              for v, (_, r) in zip(y, known)])
        bounds[is_open, 1] = 0.06 * y[is_open]  # an arrow upwards
        axes.errorbar([s + shift for s, _ in known], y, lolims=is_open,
                      yerr=numpy.maximum(bounds.T, 0.), capsize=3,
                      linestyle=DASHES[k % 8], label=f"block {row['block']}",
                      markersize=5, linewidth=1.4, **style)
        for s, r in points:
            if not has_size(r):
                up = size_alone(r) > 1.
                axes.plot(s + shift, high if up else low,
                          "^" if up else "v", color=style["color"],
                          clip_on=False, markersize=7, zorder=4)
    axes.axhline(1., color="0.3", linewidth=0.9, zorder=0)
    axes.set(ylim=(low, high), xlim=(-0.5, len(run.stages) - 0.5),
             ylabel="safety factor [-]")
    axes.set_xticks(range(len(run.stages)), run.stages)
    if is_wide:
        ticks = [t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
                 if low <= t <= high]
        axes.set_yticks(ticks, [f"{t:g}" for t in ticks])
        axes.minorticks_off()
    if len("  ".join(run.stages)) > 75:
        axes.tick_params(axis="x", rotation=30)
    others = [size_alone(r) > 1. for _, p in curves for _, r in p
              if not has_size(r)]
    handles = list(axes.get_legend_handles_labels()[0])
    for is_high, marker, text in ((True, "^", "immovable or above\nthe highest "
                                   "tried"), (False, "v", "falls freely")):
        if is_high in others:
            handles += axes.plot([], [], marker, color="0.3", label=text)
    beside(axes, handles=handles)
    sentence = ("Bars are brackets: the factor lies between the greatest at "
                "which the block held and the least at which it failed.")
    if any(is_least(r) for _, points in curves for _, r in points):
        sentence += (" Arrows: the factor is at least that, as no trial above "
                     "it was made or failed.")
    if left:
        sentence += (f" {count(left, 'more block')} {'is' if left == 1 else 'are'} "
                     "in factors.csv.")
    return as_svg(figure, "Safety factors by stage"), sentence


TERMS = {"external": "#0072b2", "elastic": "#009e73", "friction": "#d55e00",
         "kinetic": "#cc79a7", "local_damping": "#e69f00",
         "plastic": "#7f3c00", "supports": "#56b4e9"}


def positions(run):
    """Where rows of the history stand, the axis' label, ends of stages."""
    history = run.history
    kinds = {run.entries.get(f"Stages/{name}/Kind") for name in run.stages}
    ends = run.stage_ends("time")
    if kinds <= {"dynamic"}:
        return history["time"], "time [s]", ends, False
    stage = history["stage"].astype(int)
    marks = numpy.array([0., *run.stage_ends("step")])
    steps = numpy.maximum(marks[1:] - marks[:-1], 1.)
    stage = numpy.minimum(stage, len(steps) - 1)
    return (stage + (history["step"] - marks[stage]) / steps[stage], "",
            list(range(1, len(run.stages) + 1)), True)


def thin(x, values, most=700):
    """At most about so many points, with the extremes between them."""
    if len(x) <= most:
        return x, values
    parts = numpy.array_split(numpy.arange(len(x)), most // 2)
    keep = sorted({i for part in parts for i in (
        part[values[part].argmin()], part[values[part].argmax()])}
        | {0, len(x) - 1})
    return x[keep], values[keep]


def energies(run):
    """The terms of the energy ledger over time, or None."""
    names = [n for n in run.history if n.startswith("energy.")
             and n != "energy.residual"]
    if not names or not run.stages:
        return None
    # what has changed since a stage's first row is what can be compared
    values = {n.split(".", 1)[1]: run.history[n] for n in names}
    first = numpy.zeros(len(run.history["stage"]), int)
    for k in range(len(run.stages)):
        rows = numpy.flatnonzero(run.history["stage"] == k)
        if len(rows):
            first[rows] = rows[min(1, len(rows) - 1)] if k == 0 else rows[0]
    if "elastic" in values:
        values["elastic"] = values["elastic"] - values["elastic"][first]
        values["elastic"][:1] = 0.
    largest = max(abs(v).max() for v in values.values())
    if largest == 0.:
        return None
    unit, size = next((u for u in (("GJ", 1e9), ("MJ", 1e6), ("kJ", 1e3),
                                   ("J", 1.)) if largest >= u[1]),
                      ("mJ", 1e-3))
    x, x_label, ends, by_stage = positions(run)
    figure, axes = new_figure((9., 4.))
    plain(axes)
    for k, (name, series) in enumerate(values.items()):
        if abs(series).max() < 1e-4 * largest:
            continue
        label = name.replace("_", " ") + (" (change)" if name == "elastic"
                                          else "")
        for stage in numpy.unique(run.history["stage"]):
            rows = numpy.flatnonzero(run.history["stage"] == stage)
            axes.plot(*thin(x[rows], series[rows] / size), linewidth=1.4,
                      linestyle=DASHES[k % 4], label=label,
                      color=TERMS.get(name, "#777777"))
            label = "_"  # a gap between stages, one entry in the legend
    for end in ends[:-1]:
        axes.axvline(end, color="0.75", linewidth=0.8, zorder=0)
    if by_stage:
        axes.set_xlim(0., len(run.stages))
        axes.set_xticks([end - 0.5 for end in ends], run.stages)
        axes.tick_params(axis="x", length=0)
        axes.grid(False, axis="x")
        if len("  ".join(run.stages)) > 75:
            axes.tick_params(axis="x", rotation=30)
    axes.set(xlabel=x_label, ylabel=f"energy [{unit}]")
    beside(axes)
    return as_svg(figure, "Energy ledger")
