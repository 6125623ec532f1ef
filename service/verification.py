"""Answers checked by the file that clients take with them, examples/client/verify.py: there is no second checker."""

import sys
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

from schemas.base import FieldProblem
from schemas.verify import VerifyAnswer, VerifyRequest
from service.documents.examples import directory
from service.http.validation import InvalidRequest

_NAME = "counterweight_verify"


def verify(asked: VerifyRequest) -> VerifyAnswer:
    """What becomes of the claims of an answer.

    Raises
    ------
    InvalidRequest
        naming the field of request or answer that cannot be read, or that holds more than is checked at a time.
    """
    found = checker()
    try:
        return VerifyAnswer.model_validate(found.verify(asked.request, asked.answer, found.PLACES))
    except found.Unreadable as error:
        raise InvalidRequest([FieldProblem(error.path, error.message)]) from None


@cache
def checker() -> ModuleType:
    """The file, which belongs to no package and imports nothing of this one."""
    spec = spec_from_file_location(_NAME, directory() / "client" / "verify.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[_NAME] = module
    spec.loader.exec_module(module)
    return module
