"""The documents as a site: all links lead somewhere, nothing comes from elsewhere, every page can be found."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest

from service.routes import guide
from tests.docs.reading import ROOT

CONFIGURATION = ROOT / "mkdocs.yml"


class _Page(HTMLParser):
    """Links, anchors and addresses of a page that a browser loads by itself."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        named = {name: value or "" for name, value in attrs}
        self.anchors |= {named[name] for name in ("id", "name") if name in named}
        if tag == "a" and "href" in named:
            self.links.append(named["href"])
        if "src" in named:
            self.loaded.append(named["src"])
        if tag == "link" and named.get("rel") not in ("canonical", "next", "prev"):
            self.loaded.append(named["href"])


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    ran = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return folder


@pytest.fixture(scope="module")
def pages(site: Path) -> dict[Path, _Page]:
    return {path: _Page(path.read_text()) for path in site.rglob("*.html")}


def test_links_lead_to_a_page_and_a_place_on_it(site: Path, pages: dict[Path, _Page]) -> None:
    broken = []
    for path, page in pages.items():
        # the page of errors is shown at any path, and names places from the root
        for link in page.links if path.name != "404.html" else []:
            address = urlsplit(link)
            if address.scheme or address.netloc:
                continue
            target = (path.parent / unquote(address.path)).resolve() if address.path else path
            target = target / "index.html" if target.is_dir() else target
            anchors = pages[target].anchors if target in pages else set()
            if not target.exists() or (
                address.fragment and target in pages and unquote(address.fragment) not in anchors
            ):
                broken.append((path.relative_to(site), link))
    assert broken == []
    assert sum(len(page.links) for page in pages.values()) > 1000


def test_nothing_is_loaded_from_elsewhere(pages: dict[Path, _Page]) -> None:
    for path, page in pages.items():
        assert page.loaded, path
        for text in page.loaded:
            assert not urlsplit(text).netloc, (path, text)


def test_an_unknown_path_is_a_page_with_a_search(site: Path) -> None:
    text = (site / "404.html").read_text()
    assert 'class="md-search__input"' in text
    # from any depth, its files are those that the service has
    addresses = [link for link in _Page(text).loaded if not link.startswith("data:")]
    assert addresses
    assert all(link.startswith(f"{guide.PATH}/") for link in addresses), addresses
    assert (site / "search" / "search_index.json").stat().st_size > 100_000


def test_every_document_is_in_the_navigation_but_single_decisions() -> None:
    listed = set(re.findall(r"[\w./-]+\.md", CONFIGURATION.read_text().split("\nnav:")[1]))
    documents = {str(path.relative_to(ROOT / "docs")) for path in (ROOT / "docs").rglob("*.md")}
    assert listed - {"index.md", "CHANGELOG.md", "CONTRIBUTING.md"} == {
        document for document in documents if not re.match(r"decisions/\d", document)
    }
    assert re.search(r"^  font: false$", CONFIGURATION.read_text(), re.MULTILINE)
