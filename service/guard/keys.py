"""API keys: made, kept as salted hashes in a file, and compared in constant time.

A key holds 256 random bits, so that no dictionary helps against a hash and a fast one (SHA-256 with a salt) will do.
"""

import fcntl
import hashlib
import hmac
import logging
import os
import re
import secrets
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated, Literal, get_args

from pydantic import Field, StringConstraints, TypeAdapter, ValidationError
from starlette.requests import Request

from schemas.base.model import Model
from service.common.addresses import is_loopback
from service.common.replacing import replaced
from service.settings import Settings

#: compute: the computing routes; sweeps: start, resume and delete jobs; read: see the jobs of the same owner;
#: metrics: /metrics; admin: everything, with the jobs of all owners
Scope = Literal["compute", "sweeps", "read", "metrics", "admin"]
SCOPES: tuple[Scope, ...] = get_args(Scope)
#: everything else needs a key, whether there is anything at the path or not
PROBES = frozenset({"/healthz", "/readyz"})
PUBLIC = PROBES | {"/", "/docs", "/docs/guide", "/openapi.json", "/favicon.ico"}
PUBLIC_FOLDERS = ("/docs/assets/", "/docs/guide/", "/portal/", "/problems/")

_LOG = logging.getLogger(__name__)
_AUDIT = logging.getLogger("service.audit")
_KEY = re.compile(r"cw_([0-9a-f]{12})_([A-Za-z0-9_-]{43})")
#: the file is looked at again after so long [s]: keys come and go without a restart
_LOOK_S = 1.0

Owner = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9._@-]{1,64}$")]
Digest = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]


class BadKeyFile(ValueError):
    """The file of the keys cannot be read."""


class KeyRecord(Model):
    """What is kept of a key. Jobs belong to the owner, so a new key of the same owner sees the jobs of the old one."""

    id: Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{12}$")] = Field(
        description="public part of the key", examples=["0123456789ab"]
    )
    owner: Owner = Field(description="whose key it is", examples=["portal"])
    scopes: tuple[Scope, ...] = Field(min_length=1, description="what it allows", examples=[["compute", "sweeps"]])
    salt: Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{32}$")] = Field(
        description="salt of the hash", examples=["00" * 16]
    )
    sha256: Digest = Field(description="hash of salt and key", examples=["00" * 32])
    created: str = Field("", max_length=40, description="when it was made", examples=["2026-11-21T12:00:00+00:00"])
    expires: float | None = Field(
        None, description="seconds since 1970 after which it is refused; null is never", examples=[None]
    )
    rate_limit: str | None = Field(
        None, max_length=64, description="in place of the setting; null is the setting", examples=["10/second"]
    )


@dataclass(frozen=True)
class Caller:
    """Who asks."""

    key: str | None
    owner: str | None
    scopes: frozenset[Scope]
    rate_limit: str | None = None

    def acting_for(self, user: str | None) -> "Caller":
        """The same for a user of its owner, who has jobs of their own and sees no others.

        The name has a stroke, which no owner has.
        """
        if user is None:
            return self
        scopes = frozenset(SCOPES) if "admin" in self.scopes else self.scopes
        return replace(self, owner=f"{self.owner or ''}/{user}", scopes=scopes - {"admin"})

    def may(self, *scopes: Scope) -> bool:
        """Whether one of some scopes is allowed."""
        return "admin" in self.scopes or not self.scopes.isdisjoint(scopes)


#: where nobody needs a key
ANYONE = Caller(None, None, frozenset(SCOPES))
#: on a public page
NOBODY = Caller(None, None, frozenset())


def caller_of(request: Request) -> Caller:
    """Whose request it is, by :class:`~service.guard.access.Access`."""
    # its state makes an object for each look
    caller: Caller = request.scope["state"]["caller"]
    return caller


def still_admitted(request: Request) -> bool:
    """Whether the key of a request that takes long is still right; it may have been revoked, or have expired."""
    result: bool = request.state.still_admitted()
    return result


def make(
    owner: str, scopes: tuple[Scope, ...], expires: float | None = None, rate_limit: str | None = None
) -> tuple[str, KeyRecord]:
    """A new key, and what is kept of it.

    Raises
    ------
    ValidationError
        if the owner is no name or there is no scope.
    """
    identity, salt = secrets.token_hex(6), secrets.token_hex(16)
    key = f"cw_{identity}_{secrets.token_urlsafe(32)}"
    record = KeyRecord(
        id=identity,
        owner=owner,
        scopes=scopes,
        salt=salt,
        sha256=_hash(salt, key),
        created=datetime.now(UTC).isoformat(timespec="seconds"),
        expires=expires,
        rate_limit=rate_limit,
    )
    return key, record


