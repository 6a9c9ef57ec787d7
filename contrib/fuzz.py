#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs damaged scenes and meshes and reports what a user must never see.

usage: contrib/fuzz.py [--kinds validate,run,mesh] [--number 100] [--seeds 1-3]
         [--only N] [--keyblock build/keyblock] [--keep FOLDER] [--ranks N]
         [--seconds 60] [--memory 6] [--jobs 1] [--scenes WORD]

validate: the scenes of prm/tutorial and prm/verification with changed numbers,
lines, names, lengths and bytes, with --validate; run: the same with a few steps in each
stage; mesh: a small scene on damaged mesh files (MSH 2.2 and 4.1, UCD, VTK,
Abaqus). Each seed gives --number mutants, every one from its own random
numbers: --only repeats one. A mutant is at fault if it ends by a signal, with
an exit code other than 0, 1 and 2, after --seconds (a run must then stop when
it is asked to; a large mesh that was announced may take longer), with more or less than one sentence, with words of C++, MPI or
Gmsh instead of a sentence, or with 0 and a number in summary.json or
history.csv that is not finite. --memory: address space of a run [GB]; 0: no
limit. Those at fault are kept in --keep. Exits with 1 if there is one.
"""
import collections
import concurrent.futures
import json
import math
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import unicodedata

from script_tools import ROOT, make_parser, numbers, without_mpirun

NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])")

# of --kinds run: what keeps a run short, and is left alone
STEPS = 12
LIMITS = (b"Maximum steps", b"Maximum periods", b"Trial steps", b"Sweep step",
          b"Bracket", b"Method", b"Ramp duration", b"Cells", b"Size")

# what is not for users
RAW = re.compile(r"what\(\)|std::|terminate called|ExceptionBase|MPI_ABORT|"
                 r"An error occurred in|signature:|Stacktrace|Additional info|"
                 r"bad_alloc|basic_string|vector::|map::at|stod|stoul|"
                 r"internal error|Segmentation|core dumped|dealii|"
                 r"violated condition|Process received signal|ERROR:")

VALUES = (b"0", b"-1", b"1", b"2", b"1e-300", b"1e-12", b"1e6", b"1e12", b"1e30",
          b"1e200", b"1e308", b"1e400", b"-1e200", b"nan", b"inf", b"-inf", b"",
          b"4294967295", b"4294967296", b"2147483648", b"18446744073709551616",
          b"0.1.2", b"1,2", b"1;2", b"x", b"rand()", b"1/0", b"0/0")


def mutate_number(text, rng):
    """Another value in the place of a number."""
    found = list(NUMBER.finditer(text))
    if not found:
        return text
    place = rng.choice(found)
    value = rng.choice(VALUES)
    if rng.random() < 0.4:
        try:
            number = float(place.group())
            value = repr(number * rng.choice((-1, 0.5, 2, 10, 1e3, 1e-3, 1e9))
                         ).encode()
            if b"." not in place.group() and abs(number) < 1e9:
                value = str(int(float(value))).encode()
        except (ValueError, OverflowError):
            pass
    return text[:place.start()] + value + text[place.end():]


def mutate_value(text, rng):
    """Another value of an entry, all of it."""
    lines = text.split(b"\n")
    places = [i for i, line in enumerate(lines) if b"=" in line]
    if not places:
        return text
    i, j = rng.choice(places), rng.choice(places)
    name = lines[i].split(b"=", 1)[0]
    value = rng.choice(VALUES + (lines[j].split(b"=", 1)[1],) * 8)
    lines[i] = name + b"= " + value
    return b"\n".join(lines)


def mutate_lines(text, rng):
    """A line less, more, elsewhere or exchanged."""
    lines = text.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    way = rng.randrange(4)
    if way == 0:
        del lines[i]
    elif way == 1:
        lines.insert(j, lines[i])
    elif way == 2:
        lines[i], lines[j] = lines[j], lines[i]
    else:
        lines.insert(j, lines.pop(i))
    return b"\n".join(lines)


def mutate_words(text, rng):
    """A word of the file in the place of another."""
    words = list(re.finditer(rb"[A-Za-z_]\w*", text))
    if len(words) < 2:
        return text
    place, other = rng.choice(words), rng.choice(words)
    return text[:place.start()] + other.group() + text[place.end():]


def mutate_list(text, rng):
    """An item of a list less, or twice."""
    items = list(re.finditer(rb"[,;]", text))
    if not items:
        return text
    place = rng.choice(items)
    rest = re.search(rb"[,;\n]|$", text[place.end():])
    end = place.end() + rest.start()
    return (text[:place.start()] + text[end:] if rng.random() < 0.6 else
            text[:end] + text[place.start():end] + text[end:])


def mutate_bytes(text, rng):
    """Bytes changed, added or removed."""
    at = rng.randrange(len(text))
    way = rng.randrange(4)
    if way == 0:
        return text[:at] + bytes([rng.randrange(256)]) + text[at + 1:]
    if way == 1:
        return text[:at] + text[at + rng.randrange(1, 40):]
    if way == 2:
        return text[:at] + rng.choice(
            (b"\0", b"\xff\xfe", b"%n%s", b"\r", b"end\n", b"\\\n", b"#",
             b"include x.prm\n", b"subsection x\n", b"\xef\xbb\xbf")) + text[at:]
    return text[:at] + bytes(rng.randrange(256) for _ in range(8)) + text[at:]


def mutate_end(text, rng):
    """The file cut off."""
    return text[:rng.randrange(len(text))]


def mutate_length(text, rng):
    """A line of many kilobytes, with a fault somewhere."""
    lines = text.split(b"\n")
    i = rng.randrange(len(lines))
    name, equal, value = lines[i].partition(b"=")
    words = (value if equal else name).strip() or b"1"
    glue = rng.choice((b"", b"; ", b", ", b" "))
    long = glue.join([words] * (rng.choice((30000, 100000)) // len(words)))
    at = rng.randrange(len(long) + 1)
    long = long[:at] + rng.choice((b"", b"o", b"=", b".")) + long[at:]
    lines[i] = name + b"= " + long if equal else long
    return b"\n".join(lines)


MUTATIONS = ((mutate_number, 10), (mutate_value, 4), (mutate_lines, 3),
             (mutate_words, 2), (mutate_list, 3), (mutate_bytes, 2),
             (mutate_end, 1), (mutate_length, 2))


def mutate(text, rng):
    """The text with one to a few faults."""
    ways, weights = zip(*MUTATIONS)
    for way in rng.choices(ways, weights, k=rng.choice((1, 1, 1, 2, 3, 6))):
        if text:
            text = way(text, rng)
    return text


def shortened(text):
    """A scene with a few steps in each stage, and what keeps it short."""
    lines, sections, limits = [], [], []
    for line in text.split(b"\n"):
        words = line.split(b"#")[0].strip()
        if words.startswith(b"subsection "):
            sections.append(words[11:])
        is_stage = len(sections) == 2 and sections[0] == b"Stages"
        if words == b"end" and sections:
            if is_stage:
                limits.append(sections[1])
            sections.pop()
        lines.append(line)
    tail = b"".join(b"  subsection " + name + b"\n    set Maximum steps = %d\n"
                    b"  end\n" % STEPS for name in limits)
    return b"\n".join(lines), (
        b"\nsubsection Stages\n" + tail + b"end\nsubsection Safety factor\n"
        b"  set Blocks = none\nend\nsubsection Output\n  set VTU count = 1\n"
        b"end\n")


def scenes(word):
    """Shipped scenes that are set up within seconds."""
    return [path for path in sorted((ROOT / "prm").glob("*/*.prm"))
            if path.parent.name in ("tutorial", "verification")
            and word in path.name]


def grid(dim, is_simplex):
    """Points, cells and outer lines or faces (with their numbers)."""
    n = 3 if dim == 2 else 2
    places = [(i, j, k) for k in range(n + 1 if dim == 3 else 1)
              for j in range(n + 1) for i in range(n + 1)]
    index = {place: i for i, place in enumerate(places)}
    cells, faces = [], []
    for i, j, k in places:
        if dim == 2 and (i + 1, j + 1, 0) in index:
            a, b, c, d = (index[p] for p in ((i, j, 0), (i + 1, j, 0),
                                             (i + 1, j + 1, 0), (i, j + 1, 0)))
            cells += [(a, b, c), (a, c, d)] if is_simplex else [(a, b, c, d)]
        if dim == 2 and j == 0 and (i + 1, 0, 0) in index:
            faces.append((index[i, 0, 0], index[i + 1, 0, 0]))
        if dim == 3 and (i + 1, j + 1, k + 1) in index:
            v = [index[i + x, j + y, k + z] for z in (0, 1)
                 for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
            cells += ([(v[0], v[1], v[2], v[6]), (v[0], v[2], v[3], v[6]),
                       (v[0], v[3], v[7], v[6]), (v[0], v[7], v[4], v[6]),
                       (v[0], v[4], v[5], v[6]), (v[0], v[5], v[1], v[6])]
                      if is_simplex else [tuple(v)])
            if k == 0:
                faces += ([(v[0], v[1], v[2]), (v[0], v[2], v[3])]
                          if is_simplex else [tuple(v[:4])])
    return places, cells, faces


GMSH_TYPE = {(1, 2): 1, (2, 3): 2, (2, 4): 3, (3, 4): 4, (3, 8): 5}


def msh_2(dim, points, cells, faces):
    """Gmsh's format 2.2."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2",
             f'{dim - 1} 7 "base"', f'{dim} 1 "rock"', "$EndPhysicalNames",
             "$Nodes", str(len(points))]
    lines += [f"{i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(points)]
    lines += ["$EndNodes", "$Elements", str(len(cells) + len(faces))]
    for i, (d, group, element) in enumerate(
            [(dim - 1, 7, f) for f in faces] + [(dim, 1, c) for c in cells]):
        lines.append(f"{i + 1} {GMSH_TYPE[d, len(element)]} 2 {group} 1 "
                     + " ".join(str(v + 1) for v in element))
    return lines + ["$EndElements"]


def msh_4(dim, points, cells, faces):
    """Gmsh's format 4.1."""
    low = " ".join(str(min(p[d] for p in points)) for d in range(3))
    high = " ".join(str(max(p[d] for p in points)) for d in range(3))
    counts = [0, 0, 0, 0]
    counts[dim] = counts[dim - 1] = 1
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", "2",
             f'{dim - 1} 7 "base"', f'{dim} 1 "rock"', "$EndPhysicalNames",
             "$Entities", " ".join(map(str, counts)),
             f"1 {low} {high} 1 7 0", f"1 {low} {high} 1 1 1 1",
             "$EndEntities", "$Nodes", f"1 {len(points)} 1 {len(points)}",
             f"{dim} 1 0 {len(points)}"]
    lines += [str(i + 1) for i in range(len(points))]
    lines += [f"{x} {y} {z}" for x, y, z in points]
    n = len(cells) + len(faces)
    lines += ["$EndNodes", "$Elements", f"2 {n} 1 {n}"]
    number = 0
    for d, elements in ((dim - 1, faces), (dim, cells)):
        lines.append(f"{d} 1 {GMSH_TYPE[d, len(elements[0])]} {len(elements)}")
        for element in elements:
            number += 1
            lines.append(f"{number} " + " ".join(str(v + 1) for v in element))
    return lines + ["$EndElements"]


