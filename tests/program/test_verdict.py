"""What an answer may claim, from figures that are put down by hand; all expected numbers are analytic."""

import logging
from dataclasses import replace

import numpy as np
import pytest

from optimizer.numerics.arrays import Real
from optimizer.program.limits import Limits
from optimizer.program.rows import combined, statement, weighted_peak
from optimizer.program.statement import Statement
from optimizer.program.verdict import (
    CONTRADICTED,
    NOT_CLOSE,
    NOT_LIGHT,
    ON_THE_BOUNDARY,
    OPTIMAL_LIGHTEST,
    Claim,
    mass_resolution,
    verdict,
)
from optimizer.responses.response import Phasors, Response


def _claim(mass: float = 4.0, mass_bound: float = 4.0, resolution: float = 0.0, bound: float = 10.0) -> Claim:
    """One answer with an objective of 10, 20 without counterweights."""
    return Claim(
        value=np.array([10.0]),
        lower_bound=np.array([bound]),
        rounding=np.array([1e-12]),
        yardstick=np.array([20.0]),
        excess=np.asarray(-np.inf),
        mass=np.asarray(mass),
        mass_resolution=np.asarray(resolution),
        mass_lower_bound=np.asarray(mass_bound),
    )


def _program(combine: str, ceiling: float | None = None, largest: tuple[float, ...] = (5.0, 5.0)) -> Statement:
    """20 kg m at rest, and 3 kg m^2 of them; a web of 0.5 m radius and arm 0.2 m, one of 0.25 m and arm 0.8 m."""
    force = Response("force", "N", Phasors(np.asarray(20.0 + 0j), np.asarray(0j)), np.ones(2))
    moment = Response("moment", "N m", Phasors(np.asarray(3j), np.asarray(0j)), np.array([-0.2, 0.8]))
    limits = Limits(
        radius=np.array([0.5, 0.25]),
        max_mass=np.array(largest),
        free=np.ones(2, bool),
        centre=np.ones(2, complex),
        half_angle_cos=np.zeros(2),
        half_angle_sin=np.ones(2),
        max_total_mass=np.asarray(np.inf),
    )
    peaks = [weighted_peak(force, 1.0), weighted_peak(moment, 10.0)]
    return statement(combined(peaks, combine), [] if ceiling is None else [(moment, ceiling)], limits)


@pytest.mark.parametrize(
    ("program", "yardstick", "least"),
    [
        # a kilogram changes the sum by 0.5 + 10 * 0.1 = 1.5, or by 0.25 + 10 * 0.2 = 2.25
        (_program("sum"), [50.0], 50.0 / 2.25),
        # the larger of 20 and 30: force by 0.5 a kilogram, moment by 10 * 0.2
        (_program("max"), [30.0], 30.0 / 2.0),
        # each row has its own yardstick
        (_program("max"), [20.0, 60.0], 60.0 / 2.0),
        # a web that carries nothing does nothing
        (_program("sum", largest=(5.0, 0.0)), [50.0], 50.0 / 1.5),
        # the moment is 3, the ceiling less: 3 / 0.2
        (_program("sum", ceiling=2.0), [50.0], 3.0 / 0.2),
        (_program("sum", largest=(0.0, 0.0)), [50.0], 0.0),
    ],
)
def test_the_least_mass_that_could_cancel(program: Statement, yardstick: Real, least: float) -> None:
    assert mass_resolution(program, np.array(yardstick)) == pytest.approx(1e-5 * least, rel=1e-14, abs=0)


@pytest.mark.parametrize(("share", "reason"), [(0.9e-6, OPTIMAL_LIGHTEST), (1.1e-6, NOT_CLOSE)])
def test_an_optimum_is_within_the_gap_that_was_requested(share: float, reason: str) -> None:
    assert verdict(_claim(bound=10.0 - 20.0 * share), 1e-6).reason == reason


def test_a_mass_is_told_to_a_share_of_itself_or_of_what_counts() -> None:
    assert verdict(_claim(mass_bound=4.0 * (1 - 9e-5)), 1e-6).reason == OPTIMAL_LIGHTEST
    assert verdict(_claim(mass_bound=4.0 * (1 - 1.1e-4)), 1e-6).reason == NOT_LIGHT
    judgement = verdict(_claim(mass_bound=3.9), 1e-6)
    assert (judgement.status, judgement.reason) == ("inaccurate", NOT_LIGHT)
    assert judgement.mass_gap == pytest.approx(0.1 / 4.0)
    assert judgement.mass_yardstick == 4.0
    # a tenth of a microgram is half proven: it depends on what a mass has to be to count
    tiny = _claim(mass=1e-10, mass_bound=0.5e-10)
    assert verdict(tiny, 1e-6).status == "inaccurate"
    finding = verdict(replace(tiny, mass_resolution=np.asarray(1e-6)), 1e-6)
    assert finding.status == "optimal"
    assert finding.mass_yardstick == 1e-6
    assert finding.mass_gap == pytest.approx(0.5e-4)


def test_a_bound_above_the_value_by_its_rounding_is_the_value(caplog: pytest.LogCaptureFixture) -> None:
    bound = verdict(_claim(bound=10.0 + 0.9e-12), 1e-6)
    assert (bound.status, float(bound.lower_bound[0]), float(bound.gap[0])) == ("optimal", 10.0, 0.0)
    assert not caplog.records


@pytest.mark.parametrize("false", [_claim(bound=10.1), _claim(mass_bound=4.1)])
def test_a_contradiction_is_a_fault_that_is_said(false: Claim, caplog: pytest.LogCaptureFixture) -> None:
    """Never clipped: nothing is proven, and it is logged."""
    certificate = verdict(false, 1e-6)
    assert (certificate.status, certificate.reason) == ("inaccurate", CONTRADICTED)
    for figure in (
        certificate.lower_bound,
        certificate.gap,
        certificate.relative_gap,
        certificate.mass_lower_bound,
        certificate.mass_gap,
    ):
        assert np.all(np.isnan(figure))
    assert [record.levelno for record in caplog.records] == [logging.ERROR]


def test_no_mass_is_proven_of_what_exceeds_a_ceiling(caplog: pytest.LogCaptureFixture) -> None:
    light = replace(_claim(mass=1.0, mass_bound=4.0), excess=np.asarray(0.5))
    judged = verdict(light, 1e-6)
    assert (judged.status, judged.reason) == ("inaccurate", ON_THE_BOUNDARY)
    assert judged.mass_lower_bound == 1.0
    assert not caplog.records
