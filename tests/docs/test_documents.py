"""What the documents show is what the package does today."""

import re
import shlex
import subprocess
from pathlib import Path

import pytest
from typer.testing import CliRunner

from optimizer.optimize import optimize
from optimizer.studies.pareto.pareto import pareto
from schemas.front.pareto import ParetoRequest
from schemas.request.requests import OptimizeRequest
from service.cli import app
from service.documents.examples import bodies
from tests.docs.reading import ROOT, agrees, blocks

DOCUMENTS = [
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    *sorted(str(path.relative_to(ROOT)) for path in (ROOT / "docs").rglob("*.md")),
]
COMMANDS = {command.name or command.callback.__name__ for command in app.registered_commands if command.callback}
GROUPS = {group.name for group in app.registered_groups}


def document(name: str) -> str:
    return (ROOT / name).read_text()


def code(name: str) -> str:
    """What a document shows as code."""
    return "\n".join(re.findall(r"```sh\n(?:.|\n)*?```|`[^`\n]+`|^    .+$", document(name), re.MULTILINE))


def readme() -> str:
    return document("README.md")


def test_the_answer_in_the_readme() -> None:
    (block,) = blocks(readme())
    agrees(block, optimize(OptimizeRequest.model_validate(bodies("")["2d12"])).model_dump(mode="json"))


def test_the_call_in_the_readme(url: str) -> None:
    (call,) = re.findall(r"^    (curl .+)$", readme(), re.MULTILINE)
    command = ["bash", "-c", call.replace("http://127.0.0.1:8000", url)]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=180, check=True)
    assert '"status":"optimal"' in ran.stdout


#: what the README writes below a command's name, as it stands there, without what it says of it
README_COMMANDS = [
    shlex.split(line, comments=True)
    for line in re.findall(r"^    \.venv/bin/counterweight (.+)$", readme(), re.MULTILINE)
]
#: what only looks at how long it would take, where the whole is for the night
_BRIEF = {"sweep": "--dry-run"}


