"""The table: the same whatever the chunks, with units and provenance, and one row for every design."""

import json
import pickle
from concurrent.futures import ProcessPoolExecutor
from itertools import pairwise
from multiprocessing import get_context

import numpy as np
import pyarrow as pa
import pytest

from optimizer.errors import MissingInput
from optimizer.studies.sweep import plan, run_chunk
from optimizer.studies.sweep.table import REQUEST, SEED, VERSIONS
from schemas.base.target import pointer
from schemas.sweep.request import SweepRequest
from tests.studies.sweep.single import example, sweep, table

MASS = {"path": "/machine/throws/0/rows/0/reciprocating_mass_kg", "start": 150, "stop": 400}
SPEED = {"path": "/machine/speed_rpm", "start": -200, "stop": 700}
CEILING = {"path": "/objective/force_ceiling_N", "values": [None, 50, 9000]}


def hypercube(**rest: object) -> SweepRequest:
    return sweep(example("2d12"), MASS, SPEED, CEILING, design="latin_hypercube", samples=30, seed=5, **rest)


def pieces(request: SweepRequest, *edges: int) -> pa.Table:
    data = request.model_dump_json().encode()
    return pa.concat_tables(run_chunk(data, a, b) for a, b in pairwise(edges))


def test_rows_do_not_depend_on_the_chunks() -> None:
    whole = table(hypercube())
    assert set(whole["status"].to_pylist()) >= {"optimal", "infeasible", "invalid"}
    for edges in ((0, 1, 2, 30), (0, 13, 17, 30), (0, 0, 29, 30)):
        parts = pieces(hypercube(), *edges)
        assert parts.schema.equals(whole.schema, check_metadata=True)
        for name in whole.column_names:
            column, expected = parts[name].to_pylist(), whole[name].to_pylist()
            if whole.schema.field(name).type == pa.float64():
                column, expected = ([np.nan if v is None else v for v in values] for values in (column, expected))
                np.testing.assert_allclose(column, expected, rtol=1e-9, atol=1e-9, err_msg=name)
            else:
                assert column == expected


def test_chunks_run_in_other_processes() -> None:
    request = hypercube(columns=["force_peak_N"])
    data = request.model_dump_json().encode()
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        there = pool.submit(run_chunk, data, 3, 9).result()
    assert there.to_pylist() == run_chunk(data, 3, 9).to_pylist()


@pytest.mark.parametrize(("start", "stop"), [(-1, 3), (3, 2), (0, 31)])
def test_ranges_beyond_the_sweep_are_refused(start: int, stop: int) -> None:
    with pytest.raises(ValueError, match="designs 0 to 30"):
        run_chunk(hypercube().model_dump_json().encode(), start, stop)


def test_no_designs_make_an_empty_table() -> None:
    chunk = run_chunk(hypercube().model_dump_json().encode(), 4, 4)
    assert chunk.num_rows == 0
    assert chunk.column_names == [column.name for column in hypercube().all_columns]


def test_columns_of_the_contract() -> None:
    # docs/api.md: index, every axis value, status, figures, mass and angle for each web
    request = hypercube()
    names = table(request).column_names
    assert names[:4] == ["index", *(pointer(target.path) for target in request.targets)]
    assert {"status", "force_peak_N", "moment_peak_Nm", "total_mass_kg", "relative_gap"} <= set(names)
    for web in ("1a", "1b", "2a", "2b"):
        assert {f"mass_kg.{web}", f"angle_deg.{web}"} <= set(names)


def test_chosen_columns_come_with_index_and_status() -> None:
    assert table(hypercube(columns=["moment_peak_Nm"])).column_names == ["index", "status", "moment_peak_Nm"]
    top = hypercube(columns=[], top={"by": "total_mass_kg"})
    assert table(top).column_names == ["index", "status", "total_mass_kg"]
    front = hypercube(columns=["angle_deg.2b"], pareto=["force_peak_N", "moment_peak_Nm"])
    assert table(front).column_names == ["index", "status", "force_peak_N", "moment_peak_Nm", "angle_deg.2b"]


