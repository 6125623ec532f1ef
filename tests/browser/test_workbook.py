"""Workbooks on the page: a template out, a workbook in, its answer out, and what is wrong with one by its cell."""

import json
from pathlib import Path

import openpyxl
from playwright.sync_api import expect

from tests.browser.portal import Portal, ask


def _saved(portal: Portal, target: Path, button: str = "save-workbook", name: str = "2D12-90-2-20.xlsx") -> Path:
    portal.page.locator("#paste > summary").click()
    with portal.page.expect_download() as download:
        portal.page.click(f"#{button}")
    assert download.value.suggested_filename == name
    download.value.save_as(target)
    return target


def test_a_workbook_is_optimised_and_comes_back_with_its_answer(portal: Portal, tmp_path: Path) -> None:
    portal.open("2d12")
    file = _saved(portal, tmp_path / "machine.xlsx")
    with portal.page.expect_download() as download:
        portal.page.set_input_files("#workbook", file)
    download.value.save_as(tmp_path / "answer.xlsx")
    book = openpyxl.load_workbook(tmp_path / "answer.xlsx")
    heads, *rows = book["counterweights"].iter_rows(values_only=True)
    masses = [dict(zip(heads, row, strict=True)) for row in rows]
    (column,) = [str(head) for head in heads if str(head).startswith("mass_kg")]
    example = ask(portal.url, "/v1/examples/2d12")
    # independent: the same machine as JSON
    expected = [
        counterweight["mass_kg"] for counterweight in ask(portal.url, "/v1/optimize", example)["counterweights"]
    ]
    assert [round(float(str(row[column])), 6) for row in masses] == [round(mass, 6) for mass in expected]


def save(portal: Portal, file: Path) -> None:
    """The 2D12 at a speed of its own, as a workbook."""
    portal.open("2d12")
    portal.input("/machine/speed_rpm").fill("777")
    portal.page.locator("#paste > summary").click()
    with portal.page.expect_download() as saved:
        portal.page.click("#save-workbook")
    saved.value.save_as(file)


def test_what_is_worked_on_is_saved_as_a_workbook_that_is_taken_again(portal: Portal, tmp_path: Path) -> None:
    save(portal, tmp_path / "saved.xlsx")
    with portal.page.expect_download() as answered:
        portal.page.set_input_files("#workbook", tmp_path / "saved.xlsx")
    answered.value.save_as(tmp_path / "answered.xlsx")
    books = [openpyxl.load_workbook(tmp_path / name) for name in ("saved.xlsx", "answered.xlsx")]
    for book in books:
        assert 777 in [cell for row in book["machine"].iter_rows(values_only=True) for cell in row]
    counterweights = [list(book["counterweights"].iter_rows(values_only=True)) for book in books]
    assert counterweights[0] == counterweights[1]


def test_a_saved_workbook_is_opened_into_the_form(portal: Portal, tmp_path: Path) -> None:
    save(portal, tmp_path / "saved.xlsx")
    with portal.asking():
        portal.page.select_option("#example", "v60")
    expect(portal.input("/machine/speed_rpm")).not_to_have_value("777")
    with portal.asking():
        portal.page.set_input_files("#file", tmp_path / "saved.xlsx")
    expect(portal.input("/machine/speed_rpm")).to_have_value("777")
    expect(portal.page.locator("#json-error")).to_be_empty()
    example = ask(portal.url, "/v1/examples/2d12")
    example["machine"]["speed_rpm"] = 777
    for throw in example["machine"]["throws"]:
        assert throw["crank_radius_m"] == "140 mm"
        throw["crank_radius_m"] = 0.14
    portal.page.locator("#paste > summary").click()
    portal.page.click("#write")
    # independent: the example as it is published, with the speed that was typed
    assert json.loads(portal.page.locator("#json").input_value()) == example


def test_what_is_wrong_is_named_by_its_cell_and_the_form_stays(portal: Portal, tmp_path: Path) -> None:
    portal.refusals = {400, 422}
    portal.open("2d12")
    file, element = _saved(portal, tmp_path / "machine.xlsx"), portal.page.locator("#json-error")
    book = openpyxl.load_workbook(file)
    (place,) = [row[1] for row in book["machine"].iter_rows() if row[0].value == "machine.speed_rpm"]
    speed, place.value = place.value, "fast"
    book.save(file)
    # opened into the form
    portal.page.set_input_files("#file", file)
    expect(element).to_contain_text(f"machine!{place.coordinate}")
    expect(portal.input("/machine/speed_rpm")).to_have_value("500")
    # optimised at once
    place.value, sheet = speed, book["webs"]
    (column,) = [cell.column_letter for cell in sheet[1] if str(cell.value).startswith("max_mass_kg")]
    sheet[f"{column}3"] = "heavy"
    book.save(file)
    portal.page.set_input_files("#workbook", file)
    expect(element).to_contain_text(f"webs!{column}3")
    # no workbook at all
    file.write_bytes(b"no workbook")
    portal.page.set_input_files("#workbook", file)
    expect(element).not_to_contain_text("webs!")
    expect(element).not_to_be_empty()
