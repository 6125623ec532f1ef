"""The kinds of number a machine is made of, with the range in which the arithmetic cannot overflow."""

from typing import Annotated

from pydantic import Strict, StringConstraints

from schemas.base.units import Told, Unit, between, non_negative, positive, symmetric

Name = Annotated[str, StringConstraints(min_length=1, max_length=64, pattern=r"^[^\x00-\x1f\x7f]+$")]

Position = Annotated[float, symmetric(1e9), Unit("m")]
Length = Annotated[float, between(1e-12, 1e9), Unit("m")]
Area = Annotated[float, positive(1e12), Unit("m2")]
Mass = Annotated[float, non_negative(1e15), Unit("kg")]
#: a limit that is never multiplied as it stands, so that any number is one
MaxMass = Annotated[float, non_negative(1e300), Unit("kg")]
Angle = Annotated[float, symmetric(1e6), Unit("deg")]
Unbalance = Annotated[float, symmetric(1e15), Unit("kg m")]
Speed = Annotated[float, between(1e-9, 1e9), Unit("rpm")]
Pressure = Annotated[float, non_negative(1e12), Unit("Pa")]
Force = Annotated[float, non_negative(1e30), Unit("N")]
Moment = Annotated[float, non_negative(1e30), Unit("N m")]
Fraction = Annotated[float, Strict(), non_negative(1.0)]
Weight = Annotated[float, Strict(), non_negative(1e30)]
Flag = Annotated[bool, Strict()]
Count = Annotated[int, Strict()]

#: of answers
Kilograms = Annotated[float, Told("kg")]
Metres = Annotated[float, Told("m")]
KilogramMetres = Annotated[float, Told("kg m")]
Degrees = Annotated[float, Told("deg")]
Newtons = Annotated[float, Told("N")]
NewtonMetres = Annotated[float, Told("N m")]
Seconds = Annotated[float, Told("s")]
Milliseconds = Annotated[float, Told("ms")]
MetresPerSecond = Annotated[float, Told("m/s")]
MetresPerSquareSecond = Annotated[float, Told("m/s2")]
Pascals = Annotated[float, Told("Pa")]
Joules = Annotated[float, Told("J")]
Watts = Annotated[float, Told("W")]
KilogramSquareMetres = Annotated[float, Told("kg m2")]
