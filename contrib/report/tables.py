# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of blocks, factors and stages, for the page and as CSV files."""
import csv
import io
import math
import re

from .statics import (factor_by_statics, follows_others, force_of,
                      last_factor, least_limit, passed_factor)
from .words import count, demand_of, number, tried_demand_of

# What a block is like, for colours: name, colour (of Okabe and Ito, which
# colour-blind people tell apart), what the legend says
STATES = {
    "fails": ("#d55e00", "failed in a stage, falls freely, or factor below 1"),
    "follows": ("#7f3c00", "fails once others have gone"),
    "moves": ("#f0e442", "still moving at the end of the last stage"),
    "low": ("#e69f00", "factor 1 to 1.5"),
    "holds": ("#56b4e9", "factor 1.5 and more"),
    "passed": ("#0072b2", "not critical by limit equilibrium"),
    "firm": ("#009e73", "immovable, or above the highest factor tried"),
    "stable": ("#009e73", "stable by limit equilibrium"),
    "undecided": ("#cc79a7", "undecided"),
    "unknown": ("#999999", "no factor looked for")}


def in_words(result):
    """What a search for a factor has found, in words."""
    outcome = result.get("outcome", "")
    lower, upper = result.get("lower"), result.get("upper")
    if is_least(result):
        return outcome if outcome != "value" else (
            f"at least {number(lower)}: no trial above it has failed")
    if outcome == "value":
        return (f"{number(result.get('value'))} "
                f"[{number(lower)}, {number(upper)}]")
    if outcome == "falls freely":
        return (f"falls freely: fails even at {number(upper)}"
                if upper else "falls freely")
    if outcome == "carried along":
        return f"carried along: {number(result['group']['value'])} together"
    if outcome == "immovable":
        return (f"immovable: holds at {number(lower)}" if lower else
                "immovable")
    if outcome == "undecided":
        low, high = (result.get(f"undecided_{end}", result.get(end))
                     for end in ("lower", "upper"))
        return (f"undecided between {number(low)} and {number(high)}"
                if high else "undecided")
    return outcome or "–"


def size_of(result):
    """A number to sort by: 0 falls freely, infinite holds whatever is tried.

    The least of a block alone and together with those that move with it."""
    group = result.get("group") or {}
    return min(size_alone(result), group.get("value", math.inf))


def is_least(result):
    """Whether a search says no more than that the factor is at least "lower".

    It ended at the factor that is wanted, or no trial above it has failed."""
    outcome = result.get("outcome", "value")
    return "lower" in result and (outcome.endswith(", as wanted") or (
        outcome == "value" and "upper" not in result))


def size_alone(result):
    """The same of the block alone."""
    outcome = result.get("outcome", "value")
    if is_least(result):
        return result["lower"]
    if outcome == "falls freely":
        return 0.
    if outcome in ("immovable", "carried along"):
        return math.inf
    if outcome == "undecided":
        return result.get("undecided_lower", result.get("lower", math.inf))
    if outcome == "stable":
        return math.inf
    return result.get("value", result.get("lower", math.inf))


def least(results, limits=()):
    """The result with the least factor, or None.

    Of equal ones that of the stage with the least limit equilibrium, as
    "limits" has it, then of that which asks for most support, then the last."""
    def order_of(result):
        limit = of_stage(limits, result.get("stage"))
        return (size_of(result), size_of(limit) if limit else math.inf,
                -force_of(demand_of(limit)))
    return min(reversed(results), key=order_of) if results else None


def of_stage(results, stage):
    """The result of a list after a stage, or None."""
    return next((r for r in results or [] if r.get("stage") == stage), None)


def is_held_by_clamping(factor, limit):
    """Stable by strength reduction, but not as a rigid block without stress.

    And the run names nothing else that holds it."""
    if not factor or not limit or factor.get("outcome") == "undecided":
        return None
    what = held_by(factor, limit)
    return what == "" or what is not None and "clamping" in what


def held_by(factor, limit):
    """What the run says holds a block that fails as a rigid one without stress.

    Empty if it does not say, None if the block does not hold, or is stable by
    limit equilibrium, too."""
    if not factor or not limit or factor.get("outcome") == "undecided" or not (
            size_of(limit) < 1. <= factor.get("lower", size_of(factor))):
        return None
    support = re.search(r"held by (the support [^,;]*), left out",
                        limit.get("remark") or "")
    return factor.get("outcome", "").partition("held by ")[2] or (
        support[1] if support else "")


def state_of(row, is_moving):
    """Which of STATES a block is in; where it moves, only failure is worse."""
    limit, factor = row["limit"], row["factor"]
    state = state_by_factor(row["removed"] or row["moved_off"],
                            factor or factor_by_statics(limit))
    if not (row["removed"] or row["moved_off"] or factor):
        if follows_others(limit):
            state = "follows"
        elif row["passed"] is not None:
            state = "passed"
    return "moves" if is_moving and state != "fails" else state


