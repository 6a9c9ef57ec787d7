# SPDX-License-Identifier: LGPL-2.1-or-later
"""Displacements, stresses of joints and energies by stage, for figures.py.

Each function that draws takes the runs (the first solid, the second dashed)
and returns a figure, or a sentence that says what it has not got."""
import numpy

from figures_joints import block_face_stresses
from figures_style import (DASHES, NO_STEPS, NOTHING, block_colour,
                           block_label, block_line, fitting_unit, joint_style,
                           key_of_joints, key_of_runs, new_figure,
                           put_legend, put_stages)

TERMS = {"external": "#1f77b4", "elastic": "#2f9e44", "friction": "#c0392b",
         "local_damping": "#e8820e", "kinetic": "#7e57c2",
         "plastic": "#8c564b", "supports": "#0b9ba8",
         "contact_closure": "#d6336c", "penetration": "#6d4c41",
         "dilation": "#0b7285",
         "stiffness_damping": "#a9841b", "mass_damping": "#7f8c8d"}
# of monitors of points, and of blocks that are part of the rock
POINT_COLOURS = ["0.2", "#1565c0", "#2e7d32", "#00909e", "#827717", "#5c6bc0",
                 "0.55", "#26a69a"]
# of the ledger: what flows in; the rest is stored or dissipated
INFLOWS = {"external", "supports"}


def magnitude(run, monitor):
    """Length of the displacement of a monitor at all lines."""
    return numpy.sqrt(sum(run.history[f"{monitor}.u_{axis}"]**2 for axis in
                          "xyz" if f"{monitor}.u_{axis}" in run.history))


def end_of_block(run, number, values):
    """Number of lines of the history before a block was taken away."""
    if number is None or run.removal_stage(number) is None:
        return len(values)
    return int(numpy.flatnonzero(values)[-1]) + 1 if values.any() else 0


def colour_of(run, name, watched):
    """Colour and line of a monitor: of the block it watches, of points one each."""
    named, number = run.named_blocks(), watched.get(name)
    if number in named:
        return block_colour(run, number), block_line(run, number)
    others = [n for n in run.monitors("block") + run.monitors("point")
              if watched.get(n) not in named]
    return POINT_COLOURS[others.index(name) % len(POINT_COLOURS)], {}


def draw_displacements(runs):
    """Displacements of the monitors of blocks and points by stage."""
    first = runs[0]
    watched = {name: first.block_at(name) for name in first.monitors("block")}
    names = sorted(watched, key=watched.get) + first.monitors("point")
    if not first.history or not names:
        return "no monitor of a block or point"
    kind = first.axis_kind()
    curves, staying = [], []
    for run, dashes in zip(runs, DASHES):
        for name in names:
            if f"{name}.u_x" not in run.history:
                continue
            values = magnitude(run, name)
            n = end_of_block(run, watched.get(name), values)
            curves.append((run, name, dashes, values[:n]))
            if n == len(values):
                staying.append(values)
    shown = staying or [values for *_, values in curves]
    unit, size = fitting_unit("m", shown)
    top = 1.15 * max(values.max() for values in shown) / size
    if top * size < NOTHING:
        return "the monitors do not move"
    figure, ((axes,),) = new_figure()
    for run, name, dashes, values in curves:
        number = watched.get(name)
        colour, style = colour_of(first, name, watched)
        label = block_label(first, number) if number else f"point {name}"
        x = run.positions(kind)
        axes.plot(x[:len(values)], values / size, color=colour,
                  linestyle=dashes, label=label if run is first else None,
                  **style)
        if 0 < len(values) < len(x):
            above = int((values / size < top).sum())
            axes.plot(x[min(above, len(values) - 1)], min(values[-1] / size,
                                                          top), "x",
                      color=colour, markersize=8, clip_on=False,
                      markeredgewidth=2, label="goes on, taken away\nin "
                      + run.blocks[number]["removed_in_stage"])
    axes.set(ylim=(0., top), ylabel=f"displacement [{unit}]")
    key_of_runs(axes, runs)
    put_stages(axes, first, kind)
    put_legend(axes)
    return figure


def draw_joint_forces(runs):
    """Normal and shear forces of the monitors of joints by stage."""
    first = runs[0]
    names = [n for n in first.monitors("joint")
             if f"{n}.normal_force" in first.history]
    if not names:
        return "no monitor of a joint"
    kind = first.axis_kind()
    figure, axes = new_figure(2, 1, (8.6, 6.), sharex=True)
    for one, quantity in zip(axes.flat, ("normal_force", "shear_force")):
        curves = [(run, name, dashes, run.history[f"{name}.{quantity}"])
                  for run, dashes in zip(runs, DASHES) for name in names
                  if f"{name}.{quantity}" in run.history]
        unit, size = fitting_unit("N", [c[3] for c in curves])
        for run, name, dashes, values in curves:
            joint = first.entries.get(f"Monitors/{name}/Joint", "")
            style = joint_style(first, joint)
            if len(runs) > 1:
                style["linestyle"] = dashes
            label = name if name == joint else f"{name} ({joint})"
            label = label if run is first else None
            one.plot(run.positions(kind), values / size, label=label, **style)
        one.set_ylabel(f"{quantity.replace('_', ' ')} [{unit}]")
        put_stages(one, first, kind)
    axes[0, 0].set_xlabel("")
    key_of_runs(axes[0, 0], runs)
    put_legend(axes[0, 0])
    return figure


