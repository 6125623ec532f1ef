"""The pressure of all cylinders: pasted as two columns, read, doubted, drawn, and given out in the firing order."""

import json
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import expect

from tests.browser.portal import Portal

_ENGINE = json.loads(Path("examples/inline-four-engine.json").read_text())["machine"]
TRACE = _ENGINE["throws"][0]["rows"][0]["cylinder"]["pressure"]["head"]
#: as a German spreadsheet writes it
COLUMNS = "Kurbelwinkel (°KW);Druck (bar)\n" + "\n".join(
    f"{angle};{pressure / 1e5:.5f}".replace(".", ",")
    for angle, pressure in zip(TRACE["angle_deg"], TRACE["pressure_Pa"], strict=True)
)
MESSAGE = "#form .gas .said"


def _open(portal: Portal, example: str = "inline-six") -> None:
    portal.open(example)
    portal.unfold("/machine", "/machine/throws", "/machine/throws/gas")


def _type(portal: Portal, **values: str) -> None:
    for name, value in values.items():
        if name == "text":
            portal.paste("#gas-text", value)
        else:
            portal.page.fill(f"#gas-{name}", value)


def _cylinders(portal: Portal) -> list[Any]:
    portal.optimise()
    throws = portal.bodies("/v1/optimize")[-1]["machine"]["throws"]
    return [row["cylinder"] for throw in throws for row in throw["rows"]]


def test_a_pressure_pasted_anywhere_goes_to_all_cylinders_in_their_firing_order(portal: Portal) -> None:
    portal.open("inline-six")
    portal.paste("body", COLUMNS)
    expect(portal.page.locator("#progress")).to_have_text(
        "Pasted: a pressure over the angle, below the rows. Press Optimise."
    )
    _type(portal, bore="84 mm", ambient="1,05 bar", order="1-4-2-6-3-5")
    expect(portal.page.locator(MESSAGE)).to_have_text("53 lines: two revolutions, 0.95 to 85 bar.")
    curves = portal.page.locator("#form .gas-curve")
    expect(curves.locator("polyline")).to_have_count(6)
    portal.page.get_by_role("button", name="Give it to all 6 cylinders").click()
    cylinders = _cylinders(portal)
    centres = [cylinder["pressure"]["dead_centre_deg"] for cylinder in cylinders]
    # analytic: cranks at 0, 120, 240, 240, 120 and 0 degrees stand outwards at 90, 330, 210, 210, 330 and 90
    assert centres == [90, 330, 570, 210, 690, 450]
    for single_cylinder in cylinders:
        assert single_cylinder["bore_m"] == "84 mm"
        # the value that ends the cycle repeats its beginning
        assert single_cylinder["pressure"]["head"]["angle_deg"] == TRACE["angle_deg"][:-1]
        assert single_cylinder["pressure"]["head"]["pressure_Pa"] == pytest.approx(TRACE["pressure_Pa"][:-1], rel=1e-5)
    portal.page.locator("#panel-picture-indicator").wait_for()


ORDERS = {
    "": "Give the firing order",
    "1-5-3-6-2-7": "There is no cylinder 7: they are counted from 1 to 6",
    "1-5-3-6-2-2": "Cylinder 2 fires twice",
    "1-5-3": "Cylinder 2, 4, 6 is not in this order",
    "123456": "would fire after more than two revolutions",
}


def test_an_order_that_cannot_be_is_said(portal: Portal) -> None:
    _open(portal)
    _type(portal, text=COLUMNS, bore="84 mm", ambient="1,05 bar")
    for order, words in ORDERS.items():
        _type(portal, order=order)
        expect(portal.page.locator(MESSAGE)).to_contain_text(words)
        assert portal.page.get_by_role("button", name="Give it to all 6 cylinders").is_disabled(), order


PRESSURES = {
    "angle,pressure\n0,95000\n5,x\n": "line 3: “x” is no number",
    "angle;pressure\n0;95000\n5;\n": "line 3: there is no pressure",
    "0,1.5\n5,1.6\n5,1.7\n": "line 3: the angle 5 does not follow 5: angles must rise",
    "0;95000\n5;96000\n10;97000\n": "the angles span 10°, less than half of a cycle",
    "0;95000\n500;96000\n1440;97000\n": "the angles span 1440°, more than the two revolutions",
    "0;1,5\n200;-0,2\n355;1,4\n": "absolute pressures are above 0",
    "\n".join(f"{k * 0.05:.2f};1.5" for k in range(10_000)): "10000 lines are more than the 3750",
}


def test_what_is_wrong_with_a_pressure_is_said_and_nothing_is_lost(portal: Portal) -> None:
    _open(portal)
    _type(portal, bore="84 mm", ambient="1,05 bar", order="1-4-2-6-3-5")
    for text, words in PRESSURES.items():
        _type(portal, text=text)
        expect(portal.page.locator(MESSAGE)).to_contain_text(words)
        assert portal.page.get_by_role("button", name="Give it to all 6 cylinders").is_disabled(), words
        assert portal.page.locator("#gas-text").input_value().strip() == text.strip()


def test_gauge_pressures_and_too_many_lines_are_mended_by_a_click(portal: Portal) -> None:
    _open(portal)
    lines = "\n".join(f"{k * 0.072 - 360:.3f}\t{abs(k - 5000) / 1000 - 0.2:.3f}" for k in range(10_000))
    _type(portal, text=lines, bore="84 mm", ambient="1,05 bar", order="1-4-2-6-3-5")
    portal.page.get_by_role("button", name="They are gauge pressures").click()
    portal.page.get_by_role("button", name="Take one line of 3").click()
    portal.page.get_by_role("button", name="Give it to all 6 cylinders").click()
    head = _cylinders(portal)[0]["pressure"]["head"]
    # analytic: one line of three, from the dead centre on, above the atmosphere
    assert len(head["angle_deg"]) == 3334
    assert head["angle_deg"][0] == pytest.approx(0.072)
    assert head["pressure_Pa"][0] == pytest.approx(-0.199e5 + 101325)


def test_a_file_is_dropped(portal: Portal) -> None:
    _open(portal)
    portal.page.locator("#gas-text").evaluate(
        """(node, text) => {
          const dataTransfer = new DataTransfer();
          dataTransfer.items.add(new File([text], "pressure.csv", { type: "text/csv" }));
          node.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
        }""",
        COLUMNS,
    )
    expect(portal.page.locator(MESSAGE)).to_contain_text("53 lines: two revolutions, 0.95 to 85 bar.")


def test_offsets_are_typed_in_place_of_an_order(portal: Portal) -> None:
    _open(portal)
    _type(portal, text=COLUMNS, bore="84 mm", ambient="1,05 bar", offsets="90 690 210 570 330 450")
    portal.page.get_by_role("button", name="Give it to all 6 cylinders").click()
    centres = [cylinder["pressure"]["dead_centre_deg"] for cylinder in _cylinders(portal)]
    assert centres == [90, 690, 210, 570, 330, 450]
