"""What the files of the workbench are allowed to be."""

import ast
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.freecad.freecad import ROOT, WORKBENCH

PACKAGE = WORKBENCH / "freecad" / "counterweight"
FILES = sorted(WORKBENCH.rglob("*.py"))
PURE = {"__init__", "asking", "first_order", "moments", "plate", "service", "sheets", "verdict"}
WINDOW = {"init_gui", "commands", "panel"}
OF_FREECAD = {"FreeCAD", "Part", "Import"}


def imports(file: Path) -> set[str]:
    nodes = list(ast.walk(ast.parse(file.read_text())))
    found = {alias.name.partition(".")[0] for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    return found | {
        str(node.module).partition(".")[0] for node in nodes if isinstance(node, ast.ImportFrom) and not node.level
    }


def test_the_client_is_that_of_the_examples_byte_for_byte() -> None:
    assert (PACKAGE / "service.py").read_bytes() == (ROOT / "examples" / "client" / "counterweight.py").read_bytes()


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_nothing_but_the_standard_library_is_imported(file: Path) -> None:
    allowed = set(sys.stdlib_module_names) - {"tomllib", "zoneinfo", "graphlib"}
    if file.stem not in PURE:
        allowed |= OF_FREECAD | {"freecad"}
    if file.stem in WINDOW:
        allowed |= {"FreeCADGui", "PySide"}
    assert imports(file) <= allowed


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_the_grammar_is_that_of_python_3_8(file: Path) -> None:
    """That of the oldest bundle of FreeCAD 0.20."""
    assert ast.parse(file.read_text(), feature_version=(3, 8)).body


def test_the_metadata_names_what_there_is() -> None:
    root = ElementTree.parse(WORKBENCH / "package.xml").getroot()
    name = {"p": "https://wiki.freecad.org/Package_Metadata"}
    icon = root.findtext("p:icon", namespaces=name)
    assert icon is not None
    assert (WORKBENCH / icon).stat().st_size <= 10_000
    assert root.findtext("p:content/p:workbench/p:classname", namespaces=name) == "CounterweightWorkbench"
