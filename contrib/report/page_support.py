# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sections on bolts and shotcrete: each set and liner, what carries most."""
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


class Bad(str):
    """The text of a cell that is to be red."""


def cell(value):
    """A cell of a table: text, or a number."""
    text = value if isinstance(value, str) else number(value)
    kind = (" class=bad" if isinstance(value, Bad) else
            "" if isinstance(value, str) else " class=n")
    return f"<td{kind}>{escape(text)}</td>"


def table(titles, rows):
    """An HTML table."""
    return ('<div class="wide"><table><thead><tr>'
            + "".join(f"<th>{escape(t)}</th>" for t in titles)
            + "</tr></thead><tbody>"
            + "".join("<tr>" + "".join(map(cell, row)) + "</tr>"
                      for row in rows)
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


def red_if(is_bad, value):
    """A value, as text in red if it is bad."""
    return Bad(number(value)) if is_bad else value


def in_thousands(liner, key):
    """A force of a liner in kN, or None."""
    return None if liner.get(key) is None else 1e-3 * liner[key]


def structural_row(liner):
    """What a liner that carries thrust and bends bears."""
    factor, beyond = liner.get("safety_factor"), liner.get("exceeded_area", 0.)
    return [liner["name"], in_thousands(liner, "largest_compression"),
            in_thousands(liner, "largest_tension"),
            in_thousands(liner, "largest_moment"),
            in_thousands(liner, "largest_shear_force"),
            red_if(factor is not None and factor < 1., factor),
            liner.get("governed_by", "–"),
            place(liner.get("place_of_least_factor", [])) or "–",
            red_if(beyond > 0., beyond)]


def shotcrete_section(run):
    """Shotcrete and structural liners at the end of the run, if any."""
    liners = run.summary.get("shotcrete")
    if not liners:
        return ""
    per = " per m" if run.is_plane else ""
    rows = [[liner["name"], liner.get("stage", "–"), liner.get("area"),
             liner.get("trace_length"), in_thousands(
                 liner, "shear_resistance"),
             red_if(liner.get("sheared_length", 0.) > 0.,
                    liner.get("largest_load_ratio")),
             red_if(liner.get("sheared_length", 0.) > 0.,
                    liner.get("sheared_length"))] for liner in liners]
    text = ["<h2 id=shotcrete>Shotcrete and liners</h2><p class=faint>At the "
            "end of the run; what is beyond strength is red.</p>",
            table(["name", "stage", f"area [m²{per}]",
                   f"length of joints below [m{per}]",
                   f"resistance to shear over them [kN{per}]",
                   "largest share of it", f"sheared through [m{per}]"], rows)]
    structural = [liner for liner in liners if "largest_moment" in liner]
    if structural:
        text.append(
            "<p>Thrust and moment of those that carry thrust and bend:</p>"
            + table(["name", "largest compression [kN/m]",
                     "largest tension [kN/m]", "largest moment [kN m/m]",
                     "largest shear force [kN/m]", "least factor of safety",
                     "governed by", "at [m]", f"beyond strength [m²{per}]"],
                    [structural_row(liner) for liner in structural])
            + "<p class=faint>A liner is computed as elastic: beyond its "
            "strength it holds more than it can.</p>")
    return "\n".join(text)