def read(file: Path) -> list[KeyRecord]:
    """The keys in a file, one JSON object a line.

    Raises
    ------
    BadKeyFile
    """
    try:
        lines = file.read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise BadKeyFile(f"cannot read the keys in {file}: {getattr(error, 'strerror', None) or error}") from None
    records = []
    for number, line in enumerate(lines, 1):
        if line.strip():
            try:
                records.append(_RECORD.validate_json(line))
            except ValidationError as error:
                first = error.errors(include_input=False)[0]
                where = ".".join(map(str, first["loc"])) or "line"
                raise BadKeyFile(f"{file}, line {number}: {where}: {first['msg']}") from None
    return records


def write(file: Path, records: list[KeyRecord]) -> None:
    """Replace the keys in a file, at once and readable by its owner only.

    Raises
    ------
    OSError
    """
    with replaced(file, 0o600) as out:
        out.writelines(record.model_dump_json(exclude_none=True).encode() + b"\n" for record in records)


@contextmanager
def changed(file: Path, new: bool = False) -> Iterator[list[KeyRecord]]:
    """The keys in a file, to be changed in place: written when the block has ended, and left as they are if it raises.

    Of several at a time, one waits for the other, so that none loses what another has written.

    Parameters
    ----------
    new : whether there may be no such file yet.

    Raises
    ------
    BadKeyFile
    OSError
    """
    # beside the file, which is another one after each change; open for writing, as network file systems want it
    with open(os.open(file.with_name(f".{file.name}.lock"), os.O_RDWR | os.O_CREAT, 0o600), "wb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        records = [] if new and not file.exists() else read(file)
        yield records
        write(file, records)


class Keys:
    """The keys in a file, read anew when it changes.

    Raises
    ------
    BadKeyFile
    """

    def __init__(self, file: Path) -> None:
        self._file = file
        self._records: Mapping[str, KeyRecord] = {record.id: record for record in read(file)}
        self._stamp = self._stamped()
        self._last_look_s = time.monotonic()
        self._nobody = make("nobody", ("read",))[1]
        self._noted: set[tuple[str, str]] = set()

    def caller(self, key: str) -> Caller | None:
        """Whose key it is; None if it is no key, wrong or expired."""
        self._look()
        match = _KEY.fullmatch(key)
        record = self._records.get(match[1], self._nobody) if match else self._nobody
        # compared in every case, so that the time tells nothing
        right = hmac.compare_digest(_hash(record.salt, key), record.sha256)
        if not right:
            return None
        if record.expires is not None and record.expires < time.time():
            self._note_once("refused, as it has expired", record)
            return None
        self._note_once("used for the first time since the start", record)
        return Caller(record.id, record.owner, frozenset(record.scopes), record.rate_limit)

    def _look(self) -> None:
        now = time.monotonic()
        if now - self._last_look_s < _LOOK_S:
            return
        self._last_look_s = now
        stamp = self._stamped()
        if stamp == self._stamp:
            return
        try:
            records = {record.id: record for record in read(self._file)}
        except BadKeyFile as error:
            # the last valid keys stay until the file is right again
            _LOG.warning("%s", error)
        else:
            self._note_changes(records)
            self._records = records
        self._stamp = stamp

    def _note_changes(self, records: Mapping[str, KeyRecord]) -> None:
        for identity in sorted(records.keys() | self._records.keys()):
            before, now = self._records.get(identity), records.get(identity)
            if before is None and now is not None:
                _note("added", now)
            elif now is None and before is not None:
                _note("revoked", before)
            elif before is not None and now is not None and before != now:
                _note("changed", now)

    def _note_once(self, event: str, record: KeyRecord) -> None:
        # each request is a line of its own, which names the key
        if (event, record.id) not in self._noted:
            self._noted.add((event, record.id))
            _note(event, record)

    def _stamped(self) -> tuple[int, int, int]:
        try:
            status = self._file.stat()
        except OSError:
            return (0, 0, 0)
        return status.st_mtime_ns, status.st_size, status.st_ino


def keys(settings: Settings) -> Keys | None:
    """The keys of the settings; None where nobody needs one.

    Raises
    ------
    ValueError
        if other machines reach the service and nobody would need a key.
    BadKeyFile
    """
    if settings.keys_file is not None:
        return Keys(settings.keys_file)
    if is_loopback(settings.host) or settings.allow_without_keys:
        return None
    raise ValueError(
        f"other machines reach {settings.host}: set COUNTERWEIGHT_KEYS_FILE to a file made with `counterweight key`, "
        "or COUNTERWEIGHT_ALLOW_WITHOUT_KEYS=true"
    )


def _note(event: str, record: KeyRecord) -> None:
    """A line of the audit: of a key its public part, never the key."""
    about = {"key": record.id, "owner": record.owner, "scopes": " ".join(record.scopes)}
    _AUDIT.info("key %s %s", record.id, event, extra={**about, "about": about})


_RECORD = TypeAdapter(KeyRecord)


def _hash(salt: str, key: str) -> str:
    return hashlib.sha256(bytes.fromhex(salt) + key.encode("utf-8", "surrogateescape")).hexdigest()
