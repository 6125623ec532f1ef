"""What docs/api/forms.md says of forms is what the schema says."""

from typing import Any

from schemas.request.requests import OptimizeRequest
from tests.docs.reading import agrees, blocks, document


def test_the_fields_shown_are_those_of_the_schema() -> None:
    definitions: dict[str, Any] = OptimizeRequest.model_json_schema()["$defs"]
    (block,) = blocks(document("docs/api/forms.md"))
    models = {"crank_radius_m": "Throw", "diameter_m": "Bearing", "hole_angles_deg": "Web", "sector": "Web"}
    agrees(block, {name: definitions[model]["properties"][name] for name, model in models.items()})
    assert set(block) == set(models)
    assert definitions["Web"]["then"] == {"required": ["counterweight_radius_m", "max_mass_kg"]}
