"""Designs that are certified each by itself: with options, minimum masses, plates, equal castings, or tolerances."""

from collections.abc import Iterator, Sequence
from itertools import chain

from schemas.base.model import FieldProblem
from schemas.base.target import Target
from schemas.machine.rotor import no_catalogue, no_groups
from schemas.request.requests import AnalyzeRequest, OptimizeRequest

#: designs of a sweep whose counterweights are searched, each for as long as a single answer
MAX_SEARCHED = 10_000
#: fields that ask for a search and may be null in the base
_AXIS_SETTINGS = ("max_counterweights", "min_fitted_mass_kg")


def searched(base: OptimizeRequest | AnalyzeRequest, targets: Sequence[Target]) -> bool:
    """Whether counterweights are searched among discrete choices."""
    machine = base.machine
    varied = any(target.path[-1] in _AXIS_SETTINGS for target in targets)
    return isinstance(base, OptimizeRequest) and (machine.choice is not None or varied)


def separate(base: OptimizeRequest | AnalyzeRequest, targets: Sequence[Target]) -> bool:
    """Whether designs are no batch of one program."""
    if not isinstance(base, OptimizeRequest):
        return False
    plates = any(web.envelope is not None for web in base.machine.every_web)
    # cuts find what scatters, and scenarios are machines of their own
    alone = plates or base.machine.web_groups or base.uncertain
    return bool(alone or searched(base, targets))


def alone_problems(base: OptimizeRequest | AnalyzeRequest) -> Iterator[FieldProblem]:
    """Fields that only an optimum of one design after the other can have."""
    if isinstance(base, OptimizeRequest):
        return
    subject = "a sweep of what is analyzed"
    machine, place = base.machine, ("machine",)
    rules = (
        no_catalogue(machine, place, subject),
        no_groups(machine, place, subject),
        ((broken, (*place, *path), message) for broken, path, message in machine.no_envelopes(
            f"{subject}: counterweights have a known radius"
        )),
    )  # fmt: skip
    for broken, path, message in chain.from_iterable(rules):
        if broken:
            yield FieldProblem(("base", *path), message)
