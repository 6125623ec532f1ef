"""What is answered about a sweep: how far it is, and where its results are."""

from typing import Literal

from pydantic import Field

from schemas.base.model import Answer, Model
from schemas.base.quantities import Seconds

JobState = Literal["queued", "running", "done", "failed", "cancelled"]


class SweepLinks(Model):
    """Where to go from here."""

    self: str = Field(description="state of the sweep", examples=["/v1/sweeps/5f0c"])
    results: str = Field(description="rows of the result", examples=["/v1/sweeps/5f0c/results"])
    events: str = Field(description="progress as server-sent events", examples=["/v1/sweeps/5f0c/events"])


class SweepState(Answer):
    """How far a sweep is."""

    id: str = Field(description="name of the sweep", examples=["5f0c"])
    state: JobState = Field(description="how far it is", examples=["running"])
    total: int = Field(description="number of designs", examples=[1000000])
    done: int = Field(description="designs that have their row, whatever it says", examples=[250000])
    failed: int = Field(
        description="designs among them without a certified answer: infeasible, inaccurate or failed",
        examples=[12],
    )
    invalid: int = Field(
        0, description="designs among them that break a rule, counted apart; their rows say which", examples=[3]
    )
    infeasible: int = Field(
        0,
        description="designs among the failed ones for which it is proven that no counterweights keep the ceilings;"
        " 0 of what version 0.2.0 computed",
        examples=[2],
    )
    rows: int = Field(description="rows that the results hold now; fewer than done with top or pareto", examples=[20])
    selected: int | None = Field(
        description="designs that top or pareto have looked at, some time after they are done; null without them",
        examples=[None],
    )
    repaired: int = Field(
        description="times that rows on disk were found damaged or missing, and were computed again", examples=[0]
    )
    bytes: int = Field(description="room that the sweep takes on disk now", examples=[30000000])
    seed: int = Field(description="seed of the designs", examples=[0])
    eta_s: Seconds | None = Field(
        description="estimate of the seconds left, at the rate of the last chunks without outages; null where unknown,"
        " and when it has ended",
        examples=[42.0],
    )
    created_at: str = Field(description="when it was accepted, ISO 8601, UTC", examples=["2026-01-31T12:00:00Z"])
    started_at: str | None = Field(description="when the first chunk began", examples=["2026-01-31T12:00:01Z"])
    finished_at: str | None = Field(description="when it ended", examples=[None])
    message: str | None = Field(
        description="why it failed, or why there is no selection and where the rows are; null otherwise",
        examples=[None],
    )
    links: SweepLinks = Field(description="where to go from here", examples=[{"self": "/v1/sweeps/5f0c"}])


class SweepColumn(Model):
    """One column of the result."""

    name: str = Field(description="name of the column", examples=["force_peak_N"])
    kind: Literal["integer", "number", "text"] = Field(description="what it holds", examples=["number"])
    unit: str | None = Field(description="unit of its values", examples=["N"])
    meaning: str = Field(description="what its values are", examples=["peak of the first-order force"])
    source: str | None = Field(description="field of the base it belongs to, of axes and webs", examples=[None])


class SweepEstimate(Answer):
    """What a sweep would be, without running it."""

    total: int = Field(description="number of designs", examples=[1000000])
    chunks: int = Field(description="pieces in which they would be computed", examples=[50])
    chunk_rows: int = Field(description="designs in one piece", examples=[20000])
    seed: int = Field(description="seed of the designs", examples=[0])
    bytes: int = Field(description="rough room that the sweep will take on disk", examples=[120000000])
    cpu_s: Seconds = Field(
        description="rough time of one core that it will take, all designs together, at rates that were measured on"
        " ordinary machines: within a factor of three or so",
        examples=[45.0],
    )
    workers: int = Field(description="processes that would compute it, as they are set", examples=[4])
    wall_s: Seconds = Field(description="rough time until it is done, under what `assumption` states", examples=[12.0])
    assumption: str = Field(
        description="what `wall_s` assumes",
        examples=["4 workers with a core each and no other work, at measured rates: within a factor of three or so"],
    )
    columns: tuple[SweepColumn, ...] = Field(description="columns of the result", examples=[[{"name": "index"}]])
