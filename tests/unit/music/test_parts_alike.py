"""The comparer of parts finds what differs, and only in what was asked for."""

from dataclasses import replace

import pytest

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.dtx.dtx_writer import DTX
from station.music.formats.music_format import Feature, MusicFormat
from station.music.formats.smf.midi_part import MIDI
from station.music.grace_strokes import with_graces
from station.music.loudness_marks import LoudnessMark
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.parts_alike import differences, kept_differences

_STROKE = Note(PPQ, Piece.SNARE, limb=Limb.RIGHT_HAND)


def _part(*notes: Note, tempo_map: TempoMap | None = None) -> DrumPart:
    return DrumPart(Score.from_notes(notes, tempo_map or TempoMap(), 4 * PPQ, "title"))


@pytest.mark.parametrize(
    ("feature", "note"),
    [
        (Feature.TIMES, replace(_STROKE, tick=PPQ + 5)),
        (Feature.PIECES, replace(_STROKE, piece=Piece.TOM_1)),
        (Feature.SWING, replace(_STROKE, swing_ticks=10)),
        (Feature.VELOCITIES, replace(_STROKE, velocity=81)),
        (Feature.DYNAMICS, replace(_STROKE, dynamic=Dynamic.ACCENT)),
        (Feature.ZONES, replace(_STROKE, zone=Zone.RIM)),
        (Feature.CROSS_STICKS, replace(_STROKE, articulation=Articulation.CROSS_STICK)),
        (Feature.RIM_SHOTS, replace(_STROKE, articulation=Articulation.RIM_SHOT)),
        (Feature.FOOT_SPLASHES, replace(_STROKE, articulation=Articulation.SPLASH)),
        (Feature.FLAMS, replace(_STROKE, ornament=Ornament.FLAM)),
        (Feature.DRAGS, replace(_STROKE, ornament=Ornament.DRAG)),
        (Feature.DIDDLES, replace(_STROKE, ornament=Ornament.DIDDLE)),
        (Feature.BUZZES, replace(_STROKE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL)),
        (Feature.CHOKES, replace(_STROKE, choke_ticks=PPQ)),
        (Feature.STICKING, replace(_STROKE, limb=Limb.LEFT_HAND)),
        (Feature.TIMING, replace(_STROKE, late_ms=-12.0)),
    ],
)
def test_each_feature_of_a_stroke_and_it_alone(feature: Feature, note: Note) -> None:
    found = differences(_part(_STROKE), _part(note), frozenset(Feature))
    assert [line.partition(":")[0] for line in found if not line.startswith(Feature.GRACE_SPACING)] == [feature.value]
    assert differences(_part(_STROKE), _part(note), set(Feature) - {feature}) == []


def test_feet_and_openness() -> None:
    kick, hat = Note(0, Piece.KICK), Note(0, Piece.HIHAT, openness=0.0)
    usual, other = replace(kick, limb=Limb.RIGHT_FOOT), replace(kick, limb=Limb.LEFT_FOOT)
    assert differences(_part(kick), _part(usual), [Feature.FEET]) == []
    assert differences(_part(kick), _part(other), [Feature.FEET]) != []
    assert differences(_part(hat), _part(replace(hat, openness=0.5)), [Feature.OPENNESS]) != []
    unsaid = replace(hat, openness=None)
    assert differences(_part(unsaid), _part(unsaid), [Feature.OPENNESS]) == []


def test_features_of_the_part() -> None:
    before = _part(_STROKE)
    score = before.score
    sevens = MeterChange(0, 7, 8, (2, 2, 3))
    others = {
        Feature.TIMES: replace(before, score=replace(score, end_tick=8 * PPQ)),
        Feature.TEMPO: _part(_STROKE, tempo_map=TempoMap.build([TempoChange(0, 400_000)])),
        Feature.METERS: _part(_STROKE, tempo_map=TempoMap.build([], [MeterChange(0, 3, 4)])),
        Feature.BEAT: replace(before, said_beat_ticks=3 * PPQ // 2),
        Feature.SWING: replace(before, swing=Swing(1.5)),
        Feature.LOUDNESS: replace(before, score=replace(score, loudness=(LoudnessMark(0, "f"),))),
        Feature.TITLE: replace(before, score=replace(score, title="another")),
        Feature.AUTHOR: replace(before, author="somebody"),
        Feature.ABOUT: replace(before, about="something"),
        Feature.SECTIONS: replace(before, sections=(PartSection("verse", 0, 0),)),
    }
    for feature, after in others.items():
        assert [line.partition(":")[0] for line in differences(before, after, [feature])] == [feature.value]
    one, two = (
        _part(_STROKE, tempo_map=TempoMap.build([], [replace(sevens, groups=g)])) for g in ((2, 2, 3), (3, 2, 2))
    )
    assert differences(one, two, [Feature.METERS]) == []
    assert differences(one, two, [Feature.METER_GROUPS]) != []


def test_grace_strokes() -> None:
    flam = _part(*with_graces(replace(_STROKE, ornament=Ornament.FLAM)))
    later = flam.score.notes.copy()
    later["lead_ms"][0] = 25.0
    closer = replace(flam, score=replace(flam.score, notes=later))
    assert differences(flam, closer, [Feature.FLAMS]) == []
    assert differences(flam, closer, [Feature.FLAMS, Feature.GRACE_SPACING]) != []
    assert differences(flam, _part(replace(_STROKE, ornament=Ornament.FLAM)), [Feature.FLAMS]) != []


def test_where_flams_are_not_kept_their_grace_strokes_may_be_strokes() -> None:
    flam = _part(*with_graces(replace(_STROKE, ornament=Ornament.FLAM)))
    assert kept_differences(MIDI, flam) == []


@pytest.mark.parametrize("form", [MIDI, DTX], ids=lambda form: form.name)
def test_bars_of_rest_at_the_end_are_told_where_they_get_lost(form: MusicFormat) -> None:
    part = DrumPart(Score.from_notes([Note(0, Piece.KICK)], TempoMap(), 8 * PPQ, "Two bars, one of them a rest"))
    assert form.write is not None
    assert [loss.feature for loss in form.write(part).lost] == [Feature.TIMES]
    assert kept_differences(form, part) == []
