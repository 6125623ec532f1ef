"""Headers as a scope has them."""

from typing import Any

import pytest
from starlette.datastructures import Headers

from service.common.headers import header, header_list

SCOPE: dict[str, Any] = {
    "headers": [(b"accept", b"text/html"), (b"x", b"\xe9"), (b"accept", b"*/*;q=0.1"), (b"empty", b"")]
}


@pytest.mark.parametrize("name", ["accept", "x", "empty", "none"])
def test_headers_are_those_that_the_framework_finds(name: str) -> None:
    """Independent: the framework."""
    framework = Headers(scope=SCOPE)
    assert header(SCOPE, name.encode()) == framework.get(name)
    assert header_list(SCOPE, name.encode()) == ",".join(framework.getlist(name))