def ucd(_, points, cells, faces):
    """AVS UCD."""
    names = {2: "line", 3: "tri", 4: "quad", 8: "hex"}
    lines = [f"{len(points)} {len(cells) + len(faces)} 0 0 0"]
    lines += [f"{i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(points)]
    is_tet = len(cells[0]) == 4 and len(faces[0]) == 3
    for i, element in enumerate(faces + cells):
        name = ("tet" if is_tet and len(element) == 4 else names[len(element)])
        lines.append(f"{i + 1} 1 {name} " + " ".join(str(v + 1) for v in element))
    return lines


def vtk(dim, points, cells, _):
    """Legacy VTK."""
    kind = {(2, 3): 5, (2, 4): 9, (3, 4): 10, (3, 8): 12}[dim, len(cells[0])]
    lines = ["# vtk DataFile Version 3.0", "grid", "ASCII",
             "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [f"{x} {y} {z}" for x, y, z in points]
    lines.append(f"CELLS {len(cells)} {sum(len(c) + 1 for c in cells)}")
    lines += [f"{len(c)} " + " ".join(map(str, c)) for c in cells]
    return (lines + [f"CELL_TYPES {len(cells)}"] + [str(kind)] * len(cells)
            + [f"CELL_DATA {len(cells)}", "SCALARS MaterialID int 1",
               "LOOKUP_TABLE default"] + ["1"] * len(cells))


def abaqus(dim, points, cells, _):
    """Abaqus input."""
    kind = {(2, 3): "CPS3", (2, 4): "CPS4", (3, 4): "C3D4",
            (3, 8): "C3D8"}[dim, len(cells[0])]
    lines = ["*NODE"]
    lines += [f"{i + 1}, {x}, {y}, {z}" for i, (x, y, z) in enumerate(points)]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=EB1")
    lines += [f"{i + 1}, " + ", ".join(str(v + 1) for v in c)
              for i, c in enumerate(cells)]
    return lines


# twice what Gmsh reads: its readers are not ours
MESHES = (("msh", msh_2), ("msh", msh_2), ("msh", msh_4), ("msh", msh_4),
          ("ucd", ucd), ("vtk", vtk), ("inp", abaqus))

MESH_SCENE = """set Dimension = {dim}
subsection Domain
  set Shape = file
  set File = mutant.{extension}
end
subsection Mesh
  set Generator = file
end
subsection Materials
  set Names = rock
end
subsection Supports
  set Names = base
  subsection base
    set Boundaries = bottom
  end
end
subsection Initial state
  set Gravity = {gravity}
end
subsection Stages
  set Names = go
  subsection go
    set Maximum steps = 10
  end
end
"""


def prepare(kind, name, options, folder):
    """Write the mutant called @p name; returns the scene and arguments."""
    rng = random.Random(name)
    if kind == "mesh":
        extension, writer = rng.choice(MESHES)
        dim = rng.choice((2, 3))
        lines = writer(dim, *grid(dim, rng.random() < 0.5))
        text = mutate("\n".join(lines).encode() + b"\n", rng)
        (folder / f"mutant.{extension}").write_bytes(text)
        scene = folder / "mutant.prm"
        scene.write_text(MESH_SCENE.format(
            dim=dim, extension=extension,
            gravity="; ".join(["0"] * (dim - 1) + ["-9.81"])), encoding="utf-8")
        return scene, []
    source = rng.choice(scenes(options.scenes))
    text, tail = source.read_bytes(), b""
    if kind == "run":
        text, tail = shortened(text)
    scene = folder / f"{source.stem}.prm"
    scene.write_bytes(mutate(text, rng) + tail)
    for table in source.parent.glob("*"):
        if table.suffix != ".prm" and table.is_file():
            (folder / table.name).write_bytes(table.read_bytes())
    return scene, ["--validate"] if kind == "validate" else []


def limit_memory(gigabytes):
    """Of the process that is about to start."""
    def limit():
        if gigabytes > 0:
            resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 2**30),) * 2)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return limit


