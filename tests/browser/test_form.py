"""The form: edited, added to, taken from; errors stand at their fields."""

import json

from schemas.base.form_groups import GROUPS
from tests.browser.portal import Portal

THROW = "/machine/throws/0"


def _throw(portal: Portal) -> None:
    portal.unfold("/machine", "/machine/throws", THROW)


def _error(portal: Portal, pointer: str) -> str:
    return portal.page.locator(f"#form [data-pointer='{pointer}'] > .error").inner_text()


def test_units_are_shown_and_read(portal: Portal) -> None:
    portal.open()
    _throw(portal)
    heads = portal.page.locator("#form .grid-throw thead th").all_inner_texts()
    assert "crank radius m" in [" ".join(head.split()) for head in heads]
    portal.input(f"{THROW}/crank_radius_m").fill("5.5 in")
    portal.optimise()
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    assert machine["throws"][0]["crank_radius_m"] == "5.5 in"


def test_fields_stand_under_the_headings_of_the_schema_in_its_order(portal: Portal) -> None:
    portal.open()
    machine = "#form details[data-pointer='/machine'] > .inside > fieldset"
    assert portal.page.locator(f"{machine} > legend").all_inner_texts() == list(GROUPS["ReciprocatingMachine"])
    for number, fields in enumerate(GROUPS["ReciprocatingMachine"].values()):
        section = portal.page.locator(machine).nth(number)
        pointers = section.locator(":scope > [data-pointer], :scope > .fields > [data-pointer]").evaluate_all(
            "all => all.map((one) => one.dataset.pointer.split('/').at(-1))"
        )
        assert set(pointers) <= set(fields)
        assert pointers
    # one thing with a title of its own needs no heading
    assert portal.page.locator("#form > fieldset > legend").all_inner_texts() == ["What is to be small", "Answer"]