def test_the_commands_in_the_readme(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _follow(tmp_path, monkeypatch, [[*words, *_BRIEF.get(words[0], "").split()] for words in README_COMMANDS])
    assert (tmp_path / "report.html").stat().st_size > 0


@pytest.mark.nightly
def test_the_commands_in_the_readme_as_they_stand(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _follow(tmp_path, monkeypatch, README_COMMANDS)
    for name in ("grid.parquet", "report.html"):
        assert (tmp_path / name).stat().st_size > 0, name


def _follow(place: Path, monkeypatch: pytest.MonkeyPatch, commands: list[list[str]]) -> None:
    """Run one after the other, in this process, where the examples are."""
    (place / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(place)
    assert len(commands) > 10
    for words in commands:
        texts, into = (words[:-2], words[-1]) if words[-2:-1] == [">"] else (words, None)
        ran = CliRunner().invoke(app, texts)
        assert ran.exit_code == 0, f"{words}\n{ran.stdout}{ran.stderr}{ran.exception}"
        if into is not None:
            (place / into).write_text(ran.stdout)


def test_the_readme_counts_the_examples_right() -> None:
    count = re.search(r"(\d+) machines to start from", readme())
    assert count is not None
    assert int(count[1]) == len(bodies(""))


def test_the_readme_names_folders_that_are_there() -> None:
    folders = re.findall(r"^\| (`[^|]*/[^|]*) \|", readme(), re.MULTILINE)
    parent = ROOT
    for name in [name for row in folders for name in re.findall(r"`(.+?)`", row)]:
        # in a list the first names the folder of the others
        here = ROOT / name if (ROOT / name).exists() else parent / name
        assert here.exists(), name
        parent = here.parent


def test_the_front_of_the_2d12() -> None:
    """Regression: the figures of docs/pareto.md, to the digits shown."""
    rows = re.findall(r"^\| *(\d*) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", document("docs/pareto.md"), re.MULTILINE)
    budgets = [float(budget) for budget, *_ in rows if budget]
    request = {**bodies("")["2d12"], "points": 5, "total_mass_budgets_kg": budgets}
    answer = pareto(ParetoRequest.model_validate(request))
    (block,) = blocks(document("docs/pareto.md"))
    agrees(block, answer.fronts[-1].points[2].model_dump(mode="json"))
    points = [point for front in answer.fronts for point in front.points]
    for (_, *value), point in zip(rows, points, strict=True):
        figures = (point.force_peak_N, point.moment_peak_Nm, point.total_mass_kg)
        for text, figure in zip(value, figures, strict=True):
            assert figure == pytest.approx(float(text), rel=0, abs=10.0 ** -len(text.partition(".")[2])), text


def test_an_engine_whose_masses_are_off() -> None:
    """Regression: the figures of docs/tolerances.md, to the digits shown."""
    text = document("docs/tolerances.md")
    rows = re.findall(r"^\| *(\d+) \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$", text, re.MULTILINE)
    assert len(rows) == 4
    (block,) = blocks(text)
    for percent, *figures in rows:
        body = bodies("")["inline-four-engine"] | {
            "objective": {"force_weight": 0, "moment_weight": 0, "bearing_weight": 1},
            "tolerances": {"reciprocating_mass_relative": float(percent) / 100.0},
            "accuracy": {"time_limit_s": 30},
        }
        answer = optimize(OptimizeRequest.model_validate(body))
        assert answer.worst_case is not None
        price = answer.price_of_robustness
        assert price is not None
        costs = (answer.worst_case.bearing_peak_N, price.nominal_optimum_worst_case, price.nominal)
        # optima may differ by a millionth of what is there without counterweights, and what is bought with it by more
        assert costs == pytest.approx([float(figure) for figure in figures], rel=1e-4)
        if percent == "2":
            agrees(block, answer.model_dump(mode="json"))


@pytest.mark.parametrize("name", DOCUMENTS)
def test_links_lead_somewhere(name: str) -> None:
    for target in re.findall(r"\]\(([^)#]+)\)", document(name)):
        assert ((ROOT / name).parent / target).exists(), target


@pytest.mark.parametrize("name", DOCUMENTS)
def test_commands_are_there(name: str) -> None:
    targets = (ROOT / "Makefile").read_text().split(".PHONY:")[1].split("\n")[0].split()
    assert {*re.findall(r"\bmake ([a-z]+)(?=[ `\n])", code(name))} <= set(targets)
    assert {*re.findall(r"(?:^ *|`|/bin/)counterweight ([a-z-]+)", code(name), re.MULTILINE)} <= COMMANDS | GROUPS


def test_every_long_command_of_the_tests_is_run_at_night() -> None:
    """Those that can be started by themselves and print what they found; the others serve, or write a record."""
    (listed,) = re.findall(r"^long := ((?:.*\\\n)*.*)", document("Makefile"), re.MULTILINE)
    texts = {
        ".".join(path.relative_to(ROOT).with_suffix("").parts)
        for folder in ("choices", "hard", "hard_effects", "jobs", "network", "verification")
        for path in (ROOT / "tests" / folder).glob("*.py")
        if 'if __name__ == "__main__"' in path.read_text() and not path.name.startswith(("test_", "__"))
    }
    lines = {"tests.jobs.serving", "tests.jobs.held", "tests.network.limited", "tests.verification.recorded"}
    assert set(listed.replace("\\", "").split()) == texts - lines


def test_the_mathematics_names_files_that_are_there() -> None:
    """With their path, or beside the last file that had one."""
    names = {path.name for path in (ROOT / "optimizer").rglob("*.py")}
    chapters = sorted((ROOT / "docs" / "mathematics").glob("*.md"))
    assert len(chapters) > 5
    for name in re.findall(r"`([\w/]+\.py)`", "\n".join(path.read_text() for path in chapters)):
        places = [ROOT, ROOT / "optimizer"]
        assert any((place / name).exists() for place in places) or ("/" not in name and name in names), name


#: of a text, what it tells to install from a package index: up to the end of the line, of a string or of code
_INSTALLED = re.compile(r"pip3? +(?:--\S+ +\S+ +)?install +([^\n`\"]*)")


def test_nothing_is_installed_by_a_name_that_is_not_ours() -> None:
    """The name `counterweight` belongs to another project on the public index."""
    suffixes = {".py", ".md", ".sh", ".yaml", ".html", ".js", ".toml", ".service", ""}
    folders = ("schemas", "optimizer", "service", "docs", "deploy", "examples")
    files = [path for folder in folders for path in (ROOT / folder).rglob("*") if path.suffix in suffixes]
    texts = {
        path: path.read_text("utf-8") for path in [*files, ROOT / "README.md", ROOT / "Makefile"] if path.is_file()
    }
    values = [(path, line) for path, text in texts.items() for line in _INSTALLED.findall(text)]
    assert len(values) > 5
    for path, line in values:
        assert not re.search(r"(^|[ '\"])counterweight([ '\"\[=<>~!]|$)", line), (path, line)
    # nor is an extra named by it
    assert [path for path, text in texts.items() if re.search(r"\bcounterweight\[[a-z]", text)] == []