def all_numbers(value):
    """Every number of a JSON document; null stands for one that is none."""
    if isinstance(value, dict):
        for item in value.values():
            yield from all_numbers(item)
    elif isinstance(value, list):
        for item in value:
            yield from all_numbers(item)
    elif value is None:
        yield math.nan
    elif isinstance(value, (int, float)):
        yield value


def fault_of_results(folder):
    """What is wrong with what a run that ended with 0 has written."""
    try:
        summary = json.loads((folder / "summary.json").read_text("utf-8"))
    except (OSError, ValueError) as error:
        return f"exit 0, but summary.json: {error}"
    if not all(math.isfinite(value) for value in all_numbers(summary)):
        return "exit 0 with a number in summary.json that is not finite"
    history = folder / "history.csv"
    if history.exists() and re.search(r"\b(nan|inf)\b",
                                      history.read_text("utf-8").lower()):
        return "exit 0 with a number in history.csv that is not finite"
    return ""


def judge(code, errors, is_run, folder):
    """What is at fault, or nothing."""
    found = RAW.search(errors)
    if code < 0:
        return f"signal {signal.Signals(-code).name}"
    if found:
        return f"exit {code}, raw text '{found.group()}'"
    if code not in (0, 1, 2):
        return f"exit {code}"
    if code == 0:
        return fault_of_results(folder) if is_run else ""
    start = "Error: " if code == 1 else "Failed: "
    if not errors.startswith(start) or errors.strip().count("\n") > 0:
        return f"exit {code}, but not one sentence"
    if any(unicodedata.category(c) == "Cc" for c in errors.strip()):
        return f"exit {code}, with control characters"
    return ""


