# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scene files as data: sections with entries, read from and written to .prm."""
import copy
import re
from pathlib import Path


class SceneError(Exception):
    """A scene file that cannot be read; the message names file and line."""


class Section:
    """Entries and subsections by name, in the order of the file."""

    def __init__(self):
        self.entries = {}
        self.sections = {}

    def find(self, path):
        """The subsection at `path`, for instance `Joints/A`; None if it does
        not exist. The empty path is the section itself."""
        section = self
        for name in path.split("/") if path else []:
            section = section.sections.get(name)
            if section is None:
                return None
        return section

    def make(self, path):
        """The subsection at `path`, added if it does not exist."""
        section = self
        for name in path.split("/") if path else []:
            section = section.sections.setdefault(name, Section())
        return section

    def get(self, path, default=""):
        """The value of the entry at `path`, for instance `Mesh/Size`."""
        folder, _, name = path.rpartition("/")
        section = self.find(folder)
        return default if section is None else section.entries.get(name, default)

    def set(self, path, value):
        """Give the entry at `path` a value (text, a number or a list of
        numbers)."""
        folder, _, name = path.rpartition("/")
        self.make(folder).entries[name] = (
            value if isinstance(value, str) else
            text_of_list(value) if isinstance(value, (list, tuple)) else
            text_of_number(value))

    def remove(self, path):
        """Take the entry at `path` out, if it is there."""
        folder, _, name = path.rpartition("/")
        section = self.find(folder)
        if section is not None:
            section.entries.pop(name, None)

    def names(self, title):
        """The names that the entry `Names` of the section `title` lists."""
        return list_of_names(self.get(f"{title}/Names"))

    def add(self, title, name, entries):
        """List one more name in the section `title`, with these entries."""
        self.set(f"{title}/Names", ", ".join(self.names(title) + [name]))
        for entry, value in entries.items():
            self.set(f"{title}/{name}/{entry}", value)

    def items(self, prefix=""):
        """All (path, value) of this section and those below it."""
        for name, value in self.entries.items():
            yield prefix + name, value
        for name, section in self.sections.items():
            yield from section.items(f"{prefix}{name}/")

    def copy(self):
        """A deep copy."""
        return copy.deepcopy(self)


def text_of_number(value):
    """A number so that it reads back as the same number."""
    return str(value) if isinstance(value, int) else repr(float(value))


def text_of_list(values):
    """Numbers separated by commas."""
    return ", ".join(text_of_number(v) for v in values)


def text_of_points(points):
    """Points separated by semicolons."""
    return "; ".join(text_of_list(p) for p in points)


def list_of_names(text):
    """The names of a list that is separated by commas."""
    return [name.strip() for name in text.split(",") if name.strip()]


def numbers_of(text):
    """The numbers of a list that is separated by commas."""
    return [float(part) for part in text.split(",") if part.strip()]


def points_of(text):
    """The points of `x, y; x, y; ...`."""
    return [numbers_of(part) for part in text.split(";") if part.strip()]


def joined_lines(text):
    """(number, line) with continued lines joined and without comments: a line
    that ends in a backslash goes on in the next one."""
    kept, first = "", 0
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.split("#", 1)[0].strip()
        first = first if kept else number
        if line.endswith("\\"):
            kept += line[:-1].rstrip() + " "
            continue
        yield first, re.sub(r"\s+", " ", kept + line).strip()
        kept = ""
    if kept.strip():
        yield first, kept.strip()


def read_into(root, file, chain):
    """Add the entries of a file to the tree; `chain` is what included it."""
    if file.resolve() in chain:
        raise SceneError(f"'{file}' includes itself; remove that 'include'.")
    stack = [root]
    text = file.read_text(encoding="utf-8-sig").replace("\r\n", "\n")
    for number, line in joined_lines(text.replace("\r", "\n")):
        word, _, rest = line.partition(" ")
        word, rest = word.lower(), rest.strip()
        if not line:
            continue
        if word == "include":
            beside = file.parent / rest
            read_into(root, beside if beside.exists() else Path(rest),
                      chain + [file.resolve()])
        elif word == "subsection":
            stack.append(stack[-1].make(rest))
        elif word == "end" and len(stack) > 1:
            stack.pop()
        elif word == "set" and "=" in rest:
            name, _, value = rest.partition("=")
            stack[-1].entries[name.strip()] = value.strip()
        else:
            raise SceneError(f"'{file}', line {number}: '{line}' is neither "
                             "'set', 'subsection', 'end' nor 'include'.")
    if len(stack) > 1:
        raise SceneError(f"'{file}': {len(stack) - 1} subsections have no 'end'.")


def read_scene(file):
    """The tree of a scene file, with all files that it includes."""
    root = Section()
    read_into(root, Path(file), [])
    return root


def scene_text(section, indent=0):
    """The tree as the text of a scene file."""
    blank = "  " * indent
    lines = [f"{blank}set {name} = {value}\n"
             for name, value in section.entries.items()]
    for name, inner in section.sections.items():
        lines += [f"{blank}subsection {name}\n", scene_text(inner, indent + 1),
                  f"{blank}end\n"]
    return "".join(lines)
