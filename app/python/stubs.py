"""stubs.py FOLDER: writes FOLDER/gridshell.pyi from the signatures of the module in FOLDER."""
import inspect
import os
import re
import sys
import textwrap

sys.path.insert(0, sys.argv[1])
import gridshell as gs  # noqa: E402

HEAD = """from os import PathLike
from typing import Any, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike

__version__: str
"""

WORDS = ((r"\bgridshell\.", ""), (r"numpy\.ndarray\[numpy\.(\w+)\]", r"npt.NDArray[np.\1]"),
         (r"\bos\.PathLike\b", "Union[str, PathLike[str]]"), (r"= nan\b", "= ..."),
         (r"\bself: \w+", "self"))


def typed(text):
    for pattern, word in WORDS:
        text = re.sub(pattern, word, text)
    return text


def documented(head, doc, indent):
    """A class or function with this head, which contains only its docstring."""
    words = textwrap.indent(f'"""{doc.strip()}"""', indent + "    ", lambda line: line.strip())
    return f"{indent}{head}:\n{words}\n"


def function(name, doc, indent=""):
    signature, _, words = doc.partition("\n")
    return documented(f"def {typed(signature)}", words or name.strip("_"), indent)


def property_of(owner, name, what):
    made = what.fget.__doc__.split("->")[-1].strip()
    # a property that Session takes from its State has the type that it has there
    if made == "object" and owner is gs.Session:
        made = getattr(gs.State, name).fget.__doc__.split("->")[-1].strip()
    return "    @property\n" + documented(f"def {name}(self) -> {typed(made)}", what.__doc__, "    ")


def class_of(name, made):
    bases = [base.__name__ for base in made.__bases__ if not base.__name__.startswith("pybind11")]
    text = documented(f"class {name}({', '.join(bases)})" if issubclass(made, Exception)
                      else f"class {name}", made.__doc__, "")
    for member, what in vars(made).items():
        if isinstance(what, property):
            text += property_of(made, member, what)
        elif callable(what) and "->" in (what.__doc__ or "") and member not in ("__repr__", "__getstate__", "__setstate__"):
            text += function(member, what.__doc__, "    ")
    return text


parts = [f'"""{gs.__doc__}"""\n{HEAD}']
for name, what in vars(gs).items():
    if inspect.isclass(what):
        parts.append(class_of(name, what))
    elif not name.startswith("_"):
        parts.append(function(name, what.__doc__))
with open(os.path.join(sys.argv[1], "gridshell.pyi"), "w", encoding="utf-8") as file:
    file.write("\n".join(parts))
