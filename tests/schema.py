#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Looks whether summary.json and study.json are as their schemas say.

usage: schema.py KEYBLOCK PRM FOLDER [SCENE...]   the schemas themselves, what a few
                                       scenes, or those named, and a study
                                       write, and damaged copies of that
       schema.py FILE.json...          files named summary.json or study.json
"""
import copy
import functools
import json
import pathlib
import subprocess
import sys

try:
    import jsonschema
except ImportError:
    jsonschema = None

DOC = pathlib.Path(__file__).resolve().parent.parent / "doc"

# names are those of joints, sets, fields, monitors and checks
FREE = {"monitors", "checks", "joint_areas", "exact_joint_areas", "seeds",
        "coefficients", "standard_errors", "merged_areas"}
# absent where there is nothing to tell
OPTIONAL = FREE - {"monitors", "checks", "seeds"} | {
    "between_planes", "block_theory", "blocks", "bolts", "exposed_stage", "geostress",
    "governed_by", "group", "largest_volumes", "mesh", "remark",
    "removable", "removed_in_stage", "support_demand", "least_factor",
    "failed_volume", "turned_most"}

# of these damages_of_one() has more
POINTS = {"centroid", "head", "end", "largest_overlap_at"}
WORDS = {"build_type", "digest", "distribution", "entry", "failure_mode",
         "governed_by", "mode", "outcome", "sampling", "version", "way"}
NOT_EMPTY = {"blocks", "bolts", "class", "faces", "joint_pyramids",
             "largest_volumes", "limit_equilibrium", "removable",
             "safety_factor", "stress_ratio"}

# scene, arguments, and what it shows of a summary
SCENES = (
    ("verification/factor_group.prm", ["--set", "Safety factor/Bracket=0.05"],
     "blocks/0/safety_factor/0/group/value"),
    ("verification/factor_incline.prm",
     ["--set", "Safety factor/Wanted=1.5", "--set",
      "Safety factor/Wanted by=strength reduction"],
     "blocks/0/safety_factor/0/support_demand/pressure"),
    ("verification/geostress.prm", [], "geostress/r_squared"),
    ("verification/bolted_incline.prm", ["--set", "Safety factor/Blocks=none"],
     "bolts/0/governed_by"),
    ("verification/blocks_cube_4.prm",
     ["--set", "Block theory/Report=true", "--set", "Block theory/Roof span=5"],
     "block_theory/faces/0/largest_volumes/0"),
    ("verification/road_wedge.prm",
     ["--set", "Safety factor/Method=limit equilibrium"],
     "blocks/0/limit_equilibrium/0/value"),
    ("tutorial/joint_network.prm", [], "mesh/way"))


def read(path):
    """The content of a file of results; NaN and Infinity are refused."""
    def refuse(word):
        raise ValueError(f"{path}: {word} is no number of JSON")
    with open(path, encoding="utf-8") as file:
        return json.load(file, parse_constant=refuse)


@functools.lru_cache(maxsize=None)
def validator_of(kind):
    """What looks at a `summary` or a `study`."""
    return jsonschema.Draft202012Validator(read(DOC / f"{kind}.schema.json"))


def faults_of(results, kind):
    """What a schema refuses, one sentence each.

    None, and a line that says so, without the package python3-jsonschema."""
    if jsonschema is None:
        print(f"{kind}.json is not looked at: there is no python3-jsonschema")
        return []
    return [f"{kind}.json: {'/'.join(map(str, error.absolute_path))}: "
            f"{error.message[:200]}"
            for error in validator_of(kind).iter_errors(results)]


def properties_of(schema):
    """Every property that a schema names, with what it says of it."""
    if isinstance(schema, list):
        schema = dict(enumerate(schema))
    if isinstance(schema, dict):
        if "additionalProperties" in schema:
            for keyword in ("properties", "patternProperties"):
                yield from schema.get(keyword, {}).items()
        for entry in schema.values():
            yield from properties_of(entry)


def is_of_numbers(entry, schema):
    """Whether a property is a number, or a list of numbers."""
    if "$ref" in entry:
        name = entry["$ref"].rsplit("/", 1)[1]
        return is_of_numbers(schema["$defs"][name], schema)
    if entry.get("type") == "array":
        return is_of_numbers(entry["items"], schema)
    return (entry.get("type") in ("number", "integer")
            or any(isinstance(value, int) for value in entry.get("enum", [])))


def faults_of_schema(kind):
    """Whether a schema is one, and tells the unit of everything."""
    schema = read(DOC / f"{kind}.schema.json")
    jsonschema.Draft202012Validator.check_schema(schema)
    properties = list(properties_of(schema))
    if len(properties) < 40:
        yield f"{kind}.schema.json has {len(properties)} properties"
    for name, entry in properties:
        if not entry.get("description"):
            yield f"{kind}.schema.json: {name} has no description"
        if is_of_numbers(entry, schema) and not entry.get("unit"):
            yield f"{kind}.schema.json: {name} has no unit"


def paths_of(results, path=()):
    """Paths of all values by keys; of lists only the first entry."""
    if isinstance(results, list):
        results = dict(enumerate(results[:1]))
    if isinstance(results, dict):
        for key, value in results.items():
            yield path + (key,), value
            yield from paths_of(value, path + (key,))


def look_up(results, path):
    """The value at a path."""
    return functools.reduce(lambda owner, key: owner[key], path, results)


def with_value(results, path, *value):
    """A copy with another value at a path, or with none."""
    results = copy.deepcopy(results)
    owner = look_up(results, path[:-1])
    if value:
        owner[path[-1]] = value[0]
    else:
        del owner[path[-1]]
    return results


def damages_of_one(key, value):
    """Values that a key must not have, as it has another one."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return str(value), None, 1e100, -1e100
    bad = [17, None]
    if key in POINTS:
        bad += [value[:-1], [*value, 0.]]
    if key in WORDS:
        bad += ["", "?"] if key != "failure_mode" else ["?"]
    return bad + [[]] if key in NOT_EMPTY else bad


