"""The text of a student reads back as that student, and no text does worse than `BadInput`."""

from dataclasses import replace
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from station.core.errors import BadInput
from station.simulation.student_spec import FAULTS, KEYS, PLAYERS, PlantedFault, StudentSpec, parse_spec

NUMBERS = {
    name: st.integers(int(key.low), int(key.high)) if key.whole else st.floats(key.low, key.high)
    for name, key in KEYS.items()
}
FAULT_LISTS = st.lists(
    st.sampled_from(sorted(FAULTS)).flatmap(
        lambda name: st.floats(0.001, FAULTS[name].largest).map(lambda size: PlantedFault(name, size))
    ),
    unique_by=lambda fault: fault.name,
).map(tuple)


@st.composite
def specs(draw: st.DrawFn) -> StudentSpec:
    base = draw(st.sampled_from([StudentSpec(), *PLAYERS.values()]))
    said: dict[str, Any] = draw(st.fixed_dictionaries({}, optional=NUMBERS))
    spec = replace(base, **said, faults=draw(FAULT_LISTS))
    return spec if spec.miss_pct + spec.wrong_piece_pct <= 100.0 else replace(spec, wrong_piece_pct=0.0)


@given(specs())
def test_text_and_student_round_trip(spec: StudentSpec) -> None:
    assert parse_spec(spec.text()) == spec


@given(specs(), st.randoms())
def test_the_order_of_the_parts_is_free(spec: StudentSpec, random: object) -> None:
    parts = [part for part in spec.text().split(",") if not part.startswith("fault=")]
    getattr(random, "shuffle")(parts)  # noqa: B009
    assert parse_spec(",".join(parts)) == replace(spec, faults=())


@given(st.text(alphabet="seedprofaultlate_kickms=:,.-0123456789 é", max_size=60) | st.text(max_size=30))
def test_any_text_is_a_student_or_bad_input(text: str) -> None:
    try:
        spec = parse_spec(text)
    except BadInput:
        return
    assert parse_spec(spec.text()) == spec
