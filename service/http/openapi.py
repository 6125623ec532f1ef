"""The OpenAPI document: what the framework finds out by itself, and what :mod:`service.http.operations` says.

Bodies are read by :mod:`service.http.computing` and errors are written by :mod:`service.http.errors`, so their
schemas are added here.
"""

import json
from collections.abc import Mapping
from typing import Any

from fastapi import FastAPI
from pydantic.json_schema import models_json_schema
from starlette.requests import Request
from starlette.responses import Response

from schemas.answer.problem import Problem
from schemas.base.model import Model
from schemas.sweep.request import SweepRequest
from service.computations.table import COMPUTATIONS
from service.guard.keys import PUBLIC, PUBLIC_FOLDERS
from service.http.cached_document import CachedDocument, Shelf
from service.http.operations import HEADERS, MODEL_REF, PARAMETERS, Described, headers, problems

#: groups of operations, in the order in which they are shown
_TAGS: Mapping[str, str] = {
    "counterweights": "Choose counterweights, and say what a machine does with them.",
    "scroll": "The anti-rotation pins of scroll machines.",
    "rating": "Thermal design of compressors.",
    "shaft": "Crankshafts as a CAD lists them.",
    "sweeps": "Many designs of a machine, and other jobs that are answered later.",
    "pictures": "One drawing of an answer.",
    "tables": "One table of an answer.",
    "examples": "Machines to start from.",
    "problems": "Causes and remedies of problems.",
    "health": "Whether the service lives and can compute, and which version it is.",
}
_SECURITY: Mapping[str, Described] = {
    "bearer": {"type": "http", "scheme": "bearer", "description": "an API key, where the service asks for one"},
    "key": {"type": "apiKey", "in": "header", "name": "X-API-Key", "description": "the same in a header of its own"},
}


class Documented(FastAPI):
    """An application whose document holds all that its operations take and answer.

    Parameters
    ----------
    keyed : whether requests must have a key; else the document says that one is optional.
    """

    def __init__(self, *, keyed: bool, **options: Any) -> None:
        self._keyed = keyed
        self._documents = Shelf(self._document)
        described = [{"name": name, "description": words} for name, words in _TAGS.items()]
        super().__init__(**options, openapi_tags=described)

    def openapi(self) -> dict[str, Any]:
        document = super().openapi()
        schemas = document["components"]["schemas"]
        # the framework keeps the document and makes a new one when routes are added
        if Problem.__name__ not in schemas:
            models: list[type[Model]] = [
                *(computation.request_model for computation in COMPUTATIONS.values()),
                SweepRequest,
                Problem,
            ]
            _, definitions = models_json_schema([(model, "validation") for model in models], ref_template=MODEL_REF)
            # a model of requests and answers, as a cylinder, is described as in requests: that holds for both
            schemas |= definitions["$defs"]
            document["servers"] = [{"url": "/"}]
            document["components"] |= {"headers": {**HEADERS}, "parameters": {**PARAMETERS}}
            document["components"]["securitySchemes"] = {**_SECURITY}
            for path, operations in document["paths"].items():
                for operation in operations.values():
                    self._complete(path, operation)
        return document

    def _complete(self, path: str, operation: Described) -> None:
        """Say what all operations have: a key or none, the headers of every answer."""
        common = ["X-Request-ID"]
        if path in PUBLIC or path.startswith(PUBLIC_FOLDERS):
            operation["security"] = []
        else:
            operation["security"] = [{"bearer": []}, {"key": []}, *([] if self._keyed else [{}])]
            common += ["RateLimit", "RateLimit-Policy"]
            operation["responses"] |= {str(status): about for status, about in problems(401, 403, 429).items()}
        for response in operation["responses"].values():
            response["headers"] = {**response.get("headers", {}), **headers(*common)}

    def _document(self, prefix: str) -> CachedDocument:
        """The document as it is written for a prefix: hundreds of kilobytes, and most of a second of work."""
        servers = {"servers": [{"url": prefix}]} if prefix else {}
        content = json.dumps({**self.openapi(), **servers}, ensure_ascii=False).encode()
        # else it would be held twice
        self.openapi_schema = None
        return CachedDocument(content, "application/json")

    def setup(self) -> None:
        """Answer with the document."""

        async def answer(request: Request) -> Response:
            document = await self._documents.take(request, request.scope.get("root_path", ""))
            return document.answer(request)

        self.add_route("/openapi.json", answer, include_in_schema=False)