def state_by_factor(has_failed, factor):
    """Which of STATES a block is in by its factor."""
    if has_failed:
        return "fails"
    if factor is None:
        return "unknown"
    outcome = factor.get("outcome", "value")
    if outcome in ("undecided", "stable"):
        return outcome
    size = size_of(factor)
    if factor.get("group"):
        pass
    elif outcome == "immovable" or (outcome.startswith("above")
                                    and not is_least(factor)):
        return "firm"
    elif is_least(factor):  # a value that is not known: by its lower bound
        return ("holds" if size >= 1.5 else "low" if size >= 1. else
                "undecided")
    return "fails" if size < 1. else "low" if size <= 1.5 else "holds"


def where_is(normal, down):
    """Roof, wall or floor, by the outward normal of the free faces."""
    if normal is None or down is None:
        return None
    along = float(normal @ down)
    return ("roof" if along > math.sqrt(0.5) else
            "floor" if along < -math.sqrt(0.5) else "wall")


def exposure_of(run, geometry, n, exposed):
    """Where a block is exposed, and the area of its free faces.

    As blocks.csv has them; of older runs, and of older tables, by the cells of
    the state in which it is exposed."""
    row = run.block_rows.get(str(n), {})
    if exposed is None:
        return None, None
    if "place" in row and row.get("free area"):
        return row["place"] or None, float(row["free area"])
    free = geometry.free_normal(n, exposed - 2) if geometry else None
    return (where_is(free[0], run.down()), float(free[1])) if free else (
        None, None)


def largest_demand(results, demand_in=demand_of):
    """The largest support that a stage asks for, with its name; or None."""
    demands = [{**demand_in(result), "stage": result.get("stage")}
               for result in results if demand_in(result)]
    return max(demands, key=force_of, default=None)


def row_of(run, geometry, n, moved_off, moving):
    """What is known of a finite block, by column."""
    block = run.blocks[n]
    factors, limits = (block.get(key, []) for key in
                       ("safety_factor", "limit_equilibrium"))
    worst = least(factors, limits)
    limit = (of_stage(limits, worst["stage"]) if worst else
             least_limit(limits))
    exposed = block.get("exposed_stage")
    row = {"block": n, "exposed": exposed is not None,
           "since": None if exposed is None else run.stage_name(exposed),
           "volume": block.get("exact_volume", block.get("volume")),
           "is_exact": "exact_volume" in block,
           "weight": block.get("exact_weight", block.get("weight")),
           "width": block.get("width"),
           "cells_across": block.get("cells_across"),
           "faces": block.get("exact_joint_areas",
                              block.get("joint_areas", {})),
           "mode": (worst or {}).get("failure_mode") or None,
           "limit": limit, "factor": worst,
           "passed": passed_factor(run, block),
           "stress_ratio": (of_stage(block.get("stress_ratio"),
                                     worst["stage"]) if worst else
                            None) or {},
           "group": (worst or {}).get("group"),
           "demand": largest_demand(limits),
           "tried_demand": largest_demand(factors, tried_demand_of),
           "clamped": is_held_by_clamping(worst, limit),
           "held_by": next((what for what in (
               held_by(f, of_stage(limits, f.get("stage"))) for f in factors)
               if what is not None), None),
           "removed": block.get("removed_in_stage"),
           "moved_off": moved_off.get(n), "moving": moving.get(n),
           "removable": block.get("removable"),
           "centroid": block.get("centroid"),
           "displacement": None}
    row["where"], row["free_area"] = exposure_of(run, geometry, n, exposed)
    row["state"] = state_of(row, row["moving"] in run.stages[-1:])
    if geometry is not None:
        moved = [d for d, state in zip(geometry.displacement(n), run.states)
                 if d is not None and state[1] >= 0 and run.takes_steps()]
        row["displacement"] = max(moved, default=None)
    return row


def danger(row):
    """Sorting key: exposed first, then those that failed, then by factor.

    One that still moves, or fails once others have gone, is less dangerous
    than one with a factor below 1."""
    size = (-1. if row["removed"] or row["moved_off"] else
            size_of(row["factor"]) if row["factor"] else
            1. if row["state"] == "follows" else
            row["passed"] or last_factor(row["limit"]))
    if row["state"] == "moves":
        size = min(size, 1.)
    return not row["exposed"], size, -(row["volume"] or 0.), row["block"]


def block_rows(run, geometry):
    """Finite blocks, the most dangerous first."""
    moved_off, moving = run.moved_off(), run.moving()
    return sorted((row_of(run, geometry, n, moved_off, moving)
                   for n in run.finite_blocks()), key=danger)