def damages(results):
    """What is wrong, and a copy with that, for every key."""
    yield "has a key too many", with_value(results, ("surplus",), 0.)
    for path, value in paths_of(results):
        name, key = "/".join(map(str, path)), path[-1]
        may_be_absent = (isinstance(key, int) or key in OPTIONAL
                         or len(path) > 1 and path[-2] in FREE
                         or "stress_ratio" in path and key == "value"
                         # of a block that has no other factor
                         or key == "limit_equilibrium" and "safety_factor"
                         not in look_up(results, path[:-1])
                         # of a block of a study that cannot move
                         or path[0] == "blocks" and path[2:] == ("factor",))
        if not may_be_absent:
            yield f"lacks {name}", with_value(results, path)
        if isinstance(value, dict) and key not in FREE - {"monitors"}:
            yield (f"has a key too many in {name}",
                   with_value(results, path + ("surplus",), 0.))
        for bad in damages_of_one(key, value):
            yield f"has {bad!r} as {name}", with_value(results, path, bad)


def contradictions(summary):
    """Brackets that are not what their outcome says, and stages."""
    for b, block in enumerate(summary["blocks"]):
        for f, factor in enumerate(block.get("safety_factor", [])):
            place = ("blocks", b, "safety_factor", f)
            if factor["outcome"] != "value":
                continue
            for outcome in ("above 100", "above 100, held by clamping",
                            "above 100, held by bolts and clamping",
                            "falls freely", "undecided", "slides"):
                yield (f"has a value where the outcome is {outcome}",
                       with_value(summary, place + ("outcome",), outcome))
            for key in ("value", "upper", "lower"):
                yield (f"has a factor of 0 as {key}",
                       with_value(summary, place + (key,), 0.))
    for number in range(len(summary["stages"])):
        place = ("stages", number)
        stage = dict(look_up(summary, place), converged=False)
        stage.pop("remark", None)
        yield ("has a stage that did not converge, and no remark",
               with_value(summary, place, stage))
        stage = dict(look_up(summary, place), largest_overlap=1.)
        stage.pop("largest_overlap_at", None)
        yield ("has an overlap without a place",
               with_value(summary, place, stage))


def faults_of_open_bracket(summary):
    """A bracket with a lower end alone is right if it says that it is open."""
    factor = dict(summary["blocks"][0]["safety_factor"][0])
    for key in ("value", "upper", "group"):
        factor.pop(key, None)
    path = ("blocks", 0, "safety_factor", 0)
    if not faults_of(with_value(summary, path, factor), "summary"):
        yield "a value without upper end is accepted"
    for holder in ("clamping", "bolts", "bolts and clamping",
                   "bolts, shotcrete and structural liners"):
        factor["outcome"] = f"above 100, held by {holder}"
        yield from faults_of(with_value(summary, path, factor), "summary")
    factor["outcome"] = "above 100, held by magic"
    if not faults_of(with_value(summary, path, factor), "summary"):
        yield "a block held by magic is accepted"


def faults_of_damages(results, kind, more=()):
    """Damage that a schema accepts."""
    number = 0
    for what, damaged in (*damages(results), *more):
        number += 1
        if validator_of(kind).is_valid(damaged):
            yield f"accepted: a {kind}.json that {what}"
    print(f"{number} damaged copies of a {kind}.json")


def run(command, folder):
    """Run the program, and write into a folder."""
    subprocess.run([*command, "--output", str(folder)], check=True,
                   stdout=subprocess.DEVNULL)


def faults_of_scenes(keyblock, prm, folder, names):
    """What is wrong with the results of scenes, damaged or not; no names: of all."""
    for scene, arguments, shown in SCENES:
        name = pathlib.Path(scene).stem
        if names and name not in names:
            continue
        output = folder / name
        run([keyblock, str(prm / scene), *arguments,
             "--set", "Output/Write VTU=false"], output)
        summary = read(output / "summary.json")
        look_up(summary, [int(key) if key.isdigit() else key
                          for key in shown.split("/")])
        yield from faults_of(summary, "summary")
        more = list(contradictions(summary))
        yield from faults_of_damages(summary, "summary", more)
        if "safety_factor" in summary["blocks"][0]:
            yield from faults_of_open_bracket(summary)
    run([keyblock, str(prm / "verification" / "study_incline.prm"), "--study",
         "--set", "Study/Samples=100"], folder / "study")
    study = read(folder / "study" / "study.json")
    yield from faults_of(study, "study")
    yield from faults_of_damages(study, "study")


def main():
    """Exit with 1 and a sentence for what is wrong."""
    if jsonschema is None:
        print("nothing is looked at: there is no python3-jsonschema")
        return 0
    if sys.argv[1:] and sys.argv[1].endswith(".json"):
        paths = map(pathlib.Path, sys.argv[1:])
        faults = [f"{path.parent}: {fault}" for path in paths
                  for fault in faults_of(read(path), path.stem)]
    else:
        keyblock, prm, folder, *names = sys.argv[1:]
        faults = [*faults_of_schema("summary"), *faults_of_schema("study"),
                  *faults_of_scenes(keyblock, pathlib.Path(prm),
                                    pathlib.Path(folder), names)]
    print("\n".join(faults) or "all as the schemas say")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
