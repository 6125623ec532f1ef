"""What the document says is what the service answers."""

import hashlib
import io
import json
import re
from collections.abc import Callable, Iterator
from typing import get_args

import pytest
from rich.console import Console

from optimizer.formulation.formulate import span
from optimizer.optimize import optimize
from schemas.answer.outputs import OutputName
from schemas.base.version import package_version
from service.common.figures import NARROW
from service.report.blocks import Cell, Chapter, Document, Figure, Number, Paragraph, Samples, Table, angle
from service.report.chapters.answers import CHAPTERS
from service.report.chapters.reproduction import request_json
from service.report.chapters.verdict import result
from service.report.document import document
from service.report.formula import formula
from service.report.terminal import terminal
from tests.report_document.conftest import AT, request_of

Make = Callable[..., Document]


def chapter(record: Document, title: str) -> Chapter:
    return next(section for section in record.chapters if section.title == title)


def tables(record: Document, title: str) -> Iterator[Table]:
    return (block for block in chapter(record, title).blocks if isinstance(block, Table))


def words(record: Document, title: str) -> str:
    """Without what sets thousands apart."""
    text = " ".join(block.text for block in chapter(record, title).blocks if isinstance(block, Paragraph))
    return text.replace(NARROW, "")


def value(cell: Cell) -> object:
    return cell.value if isinstance(cell, Number) else cell


def values(table: Table) -> list[tuple[object, ...]]:
    return [tuple(map(value, row)) for row in table.rows]


def test_the_counterweights_and_the_prices_of_their_limits(composer: Make) -> None:
    answer = optimize(request_of("2d12"))
    (weights,) = tables(composer("2d12"), "Counterweights")
    (prices,) = tables(composer("2d12"), "Prices of the limits")
    assert [row[:3] for row in values(weights)] == [
        (counterweight.web, counterweight.mass_kg, counterweight.angle_deg) for counterweight in answer.counterweights
    ]
    assert [row[-1] for row in weights.rows] == [
        "largest mass" if counterweight.active_limits else "none" for counterweight in answer.counterweights
    ]
    assert values(prices) == [
        ("largest mass", shadow_price.web, shadow_price.value, shadow_price.unit)
        for shadow_price in answer.shadow_prices
    ]
    assert len(prices.rows) == 3


def test_a_web_without_a_counterweight_says_none(composer: Make) -> None:
    machine = request_of("2d12").machine.model_dump(mode="json", exclude_none=True)
    machine["webs"][1]["max_mass_kg"] = 0
    (weights,) = tables(composer("2d12", machine=machine), "Counterweights")
    assert values(weights)[1] == ("1b", "none", *5 * ("–",), "largest mass")


def test_a_machine_that_no_limit_holds_up(composer: Make) -> None:
    assert "all shadow prices are 0" in words(composer("scroll-three-pins"), "Certificate")


def test_before_and_after(composer: Make) -> None:
    answer = optimize(request_of("v60"))
    table, orders = tables(composer("v60"), "First order before and after")
    after = answer.residual.after
    assert after is not None
    assert values(table)[0] == (
        "peak force, N", answer.residual.before.force.peak_N, after.force.peak_N, answer.floor.force_N
    )  # fmt: skip
    assert any(row[2] == after.moment.peak_Nm for row in values(table))
    second = answer.residual.orders.before[1]
    assert second is not None
    assert values(orders)[1][1:3] == (second.force.peak_N, second.force.peak_N)


def test_the_eight_stages_stand_in_it_without_being_asked_for(composer: Make) -> None:
    stages = optimize(request_of("2d12", outputs=["stages"])).stages
    assert stages is not None
    entries = values(next(tables(composer("2d12"), "The eight balancing stages")))
    assert [row[0] for row in entries] == ["I", "II", "III", "IV", "V", "VI", "VII", "VIII"]
    assert [row[2:4] for row in entries] == [(stage.value, stage.remaining) for stage in stages]


def test_stages_that_cannot_be_computed_say_what_is_missing(composer: Make) -> None:
    request = request_of("single-vertical").model_dump(mode="json")
    request["machine"]["throws"][0]["rows"][0]["connecting_rod"] = None
    actual_words = words(composer("single-vertical", **request), "The eight balancing stages")
    assert "/machine/throws/0/rows/0/connecting_rod" in actual_words


