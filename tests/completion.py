#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What bash offers to complete a command line of keyblock.

usage: completion.py KEYBLOCK ROOT FOLDER
"""
import pathlib
import re
import subprocess
import sys
import time

KEYBLOCK, ROOT, FOLDER = (pathlib.Path(a).absolute() for a in sys.argv[1:4])
# one that lies as in the sources, and must not be asked
SILENT = FOLDER / "tree" / "build" / "keyblock"
SCENE = str(ROOT / "prm" / "tutorial" / "sliding_block.prm")
# as bash does it, twice
SCRIPT = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_keyblock; _keyblock
printf '%s\\n' "${COMPREPLY[@]}"
[[ $(complete -p keyblock) == *-F\\ _keyblock* ]] || echo "not registered"
"""


def offers(*words, program=SILENT):
    """Completions of the last word."""
    done = subprocess.run(
        ["bash", "--norc", "-c", SCRIPT, "bash",
         str(ROOT / "contrib" / "completion" / "keyblock"), str(program),
         *words], capture_output=True, text=True, check=True, cwd=FOLDER)
    assert not done.stderr, done.stderr
    return done.stdout.split("\n")[:-1]


def text_of(*arguments):
    """What the program prints."""
    return subprocess.run([str(KEYBLOCK), *arguments], check=True,
                          capture_output=True, text=True).stdout


def write_program(path, *lines):
    """A program of one's own."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(["#!/bin/sh", *lines, ""]), encoding="utf-8")
    path.chmod(0o755)


def options():
    """Every option of the program, and no other."""
    expected = set(re.findall(r"--[a-z-]+", text_of("--help")))
    assert set(offers("--")) == expected, expected
    assert offers("--va") == ["--validate"]


def files():
    """Scenes, folders and checkpoints where they belong."""
    (FOLDER / "files" / "results").mkdir(parents=True, exist_ok=True)
    for name in ("one.prm", "two words.prm", "state.h5", "notes.txt"):
        (FOLDER / "files" / name).write_text("", encoding="utf-8")

    def found(*words):
        return {name.partition("/")[2] for name in offers(*words, "files/")}
    assert found() == {"one.prm", "two words.prm", "results"}, found()
    assert found("--validate") == found()
    assert found("--output") == {"results"}, found("--output")
    assert found("--restart") == {"results", "state.h5"}


def entries():
    """Section by section, quoted or not, with the names of the scene."""
    assert "Safety\\ factor/" in offers("--set", "")
    assert "Safety factor/" in offers("--set", '"')
    assert offers("--set", "Saf") == ["Safety\\ factor/"]
    assert offers("--set", "Safety\\ factor/Hi") == ["Safety\\ factor/Highest="]
    assert offers("--set", "=", "'Safety factor/Hi") == [
        "Safety factor/Highest="]
    # as quotes are closed behind a section
    assert offers("--set", '"Safety factor/"Hi') == ["Safety\\ factor/Highest="]
    assert "Dimension=" in offers("--set", "=")
    assert offers("--set", "Safety factor/hi") == [""]
    assert offers("--set", "Joints/") == ["Joints/Names=", "Joints/File=",
                                         "Joints/Resolved="]
    assert {"Joints/base/", "Joints/left/"} <= set(
        offers(SCENE, "--set", "Joints/"))
    assert offers(SCENE, "--set", '"Stages/slide/Mass') == [
        "Stages/slide/Mass damping="]


def included():
    """Names of a scene that another one includes, beside itself."""
    folder = FOLDER / "included"
    (folder / "parts").mkdir(parents=True, exist_ok=True)
    (folder / "one.prm").write_text(
        "  include parts/more.prm  # of all\nsubsection Stages\n"
        "  set Names = last # one\nend\n", encoding="utf-8")
    (folder / "parts" / "more.prm").write_text(
        "subsection Joints\n  set Names = upper, lower\nend\n"
        "include more.prm\ninclude nothing.prm", encoding="utf-8")
    scene = str(folder / "one.prm")
    assert {"Joints/upper/", "Joints/lower/"} <= set(
        offers(scene, "--set", "Joints/"))
    assert "Stages/last/" in offers(scene, "--set", "Stages/")


def all_entries():
    """Every entry that stands for no name is offered in its section."""
    depth, missing, number = [], [], 0
    for line in text_of("--print-parameters").splitlines():
        words = line.strip().split(" ", 1)
        if words[0] == "subsection":
            depth.append(words[1])
        elif words[0] == "end":
            depth.pop()
        elif words[0] == "set" and "NAME" not in depth:
            name = words[1].split("=")[0].strip()
            path = "/".join([*depth, name])
            number += 1
            # some of them, for the sake of time
            if number % 5 == 1:
                found = offers("--set", '"' + path)
                missing += [] if path + "=" in found else [path]
    assert number > 50 and not missing, (number, missing)


def without_documents():
    """A program alone is asked for its entries, once."""
    asked, alone = FOLDER / "asked", FOLDER / "alone" / "keyblock"
    asked.unlink(missing_ok=True)
    write_program(alone, f"echo >>'{asked}'", f"exec '{KEYBLOCK}' \"$@\"")
    assert offers("--set", "Mesh/Generat", program=alone) == ["Mesh/Generator="]
    assert asked.read_text(encoding="utf-8") == "\n"
    write_program(alone, "exit 1")
    assert offers("--set", "", program=alone) == [""]


def quick():
    """Nobody waits for entries that lie in a file."""
    begin = time.time()
    offers(SCENE, "--set", "")
    assert time.time() < begin + 1., time.time() - begin


def main():
    """Exit with 1 at the first case that is not as it should be."""
    write_program(SILENT, "exit 1")
    document = FOLDER / "tree" / "doc" / "parameters.md"
    document.parent.mkdir(exist_ok=True)
    document.write_text(text_of("--print-parameters"), encoding="utf-8")
    for case in (options, files, entries, included, all_entries,
                 without_documents, quick):
        case()
        print(f"{case.__name__}: as it should be")


if __name__ == "__main__":
    main()
