"""What documents and tables say of balance shafts: no weight is left out, and a mass is that of all shafts."""

from typing import Any

import pytest

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from schemas.answer.counterweights import every_counterweight
from schemas.request.report import ReportRequest
from schemas.request.requests import AnalyzeRequest, OptimizeRequest
from service.report.blocks import Number, Table, number
from service.report.chapters.answers import analyzed
from service.report.chapters.versions import compared
from service.tables.as_built import required, residual
from service.tables.order import order
from service.tables.whole_mass import whole_mass
from tests.optimize.shafts import shaft, single

#: analytic: half of the reciprocating mass on either shaft, at the crank radius and at half of it
OWN, BESIDE = 5.0, 10.0
MACHINE = single([shaft("back", -1, radius=0.05)])


def _request(**more: Any) -> OptimizeRequest:
    return OptimizeRequest.model_validate({"machine": MACHINE, **more})


def test_the_order_for_a_workshop_holds_what_goes_on_balance_shafts() -> None:
    answer = optimize(_request())
    rows = order(answer)
    assert [row[3] for row in rows] == ["back web", "a"]
    assert [row[0] for row in rows] == pytest.approx([BESIDE, OWN], rel=1e-5)
    # a balance shaft has no crank
    assert rows[0][4] is None
    assert rows[0][5] == pytest.approx(270.0, abs=1e-3)


def test_the_mass_of_all_shafts_is_compared() -> None:
    fitted = [{"web": "a", "mass_kg": 4.0, "angle_deg": 270.0}, {"web": "back web", "mass_kg": 9.0, "angle_deg": 270.0}]
    request = _request(fitted=fitted)
    answer = optimize(request)
    assert whole_mass(answer) == pytest.approx(OWN + BESIDE, rel=1e-5)
    assert [weight.web for weight in every_counterweight(answer)] == ["a", "back web"]
    mass = residual(answer, required(request, answer))[-1]
    assert mass[1:4] == [0.0, whole_mass(answer), 13.0]


def test_an_analysis_lists_what_each_shaft_carries() -> None:
    weights = [{"web": "back web", "mass_kg": 9.0, "angle_deg": 270.0}]
    request = AnalyzeRequest.model_validate({"machine": MACHINE, "counterweights": weights})
    chapters = list(analyzed(request, analyze(request)))
    assert chapters[0].title == "Counterweights"
    rows = [row for block in chapters[0].blocks if isinstance(block, Table) for row in block.rows]
    assert any(row[0] == "back web" and row[1] == number(9.0) for row in rows)


def test_versions_compare_all_that_is_carried() -> None:
    version = {"name": "as it was", "counterweights": [{"web": "back web", "mass_kg": 9.0, "angle_deg": 270.0}]}
    request = ReportRequest.model_validate({"machine": MACHINE, "versions": [version]})
    (chapter,) = compared(request, optimize(request))
    figures, weights, *_ = (block for block in chapter.blocks if isinstance(block, Table))
    (mass,) = (row[1:] for row in figures.rows if row[0] == "total mass, kg")
    assert [cell.value for cell in mass if isinstance(cell, Number)] == pytest.approx([OWN + BESIDE, 9.0], rel=1e-4)
    assert [row[0] for row in weights.rows] == ["a", "back web"]
