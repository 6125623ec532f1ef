"""Answers for a person: a line in a terminal, tables in a notebook; and requests as dictionaries."""

import pickle
from typing import Any

import pytest
from pydantic import Field, ValidationError

import optimizer
from optimizer import optimize, pareto
from schemas.base.curves import Curve
from schemas.base.mappings import or_mapping
from schemas.base.model import Answer, Model
from schemas.front.counts import CountFront
from schemas.front.pareto import ParetoFront
from schemas.front.trade import TradedFront
from schemas.request.requests import OptimizeRequest
from service.computations.table import COMPUTATIONS
from service.documents.examples import bodies

BODY: dict[str, Any] = bodies("")["v90-equal"]


class Specimen(Answer):
    """An answer with a field of every kind."""

    mass_kg: float = Field(description="a number")
    none: float | None = Field(None, description="nothing")
    series: tuple[float, ...] = Field(description="numbers")
    words: str = Field(description="a text")
    part: Model = Field(description="a part")
    more: tuple[int, ...] = Field((), description="an empty list")


class Curved(Answer):
    """An answer with curves."""

    force_N: Curve[float] = Field(description="a curve")
    empty: Curve[float] = Field(description="without numbers")


def test_curves_are_shown_by_their_length() -> None:
    curved = Curved(version="1", force_N=range(360), empty=())
    assert repr(curved) == "Curved(version='1', force_N=[360])"
    assert "<th>force_N</th><td>360 numbers</td>" in curved._repr_html_()
    assert "empty" not in curved._repr_html_()


def test_a_line_holds_figures_and_no_series() -> None:
    example = Specimen(version="1", mass_kg=1 / 3, series=(1.0,) * 1000, words="x" * 1000, part=Model())
    assert repr(example) == str(example)
    assert (
        repr(example)
        == f"Specimen(version='1', mass_kg=0.333333, series=[1000], words='{'x' * 40}...', part=Model(...))"
    )


@pytest.mark.parametrize("front", [ParetoFront, CountFront, TradedFront])
def test_fronts_show_themselves(front: type[Any]) -> None:
    assert callable(front._repr_html_)


def test_answers_are_short_and_are_tables_in_a_notebook() -> None:
    answer = optimize(BODY)
    assert len(repr(answer)) < 400
    assert f"total_mass_kg={answer.total_mass_kg:.6g}" in repr(answer)
    front = pareto({"machine": BODY["machine"], "points": 2}).fronts[0]
    assert repr(front).startswith(f"ParetoFront(status='optimal', points=[{len(front.points)}]")
    assert front._repr_html_().count("<tr>") > len(front.points)


def test_a_dictionary_is_the_request_that_it_describes() -> None:
    whole = optimize(OptimizeRequest.model_validate(BODY))
    from_dictionary = optimize(BODY)
    assert whole.counterweights == from_dictionary.counterweights


@pytest.mark.parametrize("name", [name for name in optimizer.__all__ if name not in ("MissingInput", "catalogue")])
def test_every_function_checks_a_dictionary(name: str) -> None:
    for wrong in ({"machine": 1}, {}, [], 3):
        with pytest.raises(ValidationError):
            getattr(optimizer, name)(wrong)


def test_a_function_stays_what_it_is_called() -> None:
    """Jobs and workers name functions, and send them to other processes."""
    assert pickle.loads(pickle.dumps(optimize)) is optimize
    assert COMPUTATIONS["optimize"].function is optimize
    assert optimize.__doc__ is not None


def test_what_comes_behind_the_request_is_handed_on() -> None:
    @or_mapping(OptimizeRequest)
    def twice(request: OptimizeRequest, factor: int, *, plus: int = 0) -> int:
        return factor * len(request.machine.webs) + plus

    webs = len(BODY["machine"]["webs"])
    assert twice(BODY, 2, plus=1) == 2 * webs + 1
    assert twice(OptimizeRequest.model_validate(BODY), factor=3) == 3 * webs
