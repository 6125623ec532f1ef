"""What an operation says of itself in the OpenAPI document: parameters, headers, bodies, problems.

Parameters and headers that several operations have stand once, among the components of the document, and are referred
to by name.
"""

from collections.abc import Mapping
from functools import cache
from typing import Any

from schemas.answer.problem import Problem
from schemas.base.model import Model
from schemas.sweep.answers import SweepState
from service.common.problems import PROBLEM_JSON
from service.computations.computation import XLSX, Computation
from service.documents.examples import bodies

Described = dict[str, Any]
Responses = dict[int | str, Described]

#: statuses that every computing route may answer with
COMPUTE_PROBLEMS = (400, 408, 413, 415, 422, 503)

#: content that is no text
BINARY: Described = {"schema": {"type": "string", "format": "binary"}}
#: what is text by another name
_TEXTS = ("image/svg+xml", "application/x-ndjson")
TEXT: Described = {"schema": {"type": "string"}}

MODEL_REF = "#/components/schemas/{model}"

_DESCRIPTIONS: Mapping[int | str, str] = {
    400: "unreadable body",
    401: "no key, or a wrong one",
    403: "the key does not allow this",
    404: "no such resource",
    406: "the header `Accept` names no form that there is",
    408: "the body did not arrive in time",
    409: "in conflict with what is there",
    413: "body too large",
    415: "the body is not announced as what is read here",
    422: "invalid machine, request or parameter; `errors` names the fields",
    429: "busy, or more than the share of a client; `Retry-After` says when to try again",
    503: "not ready; `Retry-After` says when to try again",
    "default": "any other failure",
}


def _text(description: str, **more: Any) -> Described:
    return {"description": description, "schema": {"type": "string", **more}}


#: of answers, by name
HEADERS: Mapping[str, Described] = {
    "Content-Disposition": _text("the name of a file that holds the answer"),
    "ETag": {**_text("the version of the document, for `If-None-Match`"), "required": True},
    "Idempotency-Replayed": _text("the same request was accepted before, with the same key", const="true"),
    "Link": _text("the description of the columns, and the next page if there is one (RFC 8288)"),
    "Location": {**_text("the address of the sweep or job"), "required": True},
    "Preference-Applied": _text("the preference that was followed (RFC 7240)", const="respond-async"),
    "RateLimit": _text("requests that remain to the key, `r`, and the seconds until there are more, `t`"),
    "RateLimit-Policy": _text("requests that a key may send, `q`, in a window of `w` seconds"),
    "Retry-After": {
        "description": "seconds after which the same request may succeed; absent where a retry does not help",
        "schema": {"type": "integer", "minimum": 0},
    },
    "Sweep-Complete": _text("whether these are all rows that there will be; of sweeps", enum=["true", "false"]),
    "Sweep-State": _text("the state of the sweep when its rows were read"),
    "WWW-Authenticate": {**_text("how a key is sent (RFC 6750)"), "required": True},
    "X-Request-ID": {**_text("the name of the request in the log"), "required": True},
}


def _in_header(name: str, description: str, **schema: Any) -> Described:
    return {"name": name, "in": "header", "required": False, "description": description, "schema": schema}


#: of requests, by name
PARAMETERS: Mapping[str, Described] = {
    "Idempotency-Key": _in_header(
        "Idempotency-Key",
        "the same body sent again with the same key is the same sweep or job; another body is refused",
        type="string",
        pattern="^[!-~]{1,255}$",
        examples=["front-7f1c"],
    ),
    "If-None-Match": _in_header(
        "If-None-Match",
        "the `ETag` of the document that the client has; the answer is 304 if it is still the same",
        type="string",
        examples=['W/"0123456789abcdef"'],
    ),
    "Last-Event-ID": _in_header(
        "Last-Event-ID",
        "the id of the last event that the client has seen; only later ones are sent",
        type="string",
        examples=["3"],
    ),
    "Prefer": _in_header(
        "Prefer",
        "`respond-async`: the answer is a job, with status 202 (RFC 7240)",
        type="string",
        examples=["respond-async"],
    ),
}


def parameters(*names: str) -> list[Described]:
    """References to parameters that several operations have."""
    return [{"$ref": f"#/components/parameters/{name}"} for name in names]


def headers(*names: str) -> Described:
    """References to headers of answers."""
    return {name: {"$ref": f"#/components/headers/{name}"} for name in names}


