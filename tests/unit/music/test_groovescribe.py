"""GrooveScribe links both ways; expected values are read off the letters by hand."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.groovescribe.groove_formats import (
    GROOVE_SHORTCUT,
    GROOVE_TEXT,
    GROOVESCRIBE,
    is_groove_url,
    read_url,
)
from station.music.formats.groovescribe.groove_writer import write_groove
from station.music.formats.music_format import Feature
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap

ROCK = "?TimeSig=4/4&Div=8&Tempo=96&Measures=1&H=|xxxxxxxx|&S=|--O---O-|&K=|o---o---|"
EIGHTH = PPQ // 2
SILENT = "S=--------&K=--------"


def strokes(part: DrumPart, piece: Piece) -> list[int]:
    return [note.tick for note in part.score if note.piece is piece and not note.lead_ms]


def written(part: DrumPart) -> str:
    assert GROOVESCRIBE.write is not None
    return GROOVESCRIBE.write(part).data.decode().strip()


def lost(part: DrumPart) -> dict[Feature, str]:
    assert GROOVESCRIBE.write is not None
    return {loss.feature: loss.text for loss in GROOVESCRIBE.write(part).lost}


def snare_part(*notes: Note, meter: MeterChange | None = None, bars: int = 1, swing: Swing | None = None) -> DrumPart:
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 100)], [meter or MeterChange(0, 4, 4)])
    end = tempo_map.bar_start(bars)
    return DrumPart(Score.from_notes(notes, tempo_map, end, "Test"), swing=swing or Swing())


def test_a_link_plays_its_letters() -> None:
    part = read_url("https://www.mikeslessons.com/gscribe" + ROCK)
    assert strokes(part, Piece.HIHAT) == [i * EIGHTH for i in range(8)]
    assert strokes(part, Piece.SNARE) == [2 * EIGHTH, 6 * EIGHTH]
    assert strokes(part, Piece.KICK) == [0, 4 * EIGHTH]
    assert part.score.tempo_map.bpm_at(0) == 96
    assert part.score.end_tick == 4 * PPQ
    assert {note.velocity for note in part.score} == {85, 120}


@pytest.mark.parametrize(
    "link",
    [
        ROCK[1:],
        ROCK.lower().replace("--o---o-", "--O---O-"),
        ROCK.replace("|", "%7C").replace("/", "%2F"),
        ROCK.replace("&", "&amp;"),
        "http://example.org/groove/" + ROCK + "#top",
        ROCK.replace("|xxxxxxxx|", "|:xx(xx)[xx]!xx:|"),
        ROCK.replace("&K=", "&B=").replace("&H=", "&HH="),
        ROCK.replace("|xxxxxxxx|", "x" * 16),  # sixteenths in a groove of eighths: every second one
    ],
)
def test_spelled_otherwise_it_is_the_same(link: str) -> None:
    assert read_url(link).score.notes.tobytes() == read_url(ROCK).score.notes.tobytes()


def test_a_short_line_is_spread() -> None:
    part = read_url(f"?TimeSig=4/4&Div=16&H=x-x-&S={'-' * 16}&K={'-' * 16}")
    assert strokes(part, Piece.HIHAT) == [0, 2 * PPQ]


@pytest.mark.parametrize(
    ("division", "meter", "cell", "bar"),
    [
        (4, "4/4", PPQ, 4 * PPQ),
        (48, "4/4", PPQ // 12, 4 * PPQ),
        (24, "2/4", PPQ // 6, 2 * PPQ),
        (12, "5/4", PPQ // 3, 5 * PPQ),
        (16, "7/8", PPQ // 4, 7 * PPQ // 2),
        (16, "5/16", PPQ // 4, 5 * PPQ // 4),
        (8, "3/2", PPQ // 2, 6 * PPQ),
    ],
)
def test_divisions_and_meters(division: int, meter: str, cell: int, bar: int) -> None:
    beats, unit = (int(word) for word in meter.split("/"))
    count = beats * division // unit
    part = read_url(f"?TimeSig={meter}&Div={division}&Measures=2&H={'x' * 2 * count}&S={'-' * 2 * count}&K=-")
    assert strokes(part, Piece.HIHAT) == [i * cell for i in range(2 * count)]
    assert part.score.end_tick == 2 * bar


def test_in_six_eight_dotted_quarters_are_counted() -> None:
    assert read_url("?TimeSig=6/8&Div=8&H=xxxxxx&S=------&K=o-----").beat_ticks == 3 * PPQ // 2


def test_lines_that_are_missing_are_filled_as_on_the_page() -> None:
    part = read_url("?TimeSig=3/4&Div=8&H=x-x-x-")
    assert strokes(part, Piece.KICK) == [0, 2 * PPQ]
    assert strokes(part, Piece.SNARE) == [PPQ]


def test_a_link_without_any_line_is_the_groove_that_the_page_begins_with() -> None:
    part = read_url("https://www.mikeslessons.com/gscribe?TimeSig=4/4&Div=8")
    assert strokes(part, Piece.HIHAT) == [i * EIGHTH for i in range(8)]
    assert strokes(part, Piece.SNARE) == [PPQ, 3 * PPQ]


def test_swing_is_so_many_percent_longer() -> None:
    part = read_url(ROCK + "&Swing=20")  # 1.2 to 0.8
    assert part.swing == Swing(1.5, EIGHTH)
    assert strokes(part, Piece.HIHAT)[:4] == [0, 3 * PPQ // 5, PPQ, PPQ + 3 * PPQ // 5]
    assert strokes(DrumPart(part.score.as_written), Piece.HIHAT)[:4] == [0, EIGHTH, PPQ, PPQ + EIGHTH]


def test_its_slider_ends_at_half() -> None:
    assert read_url(ROCK + "&Swing=62").swing.ratio == 3


def test_triplets_do_not_swing() -> None:
    assert read_url(f"?Div=12&Swing=30&H={'x' * 12}&S={'-' * 12}&K=-").swing == Swing()


def test_every_snare_letter() -> None:
    part = read_url("?Div=8&H=--------&S=oOgxfdb-&K=--------")
    mains = [note for note in part.score if not note.lead_ms]
    assert [n.dynamic for n in mains[:3]] == [Dynamic.NORMAL, Dynamic.ACCENT, Dynamic.GHOST]
    assert mains[3].articulation is Articulation.CROSS_STICK
    assert [n.ornament for n in mains[4:]] == [Ornament.FLAM, Ornament.DRAG, Ornament.ROLL]
    assert (mains[6].articulation, mains[6].duration_ticks) == (Articulation.BUZZ, PPQ)
    assert [note.ornament for note in part.score if note.lead_ms] == [Ornament.FLAM, Ornament.DRAG, Ornament.DRAG]


def test_every_letter_of_the_cymbals() -> None:
    part = read_url(f"?Div=16&H=xXo+rbcsmnRB----&S={'-' * 16}&K={'-' * 16}")
    assert [(n.piece, n.zone) for n in part.score] == [
        *[(Piece.HIHAT, Zone.BOW)] * 4,
        (Piece.RIDE, Zone.BOW),
        (Piece.RIDE, Zone.BELL),
        (Piece.CRASH_1, Zone.EDGE),
        (Piece.CHINA, Zone.EDGE),
        (Piece.COWBELL, Zone.HEAD),
        (Piece.PERCUSSION, Zone.HEAD),
        (Piece.RIDE, Zone.BOW),
        (Piece.RIDE, Zone.BELL),
    ]
    assert [n.openness for n in part.score][:4] == [0, 0, 1, 0]


def test_the_feet_share_a_line() -> None:
    part = read_url("?Div=4&H=----&S=----&K=oxX-")
    assert strokes(part, Piece.KICK) == [0, 2 * PPQ]
    assert strokes(part, Piece.HIHAT_PEDAL) == [PPQ, 2 * PPQ]


def test_a_sticking_is_of_the_one_hand_that_strikes() -> None:
    part = read_url("?Div=4&H=--xx&S=oooo&K=oo--&Stickings=RlRB")
    hands = [(n.tick // PPQ, n.limb) for n in part.score if n.piece is not Piece.KICK]
    assert hands == [
        (0, Limb.RIGHT_HAND),
        (1, Limb.LEFT_HAND),
        *[(2, Limb.UNKNOWN)] * 2,
        *[(3, Limb.UNKNOWN)] * 2,
    ]


def test_only_two_toms_sound_but_where_others_play_four() -> None:
    query = "?Div=4&H=----&S=----&K=----&T1=o---&T2=-o--&T3=--o-&T4=---x"
    part = read_url(query)
    assert [n.piece for n in part.score] == [Piece.TOM_1, Piece.FLOOR_TOM_1]
    assert any("T2" in line for line in part.lost)
    forked = read_url("https://example.org/fork/" + query)
    assert [n.piece for n in forked.score] == [Piece.TOM_1, Piece.TOM_2, Piece.TOM_3, Piece.FLOOR_TOM_1]


def test_what_it_says_of_itself() -> None:
    part = read_url(ROCK + "&Title=One%20%2B+two&Author=A.%20Drummer&Comments=slow%20%26%20loud")
    assert (part.score.title, part.author, part.about) == ("One + two", "A. Drummer", "slow & loud")


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ("&Tempo=900", "Tempo='900' is not from 20 to 400; read as 80"),
        ("&Measures=12", "Measures='12' is not from 1 to 10; read as 10"),
        ("&TimeSig=4/5", "TimeSig='4/5' is no meter of GrooveScribe; read as 4/4"),
    ],
)
def test_what_it_reads_otherwise_is_told(more: str, told: str) -> None:
    assert read_url("?Div=8&H=xxxxxxxx&S=--------&K=-" + more).lost[:1] == (told,)


def test_letters_that_it_does_not_know_are_rests() -> None:
    part = read_url("?Div=8&H=xxqxxxxx&" + SILENT)
    assert len(part.score) == 7
    assert part.lost == ("H, bar 1, cell 3: read as rests, for GrooveScribe knows no 'q' there",)


@pytest.mark.parametrize(
    ("link", "place"),
    [
        ("?Div=0&H=x&S=-&K=-", "Div"),
        ("?Div=x&H=x&S=-&K=-", "Div"),
        ("?Div=4&TimeSig=7/8&H=x&S=-&K=-", "Div"),
        ("?Div=9&H=x&S=-&K=-", "Div"),
    ],
)
def test_a_link_that_is_no_groove_is_refused(link: str, place: str) -> None:
    with pytest.raises(BadInput) as fault:
        read_url(link)
    assert fault.value.place == place


@pytest.mark.parametrize("text", ["", "lessons/rock.toml", "song.mid", "H=x", "https://example.org/?q=1", "a\nH=x&S=o"])
def test_other_names_are_no_links(text: str) -> None:
    assert not is_groove_url(text)


def test_a_link_is_found_in_a_file() -> None:
    shortcut = f"[InternetShortcut]\r\nURL=https://www.mikeslessons.com/gscribe{ROCK}\r\n".encode()
    assert GROOVE_SHORTCUT.recognises(shortcut)
    assert len(GROOVE_SHORTCUT.read(shortcut, "rock.url").score) == 12
    assert GROOVE_TEXT.recognises(f"try this:\nhttps://www.mikeslessons.com/gscribe{ROCK}".encode())
    assert not GROOVE_TEXT.recognises(b"# drum station text score 1\n")


def test_a_shortcut_is_an_ini_file_that_a_browser_opens() -> None:
    assert GROOVE_SHORTCUT.write
    part = read_url(f"https://www.mikeslessons.com/gscribe{ROCK}")
    head, address, end = GROOVE_SHORTCUT.write(part).data.decode().split("\r\n")
    assert (head, end) == ("[InternetShortcut]", "")
    assert read_url(address.removeprefix("URL=")).score.notes.tobytes() == part.score.notes.tobytes()


# --- writing ----------------------------------------------------------------------------------------------------------


def test_what_is_written_opens_in_the_browser_and_says_the_same() -> None:
    part = read_url(ROCK)
    link = written(part)
    assert link == (
        "https://www.mikeslessons.com/gscribe?TimeSig=4/4&Div=8&Tempo=96&Measures=1"
        "&H=|xxxxxxxx|&S=|--O---O-|&K=|o---o---|"
    )
    assert lost(part) == {}


def test_the_division_is_the_least_that_has_all_strokes() -> None:
    part = snare_part(Note(0, Piece.SNARE), Note(PPQ // 4, Piece.SNARE), Note(PPQ // 3, Piece.SNARE))
    assert "Div=48" in written(part)


def test_fives_have_no_division() -> None:
    part = snare_part(Note(4 * PPQ + PPQ // 5, Piece.SNARE), bars=2)
    with pytest.raises(BadInput, match="bar 2") as fault:
        written(part)
    assert fault.value.source == "Test"


def test_two_meters_and_eleven_bars_have_no_place() -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(4 * PPQ, 3, 4)])
    with pytest.raises(BadInput, match="bar 2: a groove has one meter"):
        written(DrumPart(Score.from_notes([Note(0, Piece.SNARE)], tempo_map, 7 * PPQ)))
    with pytest.raises(BadInput, match="1 to 10 bars; this part has 11"):
        written(snare_part(Note(0, Piece.SNARE), bars=11))


def test_swing_is_written_straight_with_its_percent() -> None:
    part = read_url(ROCK + "&Swing=20")
    assert "&Swing=20&" in written(part)
    assert "H=|xxxxxxxx|" in written(part)


def test_swing_that_has_no_percent_is_told() -> None:
    swing = Swing(1.3, EIGHTH)  # 13.04 %
    late = swing.swung(EIGHTH, MeterChange(0, 4, 4)) - EIGHTH
    part = snare_part(Note(EIGHTH + late, Piece.SNARE, swing_ticks=late), swing=swing)
    assert "&Swing=13&" in written(part)
    assert set(lost(part)) == {Feature.SWING, Feature.TIMES}


@pytest.mark.parametrize(
    ("note", "letters", "feature"),
    [
        (Note(0, Piece.SNARE, Zone.RIM, articulation=Articulation.RIM_SHOT), "S=|o---|", Feature.RIM_SHOTS),
        (Note(0, Piece.HIHAT, Zone.BOW, openness=0.5), "H=|o---|", Feature.OPENNESS),
        (Note(0, Piece.HIHAT, Zone.EDGE, openness=0.0), "H=|x---|", Feature.ZONES),
        (Note(0, Piece.TOM_2), "T1=|o---|", Feature.PIECES),
        (Note(0, Piece.KICK, dynamic=Dynamic.ACCENT), "K=|o---|", Feature.DYNAMICS),
        (Note(0, Piece.CRASH_1, Zone.EDGE, choke_ticks=PPQ), "H=|c---|", Feature.CHOKES),
        (Note(0, Piece.TOM_1, ornament=Ornament.DRAG), "T1=|o---|", Feature.DRAGS),
    ],
)
def test_what_has_no_letter_is_told_with_its_bar(note: Note, letters: str, feature: Feature) -> None:
    part = snare_part(note)
    assert f"{letters}" in written(part)
    assert lost(part)[feature].startswith("bar 1: ")


def test_an_accented_flam_stays_a_flam() -> None:
    part = snare_part(Note(0, Piece.SNARE, dynamic=Dynamic.ACCENT, ornament=Ornament.FLAM))
    assert "S=|f---|" in written(part)
    assert set(lost(part)) == {Feature.DYNAMICS}


def test_of_two_cymbals_at_once_one_is_told_as_left_out() -> None:
    part = snare_part(Note(0, Piece.HIHAT, Zone.BOW, openness=0.0), Note(0, Piece.CRASH_1, Zone.EDGE))
    assert "H=|c---|" in written(part)
    assert set(lost(part)) == {Feature.PIECES, Feature.TIMES}


def test_a_swing_that_is_rounded_is_told_apart_from_what_it_was() -> None:
    """GrooveScribe has whole percent: 23 % is 1.23 / 0.77."""
    told = [loss.text for loss in write_groove(part_of(find_lesson("hip-hop-2"))).lost]
    assert "swing of 1.6:1 becomes 1.597:1" in told
