#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the type stubs are what the module has, and all of that has docstrings.

usage: stubs.py STUBS.pyi
"""
import ast
import inspect
import sys

import keyblock
from tools import check_that, end


def members(thing):
    """Names that a class has of its own, but for what every object has."""
    wanted = {"__init__", "__len__", "__getitem__", "__iter__", "__next__", "__enter__",
              "__exit__"}
    return {name for name in vars(thing)
            if not name.startswith("_") or name in wanted}


def parameters(function):
    """Names of a function's parameters as its docstring or signature has them."""
    text = (function.__doc__ or "").splitlines()[0] if inspect.isbuiltin(
        function) or not hasattr(function, "__code__") else ""
    if text:
        inside = text[text.index("(") + 1:text.rindex(") ->")]
        depth, names, piece = 0, [], ""
        for letter in inside + ",":
            depth += (letter in "[({") - (letter in "])}")
            if letter == "," and depth == 0:
                names.append(piece.split(":")[0].split("=")[0].strip())
                piece = ""
            else:
                piece += letter
        return [name for name in names if name and name not in ("*", "self")]
    return [name for name in inspect.signature(function).parameters if name != "self"]


def stub_parameters(function):
    """The same of the stubs."""
    arguments = function.args
    return [one.arg for one in arguments.args + arguments.kwonlyargs if one.arg != "self"]


def compare_class(name, node, thing):
    functions = {one.name: one for one in node.body if isinstance(one, ast.FunctionDef)}
    values = {one.target.id for one in node.body if isinstance(one, ast.AnnAssign)}
    if issubclass(thing, Exception):
        return
    stubbed, there = set(functions) | values, members(thing)
    if values:  # data classes
        there = {*thing.__dataclass_fields__, *(m for m in there if not m.startswith("_"))}
    if "__init__" not in stubbed:  # cannot be made by anybody else
        there.discard("__init__")
    # by way of __getitem__
    stubbed -= {"__iter__"} if "__iter__" not in there else set()
    check_that(f"the stubs of {name} have what it has: {stubbed ^ there}", stubbed == there)
    for member in sorted(stubbed & there - {"__init__"}):
        value = vars(thing).get(member)
        is_property = any(isinstance(one, ast.Name) and one.id == "property"
                          for one in getattr(functions.get(member), "decorator_list", []))
        if member in values:
            continue
        check_that(f"{name}.{member} is a property in both",
                   is_property == isinstance(value, property))
        if not member.startswith("_"):
            check_that(f"{name}.{member} has a docstring", bool(
                (value.__doc__ or "").strip().split("\n", 1)[-1].strip()))
            if not is_property:
                check_that(f"{name}.{member} has the parameters of the stubs: "
                           f"{parameters(value)}",
                           parameters(value)[-len(stub_parameters(functions[member])):] ==
                           stub_parameters(functions[member]) or
                           not stub_parameters(functions[member]))


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        tree = ast.parse(file.read())
    nodes = {node.name: node for node in tree.body
             if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    there = set(keyblock.__all__) - {"__version__"}
    check_that(f"the stubs have what the module has: {set(nodes) ^ there}",
               set(nodes) == there)
    for name, node in nodes.items():
        thing = getattr(keyblock, name)
        check_that(f"{name} has a docstring", bool((thing.__doc__ or "").strip()))
        if isinstance(node, ast.ClassDef):
            compare_class(name, node, thing)
        else:
            check_that(f"{name} has the parameters of the stubs",
                       parameters(thing) == stub_parameters(node))
    check_that("the module says what version it is", keyblock.__version__.count(".") == 2)


if __name__ == "__main__":
    main()
    end()
