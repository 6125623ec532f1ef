"""GET /v1/effects: what can be asked for, and what it takes."""

from typing import get_args

from starlette.testclient import TestClient

from optimizer.effects.registry import EFFECTS
from schemas.answer.effects import EffectCatalogue, OutputEntry
from schemas.answer.outputs import OutputName


def catalogue(client: TestClient) -> EffectCatalogue:
    answer = client.get("/v1/effects")
    assert answer.status_code == 200
    return EffectCatalogue.model_validate_json(answer.content)


def test_all_outputs_and_effects_are_there(client: TestClient) -> None:
    answer = catalogue(client)
    assert [output.name for output in answer.outputs] == list(get_args(OutputName))
    assert [effect.name for effect in answer.effects] == list(EFFECTS)
    assert all(model.meaning for model in (*answer.outputs, *answer.effects))


def test_effects_stand_in_the_order_in_which_they_run(client: TestClient) -> None:
    answer = catalogue(client)
    needs = {effect.name: set(effect.needs) for effect in answer.effects}
    for names in ([effect.name for effect in answer.effects], *(output.needs for output in answer.outputs)):
        for place, name in enumerate(names):
            assert needs[name] <= set(names[:place])


def test_an_output_lists_what_it_takes(client: TestClient) -> None:
    by_name = {output.name: output for output in catalogue(client).outputs}
    assert by_name["residual"].inputs == ()
    assert by_name["gas"] == OutputEntry(
        name="gas",
        meaning=by_name["gas"].meaning,
        needs=("kinematics", "gas", "indicated_work"),
        inputs=("machine.throws.rows.connecting_rod", "machine.throws.rows.cylinder"),
    )
    assert {"machine.friction", "machine.flywheel"} <= set(by_name["flywheel"].inputs)
    assert "machine.bearings" in by_name["main_bearings"].inputs
