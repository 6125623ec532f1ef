"""Answers checked by the files that clients take with them, examples/client/verify*.py: there is no second checker."""

import re
import sys
from collections.abc import Iterable
from functools import cache
from graphlib import TopologicalSorter
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

from schemas.base.model import FieldProblem
from schemas.request.verify import VerifyAnswer, VerifyRequest
from service.common.examples import directory
from service.common.validation import InvalidRequest


def verify(request: VerifyRequest) -> VerifyAnswer:
    """What becomes of the claims of an answer.

    Raises
    ------
    InvalidRequest
        naming the field of request or answer that cannot be read, or that holds more than is checked at a time.
    """
    tools = checker()
    try:
        return VerifyAnswer.model_validate(tools.verify(request.request, request.answer, tools.PLACES))
    except tools.Unreadable as error:
        raise InvalidRequest([FieldProblem(error.path, error.message)]) from None


_IMPORTED = re.compile(r"^from (verify_\w+) import", re.MULTILINE)


@cache
def checker() -> ModuleType:
    """The file for answers of every kind; none of them belongs to a package or imports anything of this one."""
    return {name: _module(name) for name in _files()}["verify"]


def _files() -> Iterable[str]:
    """The files, each behind those that it imports."""
    paths = (directory() / "client").glob("verify*.py")
    return TopologicalSorter({path.stem: _IMPORTED.findall(path.read_text("utf-8")) for path in paths}).static_order()


def _module(name: str) -> ModuleType:
    spec = spec_from_file_location(name, directory() / "client" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
