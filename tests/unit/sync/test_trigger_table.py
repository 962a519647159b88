"""Triggers that users write, and those of a drill."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone
from station.drills.library import find_lesson
from station.sync.sonification.trigger_table import PRESETS, drill_triggers, parse_trigger


def test_a_piece_by_name() -> None:
    trigger = parse_trigger("0.25=kick", "--trigger")
    assert (trigger.threshold, trigger.sound.piece, trigger.midi_note) == (0.25, Piece.KICK, 36)


def test_a_velocity() -> None:
    assert parse_trigger("0.5=snare@60", "--trigger").velocity == 60


def test_a_note_of_general_midi_by_its_number() -> None:
    """RP-003, table 3: 53 is the ride's bell; 76 a wood block, which no kit has."""
    bell, block = parse_trigger("0=53", "--trigger"), parse_trigger("0=76", "--trigger")
    assert (bell.sound.piece, bell.sound.zone) == (Piece.RIDE, Zone.BELL)
    assert (block.sound.piece, block.midi_note) == (Piece.PERCUSSION, 76)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("kick", "PHASE=WHAT"),
        ("=kick", "found nothing"),
        ("1=kick", "but not 1"),
        ("-0.1=kick", "but not 1"),
        ("nan=kick", "but not 1"),
        ("half=kick", "found half"),
        ("0.5=snair", "did you mean snare"),
        ("0.5=", "no such piece"),
        ("0.5=128", "0 to 127"),
        ("0.5=" + "9" * 5_000, "--trigger: 0.5=9"),
        ("0.5=kick@" + "9" * 5_000, "--trigger: 0.5=kick@9"),
        ("0.5=kick@0", "1 to 127"),
        ("0.5=kick@loud", "1 to 127"),
    ],
)
def test_what_cannot_be_meant_is_said(text: str, fault: str) -> None:
    with pytest.raises(BadInput, match=fault) as found:
        parse_trigger(text, "--trigger")
    assert str(found.value).startswith("--trigger: ")


def test_the_papers_footfalls() -> None:
    """§ 4.1: approximately 0.25 and 0.75."""
    assert [(t.threshold, t.limb) for t in PRESETS["walk"]] == [(0.25, Limb.RIGHT_FOOT), (0.75, Limb.LEFT_FOOT)]


def test_a_drills_strokes_lie_where_its_loop_has_them() -> None:
    """A bar of eighths with the kick on 1 and 3: the loop begins at φ = 0, half way through the share's range."""
    loop = find_lesson("rock-1").score.bars(0, 0)
    triggers = drill_triggers(loop)
    assert len(triggers) == len(loop)
    kicks = [t.threshold for t in triggers if t.sound.piece is Piece.KICK]
    assert kicks == pytest.approx([0.5, 0.0])
    hats = sorted(t.threshold for t in triggers if t.sound.piece is Piece.HIHAT)
    assert hats == pytest.approx([k / 8 for k in range(8)])
