# SPDX-License-Identifier: LGPL-2.1-or-later
"""Safety factors of blocks and the trials that lead to them, for figures.py.

Each function that draws takes the runs and returns a figure, or a sentence
that says what it has not got."""
import math

from figures_style import (DASHES, block_colour, block_label, block_line,
                           fitting_unit, key_of_runs, new_figure, put_legend,
                           use_logarithm)
from report.tables import is_least

MOST = 12  # blocks in a figure
METHODS = {"safety_factor": ("strength reduction", "-", "o"),
           "limit_equilibrium": ("limit equilibrium", (0, (5, 2)), "s"),
           "stress_ratio": ("stress ratio", (0, (1.5, 1.5)), "D")}


def factors_of(run):
    """Numbers of the blocks whose factors were looked for, of many the most
    dangerous."""
    return [n for n in run.named_blocks(MOST)
            if run.blocks[n].get("safety_factor")]


def result_of(block, stage):
    """The safety factor of a block after a stage, or None."""
    for result in block.get("safety_factor", []):
        if result["stage"] == stage:
            return result
    return None


def title_of(run, number, result):
    """Block, factor and how it fails, in two lines."""
    outcome = result["outcome"]
    if is_least(result):
        outcome = f"at least {result['lower']:.3g}"
    elif outcome == "value":
        outcome = f"{result['value']:.3g}, {result['failure_mode']}"
    elif outcome == "immovable":
        outcome = f"immovable: holds at {result['lower']:.3g}"
    elif outcome == "falls freely":
        outcome = f"falls freely: fails at {result['upper']:.3g}"
    elif outcome == "carried along":
        outcome = f"carried along: {result['group']['value']:.3g} together"
    return f"{block_label(run, number)}\n{outcome}"


def draw_trials(runs, stage=None):
    """Slip of each block against the factor of the trials after a stage."""
    run = runs[0]
    stages = [r["stage"] for n in factors_of(run)
              for r in run.blocks[n]["safety_factor"]]
    if not stages:
        return "no safety factors"
    stage = stage or max(stages, key=run.stages.index)
    found = {n: result_of(run.blocks[n], stage) for n in factors_of(run)}
    found = {n: r for n, r in found.items() if r and r.get("trials")}
    if not found:
        return f"no trials of safety factors after {stage}"
    columns = min(2, len(found))
    rows = math.ceil(len(found) / columns)
    figure, axes = new_figure(rows, columns, (4.6 * columns + 0.6,
                                              3.1 * rows + 0.5))
    for one in axes.flat[len(found):]:
        one.remove()
    slips = [[t["slip"] for t in r["trials"]] for r in found.values()]
    unit = fitting_unit("m", slips)
    for one, (number, result) in zip(axes.flat, found.items()):
        plot_trials(one, result, block_colour(run, number), unit)
        one.set_title(title_of(run, number, result), loc="left")
    axes.flat[0].plot([], [], "o", color="0.3", label="holds")
    axes.flat[0].plot([], [], "X", color="0.3", label="fails")
    axes.flat[0].fill([], [], color="0.85", label="bracket")
    figure.suptitle(" ", fontsize=10.5)  # room for the legend
    figure.legend(*axes.flat[0].get_legend_handles_labels(), ncols=3,
                  loc="upper center", fontsize=9, frameon=False)
    figure.supxlabel(f"reduction factor after {stage} [-]", fontsize=10.5)
    figure.supylabel(f"slip [{unit[0]}]", fontsize=10.5)
    return figure


def plot_trials(axes, result, colour, unit):
    """The trials of one search, those that failed as crosses.

    Slips below a millionth of the largest are drawn there."""
    trials = sorted(result["trials"], key=lambda trial: trial["factor"])
    x = [trial["factor"] for trial in trials]
    least = 1e-6 * max(trial["slip"] for trial in trials)
    y = [max(trial["slip"], least) / unit[1] for trial in trials]
    axes.plot(x, y, color=colour, linewidth=1.2)
    for marker, is_stable in (("o", True), ("X", False)):
        shown = [(a, b) for a, b, t in zip(x, y, trials)
                 if t["stable"] == is_stable]
        if shown:
            axes.plot(*zip(*shown), marker, color=colour, markersize=7,
                      markeredgecolor="white")
    if is_least(result):
        axes.axvline(result["lower"], color="0.4", linewidth=0.8, zorder=0)
    elif result["outcome"] == "value":
        axes.axvspan(result.get("lower", 0.), result["upper"], color="0.85", zorder=0)
        axes.axvline(result["value"], color="0.4", linewidth=0.8, zorder=0)
    use_logarithm(axes, x, "x")
    use_logarithm(axes, y, "y")
    if axes.get_xscale() == "linear" and max(x) < 1.2 * min(x):
        axes.set_xlim(0.8 * min(x), 1.2 * max(x))
    axes.margins(0.12)