def run(name, options, keep):
    """Prepare, run and judge one mutant: how it ended and what is at fault."""
    kind = name.split()[0]
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        scene, arguments = prepare(kind, name, options, folder)
        command = [options.keyblock, "--output", str(folder / "out"), str(scene)]
        if options.ranks > 1:
            command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n",
                       str(options.ranks)] + command
        with subprocess.Popen(
                command + arguments, stdout=subprocess.PIPE,
                stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, cwd=folder,
                preexec_fn=limit_memory(options.memory)) as process:
            is_late = False
            try:
                said, errors = process.communicate(timeout=options.seconds)
            except subprocess.TimeoutExpired:
                is_late = True
                process.send_signal(signal.SIGTERM)
                try:
                    said, errors = process.communicate(timeout=20)
                except subprocess.TimeoutExpired:
                    process.kill()
                    said, errors = process.communicate()
        errors = errors.decode("utf-8", errors="replace")
        code = process.returncode
        if options.ranks > 1:
            if code > 128 and not is_late:  # a rank's signal
                code = 128 - code
            errors = without_mpirun(errors)
        if is_late:
            is_stopped = kind == "run" and code == 128 + signal.SIGTERM
            # the mutant asks for a mesh that takes long, and is told so
            is_large = b"cells are to be made" in said
            outcome = ("stopped" if is_stopped else
                       "large mesh" if is_large else "time-out")
            fault = ("" if is_stopped or is_large else
                     f"more than {options.seconds} s")
        else:
            outcome = str(code)
            fault = judge(code, errors, kind != "validate", folder / "out")
        if fault and keep:
            target = keep / name.replace(" ", "_")
            target.mkdir(parents=True, exist_ok=True)
            for path in folder.iterdir():
                if path.is_file():
                    (target / path.name).write_bytes(path.read_bytes())
            (target / "stderr.txt").write_text(errors, encoding="utf-8")
        return outcome, fault, errors.strip().splitlines()[:1]


def main():
    parser = make_parser(__doc__)
    parser.add_argument("--kinds", default="validate,run,mesh")
    parser.add_argument("--number", type=int, default=100)
    parser.add_argument("--seeds", default="1", type=numbers)
    parser.add_argument("--only", type=int)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60.)
    parser.add_argument("--memory", type=float, default=6.)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--scenes", default="")
    options = parser.parse_args()
    options.keyblock = os.path.abspath(options.keyblock)
    n_faults = 0
    for kind in options.kinds.split(","):
        names = [f"{kind} {seed} {i}" for seed in options.seeds
                 for i in range(options.number)
                 if options.only in (None, i)]
        ends = collections.Counter()
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for name, (outcome, fault, message) in zip(
                    names, pool.map(lambda n: run(n, options, options.keep),
                                    names)):
                ends[outcome] += 1
                if fault or options.only is not None:
                    print(f"{name}: {fault}  {' '.join(message)[:300]}",
                          flush=True)
                n_faults += bool(fault)
        print(f"{kind}: {len(names)} mutants ended with "
              + ", ".join(f"{k}: {n}" for k, n in sorted(ends.items())),
              flush=True)
    print(f"{n_faults} at fault")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())
