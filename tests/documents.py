"""OpenAPI documents of applications that are alike: the first is made, which takes a second, the others are copies.

How one is made is tested where it is made anew, by ``Documented.openapi.__wrapped__``.
"""

import json
import pickle
from collections.abc import Hashable
from functools import wraps
from pathlib import Path
from typing import Any

from service.app import create_app
from service.computations.table import COMPUTATIONS
from service.http.openapi import Documented
from service.settings import Settings

_TEXTS: dict[Hashable, str] = {}


def keep_documents() -> None:
    """From now on."""
    make = Documented.openapi

    @wraps(make)
    def openapi(app: Documented) -> dict[str, Any]:
        # all that applications differ in: tests add computations, and routes after the first look
        key = (app._keyed, tuple(COMPUTATIONS), len(app.routes), app.title)
        if key not in _TEXTS:
            _TEXTS[key] = json.dumps(make(app))
        document: dict[str, Any] = json.loads(_TEXTS[key])
        return document

    Documented.openapi = openapi  # type: ignore[method-assign]


def make_documents() -> None:
    """Make those of services with and without keys, for all processes that are forked from this one."""
    for keyed in (False, True):
        app = create_app(Settings(), warm=False)
        app._keyed = keyed
        app.openapi()


def write_documents(file: Path) -> None:
    """Those that are made, for a process that is not forked from this one."""
    file.write_bytes(pickle.dumps(_TEXTS))


def read_documents(file: Path) -> None:
    """Those of another process of this run, kept from now on."""
    _TEXTS.update(pickle.loads(file.read_bytes()))
    keep_documents()