def test_fields_carry_unit_meaning_and_pointer() -> None:
    schema = table(hypercube()).schema
    assert schema.field(MASS["path"]).metadata[b"unit"] == b"kg"
    assert schema.field(MASS["path"]).metadata[b"pointer"] == MASS["path"].encode()
    assert schema.field("moment_peak_Nm").metadata[b"unit"] == b"N m"
    assert schema.field("mass_kg.2a").metadata[b"pointer"] == b"/machine/webs/2"
    assert b"unit" not in schema.field("status").metadata
    assert all(field.metadata[b"meaning"] for field in schema)


def test_the_table_says_where_it_comes_from() -> None:
    request = hypercube()
    metadata = table(request).schema.metadata
    assert SweepRequest.model_validate_json(metadata[REQUEST]) == request
    assert metadata[SEED] == b"5"
    assert {"counterweight", "numpy", "clarabel", "python"} <= set(json.loads(metadata[VERSIONS]))


def test_a_plan_covers_every_design_once() -> None:
    actual_plan = plan(hypercube())
    covered = [design for number in range(actual_plan.chunks) for design in range(*actual_plan.chunk(number))]
    assert covered == list(range(30))
    assert actual_plan.schema.equals(table(hypercube()).schema, check_metadata=True)
    assert pickle.loads(pickle.dumps(actual_plan)) == actual_plan


def test_a_dry_run_counts_ten_million_designs_without_making_them() -> None:
    axes = [{"path": f"/machine/webs/{k}/max_mass_kg", "start": 0, "stop": 60, "count": 100} for k in range(3)]
    request = sweep(example("2d12"), *axes, {**SPEED, "start": 300, "count": 10}, dry_run=True)
    estimate = plan(request).estimate
    assert estimate.total == 10_000_000
    assert estimate.chunks == -(-estimate.total // estimate.chunk_rows)
    assert [column.name for column in estimate.columns] == [column.name for column in request.all_columns]
    # analytic: chunks are dealt out, so the last round of eight workers may be short of some
    assert (estimate.workers, estimate.wall_s) == (1, estimate.cpu_s)
    eight = plan(request).estimate_for(8)
    assert 1 / 8 <= eight.wall_s / eight.cpu_s <= 1 / 8 + 1 / eight.chunks
    idle = plan(request).estimate_for(estimate.chunks + 5)
    assert idle.wall_s == pytest.approx(estimate.cpu_s / estimate.chunks)
    # at most 8 bytes a number and some overhead
    assert 5e8 < estimate.bytes < 5e9
    assert table(request, 9_999_999).to_pylist()[0]["/machine/webs/0/max_mass_kg"] == 60.0


def test_what_no_design_gives_is_refused_before_the_sweep() -> None:
    base = {"machine": example("2d12")["machine"] | {"flywheel": None}, "outputs": ["flywheel"]}
    with pytest.raises(MissingInput) as caught:
        plan(sweep(base, {"path": SPEED["path"], "values": [300]}, task="analyze"))
    assert [problem.path for problem in caught.value.problems] == [("base", "machine", "flywheel")]
    assert "needed by output 'flywheel'" in caught.value.problems[0].message


def test_an_axis_may_give_what_the_base_lacks() -> None:
    base = {"machine": example("2d12")["machine"], "outputs": ["gas"]}
    base["machine"]["throws"][0]["rows"][0]["cylinder"]["discharge_pressure_Pa"] = None
    path = "/machine/throws/0/rows/0/cylinder/discharge_pressure_Pa"
    request = sweep(base, {"path": path, "values": ["8 bar", None, "2 bar", 1e9]}, task="analyze")
    plan(request)
    rows = table(request).to_pylist()
    assert [row["status"] for row in rows] == ["analyzed", "invalid", "invalid", "invalid"]
    messages = [row["message"] for row in rows[1:]]
    assert messages[0] == f"{path}: gas forces need this field; needed by output 'gas'"
    assert messages[1] == f"{path}: must not be below the suction pressure"
    assert "never delivers" in messages[2]
