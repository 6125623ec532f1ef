"""Settings of the service, from ``COUNTERWEIGHT_*`` environment variables."""

import difflib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AliasChoices, BeforeValidator, Field, StringConstraints, ValidationError
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from schemas.machine.reciprocating import MAX_ROWS_TOGETHER
from schemas.machine.rotor import MAX_WEBS
from schemas.machine.throws import MAX_THROWS
from schemas.sweep.axes import MAX_DESIGNS

_PREFIX = "COUNTERWEIGHT_"
#: variables of clients, of the workbench and of the deployment files, which the service does not read
_CLIENT_VARIABLES = {f"{_PREFIX}{name}" for name in (
    "CPUS", "DASK_WORKERS", "FOLDER", "FORCE", "IMAGE", "KEY", "MACHINE", "MEMORY", "PUBLISH", "SHAFT", "URL",
)}  # fmt: skip


def _data_dir() -> Path:
    """Where data of a user's programs belongs (XDG base directories), or here if the user has no home."""
    try:
        return Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share") / "counterweight"
    except RuntimeError:
        return Path("counterweight-data")


def _guide_dir() -> Path:
    """Where `make docs` builds in a checkout."""
    return Path(__file__).parents[1] / "artefacts" / "site"


def _split(value: Any) -> Any:
    return tuple(filter(None, map(str.strip, value.split(",")))) if isinstance(value, str) else value


Names = Annotated[tuple[str, ...], NoDecode, BeforeValidator(_split)]
#: no wildcards: a page that frames another sees what its user does there
Origin = Annotated[str, StringConstraints(pattern=r"^https?://([A-Za-z0-9.-]+|\[[0-9A-Fa-f:]+\])(:[0-9]{1,5})?$")]
Origins = Annotated[tuple[Origin, ...], NoDecode, BeforeValidator(_split)]


class _Network(BaseSettings):
    """Where the service listens, and what it takes from a connection."""

    host: str = Field("127.0.0.1", description="address to listen on")
    port: int = Field(
        8000,
        ge=0,
        le=65535,
        # hosting platforms hand the port over without a prefix
        validation_alias=AliasChoices("COUNTERWEIGHT_PORT", "PORT"),
        description="port to listen on; 0 takes a free one",
    )
    root_path: str = Field(
        "", pattern=r"^(/[A-Za-z0-9._~-]+)*$", description="path prefix that a proxy in front strips, such as /balance"
    )
    trusted_proxies: Names = Field(
        (),
        description="addresses or networks of proxies whose X-Forwarded-For and X-Forwarded-Proto are believed, "
        "comma-separated",
    )
    max_connections: int = Field(1000, ge=1, description="open connections; further ones are answered 503")
    max_connections_each: int = Field(
        250, ge=1, description="open connections of one address that is no trusted proxy; further ones are answered 503"
    )
    headers_timeout_s: float = Field(
        10, gt=0, description="a connection that sends no whole header for longer is closed [s]"
    )
    body_timeout_s: float = Field(30, gt=0, description="a body that takes longer to arrive is answered 408 [s]")
    write_timeout_s: float = Field(
        60, gt=0, description="a connection whose client reads nothing for longer is closed [s]"
    )
    keep_alive_s: int = Field(5, ge=1, description="an idle connection is closed after so long [s]")
    graceful_shutdown_s: int = Field(10, ge=0, description="time for open requests to end at shutdown [s]")


class _Sizes(BaseSettings):
    """The largest requests; none of these can be raised above what the schemas allow."""

    max_body_bytes: int = Field(1_000_000, ge=1, description="largest request body; larger ones are answered 413")
    max_throws: int = Field(MAX_THROWS, ge=1, le=MAX_THROWS, description="throws of a machine")
    max_rows: int = Field(
        MAX_ROWS_TOGETHER, ge=1, le=MAX_ROWS_TOGETHER, description="rows of a machine, all throws together"
    )
    max_webs: int = Field(MAX_WEBS, ge=1, le=MAX_WEBS, description="webs of a machine")
    # a request that says nothing takes 360
    max_angles: int = Field(36_000, ge=360, le=36_000, description="samples of the shaft angle in one revolution")
    max_sweep_designs: int = Field(MAX_DESIGNS, ge=1, le=MAX_DESIGNS, description="designs of a sweep")


class _Work(BaseSettings):
    """How much is computed at a time, and for how long; a client is the owner of a key, or an address without keys."""

    concurrent_solves: int = Field(
        default_factory=lambda: os.cpu_count() or 1,
        ge=1,
        description="short computations at the same time, a process each; two above them for clients that had little"
        " lately, and half as many for long ones, one at least",
    )
    queue_length: int = Field(
        128, ge=0, description="requests that wait for a short computation, and for a long one; more are answered 429"
    )
    queue_length_each: int = Field(
        64, ge=0, description="requests of one client that wait for a computation; further ones are answered 429"
    )
    request_timeout_s: float = Field(
        60, gt=0, description="a request that waits and computes for longer is answered 503 [s]"
    )
    solve_memory_mb: int = Field(
        2000, ge=500, description="memory of one computation; one that needs more is answered 422 [MB]"
    )
    rate_limit: str = Field(
        "6000/minute", description="requests of one key to one service, such as 100/second; no limit if empty"
    )
    refusal_limit: str = Field(
        "60/minute", description="wrong keys from one address; further wrong ones are answered 429"
    )


