# SPDX-License-Identifier: LGPL-2.1-or-later
"""Formulas of x, y, z and t in scene files: substitution and values."""
import math
import re

from scene_tree import text_of_number

# a variable: no part of a longer name, of a number or the name of a function
VARIABLE = re.compile(r"(?<![\w.])([xyzt])(?![\w.(])")


def substitute(formula, replacements):
    """The formula with each variable replaced by a text in parentheses.

    `replacements`: texts by the name of the variable; others stay."""
    return VARIABLE.sub(
        lambda found: (f"({replacements[found.group(1)]})"
                       if found.group(1) in replacements else found.group()),
        formula)


def components_of(formula):
    """The components, which semicolons separate."""
    return [part.strip() for part in formula.split(";")]


def times(factor, formula):
    """The product of a number and a formula, as short as possible."""
    if factor == 0. or is_zero(formula):
        return "0"
    if factor == 1.:
        return formula
    return f"{text_of_number(factor)}*({formula})"


def is_zero(formula):
    """Whether a formula is the number 0."""
    try:
        return float(formula) == 0.
    except ValueError:
        return False


def sum_of(terms):
    """The sum of formulas; zeros are left out."""
    kept = [term for term in terms if not is_zero(term)]
    return "+".join(f"({term})" for term in kept) if len(kept) > 1 else (
        kept[0] if kept else "0")


def combination(factors, formulas):
    """The sum of factors times formulas."""
    return sum_of([times(f, g) for f, g in zip(factors, formulas)])


def coordinates_from(rows, offsets, names="xyz"):
    """Texts of the coordinates `rows * x + offsets`, by the variable's name.

    `rows`: one row of factors for each coordinate."""
    texts = {}
    for name, row, offset in zip(names, rows, offsets):
        terms = [times(factor, variable)
                 for factor, variable in zip(row, names)]
        texts[name] = sum_of(terms + [text_of_number(offset)])
    return texts


class Formula:
    """A formula that can be evaluated: arithmetic, comparisons, `if`, `&&`,
    `||` and the usual functions."""

    NAMES = {"abs": abs, "min": min, "max": max, "pi": math.pi,
             "_if": lambda condition, a, b: a if condition else b,
             **{name: getattr(math, name) for name in
                ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh",
                 "cosh", "tanh", "sqrt", "exp", "log", "log2", "log10", "pow",
                 "floor", "ceil")}}

    def __init__(self, text):
        text = text.replace("&&", " and ").replace("||", " or ")
        text = text.replace("^", "**")
        text = re.sub(r"\bif\s*\(", "_if(", text)
        words = set(re.findall(r"(?<![\w.])[A-Za-z_]\w*", text))
        unknown = words - set(self.NAMES) - set("xyzt") - {"and", "or"}
        if unknown:
            raise ValueError(f"the formula has unknown words: {sorted(unknown)}")
        self.code = compile(text.strip(), "<formula>", "eval")

    def at(self, point, time=0.):
        """The value at a point of two or three coordinates."""
        place = dict(zip("xyz", point), t=time)
        return float(eval(self.code, {"__builtins__": {}}, {**self.NAMES, **place}))
