# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section on bolts: each set, and those that carry most."""
import collections

from .html import escape
from .words import number

N_SHOWN = 40


def of_sets(bolts):
    """Bolts by set, in the order of the scene."""
    sets = collections.defaultdict(list)
    for n, bolt in enumerate(bolts, 1):
        sets[bolt["set"]].append((n, bolt))
    return sets


def governed(bolts):
    """What governs bolts that cross joints of blocks, with how many."""
    counts = collections.Counter(bolt.get("governed_by") for _, bolt in bolts)
    counts.pop(None, None)
    return ", ".join(f"{name} {n}" for name, n in counts.most_common()) or "–"


def place(point):
    """A point in metres."""
    return ", ".join(number(x) for x in point)


def table(titles, rows):
    """An HTML table."""
    return ('<div class="wide"><table><thead><tr>'
            + "".join(f"<th>{escape(t)}</th>" for t in titles)
            + "</tr></thead><tbody>"
            + "".join("<tr>" + "".join(
                f"<td{'' if isinstance(c, str) else ' class=n'}>"
                f"{escape(c if isinstance(c, str) else number(c))}</td>"
                for c in row) + "</tr>" for row in rows)
            + "</tbody></table></div>")


def bolts_section(run, files):
    """Bolts at the end of the run; nothing without any."""
    bolts = run.summary.get("bolts")
    if not bolts:
        return ""
    rows = []
    for name, members in of_sets(bolts).items():
        n, most = max(members, key=lambda m: m[1]["largest_axial_force"])
        rows.append([name, len(members),
                     sum(b["joints_crossed"] > 0 for _, b in members),
                     1e-3 * most["largest_axial_force"], str(n),
                     1e-3 * max(b["plate_force"] for _, b in members),
                     1e-3 * max(b["dowel_force"] for _, b in members),
                     1e3 * max(b["largest_bond_slip"] for _, b in members),
                     sum(b["is_broken"] for _, b in members),
                     sum(b["cut_length"] > 0 for _, b in members),
                     governed(members)])
    text = [f"<h2 id=bolts>{len(bolts)} bolt{'s' if len(bolts) > 1 else ''}"
            f"</h2><p class=faint>At the end of the run; as a table: {files}. "
            "Forces are those of one bolt. What governs a bolt limits its "
            "tension where it crosses a joint of a block. What a wanted factor "
            "asks for stands below the table of blocks.</p>",
            table(["set", "bolts", "cross joints", "largest axial force [kN]",
                   "of bolt", "largest plate force [kN]",
                   "largest dowel force [kN]", "largest bond slip [mm]",
                   "broken", "cut by later stages", "governed by"], rows)]
    loaded = sorted(enumerate(bolts, 1),
                    key=lambda m: -m[1]["largest_axial_force"])[:N_SHOWN]
    text.append(
        f"<details><summary>The {len(loaded)} that carry most</summary>"
        + table(["bolt", "set", "head [m]", "axial force [kN]",
                 "at, from the head [m]", "bond slip [mm]", "governed by"],
                [[str(n), b["set"], place(b["head"]),
                  1e-3 * b["largest_axial_force"], b["place_of_largest"],
                  1e3 * b["largest_bond_slip"],
                  "broken" if b["is_broken"] else b.get("governed_by", "–")]
                 for n, b in loaded]) + "</details>")
    return "\n".join(text)
