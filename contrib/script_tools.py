# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the scripts of this folder share."""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def find_program():
    """The program that was built beside the scripts, else the installed one."""
    built = ROOT / "build" / "keyblock"
    installed = ROOT.parent.parent / "bin" / "keyblock"
    return str(installed if installed.exists() and not built.exists()
               else built)


def make_parser(description):
    """A parser of arguments with the program to run and where runs are kept."""
    parser = argparse.ArgumentParser(
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--keyblock", default=find_program())
    return parser


def split_arguments():
    """The script's own arguments, and those behind `--`, for the program."""
    arguments = sys.argv[1:]
    if "--" not in arguments:
        return arguments, []
    at = arguments.index("--")
    return arguments[:at], arguments[at + 1:]


def numbers(text):
    """The numbers of, for instance, 1,4-6: a list."""
    result = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        result += range(int(first), int(last or first) + 1)
    return result


def without_mpirun(errors):
    """What the program wrote, without mpirun's remarks: these stand between
    lines of hyphens, or begin with the machine's name and process in brackets."""
    errors = re.sub(r"^-{20,}\n(.*?\n)-{20,}$", "", errors,
                    flags=re.MULTILINE | re.DOTALL)
    return "\n".join(line for line in errors.split("\n")
                     if line.strip() and not re.match(r"\[[\w.-]+:\d+\]", line))
