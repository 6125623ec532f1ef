"""The page tells what the independent checker makes of an answer, after it is shown and never before."""

import json
import re
from typing import Any

from playwright.sync_api import Route, expect

from tests.browser.portal import Portal


def test_the_answer_is_checked_once_it_is_shown(portal: Portal) -> None:
    parts: list[str] = []
    portal.page.on("request", lambda request: parts.append(request.url.rpartition("/v1/")[2]))
    portal.open("2d12")
    note = portal.page.locator("#answer .checked")
    expect(note).to_have_text(re.compile(r"^checked: (\d+) of \1 claims, and every one holds\.$"))
    # every number that the page asks for first, its hodographs among them
    assert int(note.inner_text().split()[1]) > 1500
    assert parts.index("optimize") < parts.index("verify")


def test_what_is_not_covered_is_named(portal: Portal) -> None:
    portal.open("catalogue-twin")
    note = portal.page.locator("#answer .checked")
    expect(note).to_have_text(
        re.compile(r"^checked: \d+ of \d+ claims; nothing is broken\. Not covered: .*certificate lower_bound")
    )


def test_a_broken_claim_stands_out(portal: Portal) -> None:
    def falsified(route: Route) -> None:
        reply = route.fetch()
        document: dict[str, Any] = reply.json()
        document["total_mass_kg"] *= 1.001
        route.fulfill(response=reply, body=json.dumps(document))

    portal.page.route("**/v1/optimize", falsified)
    portal.open("v8-cross-plane")
    note = portal.page.locator('#answer .checked[data-verdict="broken"]')
    expect(note).to_contain_text("Broken: total_mass (total_mass_kg)")
