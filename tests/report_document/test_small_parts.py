"""Small parts of documents by themselves: marks of axes, digits, steps, and lines that only some machines have."""

import pytest

from schemas.request.picture import PictureStyle
from schemas.request.report import ReportRequest
from service.drawings.svg import Drawing
from service.report.accuracy_picture import _steps
from service.report.blocks import _upwards
from service.report.charts import axis
from service.report.document import report
from service.report.html import html
from service.report.pictures import styled
from tests.optimize.shafts import shaft, single
from tests.report_document.conftest import AT, asked


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
    first, last, found = axis(low, high)
    assert found == pytest.approx(marks)
    assert (first, last) == (pytest.approx(marks[0]), pytest.approx(marks[-1]))


@pytest.mark.parametrize(
    ("value", "digit"), [(0.00123, 0.002), (0.002, 0.002), (95.0, 100.0), (1.0, 1.0), (31.0, 40.0)]
)
def test_one_digit_is_never_smaller(value: float, digit: float) -> None:
    """Analytic."""
    assert _upwards(value) == pytest.approx(digit, rel=1e-12)


def test_what_is_reached_stays_until_something_better_is() -> None:
    """Analytic."""
    steps = list(_steps([(1.0, 0.1), (2.0, 0.01), (5.0, 0.001)]))
    assert steps == [(1.0, 0.1), (2.0, 0.1), (2.0, 0.01), (5.0, 0.01), (5.0, 0.001)]


def test_a_title_stands_above_the_drawing() -> None:
    drawing = Drawing(200.0, 100.0, "a plot")
    made = styled(drawing, PictureStyle(title="Loads"))
    assert made.width == drawing.width
    assert made.height > drawing.height
    assert styled(drawing, PictureStyle(width_px=400)).height == drawing.height


def test_only_a_machine_with_balance_shafts_has_their_mass() -> None:
    line = b"total mass on the balance shafts"
    body = {"machine": single([shaft("back", -1)])}
    assert line in html(report(ReportRequest.model_validate(body), AT))
    assert line not in html(report(asked("2d12"), AT))