def test_the_verdict_on_an_optimum(composer: Make) -> None:
    answer = optimize(request_of("2d12"))
    assert answer.certificate is not None
    record = composer("2d12")
    assert record.status == "optimal"
    assert f"bring the objective below {answer.certificate.lower_bound:.6g}" in words(record, "Result")
    (figures,) = tables(record, "Certificate")
    assert ("lower bound", answer.certificate.lower_bound) in values(figures)


def test_the_verdict_on_ceilings_that_cannot_be_met(composer: Make) -> None:
    record = composer("2d12", objective={"force_ceiling_N": 4000})
    assert record.status == "infeasible"
    assert "the ceiling of the force cannot be met" in words(record, "Result")
    assert "best compromise, not an answer" in words(record, "Counterweights")
    assert "never below 5003.07 N" in words(record, "Certificate")


def test_the_verdict_on_less_accuracy_than_was_asked_for() -> None:
    request = request_of("2d12")
    answer = optimize(request).model_copy(update={"status": "inaccurate"})
    record = document(request, answer, (), AT)
    assert record.status == "inaccurate"
    assert "Inaccurate: the counterweights below keep the limits" in words(record, "Result")


def test_a_machine_without_a_place_for_counterweights(composer: Make) -> None:
    request = request_of("2d12").model_dump(mode="json")
    request["machine"]["webs"] = []
    record = composer("2d12", **request)
    assert "no web for counterweights" in words(record, "Result")
    assert words(record, "Counterweights").startswith("There are none.")


@pytest.mark.parametrize(
    ("output", "title", "figures"),
    [
        ("kinematics", "Motion", 3),
        ("gas", "Gas", 4),
        ("piston_force", "Piston forces", 3),
        ("rod_loads", "Rod loads", 4),
        ("torque", "Torque", 1),
        ("flywheel", "Flywheel", 0),
        ("overturning", "Overturning couple", 1),
        ("roll", "Roll moment", 1),
        ("main_bearings", "Main bearings", 4),
        ("orders", "Orders", 0),
    ],
)
def test_every_output_asked_for_has_its_chapter(composer: Make, output: str, title: str, figures: int) -> None:
    record = composer("2d12", outputs=[output])
    assert sum(isinstance(block, Figure) for block in chapter(record, title).blocks) == figures
    used, _, idle = words(record, "Which effects were simulated").partition("Not simulated: ")
    assert "rotating inertia" in used
    assert "pin loads" not in used
    assert "pin loads" in idle
    # only what was asked for
    assert ("Torque" in [section.title for section in record.chapters]) == (output == "torque")


def test_pin_loads_of_a_scroll(composer: Make) -> None:
    facts, pins, *_ = tables(composer("scroll-three-pins", outputs=["pin_loads"]), "Pin loads")
    # analytic: 2 T/(n R) with 12.5 N m, 3 pins on 48 mm
    assert value(facts.rows[0][1]) == pytest.approx(2 * 12.5 / (3 * 0.048))
    assert len(pins.rows) == 3


def test_the_request_in_the_appendix_is_the_request() -> None:
    request = request_of("v8-cross-plane", outputs=["orders"])
    actual_request_json = request_json(request)
    assert json.loads(actual_request_json) == request.alone.model_dump(mode="json")
    assert max(map(len, actual_request_json.splitlines())) <= 132 + len(request.machine.description or "")


def test_the_digest_is_that_of_the_attached_request(composer: Make) -> None:
    record = composer("2d12")
    content = json.dumps(json.loads(record.attachment.content), sort_keys=True, separators=(",", ":"))
    (last,) = tables(record, "Appendix: request")
    fields = dict(values(last))
    assert fields["digest of the request"] == hashlib.sha256(content.encode()).hexdigest()
    assert fields["at"] == "2026-02-03T04:05:06Z"
    assert dict(values(record.head))["date"] == "3 February 2026"
    assert f"counterweight {package_version()}" in str(fields["computed with"])


