import itertools

import pytest

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.sound_names import (
    SUBSTITUTES,
    TIP_TIMBRE,
    SoundChoice,
    SoundName,
    choose_sound,
    hihat_step,
    strike_of_sound,
)

# What a drummer would say each stroke is: written by hand from the names of the pieces.
STROKES = [
    (NoteMeaning(Piece.KICK), SoundName.KICK),
    (NoteMeaning(Piece.SNARE), SoundName.SNARE),
    (NoteMeaning(Piece.SNARE, Zone.RIM), SoundName.SNARE_RIM_SHOT),
    (NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT), SoundName.SNARE_RIM_SHOT),
    (NoteMeaning(Piece.SNARE, Zone.HEAD, Articulation.RIM_SHOT), SoundName.SNARE_RIM_SHOT),
    (NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK), SoundName.SNARE_CROSS_STICK),
    (NoteMeaning(Piece.SNARE, Zone.HEAD, Articulation.BUZZ), SoundName.SNARE_BUZZ),
    (NoteMeaning(Piece.TOM_2), SoundName.TOM_2),
    (NoteMeaning(Piece.TOM_2, Zone.RIM), SoundName.TOM_2_RIM),
    (NoteMeaning(Piece.FLOOR_TOM_1, Zone.RIM), SoundName.FLOOR_TOM_1_RIM),
    (NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0), SoundName.HIHAT_CHICK),
    (NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH), SoundName.HIHAT_FOOT_SPLASH),
    (NoteMeaning(Piece.RIDE, Zone.BOW), SoundName.RIDE_BOW),
    (NoteMeaning(Piece.RIDE), SoundName.RIDE_BOW),
    (NoteMeaning(Piece.RIDE, Zone.BELL), SoundName.RIDE_BELL),
    (NoteMeaning(Piece.RIDE, Zone.EDGE), SoundName.RIDE_EDGE),
    (NoteMeaning(Piece.CRASH_1, Zone.EDGE), SoundName.CRASH_1),
    (NoteMeaning(Piece.CHINA, Zone.EDGE), SoundName.CHINA),
    (NoteMeaning(Piece.COWBELL), SoundName.COWBELL),
]


@pytest.mark.parametrize(("strike", "sound"), STROKES)
def test_a_stroke_asks_for_the_sound_that_a_drummer_expects(strike: NoteMeaning, sound: SoundName) -> None:
    assert choose_sound(strike).sound is sound


@pytest.mark.parametrize(
    ("openness", "sound"),
    [
        (None, SoundName.HIHAT_CLOSED),
        (0.0, SoundName.HIHAT_CLOSED),
        (0.12, SoundName.HIHAT_CLOSED),
        (0.13, SoundName.HIHAT_LOOSE),
        (0.5, SoundName.HIHAT_HALF),
        (0.87, SoundName.HIHAT_WIDE),
        (0.88, SoundName.HIHAT_OPEN),
        (1.0, SoundName.HIHAT_OPEN),
    ],
)
def test_the_hihats_sound_is_the_one_nearest_to_its_opening(openness: float | None, sound: SoundName) -> None:
    assert choose_sound(NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=openness)).sound is sound


def test_openings_beyond_the_range_are_its_ends() -> None:
    assert (hihat_step(-3.0), hihat_step(7.0)) == (0, 4)


def test_the_tip_on_a_bow_is_darker_than_the_shank_on_the_edge() -> None:
    assert choose_sound(NoteMeaning(Piece.CRASH_1, Zone.BOW)) == SoundChoice(SoundName.CRASH_1, TIP_TIMBRE)
    assert choose_sound(NoteMeaning(Piece.CRASH_1, Zone.EDGE)) == SoundChoice(SoundName.CRASH_1, 1.0)
    assert choose_sound(NoteMeaning(Piece.HIHAT, Zone.BOW, openness=0.0)).timbre == TIP_TIMBRE
    assert TIP_TIMBRE < 1.0


def test_every_piece_zone_and_articulation_has_a_sound() -> None:
    for piece, zone, articulation in itertools.product(Piece, Zone, Articulation):
        for openness in (None, 0.0, 0.4, 1.0):
            assert choose_sound(NoteMeaning(piece, zone, articulation, openness)).sound in SoundName


def test_every_way_of_substitution_is_short_and_never_leads_to_itself() -> None:
    for name, others in SUBSTITUTES.items():
        assert name not in others
        assert len(set(others)) == len(others)


@pytest.mark.parametrize("sound", list(SoundName))
def test_every_sound_has_a_stroke_that_asks_for_it(sound: SoundName) -> None:
    assert choose_sound(strike_of_sound(sound)).sound is sound
