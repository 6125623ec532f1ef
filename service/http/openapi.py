"""What the OpenAPI document says beyond what the framework finds out by itself.

Bodies are read by :mod:`service.http.computing` and errors are written by :mod:`service.http.errors`, so their
schemas are added here.
"""

import json
from typing import Any

from fastapi import FastAPI
from pydantic.json_schema import models_json_schema
from starlette.requests import Request
from starlette.responses import Response

from schemas.answer.problem import Problem
from schemas.base.model import Model
from schemas.sweep.request import SweepRequest
from service.common.problems import PROBLEM_JSON
from service.computations import COMPUTATIONS, XLSX
from service.documents.examples import bodies
from service.guard.keys import PUBLIC
from service.http.kept import Kept

#: statuses that every computing route may answer with
COMPUTE_PROBLEMS = (400, 408, 413, 415, 422, 503)

#: content that is no text
BINARY: dict[str, Any] = {"schema": {"type": "string", "format": "binary"}}

_REF = "#/components/schemas/{model}"
_DESCRIPTIONS: dict[int | str, str] = {
    400: "unreadable body",
    401: "no key, or a wrong one",
    403: "the key does not allow this",
    404: "no such resource",
    406: "the header `Accept` names no form that there is",
    408: "the body did not arrive in time",
    409: "in conflict with what is there",
    413: "body too large",
    415: "the body is not announced as what is read here",
    422: "invalid machine or request; `errors` names the fields",
    429: "busy; `Retry-After` says when to try again",
    503: "not ready; `Retry-After` says when to try again",
    "default": "any other failure",
}

_SECURITY = {
    "bearer": {"type": "http", "scheme": "bearer", "description": "an API key, where the service asks for one"},
    "key": {"type": "apiKey", "in": "header", "name": "X-API-Key", "description": "the same in a header of its own"},
}


def problems(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """Responses with problem details: those of the statuses, and any other failure."""
    content = {PROBLEM_JSON: {"schema": _ref(Problem)}}
    listed: tuple[int | str, ...] = (*statuses, "default")
    return {status: {"description": _DESCRIPTIONS[status], "content": content} for status in listed}


def _needs_key(path: str, operation: dict[str, Any]) -> None:
    """Say that a key may be needed, and what is answered without."""
    if path not in PUBLIC:
        operation["security"] = [{"bearer": []}, {"key": []}]
        operation["responses"] |= {str(status): found for status, found in problems(401, 403, 429).items()}


def request_body(model: type[Model], folder: str = "", workbook: bool = False) -> dict[str, Any]:
    """The body of a computing route, with the examples of a folder; JSON, and a workbook where one is read."""
    content: dict[str, Any] = {"application/json": {"schema": _ref(model), "examples": _examples(model, folder)}}
    if workbook:
        content[XLSX] = BINARY
    return {"requestBody": {"required": True, "content": content}}


def example_body(model: type[Model]) -> dict[int | str, dict[str, Any]]:
    """A response that is the body of a request."""
    content = {"application/json": {"schema": _ref(model)}}
    return {200: {"description": "a request body", "content": content}}


class Documented(FastAPI):
    """An application whose document holds the schemas of bodies and problems too."""

    def openapi(self) -> dict[str, Any]:
        document = super().openapi()
        known = document["components"]["schemas"]
        # the framework keeps the document and makes a new one when routes are added
        if Problem.__name__ not in known:
            models: list[type[Model]] = [*(one.asks for one in COMPUTATIONS.values()), SweepRequest, Problem]
            _, schemas = models_json_schema([(model, "validation") for model in models], ref_template=_REF)
            # a model that is asked and answered, as a cylinder, is described as it is asked: that holds for both
            known |= schemas["$defs"]
            document["components"]["securitySchemes"] = _SECURITY
            for path, operations in document["paths"].items():
                for operation in operations.values():
                    _needs_key(path, operation)
        return document

    def document(self, prefix: str) -> Kept:
        """The document as it is written for a prefix, once: it is hundreds of kilobytes."""
        if prefix not in self._written:
            servers = {"servers": [{"url": prefix}]} if prefix else {}
            content = json.dumps({**self.openapi(), **servers}, ensure_ascii=False).encode()
            self._written[prefix] = Kept(content, "application/json")
        return self._written[prefix]

    def setup(self) -> None:
        """Answer with the document."""
        self._written: dict[str, Kept] = {}

        async def answer(request: Request) -> Response:
            return self.document(request.scope.get("root_path", "")).answer(request)

        self.add_route("/openapi.json", answer, include_in_schema=False)


def _ref(model: type[Model]) -> dict[str, str]:
    return {"$ref": _REF.format(model=model.__name__)}


def _examples(model: type[Model], folder: str) -> dict[str, Any]:
    return {
        name: {
            "summary": body.get("machine", body).get("name", name),
            "value": {key: value for key, value in body.items() if key in model.model_fields},
        }
        for name, body in bodies(folder).items()
    }
