# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of the page on blocks and their factors."""
import math

from .html import clamped_text, escape, group_text
from .statics import (follows_others, limit_in_words, mode_by_statics,
                      own_factor, statics_in_words)
from .tables import STATES, few, in_words, is_held_by_clamping, of_stage
from .words import count, mode_in_words, number, support_in_words

MOST_ROWS = 60  # rows of blocks before the rest is folded away


def block_columns(run):
    """Heading, whether it is a number, and text, of each column of blocks."""
    cubic = "m³" if not run.is_plane else "m³/m"

    def mm(value):
        return "–" if value is None else number(1e3 * value, 3)

    return [
        ("block", False, lambda r: '<span class="mark" style="background:'
         f'{STATES[r["state"]][0]}"></span>{r["block"]}'),
        ("exposed since", False, lambda r: escape(r["since"] or "hidden")),
        ("where", False, lambda r: r["where"] or "–"),
        (f"volume [{cubic}]", True, lambda r: number(r["volume"])
         + ("" if r["is_exact"] or r["volume"] is None else "*")),
        ("weight [kN]" if not run.is_plane else "weight [kN/m]", True,
         lambda r: "–" if r["weight"] is None else number(
             r["weight"] / 1e3)),
        ("cells across", True, lambda r: number(r["cells_across"], 2)),
        ("joint faces", False, lambda r: escape(few(list(r["faces"]), 8))
         or "–"),
        ("how it fails", False, lambda r: escape(
            mode_in_words(r["mode"]) or mode_by_statics(r["limit"]) or "–")),
        ("limit equilibrium", False, lambda r: escape(statics_in_words(r))),
        ("strength reduction", False, lambda r: escape(
            f"{in_words(r['factor'])} after {r['factor']['stage']}").replace(
                ", ", ",&nbsp;").replace(" [", "&nbsp;[")
         if r["factor"] else "–"),
        ("with its group", False, lambda r: escape(group_text(
            r["group"])).replace(", ", ",&nbsp;").replace(" [", "&nbsp;[")),
        ("held by clamping", False, lambda r: clamped_text(r["clamped"])),
        ("support it needs", False, lambda r: escape(support_in_words(
            r, run.is_plane) or "–")),
        ("moved [mm]", True, lambda r: mm(r["displacement"])),
        ("failed in", False, lambda r: escape(
            f"{r['removed']}, taken away" if r["removed"] else
            f"{r['moved_off']}, moved off" if r["moved_off"] else "–")),
        ("moving at the end of", False,
         lambda r: escape(r["moving"] or "–"))]


def kind_of(name, is_number):
    """The class of a cell: numbers, or sentences that need some room."""
    return (" class=n" if is_number else
            " class=broad" if name == "support it needs" else "")


def table(columns, rows, has_view, hide=()):
    """An HTML table; columns of which nothing is known are left out."""
    columns = [(name, is_number, text) for name, is_number, text in columns
               if name not in hide]
    lines = ["<thead><tr>" + "".join(
        f'<th{" class=n" if is_number else ""}>{escape(name)}</th>'
        for name, is_number, _ in columns)
        + "</tr></thead><tbody>"]
    for row in rows:
        cells = "".join(f'<td{kind_of(name, is_number)}>{text(row)}</td>'
                        for name, is_number, text in columns)
        if has_view:
            cells = cells.replace("</td>", ' <button class="show">show'
                                  "</button></td>", 1)
        lines.append(f'<tr data-block="{row["block"]}">{cells}</tr>')
    return "<table>" + "\n".join(lines) + "</tbody></table>"


def gravity_note(run):
    """That weights are with 9.81 m/s2, if the scene has another gravity."""
    gravity = math.hypot(*(run.numbers("Initial state/Gravity") or [0.]))
    if gravity and abs(gravity - 9.81) > 0.005:
        return (f"Weights are mass times 9.81 m/s², as in summary.json; the "
                f"scene's gravity is {number(gravity)} m/s².")
    return None


def by_trials_note(run, rows):
    """How the pressure by trials acts, where there is one."""
    if not any(r["tried_demand"] for r in rows):
        return ""
    convention = run.entries.get("Safety factor/Bolt convention", "active")
    return (" By trials: an active pressure, which the factor does not divide"
            + ("." if convention == "active" else
               f"; that by limit equilibrium is {convention}, as the bolts."))


