# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers, modes of failure and demands for support as people say them."""
import math


def number(value, digits=4):
    """A number as people read it, or a dash."""
    if value is None:
        return "–"
    if math.isinf(value):
        return "∞"
    if value and not 1e-4 <= abs(value) < 1e6:
        return f"{value:.3g}"
    text = f"{value:.{digits}g}"
    return f"{float(text):g}" if "e" in text else text


def count(n, name):
    """How many there are of something: 1 block, 2 blocks."""
    return f"{n} {name}{'' if n == 1 else 's'}"


def mode_in_words(mode):
    """How a block fails, as people say it: falling, sliding on J1 and J2."""
    if not mode:
        return None
    verb, on, names = mode.partition(" on ")
    if not on:
        return mode
    joints = names.split("/")
    if "a free face" in joints:  # it has left a joint and leans on an edge
        joints = [name for name in joints if name != "a free face"]
        joints.append("an edge of a free face")
    return f"{verb} on " + (" and ".join([", ".join(joints[:-1]), joints[-1]])
                            if len(joints) > 1 else joints[0])


def demand_of(limit):
    """Support that a wanted factor asks for, in N and Pa; or None.

    Without force where no pressure is enough."""
    demand = (limit or {}).get("support_demand") or {}
    return demand if demand.get("outcome") in ("support",
                                               "out of reach") else None


def bolts_in_words(demand, is_plane):
    """How many bolts of each set; in 2D in each ring along the tunnel."""
    for name, n in demand.get("bolts", {}).items():
        yield (f"{n} bolt{'s' if n != 1 else ''} of set '{name}'"
               + (" in each ring" if is_plane else ""))


def tried_demand_of(factor):
    """Support that a wanted factor asks for by trials; or None."""
    demand = (factor or {}).get("support_demand") or {}
    return demand if demand.get("outcome") not in (None, "met") else None


def tried_demand_in_words(demand, is_plane):
    """The same as people say it."""
    if not demand:
        return None
    after = f" after {demand['stage']}" if demand.get("stage") else ""
    wanted = f"{number(demand['factor'])}{after}"
    if demand["outcome"] == "out of reach":
        return f"no pressure is enough for {wanted} by trials"
    if demand["outcome"] == "undecided":
        return f"undecided by trials for {wanted}"
    ends = ", ".join(number(1e-3 * demand.get(end, 0.))
                     for end in ("lower", "upper"))
    return " or ".join([
        f"{number(1e-3 * demand['force'])} kN{'/m' if is_plane else ''}, "
        f"{number(1e-3 * demand['pressure'])} [{ends}] kPa by trials",
        *bolts_in_words(demand, is_plane)]) + f" for {wanted}"


def support_in_words(row, is_plane):
    """What a row of the table needs, by limit equilibrium and by trials."""
    return "; ".join(text for text in (
        demand_in_words(row["demand"], is_plane),
        tried_demand_in_words(row["tried_demand"], is_plane)) if text)


def demand_in_words(demand, is_plane):
    """Support that is asked for, as people say it."""
    if not demand:
        return None
    after = f" after {demand['stage']}" if demand.get("stage") else ""
    if "force" not in demand:
        return " but ".join([
            f"no pressure is enough for {number(demand['factor'])}{after}",
            *bolts_in_words(demand, is_plane)])
    return " or ".join([
        f"{number(1e-3 * demand['force'])} kN{'/m' if is_plane else ''}, "
        f"{number(1e-3 * demand['pressure'])} kPa",
        *bolts_in_words(demand, is_plane)]) + (
            f" for {number(demand['factor'])}{after}")
