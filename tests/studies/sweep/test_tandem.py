"""Designs with several cylinders on a rod: each row of the sweep is its single answer."""

from tests.mechanics.test_tandem import FIRST, SECOND, machine
from tests.studies.sweep.single import assert_row_is_the_single_answer, sweep, table


def test_rows_are_the_single_answers_independent() -> None:
    base = {
        "machine": machine(
            [{"cylinders": [FIRST, SECOND]}, {"cylinder": SECOND}], friction={"mechanical_efficiency": 0.9}
        ),
        "outputs": ["gas", "piston_force", "rod_loads", "torque", "loads"],
    }
    place = "/machine/throws/0/rows/0/cylinders/1"
    request = sweep(
        base,
        {"path": f"{place}/bore_m", "values": [0.2, 0.3, 0.05]},
        {"path": f"{place}/discharge_pressure_Pa", "values": [1.1e6, 1.6e6]},
        task="analyze",
        details=True,
    )
    texts = [assert_row_is_the_single_answer(request, row) for row in table(request).to_pylist()]
    # a bore below that of the piston rod is refused, and ends nothing
    assert [status == "invalid" for status in texts] == [False] * 4 + [True] * 2
    rows = table(request).to_pylist()
    assert rows[0]["indicated_power_W"] != rows[2]["indicated_power_W"]
