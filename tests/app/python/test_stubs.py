"""The stubs name what the module has, no more and no less."""
import ast
import inspect
import os

import gridshell as gs


def public(names):
    return {n for n in names if not n.startswith("_") or n in ("__init__", "__len__", "__getitem__")}


def stubs():
    path = os.path.join(os.path.dirname(gs.__file__), "gridshell.pyi")
    with open(path, encoding="utf-8") as file:
        return ast.parse(file.read()).body


def test_stubs_are_the_module():
    named = [node for node in stubs() if isinstance(node, (ast.ClassDef, ast.FunctionDef))]
    assert {node.name for node in named} == public(vars(gs))
    for node in named:
        if not isinstance(node, ast.ClassDef) or issubclass(getattr(gs, node.name), Exception):
            continue
        members = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
        there = public(vars(getattr(gs, node.name)))
        # a class without a constructor has pybind11's own __init__
        assert members | {"__init__"} == there | {"__init__"}, node.name


def test_stubs_name_the_arguments():
    for node in stubs():
        methods = node.body if isinstance(node, ast.ClassDef) else [node]
        owner = getattr(gs, node.name, gs) if isinstance(node, ast.ClassDef) else gs
        for method in methods:
            if not isinstance(method, ast.FunctionDef) or method.decorator_list:
                continue
            said = getattr(owner, method.name).__doc__.split("\n")[0]
            for argument in method.args.args + method.args.kwonlyargs:
                assert argument.arg in said, (method.name, argument.arg)


def test_everything_says_what_it_is():
    for name, value in vars(gs).items():
        if name.startswith("_"):
            continue
        assert value.__doc__, name
        for member, what in vars(value).items() if inspect.isclass(value) else ():
            if isinstance(what, property):
                assert what.__doc__, (name, member)
