"""What the page is made of: compressed, kept, allowed to load nothing from elsewhere. Needs no browser."""

import gzip
import json
import re
import urllib.error
import urllib.request
from email.message import Message

import pytest
from starlette.testclient import TestClient

from service.app import create_app
from service.portal.assets import PLOTS, STATIC, asset, names, page, release
from service.settings import Settings


def _get(url: str, **headers: str) -> tuple[int, Message, bytes]:
    fields = {name.replace("_", "-"): value for name, value in headers.items()}
    try:
        with urllib.request.urlopen(urllib.request.Request(url, headers=fields), timeout=180) as answer:
            return answer.status, answer.headers, answer.read()
    except urllib.error.HTTPError as error:
        return error.code, error.headers, error.read()


def test_the_page_may_load_from_its_own_service_alone(url: str) -> None:
    status, headers, body = _get(f"{url}/")
    assert status == 200
    policy = headers["content-security-policy"]
    assert "script-src 'self';" in policy
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    # every address is relative, and nothing is inline
    assert not re.search(rb'(src|href)="(https?:|//|/)', body)
    assert not re.search(rb"<style|style=|<script(?![^>]* src=)|\son\w+=", body)


def test_nobody_may_frame_it_unless_the_operator_says_who(url: str) -> None:
    _, headers, body = _get(f"{url}/")
    assert (headers["x-frame-options"], b'name="frame-origins" content=""' in body) == ("DENY", True)
    assert headers["content-security-policy"].endswith("frame-ancestors 'none'")
    client = TestClient(create_app(Settings(frame_origins=("https://a.example", "https://b.example:8443")), warm=False))
    page, api = client.get("/"), client.get("/healthz")
    assert page.headers["content-security-policy"].endswith("frame-ancestors https://a.example https://b.example:8443")
    assert 'name="frame-origins" content="https://a.example https://b.example:8443"' in page.text
    # the page alone: answers, and documents that the service writes, stay as they are
    assert ("x-frame-options" in page.headers, api.headers["x-frame-options"]) == (False, "DENY")


def test_nothing_in_our_files_writes_markup() -> None:
    text = asset("page.js").content.decode()
    assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function", text)
    assert not re.search(r"""["'`]https?://(?!www\.w3\.org/2000/svg)""", text)


def test_files_are_kept_for_ever_until_they_change(url: str) -> None:
    status, headers, body = _get(f"{url}/portal/{release()}/page.js", Accept_Encoding="gzip, br")
    assert status == 200
    assert headers["content-type"].startswith("text/javascript")
    assert "immutable" in headers["cache-control"]
    assert headers["vary"].startswith("Accept-Encoding")
    assert gzip.decompress(body) == asset("page.js").content
    status, headers, body = _get(f"{url}/portal/of-yesterday/page.js")
    assert (status, headers["cache-control"], body) == (200, "no-cache", asset("page.js").content)


@pytest.mark.parametrize("refused", ["gzip;q=0", "br", "identity", "*;q=0"])
def test_who_does_not_take_gzip_gets_none(url: str, refused: str) -> None:
    _, headers, body = _get(f"{url}/portal/{release()}/page.css", Accept_Encoding=refused)
    assert headers["content-encoding"] is None
    assert body == asset("page.css").content


@pytest.mark.parametrize("name", ["", "nothing.js", "../assets.py", "..%2f..%2fapp.py", "index.html", "%00"])
def test_nothing_else_is_served(url: str, name: str) -> None:
    status, headers, _ = _get(f"{url}/portal/{release()}/{name}")
    assert status == 404
    assert headers["content-type"] == "application/problem+json"


def test_the_page_asks_for_one_file_of_each_kind_of_this_release() -> None:
    matches = re.findall(rb'(?:src|href)="portal/(\w+)/([\w.]+)"', page())
    assert sorted(matches) == [(release().encode(), name) for name in (b"icon.svg", b"page.css", b"page.js")]
    assert {name.decode() for _, name in matches} | {"schemas.json", PLOTS} == set(names())


def test_every_module_and_every_style_is_in_the_page() -> None:
    page, style = asset("page.js").content.decode(), asset("page.css").content.decode()
    for path in STATIC.rglob("*.js"):
        assert f"\n// {path.relative_to(STATIC).as_posix()}\nconst module" in f"\n{page}", path
    assert all(path.read_text() in style for path in STATIC.glob("*.css"))


def test_the_form_has_the_schemas_of_the_document(url: str) -> None:
    document = json.loads(_get(f"{url}/openapi.json")[2])["components"]["schemas"]
    own = json.loads(asset("schemas.json").content)
    assert {"OptimizeRequest", "ParetoRequest"} <= set(own)
    assert own == {name: document[name] for name in own}