def draw_joint_stresses(runs):
    """Mean stresses on the faces of each finite block by stage."""
    first = runs[0]
    if not all(run.takes_steps() for run in runs):
        return NO_STEPS
    if not first.is_plane:
        return "drawn in 2D only"
    found = [(run, block_face_stresses(run)) for run in runs]
    order = first.exposed_blocks()
    order += [n for n in first.finite_blocks() if n not in order]
    blocks = [n for n in order if found[0][1].get(n)]
    if not blocks:
        return "no joint faces of finite blocks with stresses"
    kind = first.axis_kind()
    shown = blocks[:4]
    figure, axes = new_figure(2, len(shown), (2.9 * len(shown) + 2.6, 6.),
                              sharex=True, sharey="row")
    curves = [v for _, faces in found for n in shown
              for v in faces.get(n, {}).values()]
    titles = "normal stress (pressed: +)", "shear stress"
    for row, title in enumerate(titles):
        unit, size = fitting_unit("Pa", [c[1 + row] for c in curves])
        axes[row, 0].set_ylabel(f"{title} [{unit}]")
        for one, number in zip(axes[row], shown):
            for (run, faces), dashes in zip(found, DASHES):
                plot_faces(one, first, faces.get(number, {}), row, size,
                           dashes if len(runs) > 1 else None)
            put_stages(one, first, kind, is_narrow=True)
    for one, number in zip(axes[0], shown):
        one.set_title(block_label(first, number).replace(" (", "\n("),
                      color=block_colour(first, number))
        one.set_xlabel("")
    joints = {name for n in shown for name in found[0][1][n]}
    key_of_joints(axes[0, -1], first, [
        name for name in first.names("Joints") if name in joints],
        **({"linestyle": "-"} if len(runs) > 1 else {}))
    key_of_runs(axes[0, -1], runs)
    put_legend(axes[0, -1])
    return figure


def plot_faces(axes, run, faces, row, size, dashes):
    """The stresses of one block, a curve for each of its joints."""
    for name, (x, *stresses) in faces.items():
        style = joint_style(run, name)
        style["linestyle"] = dashes or style["linestyle"]
        axes.plot(x, stresses[row] / size, marker="o", markersize=3, **style)


def ledger(run):
    """Terms of the energy ledger by name, what is stored since its start."""
    terms = {name: run.history[f"energy.{name}"] for name in TERMS
             if f"energy.{name}" in run.history}
    residual = run.history.get("energy.residual")
    if residual is None or len(terms) < len(TERMS):
        return {}, None
    # its start, which the history has not got: what closes the balance
    start = residual + sum(-v if name in INFLOWS else v
                           for name, v in terms.items())
    terms["elastic"] = terms["elastic"] - start
    return terms, residual


def broken(run, terms, values):
    """Values with gaps where the ledger begins anew."""
    spent = terms["friction"] + terms["local_damping"]
    anew = numpy.diff(spent) < -1e-9 * abs(spent).max()
    anew |= numpy.diff(run.history["stage"]) != 0
    result = numpy.array(values, dtype=float)
    result[1:][anew] = numpy.nan
    return result


def draw_energy(runs):
    """Terms of the energy ledger, and how well it closes."""
    first = runs[0]
    ledgers = [(run, *ledger(run)) for run in runs]
    if any(not terms for _, terms, _ in ledgers):
        return "no energy ledger in its history"
    kind = first.axis_kind()
    largest = max(abs(v).max() for _, terms, _ in ledgers
                  for v in terms.values())
    if largest == 0.:
        return "no energy in its history"
    unit, size = fitting_unit("J", [[largest]])
    figure, axes = new_figure(2, 1, (8.6, 6.4), sharex=True,
                              gridspec_kw={"height_ratios": (3, 1.2)})
    shown = [name for name in TERMS if max(
        abs(terms[name]).max() for _, terms, _ in ledgers) > 2e-3 * largest]
    for (run, terms, residual), dashes in zip(ledgers, DASHES):
        x = run.positions(kind)
        for name in shown:
            label = "elastic, change" if name == "elastic" else name
            axes[0, 0].plot(x, broken(run, terms, terms[name]) / size,
                            color=TERMS[name], linestyle=dashes,
                            linewidth=2.6 if name == "external" else 1.4,
                            label=label.replace("_", " ") if run is first
                            else None)
        own = max(abs(v).max() for v in terms.values())
        axes[1, 0].semilogy(x, numpy.where(residual == 0., numpy.nan,
                                           abs(residual) / own),
                            color="0.3", linestyle=dashes, linewidth=0.8)
    axes[0, 0].plot([], [], " ", label="others below 0.2 %")
    axes[0, 0].set_ylabel(f"energy since start of stage [{unit}]")
    axes[1, 0].set_ylabel("residual over\nlargest term [-]")
    key_of_runs(axes[0, 0], runs)
    for one in axes.flat:
        put_stages(one, first, kind)
    axes[0, 0].set_xlabel("")
    put_legend(axes[0, 0])
    return figure
