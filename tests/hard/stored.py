"""Reference values of all cases, kept in reference.json: they take minutes to compute.

``python -m tests.hard --write-reference`` computes those that are missing or whose request has changed; delete the
file to compute all. A test recomputes a sample.
"""

import hashlib
import json
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import fields
from pathlib import Path

from tests.hard.cases.case import Body, Case
from tests.hard.interior import NotConverged, mp
from tests.hard.reference import Reference, reference

_FILE = Path(__file__).with_name("reference.json")
_DIGITS = 25


def digest(body: Body) -> str:
    """What tells one request from another."""
    return hashlib.sha256(json.dumps(body, sort_keys=True).encode()).hexdigest()[:16]


def read() -> dict[str, Reference]:
    """Stored references by the digest of their request."""
    if not _FILE.exists():
        return {}
    return {key: _decoded(value) for key, value in json.loads(_FILE.read_text()).items()}


def write(cases: Sequence[Case], workers: int = 2) -> list[str]:
    """Bring the file up to date with these cases; what could not be proven, a line for each."""
    document = {} if not _FILE.exists() else json.loads(_FILE.read_text())
    missing = {key: case for case in cases if (key := digest(case.body)) not in document}
    unproven = []
    with ProcessPoolExecutor(workers) as executor:
        for (key, case), result in zip(missing.items(), executor.map(_computed, missing.values()), strict=True):
            if isinstance(result, str):
                unproven.append(f"{case.name}: {result}")
            else:
                document[key] = result
    names = {digest(case.body): case.name for case in cases if digest(case.body) in document}
    lines = (f"{json.dumps(key)}: {json.dumps({**document[key], 'case': name})}" for key, name in names.items())
    _FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n")
    return unproven


def _computed(case: Case) -> dict[str, object] | str:
    try:
        return _encoded(reference(case.body))
    except NotConverged as error:
        return str(error)


def _encoded(result: Reference) -> dict[str, object]:
    return {
        field.name: part if part is None or isinstance(part, bool) else mp.nstr(part, _DIGITS)
        for field in fields(result)
        for part in [getattr(result, field.name)]
    }


def _decoded(fields: dict[str, object]) -> Reference:
    return Reference(
        **{name: mp.mpf(part) if isinstance(part, str) else part for name, part in fields.items() if name != "case"}
    )
