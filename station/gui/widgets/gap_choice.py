"""The choice of bars in which the click is silent."""

from imgui_bundle import imgui

from station.gui import theme
from station.practice.session.cues.quiet_bars import Gap, QuietBars, RandomGap, gap_words

GAP_LABEL = "##gap"
_GAPS: tuple[tuple[str, QuietBars | None], ...] = (
    ("the click sounds throughout", None),
    ("4 bars of click, 1 without", Gap(4, 1)),
    ("2 bars of click, 2 without", Gap(2, 2)),
    ("1 bar of click, 3 without", Gap(1, 3)),
    ("the click drops out at random", RandomGap()),
)


def gap_choice(gap: QuietBars | None) -> QuietBars | None:
    """Draw it; one that is none of the usual ones stands first. Returns what is chosen."""
    known = [each for _, each in _GAPS]
    labels = [label for label, _ in _GAPS]
    if gap not in known:
        assert gap is not None, "no gap is a usual one"
        known, labels = [gap, *known], [gap_words(gap), *labels]
    imgui.set_next_item_width(-1)
    changed, index = imgui.combo(GAP_LABEL, known.index(gap), labels)
    theme.tooltip("Keep the time where it is silent: the report says how far off you come back")
    return known[index] if changed else gap
