"""DXF as another library reads and audits it."""

import io
from math import degrees

import ezdxf
import pytest
from ezdxf.document import Drawing
from hypothesis import given

from schemas.machine.webs import Envelope
from service.drawings.dxf import dxf
from service.drawings.outline import Arc, outline
from tests.drawings.plates import HALF_ANGLES, plates


def read(content: bytes) -> Drawing:
    return ezdxf.read(io.StringIO(content.decode("ascii")))


@given(plates(), HALF_ANGLES)
def test_what_is_read_back_is_the_outline(plate: Envelope, half_angle: float) -> None:
    edges = outline(plate, half_angle)
    document = read(dxf(edges))
    assert document.acad_release == "R12"
    assert not document.audit().has_errors
    entities = [entity for entity in document.modelspace() if entity.dxf.layer == "OUTLINE"]
    assert len(entities) == len(edges)
    for entity, edge in zip(entities, edges, strict=True):
        if isinstance(edge, Arc):
            angles = sorted((degrees(edge.first), degrees(edge.last)))
            assert [entity.dxf.start_angle, entity.dxf.end_angle] == pytest.approx(angles, abs=1e-11)
            assert entity.dxf.radius == pytest.approx(1e3 * edge.radius, abs=1e-11)
        else:
            ends = (*entity.dxf.start, *entity.dxf.end)
            assert ends == pytest.approx(
                [1e3 * coordinate for coordinate in (*edge.start, 0.0, *edge.end, 0.0)], abs=1e-11
            )


def test_the_shaft_is_marked_on_a_layer_of_its_own() -> None:
    plate = Envelope(shape="sector", outer_radius_m=0.25, thickness_m=0.04)
    marks = [entity for entity in read(dxf(outline(plate, 1.0))).modelspace() if entity.dxf.layer == "SHAFT"]
    assert {entity.dxftype() for entity in marks} == {"LINE"}
    assert len(marks) == 2
