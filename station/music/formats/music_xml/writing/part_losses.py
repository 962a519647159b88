"""What a part has and MusicXML cannot say of it, each with the bar of its first case."""

from collections.abc import Callable, Iterator, Sequence
from functools import cache

from station.core.pieces import CHOKEABLE, Articulation, Limb, Ornament, Piece, Zone
from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, Loss
from station.music.formats.music_xml.reading.direction_reading import VELOCITY_OF_MARK
from station.music.formats.music_xml.writing.direction_writing import has_beat
from station.music.formats.music_xml.writing.element_writing import strike_of_note, xml_text
from station.music.formats.music_xml.writing.stroke_cells import DOUBLES, StrokeCell, is_roll, second_strokes
from station.music.formats.music_xml.writing.swung_bars import WrittenVoices, can_be_said
from station.music.formats.music_xml.xml_instruments import XmlInstrument, instrument_of, nearest_openness
from station.music.grace_strokes import OTHER_HAND, Graces
from station.music.loudness_marks import FADE, GROW
from station.music.score import Note
from station.music.swing import STRAIGHT

_USUAL = Graces()
_MOVED_WITH_TIMES = (Feature.TIMES, Feature.SWING, Feature.DIDDLES, Feature.BUZZES, Feature.CHOKES)
_CLOSE_MS = 0.01
LONGEST_TITLE, LONGEST_ABOUT, LONGEST_NAME = 500, 5000, 100
"""Characters that are read of a title, of what a part says of itself, and of a section's name (our choice)."""


def losses_of(part: DrumPart, written: WrittenVoices) -> tuple[Loss, ...]:
    """All that is lost, a feature at most once for each reason."""
    found = [*_of_words(part), *_of_bars(part, written)]
    notes = list(part.score)
    for feature, text, is_lost in _OF_NOTES:
        ticks = [note.tick for note in notes if is_lost(note)]
        if ticks:
            found.append(_at(part, feature, min(ticks), text))
    for cells in written.heads:
        found += _of_cells(part, cells)
    found += _of_seconds(part, [cell for cells in written.heads for cell in cells])
    spread = [cell for voice in written.voices for bar in voice for cell in bar.spread]
    if spread:
        text = "a diddle that no slash through one note says is two strokes"
        found.append(_at(part, Feature.DIDDLES, min(cell.start for cell in spread), text))
    return tuple(found)


def _at(part: DrumPart, feature: Feature, tick: int, text: str) -> Loss:
    return Loss(feature, f"bar {int(part.score.tempo_map.bars_at(max(tick, 0))) + 1}: {text}")


# --- the part ---------------------------------------------------------------------------------------------------------


def _of_words(part: DrumPart) -> Iterator[Loss]:
    for feature, text, most in (
        (Feature.TITLE, part.score.title, LONGEST_TITLE),
        (Feature.AUTHOR, part.author, LONGEST_TITLE),
        (Feature.ABOUT, part.about, LONGEST_ABOUT),
    ):
        if len(" ".join(text.split())) > most or xml_text(text) != text:
            yield Loss(feature, f"the {feature.value} has characters that XML has not, or more than {most:,}")
    names = [section.name for section in part.sections]
    if any(not name.strip() or len(name) > LONGEST_NAME or " ".join(xml_text(name).split()) != name for name in names):
        yield Loss(Feature.SECTIONS, f"a name of a section that is empty, longer than {LONGEST_NAME} or no plain text")
    if not has_beat(part.beat_ticks):
        yield Loss(Feature.BEAT, "the counted beat is no plain or dotted note value")
    if part.swing.ratio != STRAIGHT and not can_be_said(part.swing):
        yield Loss(Feature.SWING, "MusicXML swings eighths and sixteenths only; it is written as it is played")
    if any(mark.sign not in (*VELOCITY_OF_MARK, GROW, FADE) for mark in part.score.loudness):
        yield Loss(Feature.LOUDNESS, "a mark beyond ppp to fff")


def _of_bars(part: DrumPart, written: WrittenVoices) -> Iterator[Loss]:
    for frame in written.frames:
        if frame.length != frame.meter.bar_ticks:
            yield _at(part, Feature.METERS, frame.start, "a bar cut short is read in a meter of its own length")
            yield _at(part, Feature.METER_GROUPS, frame.start, "a bar cut short is read in a meter of its own length")
            break
    for frame, *bars in zip(written.frames, *written.voices, strict=True):
        if not all(bar.is_exact for bar in bars):
            for feature in _MOVED_WITH_TIMES:
                yield _at(part, feature, frame.start, "strokes that no note value writes are moved to sixty-fourths")
            break
    straight = {frame.start for frame, is_swung in zip(written.frames, written.swings, strict=True) if not is_swung}
    tempo_map = part.score.tempo_map
    for note in part.score:
        if note.swing_ticks and tempo_map.bar_start(int(tempo_map.bars_at(note.tick))) in straight:
            yield _at(
                part, Feature.SWING, note.tick, "swung and straight notes side by side, written as they are played"
            )
            break


# --- strokes ----------------------------------------------------------------------------------------------------------


