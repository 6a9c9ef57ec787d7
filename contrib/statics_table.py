"""The table of limit equilibrium that keyblock --validate prints."""
import math
import re
from typing import NamedTuple


class Row(NamedTuple):
    """A block after a stage."""
    block: int
    stage: str
    factor: float  # infinite: stable
    mode: str
    text: str  # forces and remarks


def read_statics(output):
    """The rows in what the program printed."""
    rows, is_inside = [], False
    for line in output.splitlines():
        if line.startswith("  id  after "):
            is_inside = True
            continue
        found = re.match(r" *(\d+)  (.+?)  +(\S+)  (.+?): (.*)$", line)
        is_inside = is_inside and found is not None
        if is_inside:
            block, stage, factor, mode, text = found.groups()
            rows.append(Row(int(block), stage, math.inf if factor == "-" else float(factor),
                            mode, text))
    return rows


def read_volumes(output):
    """Volumes of blocks (in 2D areas) by id, of the table of blocks."""
    table = output.partition("\nBlocks\n")[2]
    rows = re.findall(r"^ *(\d+)  [a-z]+ +(?:yes|no) +(\S+) ", table, re.MULTILINE)
    return {int(block): float(volume) for block, volume in rows}
