"""Small parts of documents by themselves: marks of axes, digits, steps, and lines that only some machines have."""

import pytest

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from schemas.answer.alternatives import Alternative
from schemas.request.picture import PictureStyle
from schemas.request.report import ReportRequest
from schemas.request.requests import AnalyzeRequest
from service.drawings.svg import Drawing
from service.report.accuracy_picture import _steps
from service.report.blocks import Number, Table, _upwards
from service.report.chapters.alternatives import alternatives
from service.report.chapters.answers import analyzed, optimized
from service.report.charts import axis
from service.report.document import report
from service.report.html import html
from service.report.pictures import styled
from tests.optimize.shafts import shaft, single
from tests.report_document.conftest import AT, request_of


@pytest.mark.parametrize(
    ("low", "high", "marks"),
    [
        (0.0, 10.0, [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]),
        (-3.0, 17.0, [-5.0, 0.0, 5.0, 10.0, 15.0, 20.0]),
        (0.02, 0.1, [0.0, 0.02, 0.04, 0.06, 0.08, 0.1]),
        (0.0, 0.0, [-1.0, -0.5, 0.0, 0.5, 1.0]),
    ],
)
def test_marks_of_an_axis_are_round_and_around_the_values(low: float, high: float, marks: list[float]) -> None:
    """Analytic."""
    first, last, values = axis(low, high)
    assert values == pytest.approx(marks)
    assert (first, last) == (pytest.approx(marks[0]), pytest.approx(marks[-1]))


@pytest.mark.parametrize(
    ("figure", "digit"), [(0.00123, 0.002), (0.002, 0.002), (95.0, 100.0), (1.0, 1.0), (31.0, 40.0)]
)
def test_one_digit_is_never_smaller(figure: float, digit: float) -> None:
    """Analytic."""
    assert _upwards(figure) == pytest.approx(digit, rel=1e-12)


def test_what_is_reached_stays_until_something_better_is() -> None:
    """Analytic."""
    steps = list(_steps([(1.0, 0.1), (2.0, 0.01), (5.0, 0.001)]))
    assert steps == [(1.0, 0.1), (2.0, 0.1), (2.0, 0.01), (5.0, 0.01), (5.0, 0.001)]


def test_a_title_stands_above_the_drawing() -> None:
    drawing = Drawing(200.0, 100.0, "a plot")
    actual_drawing = styled(drawing, PictureStyle(title="Loads"))
    assert actual_drawing.width == drawing.width
    assert actual_drawing.height > drawing.height
    assert styled(drawing, PictureStyle(width_px=400)).height == drawing.height


def test_only_a_machine_with_balance_shafts_has_their_mass() -> None:
    line = b"total mass on the balance shafts"
    body = {"machine": single([shaft("back", -1)])}
    assert line in html(report(ReportRequest.model_validate(body), AT))
    assert line not in html(report(request_of("2d12"), AT))


@pytest.mark.parametrize(("best", "above"), [(0.5, "20 %"), (60.0, "20 %"), (0.0, "0 %")])
def test_a_cheaper_choice_is_compared_with_the_best_however_small(best: float, above: str) -> None:
    """Analytic: 1.2 of the best is 20 % above it; beside a best of nothing there is no share."""
    answer = optimize(request_of("2d12").alone)
    assert answer.certificate is not None
    alternative = Alternative.model_validate(
        {
            "minimised": "pieces",
            "allowance": 0.3,
            "objective": 1.2 * best,
            "total_mass_kg": 41.0,
            "pieces": 2,
            "sizes": 1,
            "lower_bound": 2.0,
            "counterweights": [],
        }
    )
    certificate = answer.certificate.model_copy(update={"objective": best})
    variant = answer.model_copy(update={"certificate": certificate, "alternatives": (alternative,)})
    ((_, block),) = (chapter.blocks for chapter in alternatives(variant))
    assert isinstance(block, Table)
    (row,) = block.rows
    assert [cell.text if isinstance(cell, Number) else cell for cell in row] == [
        "fewest counterweights", "30 %", above, "41", "2", "1", "2", "",
    ]  # fmt: skip


@pytest.mark.parametrize("outputs", [[], ["stages"]])
def test_stages_are_shown_where_they_are_asked_for(outputs: list[str]) -> None:
    request = request_of("2d12", outputs=outputs).alone
    titles = [chapter.title for chapter in optimized(request, optimize(request))]
    assert ("The eight balancing stages" in titles) == bool(outputs)
    assert len(titles) == len(set(titles))


@pytest.mark.parametrize("outputs", [["residual"], ["residual", "stages"]])
def test_stages_of_what_is_analyzed_are_shown_where_they_are_asked_for(outputs: list[str]) -> None:
    machine = request_of("2d12").alone.machine
    request = AnalyzeRequest.model_validate({"machine": machine, "counterweights": [], "outputs": outputs})
    titles = [chapter.title for chapter in analyzed(request, analyze(request))]
    assert titles.count("The eight balancing stages") == len(outputs) - 1
