"""One physical effect: what it means, what it needs, how it is simulated."""

from collections.abc import Callable, Collection, Iterator, Mapping
from typing import Any

from optimizer.mechanics.layout import Layout
from optimizer.mechanics.reading import Reading
from optimizer.numerics.arrays import Real
from optimizer.numerics.records import record
from schemas.base.model import FieldProblem
from schemas.base.rules import Rule
from schemas.machine.machine import Machine
from schemas.request.scene import Fidelity


@record(frozen=True)
class Context:
    """What an effect may look at: the machines, the angles, and the results of the effects that it needs."""

    machine: Machine
    layout: Layout
    fidelity: Fidelity
    angle: Real  # (T,) shaft angles, or (..., T) others for each machine, rad
    results: Mapping[str, Any]
    demands: Collection[str] = ()  # effects whose results are read once all have run
    readings: tuple[Reading, ...] = ()  # of the forces of many designs over the turn, that columns will need


def _none(_machine: Machine) -> Iterator[Any]:
    return iter(())


def _always(_machine: Machine) -> bool:
    return True


@record(frozen=True)
class Effect:
    """A physical effect.

    name, meaning : a word and a line.
    simulate : pure function of its context.
    needs : effects whose results it uses.
    inputs : fields of the request that it reads beyond masses and geometry, for people.
    problems : fields that it needs and a machine does not give, by paths from the machine.
    rules : what it asks of these fields once they are there; of columns where the machine has columns.
    applies : whether a machine has the effect at all.
    """

    name: str
    meaning: str
    simulate: Callable[[Context], Any]
    needs: tuple[str, ...] = ()
    inputs: tuple[str, ...] = ()
    problems: Callable[[Machine], Iterator[FieldProblem]] = _none
    rules: Callable[[Machine], Iterator[Rule]] = _none
    applies: Callable[[Machine], bool] = _always

    @property
    def demanding(self) -> bool:
        """Whether it asks anything of the request."""
        return self.problems is not _none or self.ruled

    @property
    def ruled(self) -> bool:
        """Whether it asks anything of the fields beyond that they are there."""
        return self.rules is not _none

    @property
    def universal(self) -> bool:
        """Whether every machine has it."""
        return self.applies is _always