def blocks_section(run, rows, has_view, files):
    """The table of blocks, with footnotes on what is not known."""
    if not rows:
        return ("<h2 id=blocks>Blocks</h2><p>The scene has no finite "
                "blocks.</p>")
    columns = block_columns(run)
    empty = [name for name, _, text in columns
             if all(text(row) in ("–", "") for row in rows)]
    shown = [r for r in rows if r["exposed"] or r["removed"] or r["moved_off"] or r[
        "moving"] or (r["factor"] and r["factor"].get("outcome") in (
            "value", "falls freely"))]
    if not shown:
        shown = rows[:MOST_ROWS]
    ids = {r["block"] for r in shown}
    rest = [r for r in rows if r["block"] not in ids]
    if any(r["factor"] or r["limit"] or r["passed"] for r in rows):
        title = "Blocks, the most dangerous first"
        order = ("Exposed ones first, then those that failed, then by the least "
                 "factor, alone or of a group, of all stages; those that still "
                 "move at the end, or fail once others have gone, as if it were "
                 "1 at most. ")
    else:
        title = "Blocks, the exposed and the largest first"
        order = ("Those that failed or still move stand before others. The run "
                 "was asked for no factors (Safety factor/Blocks), so that the "
                 "table does not say which block is dangerous; --validate "
                 "prints limit equilibrium of each. ")
    text = [f"<h2 id=blocks>{title}</h2>",
            f"<p>{order}"
            + ("Click on a row to mark the block in the view below. "
               if has_view else "")
            + f"As tables: {files}.</p>",
            '<div class="wide tall">', table(columns, shown, has_view, empty),
            "</div>"]
    if rest:
        judged = ("none of them was seen to fail by itself" if any(
            r["factor"] for r in rest) else "no factor was looked for")
        text += [f"<details><summary>{count(len(rest), 'more block')} that "
                 f"{'is' if len(rest) == 1 else 'are'} never exposed; {judged}</summary>",
                 '<div class="wide tall">',
                 table(columns, rest, has_view, empty), "</div></details>"]
    notes = []
    notes.append("Strength reduction: factor [greatest at which the block "
                 "held, least at which it failed], after the stage in which "
                 "it, or that of the blocks that move together, is least; "
                 "limit equilibrium: the rigid block without in-situ stress, "
                 "after the same stage. Held by clamping: strength reduction "
                 "holds at full strength, limit equilibrium alone is below 1, "
                 "and the run names nothing else that holds the block."
                 ) if "strength reduction" not in empty else None
    if "moved [mm]" not in empty:
        notes.append("Moved: the largest displacement in the states that were "
                     "written, at the ends of stages; of a block that was "
                     "taken away, in those before.")
    if "where" not in empty:
        notes.append("Where: roof, wall or floor by the mean outward normal "
                     "of the block's free faces, within 45° of the direction "
                     "of gravity, or of the opposite one.")
    if "support it needs" not in empty:
        notes.append("Support it needs: the least force against its free faces "
                     "with which limit equilibrium, without in-situ stress, "
                     "has the wanted factor; also as bolts of each set. Of "
                     "all stages the largest is shown."
                     + by_trials_note(run, rows))
    if "moving at the end of" not in empty:
        notes.append("Moving at the end of: the last stage that ended while "
                     "the block still moved, by its remark; it may come to "
                     "rest, where one that moved off has gone.")
    if any(not r["is_exact"] for r in rows):
        notes.append("* of the mesh, not exact.")
    if gravity_note(run):
        notes.append(gravity_note(run))
    if empty:
        notes.append("Left out, as the run has nothing on it: "
                     + ", ".join(empty) + ".")
    text.append('<ul class="notes">' + "".join(
        f"<li>{escape(note)}</li>" for note in notes if note) + "</ul>")
    text.append(remarks_of(shown))
    return "\n".join(text)


def remarks_of(rows, most=40):
    """Remarks of limit equilibrium, a line for each block."""
    lines = [f"<li>Block {r['block']}: {escape(r['limit']['remark'])}.</li>"
             for r in rows if r["limit"] and r["limit"].get("remark")]
    if not lines:
        return ""
    return ("<p class=faint>Remarks of limit equilibrium:</p>"
            f'<ul class="notes">{"".join(lines[:most])}</ul>')


def why_no_factors(run, rows):
    """A sentence on why there are no factors by strength reduction."""
    if not run.entries:
        return "There are no safety factors."
    if not run.takes_steps():
        judged = sum(bool(row["limit"] or row["passed"]) for row in rows)
        falling = sum(own_factor(row["limit"]) < 1. for row in rows)
        later = sum(follows_others(row["limit"]) for row in rows)
        if not judged:
            return ("By limit equilibrium, which alone was asked for, no block "
                    "was judged.")
        return (f"By limit equilibrium, which alone was asked for, {falling} of "
                f"{count(judged, 'block')} {'has' if 1 in (falling, judged) else 'have'} "
                "a factor below 1"
                + (f", and {later} more fail{'s' if later == 1 else ''} once "
                   "others have gone." if later else "."))
    asked = run.entries.get("Safety factor/Blocks", "none")
    if asked == "none":
        return "No safety factors were looked for (Safety factor/Blocks)."
    if not rows:
        why = "there is no finite block"
    elif not any(row["exposed"] for row in rows):
        why = "no block was exposed"
    elif asked == "critical":
        why = "no block was critical"
    else:
        why = "none of these blocks was judged"
    return ("There are no safety factors: they were asked for (Safety "
            f"factor/Blocks = {asked}), but {why}.")


def factors_section(run, rows, figure, sentence):
    """Curves of factors by stage, and all of them as a table."""
    if not any(row["factor"] for row in rows):
        return ("<h2 id=factors>Factors by stage</h2><p>"
                f"{escape(why_no_factors(run, rows))}</p>")
    text = ["<h2 id=factors>Factors by stage</h2>"]
    if figure:
        text.append(f"<figure>{figure}</figure>")
    if sentence:
        text.append(f"<p class=faint>{escape(sentence)}</p>")
    lines = []
    for row in rows:
        block = run.blocks[row["block"]]
        for found in block.get("safety_factor", []):
            limit = of_stage(block.get("limit_equilibrium"), found["stage"])
            ratio = of_stage(block.get("stress_ratio"), found["stage"]) or {}
            cells = [row["block"], found["stage"], in_words(found),
                     mode_in_words(found.get("failure_mode")) or "–", limit_in_words(limit),
                     number(ratio.get("value")),
                     group_text(found.get("group")),
                     clamped_text(is_held_by_clamping(found, limit))]
            lines.append("<tr>" + "".join(f"<td>{escape(c)}</td>"
                                          for c in cells) + "</tr>")
    names = ["block", "after", "strength reduction", "mode", "limit "
             "equilibrium", "stress ratio", "with its group",
             "held by clamping"]
    text.append(f"<details><summary>All factors ({len(lines)})</summary>"
                '<div class="wide tall"><table><thead><tr>'
                + "".join(f"<th>{n}</th>" for n in names)
                + "</tr></thead><tbody>" + "\n".join(lines)
                + "</tbody></table></div></details>")
    return "\n".join(text)
