"""The documents that go in and come out, by name, with their JSON schemas."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from schemas.answer.effects import EffectCatalogue
from schemas.answer.problem import Problem
from schemas.base.model import Model
from schemas.sweep.answers import SweepEstimate, SweepState
from schemas.sweep.request import SweepRequest
from service.computations.table import COMPUTATIONS


@dataclass(frozen=True)
class Document:
    """A document: its model, which way it goes, and what it is."""

    model: type[Model]
    mode: Literal["validation", "serialization"]
    meaning: str

    def json_schema(self) -> dict[str, Any]:
        return self.model.model_json_schema(mode=self.mode)


_DOCUMENTS = {
    "sweep": Document(SweepRequest, "validation", "request of /v1/sweeps"),
    "sweep-state": Document(SweepState, "serialization", "answer of /v1/sweeps and /v1/sweeps/{id}"),
    "sweep-estimate": Document(SweepEstimate, "serialization", "answer of /v1/sweeps with dry_run"),
    "effects": Document(EffectCatalogue, "serialization", "answer of /v1/effects"),
    "problem": Document(Problem, "serialization", "what any error is answered with"),
}


def documents() -> Mapping[str, Document]:
    """Requests and answers of all computations, and the others."""
    return {**dict(_of_computations()), **_DOCUMENTS}


def _of_computations() -> Iterator[tuple[str, Document]]:
    for computation in COMPUTATIONS.values():
        # a computation that answers with a document takes the request of another
        if computation.answer_model is not None:
            yield computation.title, Document(computation.request_model, "validation", f"request of {computation.path}")
            yield (
                f"{computation.title}-answer",
                Document(computation.answer_model, "serialization", f"answer of {computation.path}"),
            )
