"""Functions that take a request, or a mapping as it is posted."""

from collections.abc import Callable, Mapping
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

from pydantic import BaseModel

Request = TypeVar("Request", bound=BaseModel)
Rest = ParamSpec("Rest")
Answer = TypeVar("Answer")


def or_mapping(
    model: type[Request],
) -> Callable[
    [Callable[Concatenate[Request, Rest], Answer]], Callable[Concatenate[Request | Mapping[str, Any], Rest], Answer]
]:
    """Have the first argument of a function checked as a model where it is a mapping.

    Raises
    ------
    pydantic.ValidationError
        naming the fields, where the function is called with a mapping that is no valid request.
    """

    def decorated(
        function: Callable[Concatenate[Request, Rest], Answer],
    ) -> Callable[Concatenate[Request | Mapping[str, Any], Rest], Answer]:
        @wraps(function)
        def wrapper(request: Request | Mapping[str, Any], /, *rest: Rest.args, **options: Rest.kwargs) -> Answer:
            # what is neither is refused by the model, in its words
            instance = request if isinstance(request, BaseModel) else model.model_validate(request)
            return function(instance, *rest, **options)

        return wrapper

    return decorated
