"""What the image does without: the list, and what removes it. `make image-check` runs what is left."""

import subprocess
import sys
from importlib.metadata import distribution, version
from pathlib import Path

import pytest
from markupsafe import _speedups as speedups

from schemas.base.version import DISTRIBUTION
from tests.deploy.files import DEPLOY, instructions, module
from tests.deploy.test_requirements import locked

pruning = module(DEPLOY / "prune.py")
UNUSED: dict[str, str] = pruning.entries((DEPLOY / "unused.txt").read_text("utf-8"))


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """A folder of two packages, as pip leaves them."""
    site = tmp_path / "lib" / "site-packages"
    for name, files in {
        "one": ["one/__init__.py", "one/tests/test_one.py", "one/tests/data/large.csv", "../../bin/one"],
        "two": ["two/__init__.py", "two.libs/two.so"],
    }.items():
        for file in files:
            (site / file).parent.mkdir(parents=True, exist_ok=True)
            (site / file).write_bytes(bytes(100))
        path = site / f"{name}-1.0.dist-info"
        path.mkdir()
        (path / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
        listed = [*files, f"{path.name}/METADATA", f"{path.name}/RECORD"]
        (path / "RECORD").write_text("".join(f"{file},sha256=x,100\n" for file in listed))
    return site


def left(site: Path) -> set[str]:
    return {path.relative_to(site.parents[1]).as_posix() for path in site.parents[1].rglob("*")}


def test_files_go_with_their_folders_and_out_of_the_list(site: Path) -> None:
    assert pruning.prune(site, ["**/tests/"]) == {"**/tests/": 200}
    assert "lib/site-packages/one" in left(site)
    assert "lib/site-packages/one/tests" not in left(site)
    listed = (site / "one-1.0.dist-info" / "RECORD").read_text()
    assert listed == (
        "one/__init__.py,sha256=x,100\n../../bin/one,sha256=x,100\n"
        "one-1.0.dist-info/METADATA,sha256=x,100\none-1.0.dist-info/RECORD,sha256=x,100\n"
    )


def test_a_package_goes_with_its_commands_and_its_entry(site: Path) -> None:
    before = left(site)
    pruning.prune(site, ["one"])
    gone = before - left(site)
    assert gone == {path for path in before if "one" in path}
    assert {"bin/one", "lib/site-packages/one-1.0.dist-info"} <= gone


def test_what_is_named_twice_is_counted_once(site: Path) -> None:
    freed = pruning.prune(site, ["one/tests/", "one/tests/data/*.csv"])
    assert list(freed.values()) == [200, 0]


@pytest.mark.parametrize("name", ["three", "one/docs/", "one"])
def test_nothing_is_removed_when_a_line_finds_nothing(site: Path, name: str) -> None:
    if name == "one":
        pruning.prune(site, ["one"])
    before = left(site)
    with pytest.raises(FileNotFoundError, match=rf"found by {name}$"):
        pruning.prune(site, ["two", name])
    assert left(site) == before


def test_a_library_without_its_symbols_works_as_before(tmp_path: Path) -> None:
    whole = Path(str(speedups.__file__))
    bare = tmp_path / whole.name
    bare.write_bytes(whole.read_bytes())
    freed = pruning.strip(bare)
    assert freed > 0
    assert bare.stat().st_size == whole.stat().st_size - freed
    assert pruning.strip(bare) == 0
    code = f"""
import importlib.util
spec = importlib.util.spec_from_file_location("markupsafe._speedups", {str(bare)!r})
module = importlib.util.module_from_spec(spec)
spec.loader.exec_module(module)
print(module._escape_inner("<a & b>"))
"""
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=True)
    assert ran.stdout == "&lt;a &amp; b&gt;\n"


def test_a_library_that_is_linked_elsewhere_stays_there_as_it_is(tmp_path: Path) -> None:
    """As in an environment whose files are links to where an installer keeps them."""
    whole, linked = tmp_path / "whole.so", tmp_path / "linked.so"
    whole.write_bytes(Path(str(speedups.__file__)).read_bytes())
    before = whole.read_bytes()
    linked.hardlink_to(whole)
    assert pruning.strip(linked) > 0
    assert whole.read_bytes() == before


@pytest.mark.parametrize("content", [b"", b"\x7fELF", b"\x7fELF\x01\x01" + bytes(100), b"GROUP ( libc.so.6 )"])
def test_what_is_no_such_library_stays_as_it_is(tmp_path: Path, content: bytes) -> None:
    file = tmp_path / "other.so"
    file.write_bytes(content)
    assert pruning.strip(file) == 0
    assert file.read_bytes() == content


def test_each_line_has_a_reason() -> None:
    assert UNUSED
    assert {name for name, reason in UNUSED.items() if not reason} == set()


def test_packages_that_go_are_ones_of_the_image() -> None:
    packages = {name for name in UNUSED if "/" not in name}
    assert packages <= set(locked(DEPLOY / "requirements.txt"))


@pytest.mark.parametrize("name", [name for name in UNUSED if "/" not in name])
def test_packages_that_go_are_not_needed_by_what_the_project_names(name: str) -> None:
    """Packages of `dependencies` stay; those that go are what they bring along."""
    needed = {line.split(">")[0].split("[")[0].lower() for line in distribution(DISTRIBUTION).requires or []}
    assert name not in needed


@pytest.mark.parametrize("name", [name for name in UNUSED if "/" in name])
def test_each_pattern_finds_files_of_the_locked_versions(name: str) -> None:
    package = name.split("/")[0].lower()
    if package != "**":
        assert version(package) == locked(DEPLOY / "requirements.txt")[package]
    site = Path(str(distribution("pyarrow").locate_file("")))
    assert next(site.glob(name), None) is not None


def test_the_image_is_asked_for_what_is_missing_before_and_computes_after() -> None:
    runs = [rest for kind, rest in instructions() if kind == "RUN"]
    (checked,) = (at for at, rest in enumerate(runs) if "deploy/check.sh" in rest)
    (pruned,) = (at for at, rest in enumerate(runs) if "prune.py" in rest)
    (computed,) = (at for at, rest in enumerate(runs) if "counterweight optimize " in rest)
    assert checked < pruned < computed