def test_an_error_stands_at_its_field(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open()
    _throw(portal)
    for name, value, message in (
        ("crank_radius_m", "-1", "at least"),
        ("crank_radius_m", "3 kg", "unit"),
        ("position_m", "", "required"),
    ):
        field = portal.input(f"{THROW}/{name}")
        before = field.input_value()
        field.fill(value)
        # the error opens what is closed around it
        portal.page.locator("#form details[data-pointer='/machine/throws'] > summary").click()
        portal.page.click("#optimise")
        portal.page.locator("#form [aria-invalid='true']").wait_for()
        assert message in _error(portal, f"{THROW}/{name}")
        assert field.is_visible()
        assert field.get_attribute("aria-invalid") == "true"
        assert field.evaluate("node => node === document.activeElement")
        assert "Invalid request" in portal.page.locator("#problem").inner_text()
        field.fill(before)
        portal.optimise()
        assert portal.page.locator("#form .wrong").count() == 0
        assert portal.page.locator("#problem").inner_text() == ""


def test_a_choice_may_be_left_open(portal: Portal) -> None:
    portal.open("inline-four-engine")
    row = f"{THROW}/rows/0"
    portal.unfold("/machine", "/machine/throws", THROW, f"{THROW}/rows", row, f"{row}/cylinder")
    acting = portal.input(f"{row}/cylinder/acting")
    assert acting.input_value() == "head"
    acting.select_option("")
    portal.optimise()
    (throw, *_) = portal.bodies("/v1/optimize")[-1]["machine"]["throws"]
    assert "acting" not in throw["rows"][0]["cylinder"]


def test_an_error_between_fields_has_a_place_too(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open()
    portal.unfold("/machine", "/machine/webs", "/machine/webs/1")
    portal.input("/machine/webs/1/name").fill("1a")
    portal.page.click("#optimise")
    portal.page.locator("#form [aria-invalid='true']").wait_for()
    assert "taken already" in _error(portal, "/machine/webs/1/name")


def test_things_are_added_and_removed(portal: Portal) -> None:
    portal.open("two-rows-180")
    portal.unfold("/machine", "/machine/webs")
    portal.page.get_by_role("button", name="Add web").click()
    portal.input("/machine/webs/4/position_m").fill("0.5")
    portal.unfold("/machine/webs/4")
    web = portal.page.locator("#form details[data-pointer='/machine/webs/4']")
    web.get_by_role("button", name="Add sector").click()
    portal.input("/machine/webs/4/sector/centre_deg").fill("170")
    portal.input("/machine/webs/4/sector/half_angle_deg").fill("30")
    portal.unfold("/machine/throws", "/machine/throws/0")
    portal.page.locator("#form details[data-pointer='/machine/throws/0']").get_by_role(
        "button", name="Remove throw"
    ).click()
    portal.optimise()
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    assert len(machine["webs"]) == 5
    assert len({web["name"] for web in machine["webs"]}) == 5
    assert machine["webs"][4]["position_m"] == 0.5
    assert machine["webs"][4]["sector"]["centre_deg"] == 170
    assert [throw["name"] for throw in machine["throws"]] == ["2"]
    assert portal.page.locator("#answer .sector").count() == 1


def test_a_limit_that_is_left_empty_is_none(portal: Portal) -> None:
    portal.open()
    portal.unfold("/machine", "/machine/webs", "/machine/webs/0")
    most = portal.input("/machine/webs/0/max_mass_kg")
    most.fill("")
    assert most.get_attribute("placeholder") == "no limit"
    # a list that is left empty has the orders that are usual
    assert portal.input("/foundation_orders").get_attribute("placeholder") == "1, 2, 3, 4, 5, 6"
    # another field is named by its label, and nobody has to know null
    assert portal.input("/machine/overspeed_rpm").get_attribute("placeholder") == "speed"
    assert not [text for text in portal.page.locator("#form .about, #form .hint").all_inner_texts() if "null" in text]
    portal.optimise()
    assert portal.bodies("/v1/optimize")[-1]["machine"]["webs"][0]["max_mass_kg"] is None


def test_rows_are_added_to_a_throw(portal: Portal) -> None:
    portal.open("v60")
    rows = f"{THROW}/rows"
    portal.page.locator("#form .grid-row").get_by_role("button", name="Add row").click()
    portal.input(f"{rows}/2/axis_deg").fill("200")
    portal.optimise()
    assert portal.bodies("/v1/optimize")[-1]["machine"]["throws"][0]["rows"][2]["axis_deg"] == 200
    assert portal.page.locator("#answer .front .row").count() == 3


def test_another_kind_of_machine_holds_nothing_that_nobody_typed(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open("2d12")
    portal.input("/machine/kind").select_option("scroll")
    portal.page.click("#optimise")
    portal.page.locator("#form [aria-invalid='true']").first.wait_for()
    machine = portal.bodies("/v1/optimize")[-1]["machine"]
    # the webs of the machine before, and of the scroll its kind alone
    assert set(machine) == {"kind", "name", "description", "speed_rpm", "webs"}
    assert len(machine["webs"]) == 4
    assert "NaN" not in portal.page.locator("#drawings").inner_html()
    values = {"orbit_radius_m": "5 mm", "orbiting_mass_kg": "1,2", "orbiting_position_m": "0"}
    for name, value in values.items():
        portal.input(f"/machine/{name}").fill(value)
    device = "/machine/anti_rotation"
    assert portal.input(f"{device}/type").input_value() == ""
    portal.input(f"{device}/type").select_option("crank_pins")
    for name, value in {"count": "3", "pin_circle_radius_m": "50 mm", "position_m": "0"}.items():
        assert portal.input(f"{device}/{name}").input_value() == ""
        portal.input(f"{device}/{name}").fill(value)
    portal.optimise()
    portal.page.locator("#panel-sweep").wait_for()


def test_a_machine_is_pasted(portal: Portal) -> None:
    portal.open()
    machine = {
        "kind": "reciprocating",
        "name": "<img src=x onerror=alert(1)>",
        "speed_rpm": 600,
        "throws": [
            {"name": "<b>1</b>", "position_m": 0, "crank_radius_m": 0.1, "crank_angle_deg": 0, "rotating_mass_kg": 10}
        ],
        "webs": [{"name": "<i>w</i>", "position_m": 0, "counterweight_radius_m": 0.1, "max_mass_kg": 20}],
    }
    portal.page.locator("#paste > summary").click()
    portal.page.fill("#json", json.dumps(machine))
    with portal.asking():
        portal.page.click("#read")
    assert portal.input("/machine/name").input_value() == machine["name"]
    # analytic: ten kilograms at the same radius opposite the crank leave nothing
    row = portal.panel("counterweights").locator("tbody tr").first.locator("th, td").all_inner_texts()
    assert row[:3] == ["<i>w</i>", "10", "180"]
    # names are texts, whatever they hold
    assert portal.page.locator("#results img, #results i, #results b, #form img").count() == 0


def test_a_machine_is_uploaded(portal: Portal) -> None:
    portal.open()
    portal.page.locator("#paste > summary").click()
    with portal.asking():
        portal.page.set_input_files("#file", "examples/w60.json")
    assert portal.page.locator("#answer .front .row").count() == 3
    assert portal.page.locator("#example").input_value() == ""


def test_whatever_is_pasted_is_answered_in_words(portal: Portal) -> None:
    portal.refusals = {422}
    portal.open()
    portal.page.locator("#paste > summary").click()
    _no_machine(portal)
    _fields_that_the_form_does_not_know(portal)
    _words_that_were_meant(portal)
    _no_machine_but_its_name(portal)


def _read(portal: Portal, text: str) -> None:
    portal.page.evaluate("document.getElementById('problem').replaceChildren()")
    portal.page.evaluate("document.getElementById('paste').open = true")
    portal.page.fill("#json", text)
    portal.page.click("#read")


def _no_machine(portal: Portal) -> None:
    before = portal.runs()
    for text in ("", "{", "[]", "null", "7"):
        _read(portal, text)
        assert "not a machine" in portal.page.locator("#json-error").inner_text(), text
    assert portal.runs() == before


def _fields_that_the_form_does_not_know(portal: Portal) -> None:
    _read(portal, '{"machine": {"kind": "reciprocating", "wings": 2}}')
    portal.page.locator("#problem h2").wait_for()
    portal.page.locator("#form .wrong").first.wait_for(state="attached")
    assert "wings: unknown field" in portal.page.locator("#form").inner_text()


def _words_that_were_meant(portal: Portal) -> None:
    _read(portal, '{"machine": {"kind": "reciprocating", "speed": 500, "throws": [{"positon_m": 0}]}}')
    portal.page.locator("#problem h2").wait_for()
    portal.page.get_by_text("did you mean speed_rpm?").wait_for()
    portal.page.get_by_text("did you mean position_m?").wait_for()


def _no_machine_but_its_name(portal: Portal) -> None:
    machines: list[object] = [
        None,
        7,
        "scroll",
        [],
        {},
        {"kind": "reciprocating", "throws": 3, "webs": {"a": 1}},
        {"kind": "reciprocating", "throws": [None, 1, "x", {"rows": [None, 2]}, {"rows": "none"}], "webs": [[]]},
        {"kind": "scroll", "anti_rotation": "none", "rotation_torque_Nm": {"angle_deg": 3}},
        {"kind": ["scroll"], "__proto__": {"kind": "scroll"}, "constructor": 1},
    ]
    for machine in machines:
        _read(portal, json.dumps({"machine": machine}))
        portal.page.locator("#problem h2").wait_for()
        assert "wrong" in portal.page.locator("#problem").inner_text(), machine
        assert portal.troubles == [], machine


def test_with_the_keyboard_alone(portal: Portal) -> None:
    portal.open()
    page = portal.page
    page.locator("#example").focus()
    for _ in range(40):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.closest('[data-pointer]')?.dataset.pointer") == "/machine/speed_rpm":
            break
    page.keyboard.press("Control+A")
    page.keyboard.type("250")
    with portal.asking():
        page.keyboard.press("Enter")
    assert portal.bodies("/v1/optimize")[-1]["machine"]["speed_rpm"] == 250
    panel = portal.panel("torque").locator("> summary")
    panel.focus()
    page.keyboard.press("Enter")
    portal.shown("torque")
