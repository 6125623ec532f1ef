"""Doors: room for each address, and always for who asks for health."""

from functools import partial

from service.fairness.connection_limits import ConnectionLimits
from service.fairness.table import PROBES, connections

_PER_CLIENT, _ALTOGETHER = int(PROBES.per_client), int(PROBES.altogether)


def test_an_address_has_its_share() -> None:
    doors = ConnectionLimits(connections(5, 3), ())
    assert [doors.enter("10.0.0.1") for _ in range(4)] == [True, True, True, False]
    assert [doors.enter("10.0.0.2") for _ in range(3)] == [True, True, False]
    doors.leave("10.0.0.1")
    assert [doors.enter("10.0.0.2") for _ in range(2)] == [True, False]


def test_a_proxy_stands_for_many_and_a_network_of_ipv6_for_one() -> None:
    doors = ConnectionLimits(connections(100, 2), ("10.0.0.0/8",))
    assert all(doors.enter("10.0.0.1") for _ in range(5))
    assert [doors.enter(f"2001:db8::{k}") for k in range(3)] == [True, True, False]
    assert doors.enter("2001:db8:0:1::1")
    assert [doors.enter(f"::ffff:192.0.2.{k}") for k in (1, 1, 1, 2)] == [True, True, False, True]


def test_who_asks_for_health_takes_the_place_of_who_held_it_longest() -> None:
    doors = ConnectionLimits(connections(0, 0), ())
    gone: list[str] = []
    for k in range(_PER_CLIENT + 2):
        doors.probe("10.0.0.1", partial(gone.append, f"a{k}"))
    assert gone == ["a0", "a1"]
    for k in range(_ALTOGETHER - _PER_CLIENT + 1):
        doors.probe(f"10.0.1.{k}", partial(gone.append, f"b{k}"))
    # the address that has the most gives one up
    assert gone == ["a0", "a1", "a2"]


def test_what_has_ended_is_forgotten() -> None:
    doors = ConnectionLimits(connections(1, 1), ())

    def give_up() -> None:
        raise AssertionError("it is gone")

    for _ in range(10 * _ALTOGETHER):
        doors.probe("10.0.0.1", give_up)
        doors.probed("10.0.0.1", give_up)
        assert doors.enter("10.0.0.1")
        doors.leave("10.0.0.1")


def test_some_are_kept_for_those_who_have_few() -> None:
    doors = ConnectionLimits(connections(100, 50), ())
    many = [doors.enter(f"10.0.0.{k % 4}") for k in range(120)]
    assert many == [True] * 90 + [False] * 30
    assert [doors.enter("10.0.0.9") for _ in range(12)] == [True] * 8 + [False] * 4
