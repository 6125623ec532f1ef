"""Interference is found where there is some, and not where there is none."""

from tests.freecad.conftest import Run


def test_what_is_in_the_way_is_found(run: Run) -> None:
    process = run("ways")
    # counterweights reach 360 mm, webs are 140 mm apart, the clearance asked for is 5 mm
    for name in ("bare", "roomy", "slim rods"):
        assert process[name] == [], name
    for name in ("near", "tight"):
        assert len(process[name]) == 4, name
        assert all(f"and {name}: " in line and "within 5 mm of its way" in line for line in process[name])
    # the rods fill the gap between the webs: each counterweight beside one is named with the angle
    assert len(process["wide rods"]) == 4
    assert all("wide " in line and "at shaft angle" in line for line in process["wide rods"])
    assert process["no rod"] == ["rows: rod: there is no body 'no such rod'"]
    assert "no bore about its crank pin" in process["not a rod"][0]
    assert len(process["turned"]) >= 1
    assert "overlap" in process["turned"][0]
