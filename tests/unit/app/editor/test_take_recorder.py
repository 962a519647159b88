"""A groove played on a kit over the click, pass by pass, against the text that clicks give; two bars at 120, four
seconds a pass, after a bar of count-in.
"""

from station.app.editor.read_draft import loop_of, read_draft
from station.app.editor.take_recorder import TakeRecorder, TakeSetting
from station.core.events import Hit
from station.core.pieces import CLOSED, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.drills.editing.edit_lesson import edited
from station.drills.editing.grid_cursor import BarRange, Cursor, Place
from station.drills.editing.lesson_edits import LineAt, PlayIn, Quantise, SetStroke
from station.drills.editing.page_reader import page_of
from station.drills.editing.take_options import TakeOptions
from station.drills.reading.lesson_file import parse_lesson
from station.engine.messages import Bus, Command, Play, Resume, Started, Stop

EMPTY = 'title = "T"\ntempo_bpm = 120\n\n[grid]\nhihat = "| xxxxxxxx | xxxxxxxx |"\nsnare = "| ---- | ---- |"\n'
COUNT_MS, BEAT_MS, PASS_MS = 2000, 500, 4000
SNARE, KICK = (LineAt(0, piece) for piece in (Piece.SNARE, Piece.KICK))


def _recorder(text: str, options: TakeOptions) -> tuple[TakeRecorder, list[Command]]:
    sent: list[Command] = []
    lesson = parse_lesson(text, "t.toml", "t").lesson
    assert lesson is not None
    setting = TakeSetting(page_of(text).grids[0], BarRange(0, 0, 1), lesson.score, options=options)
    recorder = TakeRecorder(setting, sent.append)
    recorder.handle(Started(0))
    return recorder, sent


def _hit(piece: Piece, ms: float, velocity: int = 80) -> Hit:
    zone = Zone.BOW if piece is Piece.HIHAT else Zone.HEAD
    openness = CLOSED if piece is Piece.HIHAT else None
    return Hit(round((COUNT_MS + ms) * NS_PER_MS), piece, zone, velocity, openness=openness)


def _at(recorder: TakeRecorder, ms: float) -> list[PlayIn]:
    return recorder.advance(round((COUNT_MS + ms) * NS_PER_MS))


def test_what_a_kit_plays_is_the_text_that_clicks_give() -> None:
    recorder, sent = _recorder(EMPTY, TakeOptions(over=True))
    assert isinstance(sent[0], Play)
    clicked, beats = EMPTY, [(KICK, 0), (SNARE, 1), (KICK, 2), (SNARE, 3), (KICK, 4), (SNARE, 5), (SNARE, 7)]
    for (line, beat), off_ms in zip(beats, (-20, 15, 30, -8, -35, 3, 12), strict=True):
        recorder.handle(_hit(line.piece, beat * BEAT_MS + off_ms))
        clicked = edited(clicked, SetStroke(line, beat // 4, beat % 4 * PPQ, "o"))
    assert _at(recorder, PASS_MS) == []
    (edit,) = _at(recorder, PASS_MS + 200)
    assert edited(EMPTY, edit) == clicked
    assert recorder.stop() == []
    assert isinstance(sent[-1], Stop)


def test_each_whole_pass_takes_the_place_of_the_last_and_one_that_is_cut_off_does_not() -> None:
    recorder, _ = _recorder(EMPTY, TakeOptions(Quantise(4), over=False))
    text = EMPTY
    for beat in (1, 3, 5, 7):
        recorder.handle(_hit(Piece.SNARE, beat * BEAT_MS))
    for edit in _at(recorder, PASS_MS + 200):
        text = edited(text, edit)
    assert 'hihat = "| -- -- -- -- | -- -- -- -- |"' in text  # which was not played, and is gone
    recorder.handle(_hit(Piece.SNARE, PASS_MS + 2 * BEAT_MS))
    _at(recorder, PASS_MS + 3 * BEAT_MS)
    for edit in recorder.stop():
        text = edited(text, edit)
    lesson = parse_lesson(text, "t.toml", "t").lesson
    assert lesson is not None
    assert [note.tick / PPQ for note in lesson.score] == [1, 2, 3, 5, 7]


def test_where_it_is_and_what_was_struck_in_this_pass() -> None:
    recorder, _ = _recorder(EMPTY, TakeOptions())
    _at(recorder, -500)
    assert (recorder.view().pass_index, recorder.view().place) == (-1, None)
    _at(recorder, 5 * BEAT_MS)
    recorder.handle(_hit(Piece.SNARE, 5 * BEAT_MS))
    view = recorder.view()
    assert view.place is not None
    assert (view.pass_index, view.place.bar, view.place.tick) == (0, 1, PPQ)
    (stroke,) = view.strokes
    assert (stroke.at, stroke.letter) == (Cursor(0, 1, PPQ, SNARE), "o")
    recorder.handle(_hit(Piece.KICK, 6 * BEAT_MS + 50))
    at = recorder.view().strokes[1].at  # 50 ms after the third beat, a tenth of one; its line is still to be made
    assert (at.bar, at.tick, at.line) == (1, 2 * PPQ + PPQ // 10, KICK)
    _at(recorder, PASS_MS + 10)
    assert (recorder.view().pass_index, recorder.view().strokes) == (1, ())
    recorder.handle(_hit(Piece.SNARE, 2 * PASS_MS - 20))
    _at(recorder, 2 * PASS_MS + 10)
    (early,) = recorder.view().strokes  # for the first beat
    assert early.at.place == Place(0, 0, 0)


def test_a_pass_that_was_written_is_heard_in_the_next_one() -> None:
    recorder, sent = _recorder(EMPTY, TakeOptions(guide=True))
    recorder.handle(_hit(Piece.SNARE, BEAT_MS))
    (edit,) = _at(recorder, PASS_MS + 200)
    recorder.hear(loop_of(read_draft(edited(EMPTY, edit), "t"), recorder.bars))
    resume = sent[-1]
    assert isinstance(resume, Resume)
    snare = resume.cues[(resume.cues["piece"] == Piece.SNARE) & (resume.cues["bus"] == Bus.DEMONSTRATION)]
    heard = (snare["at_ns"] - (COUNT_MS + PASS_MS + BEAT_MS) * NS_PER_MS) / NS_PER_MS
    assert min(abs(heard)) == 0
