"""The modules of the page as one file, so that a first visit needs one request and not seventy.

Every module becomes a function that returns what it exports, after those that it imports. Only what our modules use is
understood, imports and exports by name, a line each; anything else is refused. Comments stay in the folder, a seventh
of what would be sent. Nothing else is changed: what a browser runs is what can be read there.
"""

import re
from pathlib import Path
from posixpath import dirname, join, normpath

_IMPORT = re.compile(r'^import \{ ([\w$ ,]+) \} from "(\.[\w./]+)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:const|class|(?:async )?function\*?) ([\w$]+))", re.MULTILINE)
_OTHER = re.compile(r"^(?:import|export)\b.*|\bimport\(.*", re.MULTILINE)
# types are for the checker alone
_NOTE = re.compile(r"/\*\*.*?\*/", re.DOTALL)


# lines that hold nothing else; after a statement a comment stays
_COMMENT = re.compile(r"^[ \t]*(?://[^\n]*|/\*\*.*?\*/)[ \t]*\n", re.MULTILINE | re.DOTALL)


class UnknownStatement(ValueError):
    """A module imports or exports in a way that is not understood here."""


class CircularImport(ValueError):
    """Modules that need one another have no order."""


def bundle(folder: Path, entry: str) -> str:
    """One module that does what the one of this name does with all that it imports.

    Raises
    ------
    UnknownStatement
        if a module imports or exports otherwise than by name, in a line each.
    CircularImport
        if there is a module that needs itself.
    """
    modules: dict[str, str] = {}
    _write(folder, entry, modules, ())
    return "".join(modules.values())


def _write(folder: Path, name: str, modules: dict[str, str], around: tuple[str, ...]) -> None:
    if name in around:
        raise CircularImport(" needs ".join((*around[around.index(name) :], name)))
    if name in modules:
        return
    text = (folder / name).read_text(encoding="utf-8")
    for _, needed in _IMPORT.findall(text):
        _write(folder, _beside(name, needed), modules, (*around, name))
    numbers = {module_name: number for number, module_name in enumerate(modules)}
    exported = _EXPORT.findall(text)
    inside = _EXPORT.sub("", _COMMENT.sub("", text))
    inside = _IMPORT.sub(
        lambda match: f"const {{ {match[1].replace(' as ', ': ')} }} = module{numbers[_beside(name, match[2])]};",
        inside,
    )
    rest = _OTHER.search(_NOTE.sub("", inside))
    if rest:
        raise UnknownStatement(f"{name}: {rest[0]}")
    modules[name] = (
        f"// {name}\nconst module{len(modules)} = (() => {{\n{inside}return {{ {', '.join(exported)} }};\n}})();\n"
    )


def _beside(name: str, needed: str) -> str:
    """The name of a module, from the path at which another one knows it."""
    return normpath(join(dirname(name), needed))
