# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of an output folder that need no library to be read."""
import re
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


def last_states(path):
    """Index of the last state of each stage in a solution.pvd, by its name.

    {} where it does not name stages, or cannot be read."""
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except (OSError, xml.etree.ElementTree.ParseError):
        return {}
    names = [s.get("group") for s in root.iter("DataSet")
             if s.get("name") == "rock"]
    return {name: k for k, name in enumerate(names) if name}


def groups_of(joints):
    """Names of sets, or of what joints share, and the group of each joint.

    `joints` are rows of joints.csv. Few joints stand for themselves, more by
    their set or, without one, by their name up to its digits; of more than
    eight the least are others."""
    keys = [row.get("set") or row.get("name", "") for row in joints]
    if len(set(keys)) > 8:
        keys = [row.get("set") or re.sub(r"[\d_.-]+$", "",
                                         row.get("name", ""))
                or "joints" for row in joints]
        keys = [key if keys.count(key) > 1 else row.get("name", key)
                for key, row in zip(keys, joints)]
    counts = {key: keys.count(key) for key in dict.fromkeys(keys)}
    if len(counts) > 8:
        most = sorted(counts, key=counts.get, reverse=True)[:7]
        keys = [key if key in most else "others" for key in keys]
    names = list(dict.fromkeys(keys))
    if "others" in names:
        names.append(names.pop(names.index("others")))
    return names, [names.index(key) for key in keys]
