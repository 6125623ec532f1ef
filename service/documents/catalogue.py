"""The documents that go in and come out, by name, with their JSON schemas."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from schemas.accuracy import AccuracyAnswer, AccuracyRequest
from schemas.answers import AnalyzeAnswer, OptimizeAnswer
from schemas.base import Model
from schemas.effects import EffectCatalogue
from schemas.pareto import ParetoAnswer, ParetoRequest
from schemas.problem import Problem
from schemas.rating import RatingRequest
from schemas.rating_answer import RatingAnswer
from schemas.requests import AnalyzeRequest, OptimizeRequest
from schemas.scroll import PinLoadsAnswer, PinLoadsRequest
from schemas.sweep import SweepEstimate, SweepRequest, SweepState


@dataclass(frozen=True)
class Document:
    """A document: its model, which way it goes, and what it is."""

    model: type[Model]
    mode: Literal["validation", "serialization"]
    meaning: str

    def json_schema(self) -> dict[str, Any]:
        return self.model.model_json_schema(mode=self.mode)


DOCUMENTS: Mapping[str, Document] = {
    "optimize": Document(OptimizeRequest, "validation", "request of /v1/optimize"),
    "optimize-answer": Document(OptimizeAnswer, "serialization", "answer of /v1/optimize"),
    "analyze": Document(AnalyzeRequest, "validation", "request of /v1/analyze"),
    "analyze-answer": Document(AnalyzeAnswer, "serialization", "answer of /v1/analyze"),
    "pin-loads": Document(PinLoadsRequest, "validation", "request of /v1/scroll/pin-loads"),
    "pin-loads-answer": Document(PinLoadsAnswer, "serialization", "answer of /v1/scroll/pin-loads"),
    "pareto": Document(ParetoRequest, "validation", "request of /v1/pareto"),
    "pareto-answer": Document(ParetoAnswer, "serialization", "answer of /v1/pareto"),
    "accuracy": Document(AccuracyRequest, "validation", "request of /v1/accuracy"),
    "accuracy-answer": Document(AccuracyAnswer, "serialization", "answer of /v1/accuracy"),
    "sweep": Document(SweepRequest, "validation", "request of /v1/sweeps"),
    "sweep-state": Document(SweepState, "serialization", "answer of /v1/sweeps and /v1/sweeps/{id}"),
    "sweep-estimate": Document(SweepEstimate, "serialization", "answer of /v1/sweeps with dry_run"),
    "rating": Document(RatingRequest, "validation", "request of /v1/rating"),
    "rating-answer": Document(RatingAnswer, "serialization", "answer of /v1/rating"),
    "effects": Document(EffectCatalogue, "serialization", "answer of /v1/effects"),
    "problem": Document(Problem, "serialization", "what any error is answered with"),
}
