"""Every control counts over its whole range, and no two styles look alike: measured on the motion."""

from itertools import combinations, pairwise

import pytest

from station.motion.style.style import NUMBERS
from station.motion.style.style_file import style_names
from tools.style_table import EFFECTS, PAGE, effects, style_rows

STEADY = [control for control, effect in EFFECTS.items() if not effect.steps]
LEAST_SHARE = 0.01
"""Of a control's whole effect, what the first and the last tenth of its range must at least do."""


def test_every_number_is_measured() -> None:
    assert set(EFFECTS) == set(NUMBERS)


@pytest.mark.parametrize("control", STEADY)
def test_a_control_counts_over_its_whole_range(control: str) -> None:
    """Without a dead part at its beginning, saturation at its end, or a way back."""
    shares = (0.0, 0.1, 0.5, 0.9, 1.0)
    found = effects(control, shares)
    steps = [b - a for a, b in pairwise(found)]
    if control == "amplitude_wrist":  # at rest the wrist holds the stick up: its stroke grows over that from a tenth on
        steps = steps[1:]
    assert min(steps) > LEAST_SHARE * (found[-1] - found[0]) > 0


def test_controls_in_steps_do_something_at_their_ends() -> None:
    for control, effect in EFFECTS.items():
        if effect.steps:
            low, high = effects(control, (0.0, 1.0))
            assert high > 1.5 * low, control


def test_no_two_styles_move_alike() -> None:
    """Somewhere a joint or the head goes at least a seventh farther, or faster, in one than in the other."""
    for (one, first), (two, second) in combinations(style_rows().items(), 2):
        ratios = [max(a, b) / max(min(a, b), 0.1) for a, b in zip(first, second, strict=True)]
        assert max(ratios) > 1.14, (one, two)


def test_the_page_has_every_style_and_control() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert all(f"\n| {name} |" in text for name in style_names())
    assert all(f"\n| `{control}` |" in text for control in NUMBERS)
