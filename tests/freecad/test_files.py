"""What the files of the workbench are allowed to be."""

import ast
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.freecad.freecad import CLIENT, WORKBENCH, packed

FILES = sorted(WORKBENCH.rglob("*.py"))
PURE = {
    "__init__", "asking", "first_order", "moments", "plate", "plausible", "quantities", "service", "shaft", "sheets",
    "verdict",
}  # fmt: skip
WINDOW = {"init_gui", "commands", "panel"}
OF_FREECAD = {"FreeCAD", "Part", "Import"}


def imports(file: Path) -> set[str]:
    nodes = list(ast.walk(ast.parse(file.read_text())))
    parts = {alias.name.partition(".")[0] for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    return parts | {
        str(node.module).partition(".")[0] for node in nodes if isinstance(node, ast.ImportFrom) and not node.level
    }


def client_of(workbench: Path) -> Path:
    """Where a workbench has its client from, in an interpreter that knows nothing else."""
    show = "import freecad.counterweight.asking, freecad.counterweight.counterweight as c; print(c.__file__)"
    process = subprocess.run(
        [sys.executable, "-I", "-B", "-c", f"import sys; sys.path.insert(0, {str(workbench)!r}); {show}"],
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    return Path(process.stdout.strip())


def test_in_a_checkout_the_client_is_that_of_the_examples(tmp_path: Path) -> None:
    assert client_of(WORKBENCH).resolve() == CLIENT
    linked = tmp_path / "Mod" / "Counterweight"
    linked.parent.mkdir()
    linked.symlink_to(WORKBENCH)
    assert client_of(linked).resolve() == CLIENT
    # there is no second one
    assert [path for path in FILES if path.read_bytes() == CLIENT.read_bytes()] == []


def test_packed_the_client_is_built_in(tmp_path: Path) -> None:
    workbench = packed(tmp_path)
    client = client_of(workbench)
    assert client.is_relative_to(workbench)
    assert client.read_bytes() == CLIENT.read_bytes()
    first = (tmp_path / "Counterweight.zip").read_bytes()
    packed(tmp_path)
    assert (tmp_path / "Counterweight.zip").read_bytes() == first


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_nothing_but_the_standard_library_is_imported(file: Path) -> None:
    allowed = set(sys.stdlib_module_names) - {"tomllib", "zoneinfo", "graphlib"}
    if file.stem == "service":
        allowed.add("counterweight")
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
