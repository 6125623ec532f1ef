"""Docstrings list parameters and fields that are there: a name that has changed has changed in both places."""

import ast
import re
from collections.abc import Iterator

import pytest

from tests.docs.reading import ROOT

FOLDERS = ("deploy", "docs", "examples", "optimizer", "schemas", "service", "tests")
#: names of one entry of a list
_ENTRY = re.compile(r"^((?:\*{0,2}\w+, )*\*{0,2}\w+) : ", re.MULTILINE)

#: as it stands in a file
_LISTED = re.compile(r"^ +(\*{0,2}\w+, )*\*{0,2}\w+ : ", re.MULTILINE)


def parameters(node: ast.FunctionDef | ast.AsyncFunctionDef) -> set[str]:
    every = node.args
    extra = [arg for arg in (every.vararg, every.kwarg) if arg is not None]
    return {arg.arg for arg in [*every.posonlyargs, *every.args, *every.kwonlyargs, *extra]}


def fields(node: ast.ClassDef) -> set[str]:
    """Fields and attributes of a class, and the parameters that make an object of it."""
    annotated = [part.target for part in node.body if isinstance(part, ast.AnnAssign)]
    fields = {target.id for target in annotated if isinstance(target, ast.Name)}
    attributes = {part.attr for part in ast.walk(node) if isinstance(part, ast.Attribute)}
    functions = [part for part in node.body if isinstance(part, ast.FunctionDef)]
    making = {name for part in functions if part.name == "__init__" for name in parameters(part)}
    return fields | attributes | making | {part.name for part in functions}


def absent(source: str) -> Iterator[str]:
    """What docstrings list as parameters or fields, and the code does not have."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            there = parameters(node)
            section = (ast.get_docstring(node) or "").partition("Parameters\n----------\n")[2]
            listed = re.split(r"^\w+\n-+$", section, flags=re.MULTILINE)[0]
        elif isinstance(node, ast.ClassDef):
            there, listed = fields(node), ast.get_docstring(node) or ""
        else:
            continue
        for entry in _ENTRY.findall(listed):
            yield from (name for name in entry.split(", ") if name.lstrip("*") not in there)


def test_what_a_docstring_lists_is_there() -> None:
    files = [file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*.py"))]
    assert len(files) > 1200
    # most list nothing, and are not parsed
    texts = {file.relative_to(ROOT).as_posix(): file.read_text() for file in files}
    lists = {name: text for name, text in texts.items() if _LISTED.search(text)}
    assert len(lists) > 200
    assert {(file, name) for file, text in lists.items() for name in absent(text)} == set()


_FUNCTION = 'def area({}):\n    """Of it.\n\n    Parameters\n    ----------\n    {} : its side.\n    """'
_CLASS = 'class Area:\n    """Of it.\n\n    mm : its side.\n    cm : its side.\n    """\n    mm: float'
_RESULT = 'def area():\n    """Of it.\n\n    Returns\n    -------\n    cm : area.\n    """'


@pytest.mark.parametrize(
    ("source", "names"),
    [(_FUNCTION.format("mm", "mm, cm"), ["cm"]), (_FUNCTION.format("*mm", "*mm"), []), (_CLASS, ["cm"]), (_RESULT, [])],
)
def test_a_name_that_is_not_there_is_seen(source: str, names: list[str]) -> None:
    assert list(absent(source)) == names
