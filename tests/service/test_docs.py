"""The documentation page works without a network."""

import re

from starlette.testclient import TestClient


def test_the_page_loads_nothing_from_elsewhere(client: TestClient) -> None:
    page = client.get("/docs")
    assert page.status_code == 200
    assert page.headers["content-type"].startswith("text/html")
    assert "//" not in re.sub(r"<!--.*?-->", "", page.text)
    assert page.headers["content-security-policy"].startswith("default-src 'self'")
    # the badge of an online validator would be fetched from elsewhere
    assert '"validatorUrl": null' in page.text


def test_everything_that_the_page_loads_is_there(client: TestClient) -> None:
    page = client.get("/docs").text
    matches = re.findall(r'(?:src|href)="([^"]+)"', page) + re.findall(r"url: '([^']+)'", page)
    assert set(matches) == {
        "docs/assets/swagger-ui.css",
        "docs/assets/favicon.png",
        "docs/assets/swagger-ui-bundle.js",
        "openapi.json",
    }
    for address in matches:
        assert client.get(f"/{address}").status_code == 200


def test_the_assets_are_of_a_version_that_reads_the_document(client: TestClient) -> None:
    # OpenAPI 3.1 is read from version 5 on
    assert re.search(
        r'(?:PACKAGE_VERSION|version)\s*[:=]\s*"v?5\.\d+', client.get("/docs/assets/swagger-ui-bundle.js").text
    )


def test_there_is_no_second_documentation_page(client: TestClient) -> None:
    assert client.get("/redoc").status_code == 404
