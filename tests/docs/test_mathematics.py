"""The bound that the mathematics checks by hand is that of the answer."""

import re

import pytest

from tests.docs.reading import ROOT, agrees, blocks
from tests.verification.checking import optimized

TEXT = (ROOT / "docs" / "mathematics" / "program.md").read_text().split("### Checked by hand\n")[1].split("\n## ")[0]


def test_the_bound_that_is_checked_by_hand_is_that_of_the_answer() -> None:
    """Analytic: the sum that stands there is evaluated, and so is the formula, from request and multipliers alone."""
    request, multipliers = blocks(TEXT)
    answer = optimized(request)
    assert answer.certificate is not None
    agrees(multipliers, answer.certificate.multipliers.objective.model_dump(mode="json"))
    machine = request["machine"]
    (throw,), (term,) = machine["throws"], multipliers["terms"]
    square = 10.0**2
    constant = term["x"] * throw["rotating_mass_kg"] * throw["crank_radius_m"] * square
    price, budget = multipliers["budget"], machine["max_total_mass_kg"]
    bound = constant - price * budget
    for web in machine["webs"]:
        gain = web["counterweight_radius_m"] * square * term["x"]
        bound -= min(web["max_mass_kg"], budget) * max(gain - price, 0.0)
    sum_, printed = re.findall(r"\n(200 −[^=]*) = \*\*(.*?) N\*\*", TEXT)[0]
    first, *rest = sum_.split(" − ")
    assert (first, rest) == ("200", ["5 (20", "10)", "8 (10", "10)", "10 · 8"])
    assert bound == float(printed) == 200 - 5 * (20 - 10) - 8 * (10 - 10) - 10 * 8
    assert answer.certificate.lower_bound == pytest.approx(bound, rel=1e-12)
    assert answer.certificate.lower_bound <= bound <= answer.certificate.objective
