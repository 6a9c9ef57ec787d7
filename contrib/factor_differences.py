# SPDX-License-Identifier: LGPL-2.1-or-later
"""What differs between the blocks and factors of two runs (summary.json).

Limit equilibrium agrees to 1e-6. It agrees to 1e-3 for blocks that two different
meshes bound, not planes. Strength reduction agrees if outcomes are the same and
brackets overlap. Blocks are paired by place and size, not by number."""
import math
import re
from typing import NamedTuple

EXACT, OF_MESH = 1e-6, 1e-3
# volumes of different meshes, over the larger one
VOLUMES_OF_MESHES = 0.05
# two blocks may be the same up to this distance over their size, and this
# difference of volumes over the larger one
NEAR = 0.25
ROUND_OFF = 1e-9


class Difference(NamedTuple):
    """One value that differs."""
    block: int  # number in the scene; 0: in the variant only
    stage: str
    what: str
    old: str
    new: str
    # a factor that limit equilibrium does not give, with another mesh
    is_of_mesh: bool = False

    def text(self):
        """The difference in one line."""
        where = f"block {self.block}" if self.block else "new block"
        stage = f" after '{self.stage}'" if self.stage else ""
        return f"{where}{stage}: {self.what} {self.old} -> {self.new}"


class Pair(NamedTuple):
    """A block of the scene and the same block of the variant."""
    old: dict
    new: dict
    tolerance: float  # of limit equilibrium


def finite_blocks(summary):
    """The blocks that are not infinite or rigid."""
    return [block for block in summary["blocks"] if "width" in block]


def relative(a, b):
    """The difference over the larger one."""
    return abs(a - b) / max(abs(a), abs(b), 1e-300)


def is_close(a, b, tolerance):
    """Whether two numbers agree."""
    return relative(a, b) <= tolerance or abs(a - b) <= ROUND_OFF


