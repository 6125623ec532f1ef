"""A fault put into functions that are loaded already: nothing is imported again."""

import ast
import gc
from collections.abc import Iterator
from inspect import CO_OPTIMIZED
from pathlib import Path
from types import CodeType, FunctionType
from typing import NamedTuple

#: file, name and first line of a function
_Place = tuple[str, str, int]


class Functions(NamedTuple):
    """Functions by their places, several where one is made again; and those that importing has called."""

    alive: dict[_Place, list[FunctionType]]
    called: frozenset[_Place]


def functions(files: set[str], called: set[CodeType]) -> Functions:
    """Functions of some files that are alive."""
    alive: dict[_Place, list[FunctionType]] = {}
    gc.unfreeze()
    for single_object in gc.get_objects():
        if isinstance(single_object, FunctionType) and single_object.__code__.co_filename in files:
            alive.setdefault(_place(single_object.__code__), []).append(single_object)
    gc.collect()
    gc.freeze()
    return Functions(alive, frozenset(map(_place, called)))


def patched(functions: Functions, path: Path, original: str, text: str) -> bool:
    """Gives functions of a file the code of another text of it; False where that has to be imported.

    It has to be where a module or a class does something else, such as a table or a default, or calls what does.
    """
    # the text has been written anew: of a statement on several lines other code is made
    anew = ast.unparse(ast.parse(original))
    before, same, after = (list(_codes(compile(text, str(path), "exec"))) for text in (original, anew, text))
    if [code_type.co_qualname for code_type in before] != [code_type.co_qualname for code_type in after]:
        return False
    changed = [old for old, as_new, new in zip(before, same, after, strict=True) if _does(as_new) != _does(new)]
    if not changed or any(not old.co_flags & CO_OPTIMIZED or _place(old) in functions.called for old in changed):
        return False
    every = [
        (function_type, new)
        for old, new in zip(before, after, strict=True)
        for function_type in functions.alive.get(_place(old), [])
        if old.co_flags & CO_OPTIMIZED
    ]
    if any(function_type.__code__.co_freevars != new.co_freevars for function_type, new in every):
        return False
    for single_type, new in every:
        single_type.__code__ = new
    return True


def _place(code: CodeType) -> _Place:
    return code.co_filename, code.co_qualname, code.co_firstlineno


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for co_const in code.co_consts:
        if isinstance(co_const, CodeType):
            yield from _codes(co_const)


def _does(code: CodeType) -> tuple[object, ...]:
    """What a code does, without what is defined inside, its lines and its texts."""
    consts = [repr(co_const) for co_const in code.co_consts if not isinstance(co_const, CodeType | str)]
    return code.co_code, code.co_names, code.co_varnames, code.co_freevars, consts
