"""The waist: what the machine answers to unbalance, baseline + influence @ unbalance.

Mechanics ends here and the convex program begins here; neither knows the other. Vectors across the
shaft are complex, x + jy. A response of order k over the shaft angle theta is
F(theta) = co e^{j s k theta} + counter e^{-j s k theta}, s the sense of rotation: an ellipse.
"""

from dataclasses import replace
from typing import Literal

import numpy as np

from optimizer.numerics.arrays import Complex, Real, spread
from optimizer.numerics.records import record


@record(frozen=True)
class Phasors:
    """A pair of rotating vectors; ``co`` turns with the shaft, ``counter`` against it. (...) complex."""

    co: Complex
    counter: Complex

    def __add__(self, other: "Phasors") -> "Phasors":
        return Phasors(self.co + other.co, self.counter + other.counter)

    def __mul__(self, factor: Real) -> "Phasors":
        return Phasors(self.co * factor, self.counter * factor)

    __rmul__ = __mul__

    @property
    def peak(self) -> Real:
        """Largest magnitude over a turn, the major semi-axis |co| + |counter| (docs/mathematics.md section 3)."""
        return np.abs(self.co) + np.abs(self.counter)

    @property
    def minor(self) -> Real:
        """Smallest magnitude over a turn, the minor semi-axis."""
        return np.abs(np.abs(self.co) - np.abs(self.counter))

    @property
    def major_axis_deg(self) -> Real:
        """Direction of the major axis in [0, 180) degrees; 0 for a circle, which has none."""
        phases = np.arctan2(self.co.imag, self.co.real) + np.arctan2(self.counter.imag, self.counter.real)
        axis = np.mod(np.rad2deg(0.5 * phases), 180.0)
        return np.where((self.co != 0) & (self.counter != 0) & (axis < 180.0), axis, 0.0)

    def peak_along(self, direction: Complex) -> Real:
        """Largest component along a direction over a turn, |co + e^{2j g} conj(counter)| for e^{j g}.

        Parameters
        ----------
        direction : (...) unit vectors; 1 gives the x component, 1j the y component.
        """
        return np.abs(self.co + direction**2 * np.conj(self.counter))

    def at(self, angle_rad: Real, order: int = 1) -> Complex:
        """The vector at shaft angles s*theta.

        Parameters
        ----------
        angle_rad : (..., n) shaft angle times sense of rotation.

        Returns
        -------
        (..., n) complex.
        """
        return self.of_rotation(np.exp(1j * order * angle_rad))

    def of_rotation(self, unit: Complex) -> Complex:
        """The same (..., n) where a shaft that turned as often as they do points along unit vectors (..., n)."""
        return self.co[..., None] * unit + self.counter[..., None] * np.conj(unit)


@record(frozen=True)
class Response:
    """A response that is affine in the unbalance u of the counterweights.

    name : what it is, unique among the responses of a program.
    unit : of the response times omega^2: "N", "N m".
    baseline : without counterweights, divided by omega^2: kg m for a force, kg m^2 for a moment.
    influence : (..., webs) change of the co-rotating phasor for one kg m on each web; complex where a counterweight
        answers out of line with itself.
    order : how often the vectors turn while the shaft turns once.
    sense : +1 if the co-rotating vector turns with the shaft, -1 if against it.
    counter_influence : (..., webs) change of the counter-rotating phasor, of webs on shafts that turn backwards; None
        where there are none. The unbalance of such a web stands for its mirror image at the x axis, conj(v), so that
        all is affine in it: it changes conj(counter). Where the phasors never meet in one vector it may as well stand
        for v itself.
    scenario : name of the scenario whose response it is; None of the unchanged machine.
    """

    name: str
    unit: str
    baseline: Phasors
    influence: Real | Complex
    order: int = 1
    sense: int = 1
    counter_influence: Real | None = None
    scenario: str | None = None

    def spread(self, leading: tuple[int, ...]) -> "Response":
        """The same of as many machines as the leading axes say; what is common to all is not copied."""
        if not leading:
            return self
        baseline = Phasors(spread(self.baseline.co, leading), spread(self.baseline.counter, leading))
        influence = spread(np.asarray(self.influence), (*leading, self.influence.shape[-1]))
        against = self.counter_influence
        if against is not None:
            against = spread(against, (*leading, against.shape[-1]))
        return replace(self, baseline=baseline, influence=influence, counter_influence=against)

    def to(self, unbalance: Complex) -> Phasors:
        """Response with counterweights, baseline + influence @ unbalance.

        Parameters
        ----------
        unbalance : (..., webs) complex mass-radius products m R e^{ja}, kg m.
        """
        change = np.add.reduce(self.influence * unbalance, axis=-1)
        if self.counter_influence is None:
            return Phasors(self.baseline.co + change, self.baseline.counter)
        mirrored = np.add.reduce(self.counter_influence * unbalance, axis=-1)
        return Phasors(self.baseline.co + change, self.baseline.counter + np.conj(mirrored))

    def along(self, axis: Literal["x", "y"]) -> "Response":
        """Its component along an axis, which is the larger the longer co + e^{2j g} conj(counter): a single phasor.

        Its name is that of the response with the axis behind it, force:x.
        """
        counter = np.conj(self.baseline.counter)
        component = self.baseline.co + counter if axis == "x" else self.baseline.co - counter
        alone = replace(
            self,
            name=f"{self.name}:{axis}",
            baseline=Phasors(component, np.zeros_like(component)),
            counter_influence=None,
        )
        if self.counter_influence is None:
            return alone
        return replace(alone, influence=self.influence + (1.0 if axis == "x" else -1.0) * self.counter_influence)

    def unmirrored(self) -> "Response":
        """The same where webs of shafts that turn backwards stand for themselves: no vector may hold both phasors."""
        if self.counter_influence is None:
            return self
        return replace(self, baseline=Phasors(self.baseline.co, np.conj(self.baseline.counter)))

    def over_turn(self, unbalance: Complex, angle_rad: Real) -> Complex:
        """Response with counterweights while the shaft turns (..., n).

        Parameters
        ----------
        angle_rad : (..., n) how far the shaft has turned.
        """
        return self.to(unbalance).at(self.sense * angle_rad, self.order)
