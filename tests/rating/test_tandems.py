"""Stages whose pistons share a rod: what is in it is the sum."""

from typing import Any

import pytest

from optimizer.rating.rate import rate
from service.report.chapters.rating import rated
from tests.rating.design import request
from tests.rating.test_choice import OPEN, RODS, rating_of
from tests.rating.test_refusals import Path, refused


def test_the_forces_of_both_add_at_each_dead_centre() -> None:
    """Analytic: sums of what each stage alone puts into a rod."""
    alone, shared = rate(request()), rate(request(tandems=[[1, 2]]))
    (tandem_load,) = shared.tandem_loads
    outer = [stage.actual_loads.outer.gas_force_N for stage in alone.stages]
    inner = [stage.actual_loads.inner.gas_force_N for stage in alone.stages]
    assert (tandem_load.outer_N, tandem_load.inner_N) == (pytest.approx(sum(outer)), pytest.approx(sum(inner)))
    assert shared.largest_rod_load_N == tandem_load.largest_N == max(abs(sum(outer)), abs(sum(inner)))
    # sizes, powers and the loads of single pistons are what they were
    same = {"tandem_loads", "largest_rod_load_N", "warnings"}
    assert shared.model_dump(exclude=same) == alone.model_dump(exclude=same)
    assert alone.tandem_loads == ()


def test_the_rod_is_chosen_for_the_sum() -> None:
    strong = [*RODS, {"diameter_m": 0.13, "largest_force_N": 600e3}]
    apart, shared = (rating_of(*OPEN, piston_rods=strong, tandems=tandems) for tandems in ([], [[1, 2]]))
    assert apart.choice is not None
    assert shared.choice is not None
    assert apart.choice.piston_rod_diameters_m == (0.11, 0.11)
    assert shared.choice.piston_rod_diameters_m == (0.13, 0.13)


def test_the_frame_is_warned_of_the_sum() -> None:
    single = rate(request()).largest_rod_load_N
    of_both = rate(request(tandems=[[1, 2]], rated_rod_load_N=1.2 * single))
    assert [warning.stage for warning in of_both.warnings if warning.code == "rod_load"] == [1, 2]


def test_a_step_has_the_smaller_step_for_its_rod() -> None:
    """Analytic: stage 2 on the ring between its bore and that of stage 1, which is the rod there."""
    whole = rate(request(("stages/0/acting", "head")))
    bore = whole.stages[0].actual.bore_m
    step = rate(
        request(
            ("stages/0/acting", "head"), ("stages/1/acting", "crank"), ("stages/1/piston_rod_diameter_m", bore),
            tandems=[[1, 2]],
        )
    )  # fmt: skip
    size = step.stages[1].actual
    ring = size.head_area_m2 - size.crank_area_m2
    assert ring == pytest.approx(whole.stages[0].actual.head_area_m2)
    assert step.tandem_loads[0].stages == (1, 2)


def test_they_stand_in_the_table_of_the_machine() -> None:
    both = request(tandems=[[1, 2]])
    chapters = list(rated(both, rate(both)))
    (machine,) = [chapter for chapter in chapters if chapter.title == "Machine"]
    assert len(machine.blocks) == 2


@pytest.mark.parametrize(
    ("tandems", "path"),
    [
        ([[1, 3]], ("tandems", 0, 1)),
        ([[1]], ("tandems", 0)),
        ([[1, 1]], ("tandems", 0, 1)),
        ([[0, 1]], ("tandems", 0, 0)),
    ],
)
def test_what_is_no_tandem_is_refused(tandems: Any, path: Path) -> None:
    assert refused({"tandems": tandems}) == [path]


def test_unlike_numbers_of_cylinders_share_no_rods() -> None:
    assert refused({"stages/1/cylinders": 2, "tandems": [[1, 2]]}) == [("tandems", 0)]