class Comparison:
    """Compares a variant with its scene.

    `variant`: scene_relations.Variant; `stages`: names of the stages whose
    factors are compared."""

    def __init__(self, old, new, variant, stages):
        self.variant = variant
        self.mapping = variant.mapping
        self.stages = stages
        self.dim = old["scene"]["dimension"]
        self.is_cut = any(s.get("mesh", {}).get("way") == "cut" for s in (old, new))
        self.old, self.new = finite_blocks(old), finite_blocks(new)
        self.found = []
        self.pairs = self.make_pairs()
        self.number = {pair.new["id"]: pair.old["id"] for pair in self.pairs}

    def add(self, block, stage, what, old, new, is_of_mesh=False):
        """Note a difference."""
        self.found.append(Difference(block, stage, what, str(old), str(new),
                                     is_of_mesh))

    def place(self, block):
        """Where a block of the variant is in the scene [m]."""
        return self.mapping.back(block["centroid"])

    def volume(self, block, entry="volume"):
        """Its volume there [m3], in 2D its area [m2]."""
        return block[entry] / self.mapping.length**self.dim

    def make_pairs(self):
        """Pair the blocks that are nearest to each other."""
        candidates = []
        for i, old in enumerate(self.old):
            size = old["volume"]**(1. / self.dim)
            for j, new in enumerate(self.new):
                distance = math.dist(old["centroid"], self.place(new)) / size
                change = relative(old["volume"], self.volume(new))
                if distance < NEAR and change < NEAR:
                    candidates.append((distance + change, i, j))
        partner, taken = {}, set()
        for _, i, j in sorted(candidates):
            if i not in partner and j not in taken:
                partner[i] = j
                taken.add(j)
        self.lost = [b for i, b in enumerate(self.old) if i not in partner]
        self.added = [b for j, b in enumerate(self.new) if j not in taken]
        return [self.make_pair(self.old[i], self.new[j])
                for i, j in sorted(partner.items())]

    def make_pair(self, old, new):
        """Both blocks with the tolerance of their factors."""
        is_same_mesh = (self.variant.keeps_mesh or (
            old["cells"] == new["cells"]
            and relative(old["volume"], self.volume(new)) < ROUND_OFF))
        is_exact = "exact_volume" in old and "exact_volume" in new
        return Pair(old, new, EXACT if is_same_mesh or is_exact else OF_MESH)

    def changes_numbers(self):
        """Whether a block has another number in the variant."""
        return any(pair.old["id"] != pair.new["id"] for pair in self.pairs)

    def has_cut_blocks(self):
        """Whether two meshes that joints are cut into have different blocks."""
        return self.is_cut and not self.variant.keeps_mesh and (
            bool(self.lost)
            or not all(self.is_expected(block) for block in self.added)
            or any(not is_close(pair.old["volume"], self.volume(pair.new), OF_MESH)
                   or has_other_sides(pair) for pair in self.pairs))

    def differences(self):
        """All differences, by block."""
        for block in self.lost:
            if self.variant.keeps_mesh or is_judged(block):
                self.add(block["id"], "", "block", f"{block['volume']:.6g}",
                         "none")
        for block in self.added:
            if (self.variant.keeps_mesh or is_judged(block)) and not (
                    self.is_expected(block)):
                self.add(0, "", "block", "none", f"{self.volume(block):.6g} at "
                         + ", ".join(f"{c:.4g}" for c in self.place(block)))
        for pair in self.pairs:
            self.compare_shape(pair)
            self.compare_statics(pair)
            self.compare_reduction(pair)
        return self.found

    def is_expected(self, block):
        """Whether a new block is where the variant adds one."""
        if not self.variant.new_blocks:
            return False
        center, radius = self.variant.new_blocks
        return math.dist(center, self.place(block)) < radius

    def compare_shape(self, pair):
        """Volumes, classes, and whether joints let a block move."""
        old, new = pair.old, pair.new
        both = "exact_volume" in old and "exact_volume" in new
        entry = ("exact_volume" if both and not self.variant.keeps_mesh
                 else "volume")
        limit = EXACT if both or self.variant.keeps_mesh else VOLUMES_OF_MESHES
        if not is_close(old[entry], self.volume(new, entry), limit):
            self.add(old["id"], "", entry.replace("_", " "),
                     f"{old[entry]:.9g}", f"{self.volume(new, entry):.9g}")
        for entry in ("class", "removable", "removed_in_stage"):
            if old.get(entry) != new.get(entry):
                self.add(old["id"], "", entry, old.get(entry), new.get(entry))

    def rows(self, block, name):
        """Rows of a block by their stage."""
        return {row["stage"]: row for row in block.get(name, [])
                if row["stage"] in self.stages}

    def in_both(self, pair, name):
        """(stage, old row, new row); rows of one run only are differences."""
        old, new = self.rows(pair.old, name), self.rows(pair.new, name)
        for stage in list(old) + [s for s in new if s not in old]:
            if stage in old and stage in new:
                yield stage, old[stage], new[stage]
                continue
            self.add(pair.old["id"], stage, name, text_of_row(old.get(stage)),
                     text_of_row(new.get(stage)))

    def compare_statics(self, pair):
        """Factors by limit equilibrium."""
        for stage, old, new in self.in_both(pair, "limit_equilibrium"):
            block = pair.old["id"]
            modes = old["mode"], self.old_mode(new["mode"])
            if old["outcome"] != new["outcome"] or (
                    "value" in old and "value" in new and not is_close(
                        old["value"], new["value"], pair.tolerance)):
                self.add(block, stage, "limit equilibrium", text_of_row(old),
                         text_of_row(new))
            elif self.of_surfaces(modes[0]) != self.of_surfaces(modes[1]):
                self.add(block, stage, "mode", *modes)
            self.compare_once_gone(pair, stage, old, new)
            self.compare_demand(block, stage, old.get("support_demand"),
                                new.get("support_demand"), pair.tolerance)

    def old_mode(self, mode):
        """A mode with the scene's names of joints."""
        motion, on, joints = mode.partition(" on ")
        return motion + on + "/".join(self.mapping.names.get(name, name)
                                      for name in joints.split("/"))

    def of_surfaces(self, mode):
        """A mode with the joints in alphabetical order, and the bent joints in
        place of their facets: any may be named of those that hold alike."""
        motion, on, joints = mode.partition(" on ")
        tree = self.variant.tree
        names = {tree and tree.get(f"Joints/{name}/Surface") or name
                 for name in joints.split("/")}
        return motion + on + "/".join(sorted(names))

    def compare_once_gone(self, pair, stage, old, new):
        """Factors once neighbours have gone."""
        old, new = old.get("once_gone"), new.get("once_gone")
        if old is None and new is None:
            return
        texts = ["none" if row is None else f"{row['value']:.9g} ({row['mode']})"
                 for row in (old, new)]
        if old is None or new is None or not is_close(
                old["value"], new["value"], pair.tolerance) or sorted(
                    old["blocks"]) != sorted(self.number.get(b, 0)
                                             for b in new["blocks"]):
            self.add(pair.old["id"], stage, "factor once neighbours have gone",
                     *texts)

    def compare_demand(self, block, stage, old, new, tolerance):
        """The support that a wanted factor asks for."""
        if old is None and new is None:
            return
        if old is None or new is None or old["outcome"] != new["outcome"]:
            self.add(block, stage, "support demand", old and old["outcome"],
                     new and new["outcome"])
            return
        for entry, factor in (("force", self.mapping.force),
                              ("pressure", self.mapping.pressure)):
            if entry in old and not is_close(old[entry], new[entry] / factor,
                                             tolerance):
                self.add(block, stage, f"{entry} of support demand", old[entry],
                         new[entry] / factor)

    def compare_reduction(self, pair):
        """Brackets and outcomes of strength reduction. A bracket without the
        factor by limit equilibrium depends on stresses or on bent faces, and
        so on the mesh."""
        limits = self.rows(pair.old, "limit_equilibrium")
        for stage, old, new in self.in_both(pair, "safety_factor"):
            brackets = [(row.get("lower", 0.), row.get("upper", math.inf))
                        for row in (old, new)]
            texts = [f"{row['outcome']} [{low:.6g}, {high:.6g}]"
                     for row, (low, high) in zip((old, new), brackets)]
            overlap = (max(b[0] for b in brackets) <= min(b[1] for b in brackets))
            if old["outcome"] != new["outcome"] or not overlap:
                value = limits.get(stage, {}).get("value", math.nan)
                is_closed_form = brackets[0][0] <= value <= brackets[0][1]
                self.add(pair.old["id"], stage, "strength reduction", *texts,
                         not self.variant.keeps_mesh and not is_closed_form)


def has_other_sides(pair):
    """Whether joints let one of both move and not the other, or free one of
    them only."""
    return any(pair.old[entry] != pair.new[entry]
               for entry in ("class", "removable"))


def is_judged(block):
    """Whether a block has a factor."""
    return "limit_equilibrium" in block or "safety_factor" in block


def text_of_row(row):
    """A factor by limit equilibrium or by strength reduction in a few words."""
    if row is None:
        return "none"
    if "mode" in row:
        value = f"{row['value']:.9g}" if "value" in row else row["outcome"]
        return f"{value} ({row['mode']})"
    return row["outcome"]


def is_unsafe(difference):
    """Whether the variant has a larger factor, or lacks a block or a factor."""
    if difference.what in ("limit equilibrium", "strength reduction"):
        return first_number(difference.new) > first_number(difference.old)
    return difference.new == "none" and difference.what in (
        "block", "limit_equilibrium", "safety_factor")


def first_number(text):
    """The number at which a text begins, or its bracket does; infinite for
    blocks that are stable or cannot move."""
    if text.startswith(("stable", "immovable")):
        return math.inf
    found = re.search(r"(?:^|\[)([\d.]+(?:e[+-]?\d+)?)", text)
    return float(found.group(1)) if found else 0.
