"""The kinds of number a machine is made of, with the range in which the arithmetic cannot overflow."""

from typing import Annotated

from pydantic import Strict, StringConstraints

from schemas.base.units import AnswerUnit, Unit, between, non_negative, positive, symmetric

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
Kilograms = Annotated[float, AnswerUnit("kg")]
Metres = Annotated[float, AnswerUnit("m")]
KilogramMetres = Annotated[float, AnswerUnit("kg m")]
Degrees = Annotated[float, AnswerUnit("deg")]
Newtons = Annotated[float, AnswerUnit("N")]
NewtonMetres = Annotated[float, AnswerUnit("N m")]
Seconds = Annotated[float, AnswerUnit("s")]
Milliseconds = Annotated[float, AnswerUnit("ms")]
MetresPerSecond = Annotated[float, AnswerUnit("m/s")]
MetresPerSquareSecond = Annotated[float, AnswerUnit("m/s2")]
Pascals = Annotated[float, AnswerUnit("Pa")]
Joules = Annotated[float, AnswerUnit("J")]
Watts = Annotated[float, AnswerUnit("W")]
KilogramSquareMetres = Annotated[float, AnswerUnit("kg m2")]