class _Shares(BaseSettings):
    """What clients may hold at a time; more is answered 429, but for a first one of each client."""

    held_mb: int = Field(
        48, ge=1, description="bytes of bodies that are computed or still arrive, and as many of answers not read [MB]"
    )
    held_mb_each: int = Field(16, ge=1, description="the same of one client [MB]; 8 times that in files, on disk")
    event_streams: int = Field(400, ge=1, description="streams of events")
    event_streams_each: int = Field(100, ge=1, description="streams of events of one client")
    row_streams: int = Field(24, ge=1, description="streams of rows")
    row_streams_each: int = Field(8, ge=1, description="streams of rows of one client")


class _Access(BaseSettings):
    """Who may ask."""

    keys_file: Path | None = Field(
        None, description="file of the API keys, made with `counterweight key`; without it nobody needs a key"
    )
    allow_without_keys: bool = Field(
        False, description="whether to serve without keys on an address that other machines reach"
    )
    allowed_hosts: Names = Field(
        (),
        description="hosts, without ports, that requests may name besides this machine where nobody needs a key, "
        "comma-separated; * is any",
    )
    cors_origins: Names = Field((), description="origins whose pages may ask, comma-separated; * is any")
    owner_header: str = Field(
        "",
        pattern=r"^[A-Za-z0-9-]{0,64}$",
        description="header by which a portal names its user, such as X-Portal-User, so that jobs of users are kept "
        "apart; believed from COUNTERWEIGHT_TRUSTED_PROXIES alone",
    )
    frame_origins: Origins = Field(
        (),
        description="origins whose pages may show the page in a frame and speak with it, such as "
        "https://portal.example.com, comma-separated",
    )
    hsts_s: int = Field(0, ge=0, description="Strict-Transport-Security of answers over https [s]; 0 sends none")


class _Watching(BaseSettings):
    """What is written down."""

    log_level: Literal["debug", "info", "warning", "error"] = Field("info", description="least level that is logged")
    log_format: Literal["json", "text"] = Field("json", description="a JSON object a line, or text to read")
    log_machines: bool = Field(
        False, description="whether bodies, and messages of faults that may quote them, go into the log"
    )
    otlp_endpoint: str | None = Field(
        None, description="where traces go, such as http://collector:4318; needs the extra `telemetry`"
    )


class _Documents(BaseSettings):
    """The documents beside the service."""

    guide_dir: Path = Field(
        default_factory=_guide_dir, description="folder that `make docs` has built; served at /docs/guide"
    )


class _Jobs(BaseSettings):
    """Sweeps and other jobs."""

    data_dir: Path = Field(default_factory=_data_dir, description="folder of the sweeps and their results")
    database_url: str | None = Field(
        None, description="database of the sweeps, such as postgresql://host/name; by default SQLite in data_dir"
    )
    database_busy_s: float = Field(5, gt=0, le=600, description="how long to wait for a locked database [s]")
    engine: str = Field("processes", description="where sweeps are computed: processes, or dask:tcp://host:port")
    sweep_workers: int = Field(default_factory=lambda: os.cpu_count() or 1, ge=1, description="processes for sweeps")
    # what computes answers is up to 13 nicer than the service
    sweep_niceness: int = Field(
        15, ge=6, le=19, description="how much nicer than the service the processes for sweeps are; 19 gives way most"
    )
    lease_s: float = Field(
        10, ge=0.5, description="work of a service that says nothing for longer is done by another [s]"
    )
    min_free_mb: int = Field(
        200, ge=0, description="the service is not ready when less is free where the jobs are kept [MB]"
    )
    results_keep_days: float = Field(
        30, ge=0, description="how long results are kept, counted while a service runs [days]; 0 is for ever"
    )
    max_jobs: int = Field(1000, ge=1, description="sweeps that wait or run at the same time")
    max_jobs_each: int = Field(100, ge=1, description="the same of one owner; without keys all have one owner")
    disk_quota_mb: float = Field(
        20_000,
        ge=0,
        description="room on disk for the sweeps of one owner, with their part of a database in data_dir [MB]; "
        "0 is any; more is answered 409",
    )


class Settings(_Network, _Sizes, _Work, _Shares, _Access, _Watching, _Documents, _Jobs):
    """What an operator can set; the defaults suit one user on one machine."""

    model_config = SettingsConfigDict(
        env_prefix="COUNTERWEIGHT_", env_ignore_empty=True, populate_by_name=True, frozen=True, extra="ignore"
    )


def variable(field: str) -> str:
    """The environment variable of a setting."""
    return f"{_PREFIX}{field.upper()}"


def unknown_variables(environment: Mapping[str, str]) -> Iterator[str]:
    """A sentence for every variable with our prefix that is no setting: a misspelt one would be without effect."""
    settings = {variable(field) for field in Settings.model_fields}
    for name in sorted(environment):
        if name.upper().startswith(_PREFIX) and name.upper() not in settings | _CLIENT_VARIABLES:
            near = difflib.get_close_matches(name.upper(), settings, n=1, cutoff=0.0)[0]
            yield f"{name}: there is no such setting; the nearest name is {near}"


def wrong_values(error: ValidationError, options: Mapping[str, object]) -> Iterator[str]:
    """A sentence for every setting with a wrong value, by its option or by its environment variable."""
    # as the operator has written them: names are read in small letters too
    variables = {name.upper(): name for name in os.environ}
    for detail in error.errors():
        place = str(detail["loc"][0]) if detail["loc"] else ""
        field = place.removeprefix(_PREFIX).lower()
        option = field in options or place in options
        # the port has a second variable, without the prefix
        name = variable(field)
        if field == "port" and name not in variables:
            name = "PORT"
        name = f"--{field}" if option else variables.get(name, name)
        yield f"{name}: {detail['msg']}"