def as_csv(names, rows):
    """The text of a CSV file."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([["" if value is None else value for value in row]
                      for row in rows])
    return text.getvalue()


def bolts_csv(run):
    """bolts.csv: bolts at the end of the run, as they are numbered in VTU."""
    bolts = run.summary["bolts"]
    axes = "xyz"[:len(bolts[0]["head"])]
    names = (["bolt", "set"] + [f"head {a} (m)" for a in axes]
             + [f"end {a} (m)" for a in axes]
             + ["largest axial force (N)", "place of largest (m)",
                "plate force (N)", "largest bond slip (m)", "dowel force (N)",
                "joints crossed", "broken", "cut length (m)", "governed by"])
    return as_csv(names, [
        [n, b["set"], *b["head"], *b["end"], b["largest_axial_force"],
         b["place_of_largest"], b["plate_force"], b["largest_bond_slip"],
         b["dowel_force"], b["joints_crossed"],
         "yes" if b["is_broken"] else "no", b["cut_length"],
         b.get("governed_by")]
        for n, b in enumerate(bolts, 1)])


STAGE_COLUMNS = {
    "name": "stage", "steps": "steps", "time_step": "time step (s)",
    "converged": "converged", "unbalanced_ratio": "unbalanced ratio",
    "largest_nodal_ratio": "largest nodal ratio",
    "max_displacement": "largest displacement (m)", "cells": "cells",
    "plastic_cells": "plastic cells", "open_points": "open points",
    "sliding_points": "sliding points", "sticking_points": "sticking points",
    "contacts_through_rock": "contacts through rock",
    "largest_overlap": "largest overlap (m)", "remark": "remark"}


def stages_csv(run):
    """stages.csv: a line for each stage; empty what no step has computed."""
    def known(stage):
        return stage if run.takes_steps() else {
            key: stage.get(key) for key in ("name", "steps", "cells", "remark")}

    return as_csv(
        [*STAGE_COLUMNS.values(), "energy residual (J)",
         "relative energy residual"],
        [[stage.get(key) for key in STAGE_COLUMNS]
         + [stage.get("energy", {}).get(key) for key in
            ("residual", "relative_residual")]
         for stage in map(known, run.summary["stages"])])


def few(names, most=6):
    """The first names of a list, and how many more there are."""
    return ", ".join(names[:most]) + (
        f" and {len(names) - most} more" if len(names) > most else "")


def per_metre(run):
    """What follows amounts of plane scenes."""
    return " per m" if run.is_plane else ""


def warnings_of(run):
    """What the files of the run say that its user should know.

    First the warnings of the run as the screen had them."""
    summary = run.summary
    found = [str(warning) for warning in summary.get("warnings") or []]
    for liner in summary.get("shotcrete") or []:
        if liner.get("exceeded_area") and not any(
                f"liner {liner['name']} are beyond" in text for text in found):
            found.append(
                f"Thrust and moment of liner {liner['name']} are beyond its "
                f"strength on {number(liner['exceeded_area'])} of "
                f"{number(liner.get('area'))} m²{per_metre(run)}, its factor "
                f"is {number(liner.get('safety_factor'))}.")
        if liner.get("sheared_length"):
            found.append(f"Shotcrete {liner['name']} is sheared through on "
                         f"{number(liner['sheared_length'])} m"
                         f"{per_metre(run)} of joints.")
    for stage in summary["stages"]:
        if stage.get("converged") is False:
            found.append(f"Stage {stage['name']} did not converge: its "
                         "unbalanced ratio is "
                         f"{number(stage.get('unbalanced_ratio'))}.")
    mesh = summary.get("mesh", {})
    if mesh.get("merged_areas"):
        shared = sorted(mesh["merged_areas"].items(), key=lambda m: -m[1])
        found.append("Joints share faces, which the weaker rules: "
                     + few([f"{names} ({number(area)} "
                            f"{'m' if run.is_plane else 'm²'})"
                            for names, area in shared]) + ".")
    gaps = summary.get("between_planes", {}).get("gaps", [])
    if gaps:
        found.append("Joints that end just before another: "
                     + few([f"{gap['joint']} before {gap['before']} "
                            f"({number(gap['width'])} m)" for gap in gaps]) + ".")
    undecided = [n for n in run.finite_blocks() if any(
        r.get("outcome") == "undecided" or "undecided_upper" in r
        for r in run.blocks[n].get("safety_factor", []))]
    if undecided:
        found.append("Trials of blocks neither came to rest nor failed: "
                     + few(list(map(str, undecided)), 20) + ".")
    if summary.get("not_finite"):
        found.append("Numbers that are not finite: "
                     + few(summary["not_finite"]) + ".")
    wanted = (run.numbers("Mesh/Cells across blocks") or [0.])[0]
    coarse = [n for n in run.finite_blocks()
              if "exposed_stage" in run.blocks[n]
              and run.blocks[n].get("cells_across", wanted) < wanted]
    if coarse:
        found.append(f"Fewer than the {wanted:g} cells that Mesh/Cells across "
                     "blocks asks for across exposed blocks: " + few(list(map(str, coarse)), 20) + ".")
    return found
