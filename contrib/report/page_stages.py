# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sections of the page on stages, joints and energies."""
from .html import escape, facts
from .words import number


def stage_facts(stage):
    """How a stage went, as names and values."""
    energy = stage.get("energy", {})
    ended = stage.get("ended", "")
    if "converged" in stage:
        ended = "converged" if stage["converged"] else "did not converge"
    return facts([
        ("ended", ended), ("steps", stage.get("steps")),
        ("unbalanced ratio", number(stage["unbalanced_ratio"], 3)
         if "unbalanced_ratio" in stage else None),
        ("largest displacement", f"{number(1e3 * stage['max_displacement'])}"
         " mm" if "max_displacement" in stage else None),
        ("energy residual", f"{number(energy['residual'], 3)} J, relative "
         f"{number(energy.get('relative_residual'), 3)}"
         if "residual" in energy else None),
        ("cells", stage.get("cells")),
        ("plastic cells", stage.get("plastic_cells") or None),
        ("joint points", ", ".join(
            f"{stage[f'{kind}_points']} {kind}" for kind in
            ("open", "sliding", "sticking") if f"{kind}_points" in stage)),
        ("largest overlap", f"{number(1e3 * stage['largest_overlap'], 3)} mm"
         if stage.get("largest_overlap") else None),
        ("remark", escape(stage["remark"]) if stage.get("remark") else None)]
    ).replace(' class="facts"', "")


def facts_of_statics(stage):
    """The same where no step was taken."""
    return facts([
        ("steps", "none, blocks are judged by limit equilibrium"),
        ("cells", stage.get("cells")),
        ("remark", escape(stage["remark"]) if stage.get("remark") else None)]
    ).replace(' class="facts"', "")


def legend_of(marks):
    """The legend of the stages' pictures."""
    lines = []
    for colour, kind, text in marks:
        style = {"area": f"background:{colour}",
                 "line": f"border-top:3px solid {colour}",
                 "dashes": f"border-top:2px dashed {colour}"}.get(kind, "")
        mark = f'<i class="{kind}" style="{style}"></i>' if kind else ""
        lines.append(f"<span>{mark}{escape(text)}</span>")
    return f'<div class="legend">{"".join(lines)}</div>' if lines else ""


def stages_section(run, pictures, marks, why, files):
    """Stage by stage: picture, convergence, displacement, remarks."""
    text = ["<h2 id=stages>Stage by stage</h2>",
            f"<p class=faint>As a table: {files}."
            + (f" {escape(why)}" if why else "") + "</p>", legend_of(marks)]
    drawn = {index: rest for index, *rest in pictures}
    for index in [-1, *range(len(run.stages))]:
        picture = drawn.get(index)
        if index < 0:
            if not picture:
                continue
            title, side = "Before the first stage", ""
        else:
            stage = run.summary["stages"][index]
            title, side = stage["name"], (
                stage_facts if run.takes_steps() else facts_of_statics)(stage)
        image = ""
        if picture:
            name, address, factor = picture
            times = ("" if factor == 1. else
                     f"; displacements drawn {factor:g} times as large")
            image = (f'<figure><img loading="lazy" src="{address}" '
                     f'alt="{escape(title)}"><figcaption>{escape(title)}'
                     f"{times}</figcaption></figure>")
        elif not why:
            image = "<p class=faint>No state was written for this stage.</p>"
        text.append(f'<section class="stage"><div>{image}</div><div><h3>'
                    f"{escape(title)}</h3>{side}</div></section>")
    return "\n".join(text)


def joints_section(run, figure, pyramids=None, caption=""):
    """Orientations of the joints, and which pyramids of them are removable."""
    if not run.joints:
        return ("<h2 id=joints>Joints</h2><p>There is no table of joints "
                "(joints.csv).</p>")
    names, group = run.joint_groups()
    text = [f"<h2 id=joints>{len(run.joints)} joint"
            f"{'s' if len(run.joints) != 1 else ''}</h2>"]
    if figure:
        text.append(f"<figure>{figure}</figure>")
    elif figure == "":
        text.append("<p>joints.csv has no orientations that can be drawn.</p>")
    keys = ("friction angle", "cohesion", "tensile strength")
    lines = []
    for k, name in enumerate(names):
        mine = [row for row, g in zip(run.joints, group) if g == k]
        cells = [name, len(mine)]
        for key in keys:
            values = list(dict.fromkeys(row.get(key, "") for row in mine))
            cells.append(values[0] if len(values) == 1 else "various")
        lines.append("<tr>" + "".join(f"<td>{escape(c)}</td>" for c in cells)
                     + "</tr>")
    text.append('<div class="wide"><table><thead><tr><th>joints</th><th>number'
                "</th><th>friction angle [°]</th><th>cohesion [Pa]</th><th>"
                "tensile strength [Pa]</th></tr></thead><tbody>"
                + "".join(lines) + "</tbody></table></div>")
    if pyramids:
        text.append(f"<figure>{pyramids}<figcaption>{escape(caption)}"
                    "</figcaption></figure>")
    elif caption:
        text.append(f"<p>{escape(caption)}</p>")
    return "\n".join(text)


def energy_section(run, figure):
    """The ledger over time, and what it left."""
    if not run.takes_steps():
        return ""
    energy = run.summary.get("energy", {})
    text = ["<h2 id=energy>Energy ledger</h2>"]
    if figure:
        text.append(f"<figure>{figure}</figure><p class=faint>The ledger "
                    "begins anew with each stage, and when a block is taken "
                    "away; of elastic energy the change since the stage's "
                    "first row is drawn. Terms below 1/10000 of the largest "
                    "are left out.</p>")
    elif not run.history:
        text.append("<p>There is no history.csv, or it is damaged.</p>")
    if "residual" in energy:
        text.append("<p>Residual of the last stage: "
                    f"{number(energy['residual'], 3)} J, relative "
                    f"{number(energy.get('relative_residual'), 3)}.</p>")
    return "\n".join(text)
