"""Answers checked by the files that clients take with them, examples/client/verify*.py: there is no second checker."""

import sys
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from types import ModuleType

from schemas.base.model import FieldProblem
from schemas.request.verify import VerifyAnswer, VerifyRequest
from service.common.examples import directory
from service.common.validation import InvalidRequest


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


#: the files, each behind those that it imports
_PARTS = (
    "numbers leaves plates machine claims cranks weights shafts form orders quality program cases answer prices"
    " alternatives first spans harmonics gas pistons pressed curves loads circle bearings shaking dynamics rods parts"
    " inside outputs cuts costs values misplacement ceilings levels nominal goals turn single many match"
)
_FILES = [*(f"verify_{part}" for part in _PARTS.split()), "verify"]


@cache
def checker() -> ModuleType:
    """The file for answers of every kind; none of them belongs to a package or imports anything of this one."""
    return [_loaded(name) for name in _FILES][-1]


def _loaded(name: str) -> ModuleType:
    spec = spec_from_file_location(name, directory() / "client" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
