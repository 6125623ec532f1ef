"""Answers are made without a look for unknown fields: here every name that they are made of is one."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from optimizer.analyze import analyze
from optimizer.optimize import optimize
from schemas.answer.first_order import Floor
from schemas.base.model import Model

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.json"))


@pytest.fixture
def strict(monkeypatch: pytest.MonkeyPatch) -> None:
    def checked(cls: type[Model], fields: Mapping[str, Any]) -> Model:
        return cls.model_validate(fields)

    monkeypatch.setattr(Model, "of_figures", classmethod(checked))


@pytest.mark.usefixtures("strict")
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_all_names_of_figures_are_fields(example: Path) -> None:
    request = json.loads(example.read_bytes())
    answer = optimize(request)
    assert answer.residual.after is not None
    weights = [
        {"web": counterweight.web, "mass_kg": counterweight.mass_kg}
        for counterweight in answer.counterweights
        if not counterweight.fixed
    ]
    weights = [{**counterweight, "angle_deg": 0.0} for counterweight in weights]
    if not request["machine"].get("balance_shafts"):
        assert analyze({"machine": request["machine"], "counterweights": weights}).effects


@pytest.mark.usefixtures("strict")
def test_a_name_that_is_no_field_is_found() -> None:
    with pytest.raises(ValidationError, match="extra"):
        Floor.of_figures({"force_N": 0.0, "moment_Nm": 0.0, "forces_N": 0.0})


@pytest.mark.parametrize("wrong", [float("nan"), float("inf"), "much", None])
def test_figures_are_checked(wrong: object) -> None:
    with pytest.raises(ValidationError):
        Floor.of_figures({"force_N": 0.0, "moment_Nm": wrong})
