# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units of the entries of a scene, and scenes in other units.

The unit of an entry is what the list of entries (doc/parameters.md, or
`keyblock --print-parameters`) says in brackets, as powers of metre, kilogram and
second."""
import re

from scene_formula import components_of, coordinates_from, substitute, times

# powers of metre, kilogram, second
BASE = {"m": (1, 0, 0), "kg": (0, 1, 0), "s": (0, 0, 1), "Hz": (0, 0, -1),
        "N": (1, 1, -2), "Pa": (-1, 1, -2), "-": (0, 0, 0), "deg": (0, 0, 0),
        "1": (0, 0, 0), "GB": (0, 0, 0)}

# entries of several units, which no scale changes
CHOICES = {"Supports/NAME/History file", "Supports/NAME/History quantity"}

# what their own text does not say
NOT_FORMULAS = {"Excavations/NAME/Shape"}
LIKE_OTHERS = {"Stages/NAME/Water level": "Water/Level"}


class Entry:
    """What the list of entries says of one of them: its text, whether it is a
    formula, and its unit as powers of metre, kilogram and second (None: none)."""

    def __init__(self, path, text):
        self.text = text
        self.is_formula = (path not in NOT_FORMULAS and
                           re.search(r"\b[Ff]ormulas?\b", text) is not None)
        self.unit = None if path in CHOICES else unit_of(text)


def powers_of(unit):
    """The powers of metre, kilogram and second of, for instance, N/m3; None if
    this is no unit."""
    powers = [0, 0, 0]
    for i, part in enumerate(unit.split("/")):
        found = re.fullmatch(r"(m|kg|s|Hz|N|Pa|-|deg|1)(\d?)", part.strip())
        if not found:
            return None
        exponent = int(found.group(2) or 1) * (1 if i == 0 else -1)
        for k, power in enumerate(BASE[found.group(1)]):
            powers[k] += exponent * power
    return tuple(powers)


def unit_of(text):
    """The unit in a description: the first one in brackets; None: none."""
    for words in re.findall(r"\[([^\[\]]+)\]", text):
        powers = powers_of(words)
        if powers is not None:
            return powers
    return None


def read_entries(listing):
    """Entries by their path, with NAME for names, of the list of entries."""
    entries, folder, comment = {}, [], []
    for line in listing.splitlines():
        line = line.strip()
        if line.startswith("#"):
            comment.append(line.lstrip("# "))
        elif line.startswith("subsection "):
            folder.append(line[len("subsection "):])
            comment = []
        elif line == "end":
            folder.pop()
        elif line.startswith("set "):
            name = line[4:].split("=", 1)[0].strip()
            path = "/".join(folder + [name])
            entries[path] = Entry(path, " ".join(comment))
            comment = []
        elif not line:
            comment = []
    for path, other in LIKE_OTHERS.items():
        entries[path] = entries[other]
    return entries


def pattern_of(path, entries):
    """The path with NAME in place of the name; None if the list lacks it."""
    parts = path.split("/")
    for candidate in (path, "/".join([parts[0], "NAME", parts[-1]])):
        if candidate in entries:
            return candidate
    return None


def scaled_number(text, factor, words):
    """A number times a factor; values with a meaning of their own stay."""
    value = float(text)
    if value == -1. and re.search(r"(?<![\w.])-1:", words):
        return text.strip()
    if abs(value) >= 1e300:
        return text.strip()
    return repr(value * factor)


def scaled_list(text, factor, words):
    """Numbers or points, separated by commas and semicolons."""
    return "; ".join(", ".join(scaled_number(number, factor, words)
                               for number in part.split(",") if number.strip())
                     for part in text.split(";") if part.strip())


def scaled_formula(text, factor, length, time, dim):
    """A formula of places and times in the old units, of those in the new."""
    if text.strip() in ("", "none"):
        return text
    places = {}
    if length != 1.:
        rows = [[1. / length if i == j else 0. for j in range(dim)]
                for i in range(dim)]
        places = coordinates_from(rows, [0.] * dim, "xyz"[:dim])
    if time != 1.:
        places["t"] = times(1. / time, "t")
    return "; ".join(times(factor, substitute(part, places))
                     for part in components_of(text))


def is_region_of_words(text):
    """Whether a region is no formula: all, `id N` or `band A B`."""
    return text == "all" or text.startswith(("id ", "band "))


def factor_of_lengths(ratio):
    """Factors of units if lengths grow by a ratio, gravity and densities not:
    times grow by its root, and masses by its cube."""
    return lambda powers: ratio**(powers[0] + 3 * powers[1] + powers[2] / 2)


def factor_of_masses(ratio):
    """Factors of units if densities, strengths, moduli and stresses grow by a
    ratio."""
    return lambda powers: float(ratio)**powers[1]


def scale(tree, entries, factor_of):
    """The tree with all numbers multiplied by the factors of their units.

    `factor_of` gives the factor for powers of metre, kilogram and second;
    formulas are rewritten, in places and times, too."""
    dim = int(tree.get("Dimension"))
    length, time = factor_of((1, 0, 0)), factor_of((0, 0, 1))
    result = tree.copy()
    for path, value in tree.items():
        pattern = pattern_of(path, entries)
        if pattern is None or not value.strip():
            continue
        entry = entries[pattern]
        factor = factor_of(entry.unit or (0, 0, 0))
        if entry.is_formula and not is_region_of_words(value):
            result.set(path, scaled_formula(value, factor, length, time, dim))
        elif entry.unit and factor != 1.:
            result.set(path, scaled_list(value, factor, entry.text))
    return result