def _read_back(note: Note) -> tuple[Zone, Articulation] | None:
    """Zone and articulation as a reader finds them by the instrument that the note is written with."""
    return _of_instrument(instrument_of(strike_of_note(note)))


@cache
def _of_instrument(instrument: XmlInstrument) -> tuple[Zone, Articulation] | None:
    strike = instrument.meaning()
    return None if strike is None else (strike.zone, strike.articulation)


def _loses_zone(note: Note) -> bool:
    found = _read_back(note)
    return found is None or found[0] is not note.zone


def _loses(articulation: Articulation) -> Callable[[Note], bool]:
    def is_lost(note: Note) -> bool:
        found = _read_back(note)
        return note.articulation is articulation and (found is None or found[1] is not articulation)

    return is_lost


def _loses_openness(note: Note) -> bool:
    is_hat = note.piece is Piece.HIHAT
    return is_hat and (note.openness is None or nearest_openness(note.openness) != note.openness)


def _loses_splash(note: Note) -> bool:
    return note.articulation is Articulation.SPLASH and note.piece is not Piece.HIHAT_PEDAL


def _loses_hand(note: Note) -> bool:
    return note.piece not in _PEDALS and note.limb is not Limb.UNKNOWN and not note.limb.is_hand


def _loses_foot(note: Note) -> bool:
    return note.piece in _PEDALS and note.limb.is_hand


def _loses_lead(note: Note) -> bool:
    leads = _USUAL.leads_ms(note.ornament)
    return note.lead_ms > 0 and not any(abs(lead - note.lead_ms) < _CLOSE_MS for lead in leads)


_PEDALS = (Piece.KICK, Piece.HIHAT_PEDAL)
_OF_NOTES: tuple[tuple[Feature, str, Callable[[Note], bool]], ...] = (
    (Feature.ZONES, "a zone that no instrument is named for", _loses_zone),
    (Feature.CROSS_STICKS, "a cross-stick on what is no snare", _loses(Articulation.CROSS_STICK)),
    (Feature.RIM_SHOTS, "a rim shot on what is no drum", _loses(Articulation.RIM_SHOT)),
    (Feature.OPENNESS, "a hi-hat neither closed, half open nor open", _loses_openness),
    (Feature.FOOT_SPLASHES, "a splash of what is no hi-hat foot", _loses_splash),
    (Feature.STICKING, "a foot that plays what hands play", _loses_hand),
    (Feature.FEET, "a hand that plays a pedal", _loses_foot),
    (
        Feature.CHOKES,
        "a choke of what does not ring",
        lambda note: note.choke_ticks > 0 and note.piece not in CHOKEABLE,
    ),
    (Feature.GRACE_SPACING, "grace strokes farther apart or closer than usual", _loses_lead),
)


def _of_cells(part: DrumPart, cells: Sequence[StrokeCell]) -> Iterator[Loss]:
    rolls = is_roll(cells)
    checks: tuple[tuple[Feature, str, Callable[[int, StrokeCell], bool]], ...] = (
        (Feature.DIDDLES, "a stroke of a roll that is no pair with its neighbour",
         lambda i, c: c.note.ornament in DOUBLES and c.second is None and c.note.articulation is not Articulation.BUZZ),
        (Feature.DIDDLES, "a diddle that touches others, or a roll that touches none",
         lambda i, c: c.second is not None and rolls[i] != (c.note.ornament is Ornament.ROLL)),
        (Feature.FLAMS, "a flam without its one grace stroke", lambda i, c: _wants_graces(c, Ornament.FLAM, 1)),
        (Feature.DRAGS, "a drag without its two grace strokes", lambda i, c: _wants_graces(c, Ornament.DRAG, 2)),
        (Feature.BUZZES, "a buzz roll that has no length, or is cut by the next stroke",
         lambda i, c: c.note.articulation is Articulation.BUZZ and c.end != c.start + c.note.duration_ticks),
        (Feature.CHOKES, "a choke after the next stroke of its cymbal",
         lambda i, c: bool(c.note.choke_ticks) and c.end != c.start + c.note.choke_ticks),
        (Feature.STICKING, "a grace stroke without a hand before a stroke that has one",
         lambda i, c: any(g.limb is Limb.UNKNOWN and c.note.limb in OTHER_HAND for g in c.graces)),
    )  # fmt: skip
    for feature, text, is_lost in checks:
        lost = next((cell for i, cell in enumerate(cells) if is_lost(i, cell)), None)
        if lost is not None:
            yield _at(part, feature, lost.start, text)


def _of_seconds(part: DrumPart, cells: Sequence[StrokeCell]) -> Iterator[Loss]:
    seconds = second_strokes(cells)
    for cell in cells:
        first, second = cell.note, cell.second
        if second and second.velocity != seconds.velocity(first.piece, first.dynamic, first.velocity):
            yield _at(
                part, Feature.VELOCITIES, cell.start, "the second stroke of a diddle is louder or softer than usual"
            )
            return


def _wants_graces(cell: StrokeCell, ornament: Ornament, count: int) -> bool:
    return cell.note.ornament is ornament and len(cell.graces) != count
