"""The same combinations in every form that goes out: terminal, documents, tables, pictures, drawings and workbooks."""

from io import StringIO
from pkgutil import resolve_name
from typing import Any

from rich.console import Console

from optimizer.errors import NotComputable
from schemas.request.requests import OptimizeRequest
from schemas.scroll.pin_loads import PinLoadsRequest
from service.common.validation import InvalidRequest, check
from service.computations.computation import Computation
from service.computations.table import COMPUTATIONS
from service.report.terminal import terminal
from tests.pairs.asking import body_of
from tests.pairs.combinations import PINS

#: how a form begins, and what a text may not hold
_BEGINNINGS = {".pdf": b"%PDF", ".png": b"\x89PNG", ".zip": b"PK", ".xlsx": b"PK", ".svg": b"<svg", ".json": b"{"}
_NO_NUMBERS = (b">nan<", b">inf<", b"NaN", b"Infinity")


def form_fault(base: str, features: tuple[str, ...]) -> str | None:
    """What is wrong with a form of a combination; None where each is written, or refused by a field."""
    body = body_of(base, features)
    if body is None:
        return None
    model = PinLoadsRequest if base == PINS else OptimizeRequest
    for name, computation in COMPUTATIONS.items():
        if issubclass(computation.request_model, model) and not computation.long:
            try:
                fault = _fault(computation, body)
            except Exception as error:  # whatever it is, it is a fault
                fault = f"{type(error).__name__}: {error}"
            if fault is not None:
                return f"{name}: {fault}"
    return None


def _fault(computation: Computation, body: dict[str, Any]) -> str | None:
    try:
        request = check(computation.request_model, body)
        answer = computation.function(request)
    except (InvalidRequest, NotComputable) as refusal:
        return None if all(problem.path and problem.message for problem in refusal.problems) else "no field is named"
    for form in computation.forms:
        content = form.content(request, answer)
        if not content.lstrip().startswith(_BEGINNINGS.get(form.suffix, b"")) or len(content) < 2:
            return f"{form.suffix} begins with {content[:20]!r}"
        if not form.compressed and any(number in content for number in _NO_NUMBERS):
            return f"{form.suffix} holds no finite number"
    if computation.chapters is not None:
        chapters = resolve_name(computation.chapters)(request, answer)
        Console(file=StringIO(), width=160).print(terminal(chapters))
    return None
