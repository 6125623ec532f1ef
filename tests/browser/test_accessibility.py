"""axe-core finds nothing serious, in light and dark, wide and narrow; and what it cannot see."""

from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe

from tests.browser.portal import Look, Portal

SERIOUS = ("serious", "critical")
PANELS = ("counterweights", "hodographs", "orders", "pareto", "torque", "main-bearings", "pin-loads", "sweep")


@pytest.fixture(params=[Look(1280, "light"), Look(390, "dark")], ids=["wide-light", "narrow-dark"])
def options(request: pytest.FixtureRequest) -> Look:
    look: Look = request.param
    return look


@pytest.mark.parametrize("example", ["2d12", "scroll-three-pins"])
def test_axe_finds_nothing_serious(portal: Portal, example: str, options: Look) -> None:
    portal.open(example, PANELS)
    portal.unfold("/machine", "/machine/webs", "/machine/webs/0")
    portal.page.locator("#paste > summary").click()
    portal.screenshot(f"{example}-{options.scheme}-{options.width}")
    found = Axe().run(portal.page).response["violations"]
    serious = [
        (one["id"], one["help"], [node["html"][:160] for node in one["nodes"][:3]])
        for one in found
        if one["impact"] in SERIOUS
    ]
    assert serious == []


@pytest.mark.parametrize("options", [Look()])
def test_the_theme_can_be_chosen(portal: Portal) -> None:
    portal.open("w60", ("orders",))

    def background() -> Any:
        return portal.page.evaluate("getComputedStyle(document.body).backgroundColor")

    seen = {}
    for _ in range(3):
        button = portal.page.locator("#theme")
        button.click()
        seen[button.inner_text()] = background()
    assert seen["Theme: light"] == "rgb(255, 255, 255)"
    assert seen["Theme: dark"] == "rgb(18, 22, 27)"
    assert seen["Theme: auto"] in seen["Theme: light"] + seen["Theme: dark"]