@pytest.mark.parametrize(
    ("text", "runs"),
    [
        ("omega^2/2", [("ω", "base"), ("2", "sup"), ("/2", "base")]),
        ("e^{j(2d - g)}", [("e", "base"), ("j(2d − g)", "sup")]),
        ("|A1|", [("|", "base"), ("A", "base"), ("1", "sub"), ("|", "base")]),
        ("m_r z_ref", [("m", "base"), ("r", "sub"), (" z", "base"), ("ref", "sub")]),
        ("first-order force <script>", [("first-order force <script>", "base")]),
    ],
)
def test_formulas(text: str, runs: list[tuple[str, str]]) -> None:
    assert list(formula(text)) == runs


def test_every_output_has_its_chapter() -> None:
    # the first order and the stages stand at places of their own
    assert set(CHAPTERS) | {"residual", "stages", "balance_rate"} == set(get_args(OutputName))


def test_an_engine_is_told_over_both_turns(composer: Make) -> None:
    (pressures,) = [
        table for table in tables(composer("inline-four-engine"), "Inputs") if table.title.startswith("Indicated")
    ]
    firing = [0, 540, 180, 360]
    assert [row[:5] for row in values(pressures)] == [(str(k + 1), "head", 2, firing[k], 53) for k in range(4)]


@pytest.mark.parametrize("turns", [1, 2])
def test_a_terminal_tells_every_30_degrees(turns: int) -> None:
    angle = [5.0 * step for step in range(72 * turns)]
    figure = Figure((), "", Samples("torque", "N m", angle, [("machine", [0.5] * len(angle))]))
    console = Console(width=80, record=True, file=io.StringIO())
    console.print(terminal([Chapter("Torque", (figure,))]))
    # analytic
    matches = re.findall(r"(\d+) │ *0\.5", console.export_text())
    assert [int(match) for match in matches] == [30 * step for step in range(12 * turns)]


@pytest.mark.parametrize(
    ("angle_deg", "text"),
    [
        (4.4e-10, "0"), (-4.4e-10, "0"), (360.0 - 1e-9, "0"), (360.0, "0"), (-360.0, "0"), (123.45678, "123.457"),
        (0.00016, "0.0002"), (-90.0, "-90"), (359.9994, "359.999"), (359.99951, "0"),
    ],
)  # fmt: skip
def test_an_angle_of_a_whole_turn_is_printed_as_none(angle_deg: float, text: str) -> None:
    phase = angle(angle_deg)
    assert isinstance(phase, Number)
    # to all its digits where it is computed with
    assert (phase.text, phase.value) == (text, angle_deg)


def test_of_inertia_alone_nothing_is_filed_that_is_zero(composer: Make) -> None:
    """No curves that are cosines, no powers and errors of none, no samples of crank pins."""
    dry, driven = (composer(name, outputs=["torque", "rod_loads", "orders"]) for name in ("v8-cross-plane", "2d12"))
    counts = [
        sum(isinstance(block, Figure) for block in chapter(record, "Rod loads").blocks) for record in (dry, driven)
    ]
    assert counts == [0, 4]
    names = [[row[0] for row in values(next(tables(record, "Torque")))] for record in (dry, driven)]
    assert names[0] == ["largest torque over the cycle, N m", "fluctuation energy ΔE, J"]
    assert "shaft power, W" in names[1]
    # the orders stand in their chapter alone
    assert [table.title for table in tables(dry, "First order before and after")] == [""]


def test_a_peak_that_the_gap_outweighs_is_shown_as_below_it() -> None:
    """Analytic: a millionth of the yardstick, over the weight of the moment."""
    request = request_of("v60")
    answer = optimize(request)
    after, proof = answer.residual.after, answer.certificate
    assert after is not None
    assert proof is not None
    most = 1e-6 * proof.yardstick * span(request.machine)
    for peak, below in ((0.9 * most, True), (1.1 * most, False)):
        moment = after.moment.model_copy(update={"peak_Nm": peak})
        residual = answer.residual.model_copy(update={"after": after.model_copy(update={"moment": moment})})
        before = residual.before.model_copy(update={"moment": moment})
        variant = answer.model_copy(update={"residual": residual.model_copy(update={"before": before})})
        (block,) = (
            paragraph
            for paragraph in result(request, variant, None).blocks
            if isinstance(paragraph, Table) and paragraph.title
        )
        text = block.rows[1][2]
        assert isinstance(text, Number)
        assert text.text.startswith("< ") is below
        assert not below or most <= float(text.text[2:]) <= 2.0 * most
