"""axe-core finds nothing serious, in light and dark, wide and narrow; and what it cannot see."""

from typing import Any, Literal

import pytest
from axe_playwright_python.base import AXE_SCRIPT

from tests.browser.portal import Look, Portal, ask

SERIOUS = ("serious", "critical")
SCHEMES: tuple[Literal["light", "dark"], ...] = ("light", "dark")
#: in the page: name and impact of every rule of axe that is broken, with some of the elements that break it
_VIOLATIONS = """async ([within, without, options]) => {
  const { violations } = await axe.run({ include: [within ?? "html"], exclude: without ? [without] : [] }, options);
  const some = (nodes) => nodes.slice(0, 3).map(({ html }) => html.slice(0, 160));
  return violations.map(({ id, impact, nodes }) => [id, impact, some(nodes)]);
}"""
PANELS = ("counterweights", "hodographs", "orders", "pareto", "torque", "main-bearings", "pin-loads", "sweep")


WIDE, NARROW = Look(1280, "light"), Look(390, "dark")


@pytest.fixture
def portal(visit: Portal) -> Portal:
    """Nothing of another test is in what axe looks at."""
    return visit


#: inside of the second of two plots, and of further pairs, whose marks are made as those of the first
SECOND = ".pair > .plot + .plot > *, .pair ~ .pair > .plot > *"


@pytest.mark.parametrize(
    ("example", "options", "without"),
    [
        pytest.param("2d12", WIDE, SECOND, id="2d12"),
        pytest.param("scroll-three-pins", NARROW, SECOND, id="scroll-three-pins"),
        *(
            pytest.param(example, look, None, marks=pytest.mark.nightly, id=f"{example} {look.width}")
            for example in ("2d12", "scroll-three-pins")
            for look in (WIDE, NARROW)
        ),
    ],
)
def test_axe_finds_nothing_serious(portal: Portal, example: str, options: Look, without: str | None) -> None:
    portal.open(example, PANELS)
    portal.unfold("/machine", "/machine/webs", "/machine/webs/0")
    portal.page.locator("#paste > summary").click()
    portal.screenshot(f"{example}-{options.scheme}-{options.width}")
    if without:
        assert portal.page.locator(without).count() > 0
    assert serious(portal, without=without) == []


def serious(portal: Portal, within: str | None = None, without: str | None = None, **options: Any) -> list[Any]:
    """What axe finds, of the whole page or of the elements that a selector names, which must be there.

    ``without`` is a selector of elements that it does not look at.
    """
    # half a megabyte, which a page reads once
    if not portal.page.evaluate("'axe' in globalThis"):
        portal.page.evaluate(AXE_SCRIPT)
    # nothing is made of what is right, which takes longer than to look
    figures = portal.page.evaluate(_VIOLATIONS, [within, without, {"resultTypes": ["violations"], **options}])
    return [(rule, nodes) for rule, impact, nodes in figures if impact in SERIOUS]


@pytest.mark.parametrize("options", [Look()])
@pytest.mark.parametrize("which", ["the beginning", pytest.param("all", marks=pytest.mark.nightly)])
def test_examples_and_the_beginning_in_both_colours(portal: Portal, url: str, which: str) -> None:
    portal.page.goto(f"{url}/")
    portal.page.get_by_role("heading", name="Begin with your machine").wait_for()
    names = [example["name"] for example in ask(url, "/v1/examples")["examples"]]
    fields = {}
    for name in ("", *(names if which == "all" else ())):
        if name:
            portal.page.select_option("#example", name)
            portal.page.wait_for_url(f"**#example={name}&*")
            portal.page.wait_for_selector("#results:not([aria-busy])")
            portal.page.wait_for_selector("#results[data-drawn]")
        for scheme in SCHEMES:
            portal.page.emulate_media(color_scheme=scheme)
            # but for its colours the page is the same in both
            fields[name, scheme] = serious(portal, **({} if scheme == "light" else {"runOnly": ["cat.color"]}))
    assert {where: faults for where, faults in fields.items() if faults} == {}


@pytest.mark.parametrize("options", [Look()])
def test_the_theme_can_be_chosen(portal: Portal) -> None:
    portal.open("w60", ("orders",))

    def background() -> Any:
        return portal.page.evaluate("getComputedStyle(document.body).backgroundColor")

    backgrounds = {}
    for _ in range(3):
        button = portal.page.locator("#theme")
        button.click()
        backgrounds[button.inner_text()] = background()
    assert backgrounds["Theme: light"] == "rgb(255, 255, 255)"
    assert backgrounds["Theme: dark"] == "rgb(18, 22, 27)"
    assert backgrounds["Theme: auto"] in backgrounds["Theme: light"] + backgrounds["Theme: dark"]
