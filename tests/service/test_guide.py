"""The documents as a site below ``/docs/guide``."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.settings import Settings

START, MISSING = "<!doctype html><title>Start</title>", "<!doctype html><input type=search>"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    site = tmp_path_factory.mktemp("site")
    (site / "how-to").mkdir()
    (site / "index.html").write_text(START)
    (site / "how-to" / "sweep.html").write_text("<!doctype html><title>Sweep</title>")
    (site / "404.html").write_text(MISSING)
    (site.parent / "secret.txt").write_text("outside")
    return site


@pytest.fixture(scope="module")
def guide(folder: Path) -> Iterator[TestClient]:
    with TestClient(create_app(Settings(guide_dir=folder), warm=False), follow_redirects=False) as client:
        yield client


def test_the_start_page_stands_at_the_folder(guide: TestClient) -> None:
    moved = guide.get("/docs/guide")
    # relative: a prefix of a proxy stays
    assert (moved.status_code, moved.headers["location"]) == (308, "guide/")
    page = guide.get("/docs/guide/")
    assert (page.status_code, page.text) == (200, START)
    assert page.headers["content-type"].startswith("text/html")
    assert page.headers["content-security-policy"].startswith("default-src 'self'")
    assert "http" not in page.headers["content-security-policy"]


def test_a_page_is_not_sent_to_a_reader_who_has_it(guide: TestClient) -> None:
    page = guide.get("/docs/guide/how-to/sweep.html")
    assert page.status_code == 200
    again = guide.get("/docs/guide/how-to/sweep.html", headers={"If-None-Match": page.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


@pytest.mark.parametrize(
    "path", ["nothing", "how-to/nothing.html", "%2e%2e/secret.txt", "..%2fsecret.txt", "a%00b", "x" * 300]
)
def test_an_unknown_path_is_a_page_with_a_search(guide: TestClient, path: str) -> None:
    page = guide.get(f"/docs/guide/{path}")
    assert (page.status_code, page.text) == (404, MISSING)


@pytest.mark.parametrize("method", ["POST", "DELETE"])
def test_pages_are_only_read(guide: TestClient, method: str) -> None:
    answer = guide.request(method, "/docs/guide/")
    assert answer.status_code == 405
    assert answer.headers["content-type"] == "application/problem+json"
    assert guide.head("/docs/guide/").status_code == 200


@pytest.mark.parametrize("name", ["", "nowhere"])
def test_a_guide_that_is_not_built_says_how_to_build_it(tmp_path: Path, name: str) -> None:
    with TestClient(create_app(Settings(guide_dir=tmp_path / name), warm=False)) as client:
        answer = client.get("/docs/guide/how-to/sweep.html")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"
    assert "make docs" in answer.json()["detail"]


def test_a_page_is_counted_as_one_of_the_guide(guide: TestClient) -> None:
    """A mounted application moves the root path of a request; that of the start page would be `/` then."""
    for path in ("", "how-to/sweep.html", "nothing"):
        guide.get(f"/docs/guide/{path}")
    counted = re.findall(r'counterweight_requests_total\{method="GET",route="([^"]+)"', guide.get("/metrics").text)
    assert "/docs/guide" in counted
    assert "/" not in counted
