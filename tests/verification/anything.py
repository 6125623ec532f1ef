"""Any JSON in any place of what is sent to the checker."""

import json
from typing import Any

from hypothesis import strategies as st

from service.verification import checker
from tests.verification.kinds import SINGLE

_WEB = SINGLE["sum"]["machine"]["webs"][0]["name"]
JSON = st.recursive(
    st.none()
    | st.booleans()
    | st.floats()
    | st.integers()
    | st.sampled_from([10**400, -(10**400), 10**4000, 1e308, -1e308, 5e-324, "", "5 kg", "1e999 mm", "\ud800", _WEB])
    | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3) | st.just("name"), inner, max_size=3)
    ),
    max_leaves=6,
)


def paths(node: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    actual_paths = [path]
    if isinstance(node, dict):
        return [*actual_paths, *(deeper for key, value in node.items() for deeper in paths(value, (*path, key)))]
    if isinstance(node, list):
        return [*actual_paths, *(deeper for key, value in enumerate(node) for deeper in paths(value, (*path, key)))]
    return actual_paths


def replaced(node: Any, path: tuple[str | int, ...], value: Any) -> Any:
    if not path:
        return value
    if isinstance(node, dict):
        return {key: replaced(number, path[1:], value) if key == path[0] else number for key, number in node.items()}
    return [replaced(number, path[1:], value) if key == path[0] else number for key, number in enumerate(node)]


def judged(request: Any, answer: Any) -> None:
    path: tuple[str | int, ...] = ()
    try:
        verdict = checker().verify(request, answer)
    except checker().Unreadable as error:
        path = error.path
    else:
        json.dumps(verdict, allow_nan=False).encode()
    assert path[:1] in ((), ("request",), ("answer",))
