"""Why requests are refused, kind by kind: what stands behind the address in ``type`` of a problem."""

from collections.abc import Mapping
from types import MappingProxyType

from pydantic import Field

from schemas.base.model import Model


class ProblemKind(Model):
    """A kind of problem: what causes it, and what helps."""

    type: str = Field(description="the address in `type` of such a problem", examples=["/problems/busy"])
    title: str = Field(description="short name", examples=["Busy"])
    status: int = Field(description="HTTP status code", examples=[429])
    cause: str = Field(description="why the service answers so", examples=["As many requests wait as may wait."])
    remedy: str = Field(description="what helps", examples=["Send the request again after `Retry-After` seconds."])


class UnknownProblemKind(LookupError):
    """There is no kind of problem of this name."""


_AGAIN = "Send the request again after `Retry-After` seconds"
_OPERATOR = "whoever operates the service"

#: title, status, cause, remedy
_TABLE = (
    # ---- what cannot be read
    ("Unreadable JSON", 400, "The body is not JSON in UTF-8.", "Correct the place that `detail` names."),
    ("Unreadable body", 400, "The body is announced as a workbook and is none.", "Send a file of the kind .xlsx."),
    ("Incomplete request", 400, "The connection ended before the whole body came.", "Send the whole body."),
    ("Unreadable request", 400, "What came is not HTTP.", "Look at the client, or at a proxy before the service."),
    (
        "Not allowed across origins",
        400,
        "A page of another origin asks, and the service does not allow its origin, method or headers.",
        f"Ask {_OPERATOR} to add the origin to `COUNTERWEIGHT_CORS_ORIGINS`.",
    ),
    (
        "Body too slow",
        408,
        "The body did not come within the time of `COUNTERWEIGHT_BODY_TIMEOUT_S`.",
        "Send it faster, or over another network.",
    ),
    (
        "Headers too slow",
        408,
        "The headers did not come within the time of `COUNTERWEIGHT_HEADERS_TIMEOUT_S`.",
        "Send the whole request at once.",
    ),
    (
        "Body too large",
        413,
        "The body has more bytes than `COUNTERWEIGHT_MAX_BODY_BYTES`.",
        "Send less. Many designs of one machine are a sweep: a base and axes.",
    ),
    (
        "Unsupported media type",
        415,
        "`Content-Type` announces something that is not read here, or the body is compressed.",
        "Announce `application/json` in UTF-8, and send the body uncompressed.",
    ),
    (
        "Headers too large",
        431,
        "The request line or the headers are larger than HTTP servers read.",
        "Send shorter headers, or a shorter address.",
    ),
    # ---- who may ask
    ("Unauthorized", 401, "There is no key, or it is wrong or has expired.", "Send a valid key; see `/docs`."),
    ("Forbidden", 403, "The key does not have the scope of this route.", "Use a key with the scope in `detail`."),
    (
        "Misdirected request",
        421,
        "The service needs no key, so it answers only for hosts that it knows.",
        "Use a name of this machine, one of `COUNTERWEIGHT_ALLOWED_HOSTS`, or a service with keys.",
    ),
    # ---- what is not there
    ("Not Found", 404, "There is nothing at this path.", "`GET /openapi.json` lists the paths."),
    (
        "Missing guide",
        404,
        "The documents are not built as a site.",
        f"Ask {_OPERATOR} to run `make docs`, or to set `COUNTERWEIGHT_GUIDE_DIR`.",
    ),
    ("Unknown example", 404, "There is no example of this name.", "`GET /v1/examples` lists the names."),
    (
        "Unknown sweep",
        404,
        "There is no sweep or job of this id: it was deleted, has expired, or belongs to another owner.",
        "`GET /v1/sweeps` lists the sweeps of the owner. Start it again if its rows are needed.",
    ),
    (
        "Method Not Allowed",
        405,
        "The path does not answer this method.",
        "Use a method that the header `Allow` names.",
    ),
    ("Not acceptable", 406, "`Accept` names no form that there is.", "Accept one of the forms that `detail` names."),
    # ---- conflicts
    (
        "Key reused",
        409,
        "The `Idempotency-Key` came before, with another request.",
        "Take a new key for a new request.",
    ),
    (
        "Not finished",
        409,
        "The answer of the job is not there: not yet, or never.",
        f"{_AGAIN} if there is that header. Else `detail` states why the job has ended.",
    ),
    (
        "Quota exceeded",
        409,
        "The sweeps of the owner take as much disk as `COUNTERWEIGHT_DISK_QUOTA_MB` allows.",
        "Delete sweeps, or ask for fewer designs or columns.",
    ),
    # ---- what cannot be computed
    (
        "Invalid request",
        422,
        "Fields of the body are missing, unknown, or outside their ranges.",
        "Correct the fields in `errors`; each has its pointer and the rule.",
    ),
    (
        "Invalid parameter",
        422,
        "A parameter of path or query is unknown or outside its range.",
        "Correct the parameters in `errors`; each has its pointer and the rule.",
    ),
    ("Invalid header", 422, "A header holds what it must not hold.", "Correct the header that `detail` names."),
    (
        "Missing input",
        422,
        "The machine lacks what an output or the objective needs.",
        "Give the fields in `errors`, or ask for fewer outputs.",
    ),
    (
        "Out of range",
        422,
        "A number is so large or small that the result could not be computed with the usual accuracy.",
        "Correct the fields in `errors`; often it is a unit.",
    ),
    ("Unknown column", 422, "The sweep has no column of this name.", "`GET /v1/sweeps/{id}/metadata` lists them."),
    (
        "Too large for a worksheet",
        422,
        "The rows or columns are more than a worksheet holds.",
        "Ask for part of the rows with `offset` and `limit`, or for Parquet or CSV.",
    ),
    (
        "Out of memory",
        422,
        "The computation needs more memory than `COUNTERWEIGHT_SOLVE_MEMORY_MB`.",
        "Ask for less at a time: fewer outputs, samples or webs.",
    ),
    # ---- too much at a time
    ("Busy", 429, "As many requests wait as may wait, of the client or altogether.", f"{_AGAIN}."),
    (
        "Over share",
        429,
        "The client holds as many streams or bytes as one client may.",
        f"{_AGAIN}, when answers that are open have been read.",
    ),
    ("Too many requests", 429, "The key has sent more requests than its rate allows.", f"{_AGAIN}."),
    ("Too many jobs", 429, "As many jobs wait or run as may.", f"{_AGAIN}, or cancel a job."),
    ("Too many connections", 503, "As many connections are open as may be.", f"{_AGAIN}, on one connection."),
    # ---- the service
    (
        "Internal error",
        500,
        "The service has failed. It is never the fault of the request.",
        f"Report it to {_OPERATOR} with `X-Request-ID`; the log says why.",
    ),
    ("Not ready", 503, "The solver loads, or the service lacks what `detail` names.", f"{_AGAIN}."),
    (
        "Too slow",
        503,
        "The request waited and computed for longer than `COUNTERWEIGHT_REQUEST_TIMEOUT_S`.",
        f"{_AGAIN}. Long computations are jobs: send `Prefer: respond-async`.",
    ),
    ("Worker died", 503, "The process that computed has ended, twice.", f"{_AGAIN}, or ask for less."),
    ("Workers failed", 503, "No process that computes could be started.", f"{_AGAIN}."),
    ("No room", 503, "A large answer found no room on the disk of the service.", f"{_AGAIN}."),
    ("No file left", 503, "The service can open no further file at the moment.", "Send the request again."),
    ("Database unavailable", 503, "The database of the jobs is locked, full, or away.", f"{_AGAIN}."),
    ("Files unavailable", 503, "The folder of the results cannot be read.", f"{_AGAIN}."),
    (
        "Rows damaged",
        503,
        "Rows on disk are not what was written. The service computes them again.",
        f"{_AGAIN}.",
    ),
    (
        "Wrong schema",
        503,
        "The database belongs to another version of the service.",
        f"Ask {_OPERATOR} to update the service or its database.",
    ),
)


def slug(title: str) -> str:
    """The name of a kind in addresses."""
    return title.lower().replace(" ", "-")


KINDS: Mapping[str, ProblemKind] = MappingProxyType(
    {
        slug(title): ProblemKind(
            type=f"/problems/{slug(title)}", title=title, status=status, cause=cause, remedy=remedy
        )
        for title, status, cause, remedy in _TABLE
    }
)


def kind_of(name: str) -> ProblemKind:
    """The documentation of a kind.

    Raises
    ------
    UnknownProblemKind
    """
    if name not in KINDS:
        raise UnknownProblemKind(name)
    return KINDS[name]