def accept(*media_types: str) -> Described:
    """The header by which a client chooses a form; generators that follow the specification leave it out."""
    types = ", ".join(f"`{media_type}`" for media_type in media_types)
    words = f"the forms of the answer that the client takes: {types}; the first one where it takes any"
    return _in_header("Accept", words, type="string", examples=list(media_types))


def problems(*statuses: int) -> Responses:
    """Responses with problem details: those of the statuses, and any other failure."""
    content = {PROBLEM_JSON: {"schema": ref(Problem)}}
    keys: tuple[int | str, ...] = (*statuses, "default")
    return {status: {"description": _DESCRIPTIONS[status], "content": content, **_more(status)} for status in keys}


def _more(status: int | str) -> Described:
    more = {401: ("WWW-Authenticate",), 409: ("Retry-After",), 429: ("Retry-After",), 503: ("Retry-After",)}
    return {"headers": headers(*more[status])} if status in more else {}


def unchanged(content: Described | None = None, *names: str, description: str = "the document") -> Responses:
    """A document that is sent once: with its tag, or 304 to a client that has it."""
    response: Described = {"description": description, "headers": headers("ETag", *names)}
    if content is not None:
        response["content"] = content
    return {200: response, 304: {"description": "the client has the document already", "headers": headers("ETag")}}


def on_disk(description: str) -> Responses:
    """A sweep or job that goes on by itself."""
    about = headers("Location", "Preference-Applied", "Idempotency-Replayed")
    content = {"application/json": {"schema": ref(SweepState)}}
    return {
        202: {"description": description, "content": content, "headers": about, "links": links("$response.body#/id")}
    }


def links(identity: str) -> Described:
    """Where one can go on with a sweep or job whose id is at a place of the answer."""
    operations = ("read_sweep", "read_sweep_results", "describe_sweep", "resume_sweep", "end_sweep")
    return {name: {"operationId": name, "parameters": {"id": identity}} for name in operations}


def request_body(model: type[Model], folder: str = "", workbook: bool = False) -> Described:
    """The body of a computing route, with the examples of a folder; JSON, and a workbook where one is read."""
    content: Described = {"application/json": {"schema": ref(model), "examples": _examples(model, folder)}}
    if workbook:
        content[XLSX] = BINARY
    return {"requestBody": {"required": True, "content": content}}


def of_computation(computation: Computation) -> tuple[Responses, Described]:
    """What a computing route answers, and what else it says of itself."""
    media_types = [form.media_type for form in computation.forms]
    about = request_body(computation.request_model, computation.examples, computation.workbook is not None)
    about["parameters"] = [accept(*media_types)] if len(media_types) > 1 else []
    answers: Responses = {200: {"description": "the answer", "content": {}}}
    if computation.answer is not None:
        answers[200]["content"] = {media_type: content_of(media_type) for media_type in media_types[1:]}
    else:
        # no answer but JSON: the request itself
        own = {"application/json": {"schema": ref(computation.request_model)}}
        answers[200]["content"] = {
            media_type: own.get(media_type, content_of(media_type)) for media_type in media_types
        }
    if (
        any(name == "Content-Disposition" for form in computation.forms for name, _ in form.headers)
        or computation.answer is None
    ):
        answers[200]["headers"] = headers("Content-Disposition")
    statuses = [*COMPUTE_PROBLEMS]
    if computation.answer is None and len(computation.forms) > 1:
        # answers in JSON go to everybody; of other forms one has to be accepted
        statuses.append(406)
    if computation.later:
        about["parameters"] += parameters("Prefer", "Idempotency-Key")
        answers |= on_disk("with `Prefer: respond-async`: the job is on disk and goes on by itself")
        statuses.append(409)
    return {**answers, **problems(*statuses)}, about


def content_of(media_type: str) -> Described:
    """What there is of a media type: text, or bytes."""
    return TEXT if media_type.startswith("text/") or media_type in _TEXTS else BINARY


def ref(model: type[Model]) -> dict[str, str]:
    """Where the schema of a model is in the document."""
    return {"$ref": MODEL_REF.format(model=model.__name__)}


def _examples(model: type[Model], folder: str) -> Described:
    return {
        name: {
            "summary": body.get("machine", body).get("name", name),
            "value": {key: value for key, value in body.items() if key in model.model_fields},
        }
        for name, body in _bodies(folder).items()
    }


@cache
def _bodies(folder: str) -> dict[str, Any]:
    """Read once, not for every route; not to be changed."""
    return bodies(folder)
