# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of an output folder that need no library to be read."""
import xml.etree.ElementTree


def entries_of(text):
    """(path, value, what stands in its comment) of each entry of a used.prm, the
    path as in Stages/dig/Kind."""
    above = []
    for line in text.splitlines():
        before, _, comment = line.partition("#")
        words = before.split(maxsplit=1)
        if words[:1] == ["subsection"]:
            above.append(words[1].strip())
        elif words == ["end"]:
            above.pop()
        elif words[:1] == ["set"] and "=" in words[1]:
            name, value = words[1].split("=", 1)
            yield ("/".join([*above, name.strip()]), value.strip(),
                   comment.strip())


def states_of(path):
    """Time, file of the rock and file of the joints, or None, of each state in a
    solution.pvd; ValueError with a sentence if it cannot be read."""
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
        sets = [(float(s.get("timestep")), s.get("name"), s.get("file"))
                for s in root.iter("DataSet")]
    except (OSError, ValueError, TypeError,
            xml.etree.ElementTree.ParseError) as error:
        raise ValueError(f"'{path}' cannot be read: {error}.") from None
    joints = {when: name for when, kind, name in sets if kind == "interface"}
    return [(when, path.parent / name,
             path.parent / joints[when] if when in joints else None)
            for when, kind, name in sets if kind == "rock"]
