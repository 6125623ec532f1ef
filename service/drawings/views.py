"""The views of a machine, whole or half-typed, without anything being solved."""

from schemas.answer.problem import FieldError
from schemas.request.layout import LayoutAnswer, LayoutRequest
from service.common.validation import pointer
from service.drawings.front import front
from service.drawings.side import side
from service.drawings.typed import partial_layout


def views(request: LayoutRequest) -> LayoutAnswer:
    """Front and side of the valid part, and why the rest is not drawn."""
    # field by field: what stands in them may be nested more deeply than a model writes
    layout, missing = partial_layout({name: getattr(request, name) for name in ("machine", "counterweights", "fitted")})
    return LayoutAnswer(
        front=None if layout is None else front(layout).svg(),
        side=None if layout is None else side(layout).svg(),
        missing=tuple(FieldError(pointer=pointer(problem.path), message=problem.message) for problem in missing),
    )
