"""docs/python.md: what stands there runs and prints what stands below it; the public names are those in its table."""

import contextlib
import io
import re
import subprocess
import sys
from importlib import import_module
from typing import Any

import pytest

import optimizer
import schemas
from optimizer.optimize import optimize
from schemas.request.requests import OptimizeRequest
from service.documents.examples import bodies
from tests.docs.reading import ROOT

TEXT = (ROOT / "docs" / "python.md").read_text()


def test_the_examples_print_what_stands_below_them() -> None:
    names: dict[str, Any] = {}
    matches = re.findall(r"```python\n(.*?)```\n\n```text\n(.*?)```", TEXT, re.DOTALL)
    assert len(matches) == TEXT.count("```python")
    for code, output in matches:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(code, names)
        assert printed.getvalue() == output


def test_the_public_names() -> None:
    """Regression: what notebooks import; names may be added, none goes."""
    assert optimizer.__all__ == [
        "MissingInput",
        "accuracy",
        "analyze",
        "catalogue",
        "match",
        "optimize",
        "pareto",
        "pin_loads",
        "rate",
        "round_weights",
        "sweep_table",
    ]
    assert schemas.__all__ == [
        "AccuracyAnswer",
        "AccuracyRequest",
        "AnalyzeAnswer",
        "AnalyzeRequest",
        "MatchAnswer",
        "MatchRequest",
        "OptimizeAnswer",
        "OptimizeRequest",
        "ParetoAnswer",
        "ParetoRequest",
        "PinLoadsAnswer",
        "PinLoadsRequest",
        "RatingAnswer",
        "RatingRequest",
        "ReciprocatingMachine",
        "RoundAnswer",
        "RoundRequest",
        "ScrollMachine",
        "SweepRequest",
        "VerifyAnswer",
        "VerifyRequest",
    ]


@pytest.mark.parametrize("package", [optimizer, schemas], ids=lambda package: package.__name__)
def test_every_public_name_is_there_whatever_was_loaded_before(package: Any) -> None:
    for name in package.__all__:
        value = getattr(package, name)
        assert value.__name__ == name
        assert value.__doc__
    # files of the same name do not hide the functions, and are still files
    assert optimizer.optimize is optimize
    assert import_module("optimizer.optimize").optimize is optimize
    with pytest.raises(AttributeError, match="nothing"):
        _ = package.nothing


def test_the_table_names_the_functions_with_their_models() -> None:
    rows = re.findall(r"^\| `(\w+)` \| (?:`(\w+)`)? ?\| (?:`(\w+)`|.*) \|$", TEXT, re.MULTILINE)
    assert {name for name, _, _ in rows} == set(optimizer.__all__) - {"MissingInput"}
    assert {name for _, *models in rows for name in models if name} <= set(schemas.__all__)


def test_importing_loads_nothing_that_takes_long() -> None:
    code = "import sys, optimizer, schemas; print(sorted({'numpy', 'numba', 'pydantic', 'pyarrow'} & set(sys.modules)))"
    ran = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_the_first_function_loads_neither_compiler_nor_sparse_matrices() -> None:
    code = (
        "import sys; from optimizer import optimize; "
        "print(sorted({'numba', 'scipy', 'pyarrow', 'cvxpy', 'clarabel'} & set(sys.modules)))"
    )
    ran = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "[]"


def test_an_answer_shows_itself_in_a_notebook() -> None:
    answer = optimize(OptimizeRequest.model_validate(bodies("")["2d12"]))
    words = answer._repr_html_()
    assert words.count("<table>") == words.count("</table>") > 5
    for text in ("<th>status</th><td>optimal</td>", "<th>lower_bound</th>", "<td>1a</td><td>60</td><td>180</td>"):
        assert text in words
    # what is null is left out, and texts are no HTML
    assert "None" not in words
    assert "&lt;b&gt;" in answer.model_copy(update={"status_reason": "<b>"})._repr_html_()