def factor_points(run, number, method):
    """Stage number, factor and outcome of a block by one of the methods."""
    points = []
    for result in run.blocks[number].get(method, []):
        value = result.get("value")
        outcome = result.get("outcome", "value")
        if outcome == "carried along":
            value, outcome = result["group"]["value"], "value"
        if value is None:
            value = 0. if outcome == "falls freely" else math.inf
        if is_least(result):  # by its lower bound
            value, outcome = result["lower"], "least"
        elif outcome.startswith("above "):
            outcome = "immovable"  # as far as trials go: the same symbol
        if outcome == "value" and not 0. < value < math.inf:
            outcome = "falls freely" if value <= 0. else "immovable"
        if result["stage"] in run.stages:
            points.append((run.stages.index(result["stage"]), value, outcome))
    return points


def draw_factors(runs):
    """Factors of the blocks by stage and method; of two runs the first."""
    first = runs[0]
    if not factors_of(first):
        return "no safety factors"
    methods = METHODS if len(runs) == 1 else ["safety_factor"]
    curves = [(run, n, m, factor_points(run, n, m)) for run in runs
              for n in factors_of(first) for m in methods]
    values = [v for *_, points in curves for _, v, o in points
              if o in ("value", "least")]
    low, high = (min(values), max(values)) if values else (0.5, 2.)
    is_wide = high > 8. * low
    ends = ((low / 1.6, high * 1.6) if is_wide else
            (0., 1.25 * high))
    figure, ((axes,),) = new_figure()
    axes.set_yscale("log" if is_wide else "linear")
    for run, number, method, points in curves:
        plot_factors(axes, first, number, method, points, ends,
                     DASHES[runs.index(run)] if len(runs) > 1 else None)
    axes.set(ylim=ends, ylabel="safety factor [-]", xlim=(
        -0.5, len(first.stages) - 0.5))
    axes.set_xticks(range(len(first.stages)), first.stages)
    if 1. > ends[0]:
        axes.axhline(1., color="0.6", linewidth=0.8, zorder=0)
    if is_wide:
        axes.set_yticks([t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
                         if ends[0] <= t <= ends[1]])
        axes.yaxis.set_major_formatter("{x:g}")
        axes.yaxis.set_minor_formatter("")
    key_of_factors(axes, first, runs, curves)
    return figure


def plot_factors(axes, run, number, method, points, ends, dashes):
    """The factors of one block by one method; triangles at the rims."""
    _, own_dashes, marker = METHODS[method]
    colour = block_colour(run, number)
    blocks = factors_of(run)
    shift = min(0.09, 0.8 / len(blocks)) * (
        blocks.index(number) - 0.5 * (len(blocks) - 1))
    is_found = method == "safety_factor"
    fill = {"markerfacecolor": colour if is_found else "white",
            "color": colour, "clip_on": False, "zorder": 4 if is_found else 3}
    known = [(x, y) for x, y, outcome in points
             if outcome in ("value", "least")]
    if known:
        axes.plot(*zip(*known), linestyle=dashes or own_dashes, color=colour,
                  zorder=fill["zorder"], **block_line(run, number))
        axes.plot(*zip(*known), marker=marker, linestyle="none", markersize=5,
                  **fill)
    for x, y, outcome in points:
        if outcome == "least":
            axes.annotate("", (x, y), (0, 16), textcoords="offset points",
                          arrowprops={"arrowstyle": "<-", "color": colour})
    for outcome, symbol, place in (("immovable", "^", ends[1]),
                                   ("falls freely", "v", ends[0])):
        x = [x + shift for x, _, found in points if found == outcome]
        if x:
            axes.plot(x, [place] * len(x), symbol, **fill,
                      markersize=6 if is_found else 9)


def key_of_factors(axes, run, runs, curves):
    """Legend of blocks, methods or runs, and symbols."""
    for number in factors_of(run):
        if any(n == number and points for _, n, _, points in curves):
            axes.plot([], [], color=block_colour(run, number), linewidth=3,
                      label=block_label(run, number),
                      **block_line(run, number))
    if len(runs) > 1:
        key_of_runs(axes, runs)
    else:
        for name, dashes, marker in METHODS.values():
            fill = "0.3" if marker == "o" else "white"
            axes.plot([], [], color="0.3", linestyle=dashes, marker=marker,
                      markersize=5, markerfacecolor=fill, label=name)
    for marker, label in (("^", "immovable, stable or above the highest"),
                          ("v", "falls freely"), (r"$\uparrow$", "or more")):
        axes.plot([], [], marker=marker, linestyle="none", color="0.3",
                  markersize=8, label=label)
    put_legend(axes)
