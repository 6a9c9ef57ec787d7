# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small pieces of HTML that all sections of the page share."""
import base64
import html
import pathlib

from .words import number

FOLDER = pathlib.Path(__file__).resolve().parent


def escape(text):
    """Text for HTML."""
    return html.escape(str(text))


def source(name):
    """A file beside this module."""
    return (FOLDER / name).read_text(encoding="utf-8")


def facts(pairs):
    """A list of names and values, without those that are not known."""
    return '<dl class="facts">' + "".join(
        f"<dt>{escape(name)}</dt><dd>{value}</dd>" for name, value in pairs
        if value not in (None, "")) + "</dl>"


def seconds(value):
    """A time in words."""
    if value is None:
        return None
    if value < 100.:
        return f"{value:.3g} s"
    if value < 6000.:
        return f"{value / 60.:.3g} min"
    return f"{value / 3600.:.3g} h"


def clamped_text(value):
    """Yes, no, or a dash."""
    return {True: "yes", False: "no", None: "–"}[value]


def group_text(group):
    """Factor of the blocks that move together."""
    if not group:
        return "–"
    blocks = "+".join(map(str, group["blocks"]))
    return (f"{number(group.get('value'))} [{number(group.get('lower'))}, "
            f"{number(group.get('upper'))}] ({blocks})")


def download(name, text):
    """A link to a table that the page carries."""
    data = base64.b64encode(text.encode()).decode()
    return (f'<a download="{name}" href="data:text/csv;base64,{data}">'
            f"{name}</a>")
