"""The commands that make, list and revoke API keys."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from service.cli.terminal import fail, put, show

if TYPE_CHECKING:
    from service.guard.keys import KeyRecord

_DAY_S = 86_400

key = typer.Typer(help="Make, list and revoke API keys; a running service follows within a second.")

File = Annotated[Path | None, typer.Option("--file", help="File of the keys.", show_default="COUNTERWEIGHT_KEYS_FILE")]


@key.command()
def create(
    owner: Annotated[str, typer.Argument(help="Whose key it is; jobs belong to the owner, not to the key.")],
    scope: Annotated[
        list[str] | None,
        typer.Option(help="compute, sweeps, read, metrics or admin; repeatable.", show_default="compute, sweeps, read"),
    ] = None,
    days: Annotated[float | None, typer.Option(help="Days until it expires.", show_default="never")] = None,
    rate: Annotated[str | None, typer.Option(help="Requests, such as 100/second.", show_default="the setting")] = None,
    file: File = None,
) -> None:
    """Make a key and print it; only its hash is kept, so it cannot be printed again."""
    from pydantic import ValidationError

    from service.guard import keys
    from service.guard.rates import parsed

    where = _file(file)
    expires = None if days is None else time.time() + days * _DAY_S
    try:
        parsed(rate or "")
        secret, record = keys.make(owner, tuple(scope or ("compute", "sweeps", "read")), expires, rate)  # type: ignore[arg-type]
    except ValidationError as error:
        fail(*(f"{detail['loc'][0]}: {detail['msg']}" for detail in error.errors(include_input=False)))
    except ValueError as error:
        fail(str(error))
    with _changed(where, new=True) as records:
        records.append(record)
    put(secret)


@key.command(name="list")
def list_keys(file: File = None) -> None:
    """Show the keys: owners, scopes and times, never the keys themselves."""
    from service.report.blocks import Chapter, table

    rows = [
        (
            record.id,
            record.owner,
            ", ".join(record.scopes),
            record.created,
            "never" if record.expires is None else _moment(record.expires),
            record.rate_limit or "",
        )
        for record in _read(_file(file))
    ]
    show([Chapter("Keys", (table("", ["id", "owner", "scopes", "made", "expires", "rate"], rows),))])


@key.command()
def revoke(
    identity: Annotated[str, typer.Argument(metavar="ID", help="Public part of the key, as `list` shows it.")],
    file: File = None,
) -> None:
    """Remove a key."""
    where = _file(file)
    with _changed(where) as records:
        left = [record for record in records if record.id != identity]
        if len(left) == len(records):
            fail(f"there is no key of the id {identity}")
        records[:] = left


def _file(path: Path | None) -> Path:
    place = path or os.environ.get("COUNTERWEIGHT_KEYS_FILE")
    if not place:
        fail("name the file of the keys with --file or COUNTERWEIGHT_KEYS_FILE")
    return Path(place)


def _read(file: Path) -> "list[KeyRecord]":
    from service.guard.keys import BadKeyFile, read

    try:
        return read(file)
    except BadKeyFile as error:
        fail(str(error))


@contextmanager
def _changed(file: Path, new: bool = False) -> Iterator["list[KeyRecord]"]:
    from service.guard.keys import BadKeyFile, changed

    try:
        with changed(file, new) as records:
            yield records
    except BadKeyFile as error:
        fail(str(error))
    except OSError as error:
        fail(f"cannot write {file}: {error.strerror}")


def _moment(seconds: float) -> str:
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="seconds")
