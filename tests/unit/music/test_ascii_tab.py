"""Drum tablature as people type it, and the station's own both ways; expected strokes are counted by hand."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Ornament, Piece, Zone
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.ascii_tab.tab_reader import read_tab
from station.music.formats.ascii_tab.tab_text import is_tab
from station.music.formats.ascii_tab.tab_writer import write_tab
from station.music.formats.music_format import Feature
from station.music.swing import Swing
from tests.shipped_lesson import shipped_lessons

EIGHTH, SIXTEENTH = PPQ // 2, PPQ // 4

SONG = """
Song: A Tune
Artist: Some Band
Tempo: 96

[Intro] x2
    1 + 2 + 3 + 4 +
HH|x-x-x-o-x-x-x-X-|
SD|----O--g----f---|
BD|o-----o-o-------|

Verse:
CC|x---------------|----------------|
Hh|--x-x-x-x-x-x-x-|x-x-x-x-x-x-x-x-| x4
S |----o-------o---|----o-------o---|
B |o-------o-------|o-------o-------|
"""


def read(text: str) -> DrumPart:
    return read_tab(text.encode(), "song.tab")


def ticks(part: DrumPart, piece: Piece) -> list[int]:
    return [n.tick for n in part.score if n.piece is piece and not n.lead_ms]


def test_a_song_with_sections_that_repeat() -> None:
    part = read(SONG)
    assert (part.score.title, part.author) == ("A Tune", "Some Band")
    assert [(s.name, s.first_bar, s.last_bar) for s in part.sections] == [("Intro", 0, 1), ("Verse", 2, 9)]
    assert part.score.bar_count == 2 + 4 * 2
    assert ticks(part, Piece.CRASH_1) == [bar * 4 * PPQ for bar in (2, 4, 6, 8)]
    assert ticks(part, Piece.KICK)[:3] == [0, 6 * SIXTEENTH, 8 * SIXTEENTH]
    assert round(60e6 / part.score.tempo_map.tempos[0].us_per_quarter) == 96


def test_letters_say_how_a_drum_is_struck() -> None:
    bar = [n for n in read(SONG).score if n.tick < 4 * PPQ]
    snares = [(n.tick, n.dynamic, n.ornament) for n in bar if n.piece is Piece.SNARE and not n.lead_ms]
    assert snares == [
        (4 * SIXTEENTH, Dynamic.ACCENT, Ornament.NONE),
        (7 * SIXTEENTH, Dynamic.GHOST, Ornament.NONE),
        (12 * SIXTEENTH, Dynamic.NORMAL, Ornament.FLAM),
    ]
    hats = {n.tick: (n.openness, n.dynamic) for n in bar if n.piece is Piece.HIHAT}
    assert hats[6 * SIXTEENTH] == (1.0, Dynamic.NORMAL)
    assert hats[14 * SIXTEENTH] == (0.0, Dynamic.ACCENT)
    assert sum(n.lead_ms > 0 for n in bar) == 1


def test_a_key_may_say_that_x_is_a_loose_hat() -> None:
    part = read("X - loose hi-hat\nHH|X-x-X-x-|\nBD|o---o---|")
    assert [n.openness for n in part.score if n.piece is Piece.HIHAT] == [0.5, 0.0, 0.5, 0.0]


@pytest.mark.parametrize(
    ("cells", "words", "meter"),
    [
        ("o---" * 4, "", "4/4"),
        ("o-" * 4, "", "4/4"),
        ("o-----", "", "6/8"),
        ("o-o-o-o-o-o-o-", "", "7/8"),
        ("o-o-o-o-o-o-", "", "3/4"),
        ("o-o-o-o-o-o-", "   1 . . 2 . . 3 . . 4 . .", "4/4"),
        ("o-o-o-o-o-", "Time: 5/4", "5/4"),
        ("o---" * 5, "", "5/4"),
    ],
)
def test_the_meter_is_stated_counted_or_usual(cells: str, words: str, meter: str) -> None:
    part = read(f"{words}\nHH|{cells}|\nBD|{'-' * len(cells)}|")
    assert [str(m) for m in part.score.tempo_map.meters] == [meter]


def test_twelve_cells_with_a_backbeat_are_triplets() -> None:
    part = read("HH|x-xx-xx-xx-x|\nSD|---o-----o--|\nBD|o-----o-----|")
    assert [str(m) for m in part.score.tempo_map.meters] == ["4/4"]
    assert ticks(part, Piece.SNARE) == [PPQ, 3 * PPQ]


def test_other_cymbals_and_bells_and_chokes() -> None:
    part = read("CC|x-#-s-c-|\nRd|b-x---x-|\nSD|@-r-b---|")
    struck = [(n.tick, n.piece, n.zone) for n in part.score]
    assert (0, Piece.RIDE, Zone.BELL) in struck
    assert (4 * EIGHTH, Piece.SPLASH, Zone.EDGE) in struck
    assert (6 * EIGHTH, Piece.CHINA, Zone.EDGE) in struck
    assert [n.choke_ticks for n in part.score if n.piece is Piece.CRASH_1] == [2 * EIGHTH]
    articulations = [n.articulation for n in part.score if n.piece is Piece.SNARE]
    assert articulations == [Articulation.CROSS_STICK, Articulation.RIM_SHOT, Articulation.BUZZ]


def test_repeat_signs_in_the_lines() -> None:
    part = read("HH|x---x---|:x-x-x-x-:|x-------|\nBD|o-------|:o-------:|--------|")
    assert part.score.bar_count == 4
    assert ticks(part, Piece.KICK) == [0, 4 * PPQ, 8 * PPQ]


def test_a_line_of_other_length_is_filled_and_told() -> None:
    part = read("HH|x-x-x-x-|\nSD|--o---o-|\nBD|o---o--|")
    assert ticks(part, Piece.KICK) == [0, 2 * PPQ]
    assert any("line 3" in line for line in part.lost)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("just words\n", "song.tab: no line of tablature"),
        ("HH|x-x-q-x-x-x-|\nBD|o-----------|", "song.tab: line 1, column 8: 'q'"),
        ("HH|x-x-x-x-|\nQQ|x-x-x-x-|", "song.tab: line 2: no drum is called 'QQ'"),
        (f"HH|{'x' * 500}|\nBD|{'o' * 500}|", "song.tab: line 1: a bar of 500 cells"),
    ],
)
def test_faults_name_the_file_and_the_place(text: str, words: str) -> None:
    with pytest.raises(BadInput) as fault:
        read(text)
    assert str(fault.value).startswith(words)


def test_words_are_no_tablature() -> None:
    assert is_tab(SONG.encode())
    assert not is_tab(b"# drum station text score 1\n1:1 hihat bow right_hand 80\n")
    assert not is_tab(b"S: one\nB: two\n")


def test_what_comes_back_of_every_lesson_is_what_is_kept() -> None:
    columns = ["tick", "piece", "dynamic", "articulation"]
    for lesson in shipped_lessons():
        part = part_of(lesson)
        written = write_tab(part)
        back, lost = read_tab(written.data, lesson.name), {loss.feature for loss in written.lost}
        before, after = (s.notes[s.notes["lead_ms"] == 0] for s in (part.score, back.score))
        if not lost & {Feature.TIMES, Feature.DYNAMICS}:
            assert before[columns].tolist() == after[columns].tolist(), lesson.name
        if Feature.SWING not in lost:
            assert part.swing == back.swing, lesson.name
            assert (part.score.notes["tick"] == back.score.notes["tick"]).all() or lost & {Feature.TIMES}, lesson.name
        if Feature.TEMPO not in lost:
            assert part.score.tempo_map.tempos == back.score.tempo_map.tempos, lesson.name
        if Feature.SECTIONS not in lost:
            assert part.sections == back.sections, lesson.name
        assert (part.author, part.about, part.score.title) == (back.author, back.about, back.score.title)


def test_swing_that_begins_later_is_told_too() -> None:
    """Its first part is straight, and so is the swing that the whole part has."""
    told = {loss.feature: loss.text for loss in write_tab(part_of(find_lesson("latin-jazz-1"))).lost}
    assert told == dict.fromkeys((Feature.TIMES, Feature.SWING), "swing is written straight")


@pytest.mark.parametrize(
    ("name", "line"), [("jazz-ride-1", "Swing 2:1 of eighths"), ("hip-hop-2", "Swing 1.6:1 of sixteenths")]
)
def test_swing_is_written_in_words(name: str, line: str) -> None:
    part = part_of(find_lesson(name))
    written = write_tab(part)
    assert line in written.data.decode().splitlines()
    assert not {loss.feature for loss in written.lost} & {Feature.TIMES, Feature.SWING}
    back = read_tab(written.data, "a.tab")
    assert back.swing == part.swing
    assert sorted(back.score.notes["tick"]) == sorted(part.score.notes["tick"])


def test_bars_of_no_section_are_told_by_their_numbers() -> None:
    told = [loss.text for loss in write_tab(part_of(find_lesson("funk-fill-1"))).lost]
    assert "bar 5 belongs to no section; in the file it stands in 'fill'" in told


def test_no_line_is_wider_than_a_mail() -> None:
    parts = (part_of(lesson) for lesson in shipped_lessons())
    wide = [row for part in parts for row in write_tab(part).data.decode().splitlines() if len(row) > 100]
    assert not [row for row in wide if "|" in row]


HAT_ON_EIGHTHS = [k * EIGHTH for k in range(8)]


@pytest.mark.parametrize(
    "text",
    [
        "HH|x-x-x-x-x-x-x-x-|\nSD|----o-------o---|\n",
        "HH|x-x- x-x- x-x- x-x-|\nSD|---- o--- ---- o---|\n",
        "HH|x x x x x x x x|\nSD|    o       o  |\n",
        "Hi-hat  x-x-x-x-x-x-x-x-\nSnare   ----o-------o---\n",
        "|-x-x-x-x-x-x-x-x-| HH\n|-----o-------o---| SD\n",
        "    1   2   3   4\nHH||x-x-|x-x-|x-x-|x-x-||\nSD||----|o---|----|o---||\n",
        "HH|x-x-|x-x-|x-x-|x-x-|\nSD|----|o---|----|o---|\n",
        "HH-x-x-x-x-x-x-x-x-|\nSD-----o-------o---|\n",
        "HH x-x-x-x-x-x-x-x-|\nSD ----o-------o---|\n",
        "HH: x-x-x-x-x-x-x-x-\nSD: ----o-------o---\n",
        "   1e+a2e+a3e+a4e+a\nHH|x-x-x-x-x-x-x-x|\nSD|----o-------o--|\n",
        "4/4\nHH|x-x-x-x-x-x-x-x--|\nSD|----o-------o----|\n",
        "HH|-xxxxxxxx|\nSD|---o---o-|\n",
        "HHc |x-x-x-x-x-x-x-x-|\nSn  |----o-------o---|\n",
    ],
    ids=[
        "dashes",
        "groups",
        "blanks",
        "no bar lines",
        "label behind",
        "beats counted",
        "beats",
        "dash for a bar line",
        "no first bar line",
        "colons",
        "a cell short",
        "a cell long",
        "dash before eighths",
        "closed hats",
    ],
)
def test_one_bar_as_fourteen_people_type_it(text: str) -> None:
    assert is_tab(text.encode())
    part = read(text)
    assert (part.score.bar_count, str(part.score.tempo_map.meter_at(0))) == (1, "4/4")
    assert ticks(part, Piece.HIHAT) == HAT_ON_EIGHTHS
    assert ticks(part, Piece.SNARE) == [PPQ, 3 * PPQ]


def test_a_bar_of_blanks_alone_is_a_bar() -> None:
    part = read("HH|x x x x |x x x x |\nBD|        |o   o   |\n")
    assert part.score.bar_count == 2
    assert ticks(part, Piece.KICK) == [4 * PPQ, 6 * PPQ]


def test_quarters_that_are_counted_within_a_group_stay_quarters() -> None:
    part = read("   1234 1234 1234 1234\nHH|x-x-|x-x-|x-x-|x-x-|\nBD|o---|o---|o---|o---|\n")
    assert part.score.bar_count == 4
    assert ticks(part, Piece.KICK) == [bar * 4 * PPQ for bar in range(4)]


@pytest.mark.parametrize(
    ("head", "title", "section"),
    [
        ("Some Tune - Some Band\nTempo: 117\n\n", "Some Tune - Some Band", ""),
        ("Some Tune\nby Somebody\n\nChorus (x2)\n", "Some Tune", "Chorus"),
        ("Intro x4\n", "", "Intro"),
        ("Verse 2\n\n", "", "Verse 2"),
        ("[Verse 1] 12/8 slow blues 60 bpm\n", "", "Verse 1"),
        ("Key:\nf - flam\n", "", ""),
        ("Chorus (2)\n", "", "Chorus"),
    ],
)
def test_what_stands_above_is_the_title_or_the_name_of_a_part(head: str, title: str, section: str) -> None:
    part = read(f"{head}HH|x-x-x-x-x-x-|\nSD|---o-----o--|\n")
    assert (part.score.title, part.sections[0].name if part.sections else "") == (title, section)


def test_a_tempo_above_twelve_eighths_counts_dotted_quarters() -> None:
    part = read("12/8, 60 bpm\nHH|x-x-x-x-x-x-|\nBD|o-----o-----|\n")
    assert part.score.tempo_map.tempos[0].us_per_quarter == round(60e6 / 90)


@pytest.mark.parametrize("words", ["(repeat 3x)", "Play 3 times", "x3", "3 times"])
def test_a_line_that_says_how_often_may_stand_below(words: str) -> None:
    assert read(f"HH|x-x-x-x-x-x-x-x-|\nBD|o-------o-------|\n{words}\n").score.bar_count == 3


@pytest.mark.parametrize(
    ("words", "bars"), [("(Repeat 2x)", 2), ("(play 4 times):", 4), ("- x3", 3), ("twice", 2), ("x 3:", 3)]
)
def test_a_name_of_a_part_may_say_how_often(words: str, bars: int) -> None:
    part = read(f"Verse {words}\nHH|x-x-x-x-x-x-x-x-|\nBD|o-------o-------|\n")
    assert (part.score.bar_count, [s.name for s in part.sections]) == (bars, ["Verse"])


def test_dashes_for_bar_lines_may_stand_in_every_bar() -> None:
    part = read("HH-x-x-x-x-|-x-x-x-x-|\nBD-o---o---|-o---o---|\n")
    assert part.score.bar_count == 2
    assert ticks(part, Piece.KICK) == [0, 2 * PPQ, 4 * PPQ, 6 * PPQ]


def test_a_key_with_names_between_bar_lines_is_no_music() -> None:
    """As the article on drum tablature of Wikipedia shows the labels."""
    key = "HH|-Hi-hat----------|\nSN|-Snare drum------|\nHf/FH|-Hi-hat w/foot|\n\n|-o-| Strike\n|-s-| Splash\n\n"
    part = read(f"{key} HH|x-x-x-x-x-x-x-x-||\n  S|----o-------o---||\n")
    assert part.score.bar_count == 1
    assert (ticks(part, Piece.HIHAT), ticks(part, Piece.SNARE)) == (HAT_ON_EIGHTHS, [PPQ, 3 * PPQ])


@pytest.mark.parametrize("numbers", ["Bar 1            Bar 2", "[1]              [2]"])
def test_numbers_of_bars_name_no_part(numbers: str) -> None:
    assert not read(f"{numbers}\nHH|x-x-x-x-|x-x-x-x-|\nBD|o---o---|o---o---|\n").sections


def test_words_by_themselves_below_say_how_often() -> None:
    tab = "HH|x-x-x-x-|\nBD|o---o---|\n"
    assert read(f"{tab}\nRepeat x3\n\n{tab}").score.bar_count == 4


def test_the_last_bar_line_may_be_missing() -> None:
    part = read("HH|x-x-x-x-|x-x-x-x-\nBD|o---o---|o---o---\n")
    assert part.score.bar_count == 2
    assert ticks(part, Piece.KICK) == [k * 2 * PPQ for k in range(4)]


def test_a_percent_sign_is_the_bar_before() -> None:
    part = read("HH|x-x-x-x-|   %    |--------|\nBD|o---o---|---%----|o-------|\n")
    assert part.score.bar_count == 3
    assert ticks(part, Piece.KICK) == [0, 2 * PPQ, 4 * PPQ, 6 * PPQ, 8 * PPQ]
    assert ticks(part, Piece.HIHAT) == [k * PPQ for k in range(8)]


def test_a_tab_says_the_tempo_as_people_do() -> None:
    assert b"\nTempo: 76\n" in write_tab(part_of(find_lesson("funk-1"))).data


@pytest.mark.parametrize(
    "line",
    [f"A{' ' * 100_000}!", f"tempo{' ' * 100_000}!", "1" * 5_000, "X " * 50_000, "|x-" * 30_000 + "| HH!"],
    ids=["blanks", "tempo", "digits", "letters", "bars"],
)
def test_an_endless_line_is_read_at_once(line: str) -> None:
    """Patterns that try each blank again take minutes, and 5,000 digits are no number."""
    assert read(f"{line}\nHH|x-x-x-x-|\nSD|--o---o-|\n").score.bar_count >= 1


# --- words that people write round their tabs ------------------------------------------------------------------------


GROOVE = "HH|x-x-x-x-x-x-x-x-|\nSD|----o-------o---|\nBD|o-------o-------|\n"


def names(part: DrumPart) -> list[str]:
    return [section.name for section in part.sections]


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("Intro (bass plays alone):", "Intro"),
        ("V: verse", "verse"),
        ("C: chorus x2", "chorus"),
        ("Ending: hit crash and stop", "Ending"),
        ("2nd ending:", "2nd ending"),
        ("1st Verse", "1st Verse"),
        ("--- Chorus ---", "Chorus"),
        ("Verse 1 - with ghost notes", "Verse 1"),
        ("Verse 1 [play 4x]", "Verse 1"),
    ],
)
def test_names_of_parts_as_people_write_them(line: str, name: str) -> None:
    assert names(read(f"A Tune\nTempo: 96\n\n{line}\n{GROOVE}")) == [name]


def test_what_is_said_under_the_title_names_no_part() -> None:
    part = read(f"Seven Steps\nThe Grey Coats\n\nLegend:\nC = crash\n\nIntro\n{GROOVE}")
    assert (part.score.title, part.author, names(part)) == ("Seven Steps", "The Grey Coats", ["Intro"])


@pytest.mark.parametrize(
    ("line", "title"),
    [
        ('=== "My Tune" style groove ===     163 bpm', '"My Tune" style groove'),
        ("*** A TUNE ***", "A TUNE"),
        ("A drum tab, 12/8 blues, bpm=70", "A drum tab, 12/8 blues"),
        ("Slow Blues (tempo 70)", "Slow Blues"),
        ("Fast thing. 200bpm, 4/4", "Fast thing."),
        ("163 bpm - A Tune (live)", "A Tune (live)"),
    ],
)
def test_a_title_among_rules_or_beside_its_tempo(line: str, title: str) -> None:
    assert read(f"{line}\n\n{GROOVE}").score.title == title


@pytest.mark.parametrize(
    "words", ["q = 160", "♩ = 160", "quarter note = 160", "Tempo: quarter = 160", "160 BPM", "1/4 = 160", "4/4 @ 160"]
)
def test_the_tempo_as_people_write_it(words: str) -> None:
    part = read(f"A Tune\n{words}\n\n{GROOVE}")
    assert round(60e6 / part.score.tempo_map.tempos[0].us_per_quarter) == 160
    assert not part.lost


def test_swing_in_words_swings_the_eighths() -> None:
    """2:1: the second eighth of a beat stands where its third triplet does."""
    part = read("A Tune\ntempo 160, swing 8ths\n\nRd|x---x-x-x---x-x-|\nBD|o---------------|\n")
    assert part.swing == Swing(2.0, PPQ // 2)
    assert ticks(part, Piece.RIDE) == [0, PPQ, PPQ + 2 * PPQ // 3, 2 * PPQ, 3 * PPQ, 3 * PPQ + 2 * PPQ // 3]
    assert part.score.notes["swing_ticks"].max() == 2 * PPQ // 3 - PPQ // 2


def test_triplets_under_a_swing_mark_stay_where_they_are() -> None:
    part = read("A Tune\nTempo: 90\nSwing\n\nHH|x-xx-xx-xx-x|\nSD|---o-----o--|\n")
    assert ticks(part, Piece.HIHAT)[:3] == [0, 2 * PPQ // 3, PPQ]
    assert not part.score.notes["swing_ticks"].any()


def test_what_the_text_asks_to_repeat_and_nobody_does_is_told() -> None:
    part = read(f"A Tune\nTempo: 96\n\nVerse\n{GROOVE}\nthen repeat everything\n\nD.C. al Fine\n")
    assert [line for line in part.lost if "line 9" in line or "line 11" in line] == [
        "line 9: 'then repeat everything' is not carried out",
        "line 11: 'D.C. al Fine' is not carried out",
    ]


def test_a_line_that_asks_to_repeat_names_no_part() -> None:
    part = read(f"A Tune\nTempo: 96\n\nVerse\n{GROOVE}\nrepeat V 3 times then go to C\n\nC: chorus\n{GROOVE}")
    assert [(s.name, s.first_bar, s.last_bar) for s in part.sections] == [("Verse", 0, 2), ("chorus", 3, 3)]


# --- lines that people write otherwise -------------------------------------------------------------------------------


def test_lines_without_any_bar_line() -> None:
    part = read("C1-x---------------\nHH---x-x-x-x-x-x-x-\nSD-----o-------o---\nBD-o-----o-o-------\n")
    assert ticks(part, Piece.SNARE) == [PPQ, 3 * PPQ]
    assert ticks(part, Piece.HIHAT) == [k * EIGHTH for k in range(1, 8)]


@pytest.mark.parametrize(
    ("label", "piece"),
    [
        ("Snr", Piece.SNARE),
        ("BDr", Piece.KICK),
        ("BD1", Piece.KICK),
        ("BD2", Piece.KICK),
        ("TT1", Piece.TOM_1),
        ("HT1", Piece.TOM_1),
        ("Bass Dr.", Piece.KICK),
        ("Ride Bell", Piece.RIDE),
        ("Hi Hat Foot", Piece.HIHAT_PEDAL),
        ("HH Pedal", Piece.HIHAT_PEDAL),
        ("Cym", Piece.CRASH_1),
    ],
)
def test_more_names_of_drums(label: str, piece: Piece) -> None:
    assert ticks(read(f"Sp|----------------|\n{label}|x-------x-------|\n"), piece) == [0, 2 * PPQ]


def test_a_drum_that_nobody_knows_is_named_with_what_is_known() -> None:
    with pytest.raises(BadInput, match=r"line 2: no drum is called 'Gong' here; expected one such as BD, SD, HH"):
        read("HH|x-x-x-x-|\nGong|x-------|\n")


def test_a_text_whose_first_lines_are_known_in_part_is_tablature() -> None:
    """So that the message names the line, and not the formats that a text may be in."""
    assert is_tab(b"Words\n\nRide |x---x-x-|\nQqq  |----o---|\nZzz  |o---o---|\n")
    assert not is_tab(b"Words | and more\nof them | here\n")


def test_a_hat_that_finds_no_hand_is_the_foots() -> None:
    text = "Tempo: 70\n12/8\nR |x-xx-xx-xx-x|\nS |---o-----o--|\nB |o-----o-----|\nH |---x-----x--|\n"
    part = read(text)
    assert ticks(part, Piece.HIHAT_PEDAL) == [3 * EIGHTH, 9 * EIGHTH]
    assert part.lost == ("line 6: read as the hi-hat of the foot, for both hands are busy at its strokes",)


def test_a_hat_beside_a_ride_in_other_cells_is_the_hands() -> None:
    part = read("Rd|--------x-x-x-x-|\nHH|x-x-x-x---------|\nSD|----o-------o---|\n")
    assert not ticks(part, Piece.HIHAT_PEDAL)
    assert len(ticks(part, Piece.HIHAT)) == 4


def test_a_title_between_rules() -> None:
    part = read(f"--------\n A TUNE\n by: Ada\n 4/4 @ 82\n--------\n\n{GROOVE}\n            [x8]\n")
    assert (part.score.title, part.author, names(part)) == ("A TUNE", "Ada", [])
    assert round(60e6 / part.score.tempo_map.tempos[0].us_per_quarter) == 82
    assert part.score.bar_count == 8


def test_a_part_that_is_the_same_as_another_is_told() -> None:
    part = read(f"A Tune\nTempo: 96\n\nVerse 1 [play 4x]\n{GROOVE}\nVerse 2: same as verse 1\n\n{GROOVE}")
    assert [(s.name, s.first_bar, s.last_bar) for s in part.sections] == [("Verse 1", 0, 4)]
    assert part.lost == ("line 9: 'Verse 2: same as verse 1' is not carried out",)
