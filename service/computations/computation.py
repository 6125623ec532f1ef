"""What a computation of the service is: its models, the function that answers, and the forms of answers.

A computation is data and refers to models and functions by name. To read one loads neither schemas nor optimiser. It
goes to a worker as it is, which looks up there what it refers to.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from schemas.base.model import Model
    from service.guard.keys import Scope

#: ``module:name``
Reference = str


# to find the module takes as long as to read a small request
@cache
def _place(reference: Reference) -> tuple[ModuleType, str]:
    module, _, name = reference.partition(":")
    return import_module(module), name


def _object(reference: Reference) -> Any:
    return getattr(*_place(reference))


@dataclass(frozen=True)
class Form:
    """A form in which an answer goes out.

    write : the function that makes bytes of the answer.
    suffix : of a file that holds it.
    headers : of an answer in this form, beyond its media type.
    compressed : in itself, so that no coding makes it smaller.
    needs_request : whether the function takes the request too, before the answer.
    """

    media_type: str
    write: Reference
    suffix: str
    headers: tuple[tuple[str, str], ...] = ()
    compressed: bool = False
    needs_request: bool = False

    def content(self, request: Any, answer: Any) -> bytes:
        """The answer to a request in this form."""
        write = _object(self.write)
        content: bytes = write(request, answer) if self.needs_request else write(answer)
        return content


JSON = Form("application/json", "service.common.answer_bytes:json_bytes", ".json")
#: media type of workbooks (.xlsx)
XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"


def request_bytes(request: "Model") -> bytes:
    """A request as JSON: the fields of the client, without defaults."""
    return request.model_dump_json(exclude_unset=True).encode()


def echo_request(request: "Model") -> "Model":
    """The request, for a route that only reads and checks it."""
    return request


@dataclass(frozen=True)
class Computation:
    """A computation.

    name : of operation, job and metric; with hyphens, of command and documents.
    request, answer : models; an answer that is a document, or the request itself, has none.
    compute : request -> answer.
    summary, remark : one line and some sentences for OpenAPI.
    help : one line for the command line.
    chapters : request, answer -> what a terminal shows; None where the command has a file of its own.
    tag : the group of operations in OpenAPI.
    forms : in which the answer is there; of several the header `Accept` chooses, the first for those who take all.
    options : fields of the request that the command line may give in place of the file.
    picture : title, answer -> SVG, for the command line.
    workbook : request, answer -> xlsx, for the command line; then requests may be workbooks too.
    examples : folder of example bodies.
    long : takes seconds: such computations have turns of their own, behind all others.
    later : may run as a job, by `Prefer: respond-async`.
    scope : what a key must allow.
    """

    name: str
    path: str
    request: Reference
    answer: Reference | None
    compute: Reference
    summary: str
    remark: str
    help: str = ""
    chapters: Reference | None = None
    options: tuple[str, ...] = ()
    picture: Reference | None = None
    workbook: Reference | None = None
    tag: str = "counterweights"
    forms: tuple[Form, ...] = (JSON,)
    examples: str = ""
    long: bool = False
    later: bool = False
    scope: "Scope" = "compute"

    @property
    def title(self) -> str:
        """The name in addresses and on the command line."""
        return self.name.replace("_", "-")

    def long_by_kind(self, form: Form, workbook: bool) -> bool:
        """Whether it is long whatever it is about; reading and writing workbooks is."""
        return self.long or workbook or form.media_type == XLSX

    @property
    def request_model(self) -> "type[Model]":
        """Model of the request."""
        model: type[Model] = _object(self.request)
        return model

    @property
    def answer_model(self) -> "type[Model] | None":
        """Model of the answer."""
        return None if self.answer is None else _object(self.answer)

    @property
    def function(self) -> Callable[[Any], Any]:
        """What makes the answer."""
        operation: Callable[[Any], Any] = _object(self.compute)
        return operation
