"""Hydrogen's songs and patterns; expected values are counted by hand in its ticks, 48 to a quarter."""

from xml.etree.ElementTree import fromstring

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.hydrogen.hydrogen_formats import HYDROGEN_PATTERN, HYDROGEN_SONG
from station.music.formats.music_format import Feature
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.unit.music.hydrogen_xml import instrument, note, pattern, song

TICK = PPQ // 48


def read(data: bytes) -> DrumPart:
    return HYDROGEN_SONG.read(data, "test.h2song")


def ticks(part: DrumPart) -> list[int]:
    return [n.tick // TICK for n in part.score]


def written(part: DrumPart) -> DrumPart:
    assert HYDROGEN_SONG.write is not None
    return read(HYDROGEN_SONG.write(part).data)


def lost(part: DrumPart) -> set[Feature]:
    assert HYDROGEN_SONG.write is not None
    return {loss.feature for loss in HYDROGEN_SONG.write(part).lost}


def part_of(*notes: Note, bars: int = 1, tempo_map: TempoMap | None = None, swing: Swing | None = None) -> DrumPart:
    tempo_map = tempo_map or TempoMap.constant(100)
    score = Score.from_notes(notes, tempo_map, tempo_map.bar_start(bars), "A song")
    return DrumPart(score, "Somebody", "About it", swing=swing or Swing())


# --- reading ----------------------------------------------------------------------------------------------------------


def test_columns_follow_each_other_as_long_as_their_longest_pattern() -> None:
    long, short = pattern("long", note(0), size=288), pattern("short", note(24, 1), size=96)
    part = read(song([long, short], [["long", "short"], ["short"], [], ["short"]]))
    assert ticks(part) == [0, 24, 288 + 24, 288 + 96 + 192 + 24]
    assert part.score.end_tick == (288 + 96 + 192 + 96) * TICK
    assert [str(m) for m in part.score.tempo_map.meters] == ["6/4", "2/4", "4/4", "2/4"]


def test_pieces_velocities_and_words() -> None:
    data = song([pattern("a", note(0, 2, velocity=1), note(48, 3, velocity=0.5))], [["a"]], "<author>Me</author>")
    part = read(data)
    assert [(n.piece, n.velocity, n.midi_note) for n in part.score] == [(Piece.HIHAT, 127, 42), (Piece.CRASH_1, 63, 49)]
    assert (part.score.title, part.author) == ("A song", "Me")
    assert part.score.tempo_map.bpm_at(0) == 100


def test_lead_and_lag_are_five_ticks() -> None:
    part = read(song([pattern("a", note(48, leadlag=-1), note(96, 1, leadlag=0.5))], [["a"]]))
    assert [n.tick for n in part.score] == [43 * TICK, 96 * TICK + 5 * TICK // 2]


def test_swing_delays_the_second_sixteenth_of_each_eighth() -> None:
    notes = [note(position) for position in (0, 12, 24, 36, 6)]
    part = read(song([pattern("a", *notes)], [["a"]], "<swing_factor>0.5</swing_factor>"))
    assert part.swing == Swing(15 / 9, PPQ // 4)
    assert ticks(part) == [0, 6, 15, 24, 39]
    assert [n.swing_ticks // TICK for n in part.score] == [0, 0, 3, 0, 3]


def test_virtual_patterns_sound_with_theirs_even_in_a_circle() -> None:
    virtual = (
        "<virtualPatternList><pattern><name>a</name><virtual>b</virtual></pattern>"
        "<pattern><name>b</name><virtual>a</virtual></pattern></virtualPatternList>"
    )
    part = read(song([pattern("a", note(0)), pattern("b", note(24, 1))], [["a"]], virtual))
    assert ticks(part) == [0, 24]


def test_the_timeline_has_tempos_and_sections() -> None:
    line = (
        "<BPMTimeLine><newBPM><BAR>1</BAR><BPM>150</BPM></newBPM></BPMTimeLine>"
        "<timeLineTag><newTAG><BAR>0</BAR><TAG>verse</TAG></newTAG><newTAG><BAR>2</BAR><TAG>fill</TAG></newTAG></timeLineTag>"
    )
    part = read(song([pattern("a", note(0))], [["a"]] * 3, line))
    assert [(t.tick, t.us_per_quarter) for t in part.score.tempo_map.tempos] == [(0, 600_000), (4 * PPQ, 400_000)]
    assert part.sections == (PartSection("verse", 0, 1), PartSection("fill", 2, 2))
    off = read(song([pattern("a")], [["a"]] * 3, line + "<isTimelineActivated>false</isTimelineActivated>"))
    assert len(off.score.tempo_map.tempos) == 1


def test_a_note_that_stops_a_cymbal_is_its_choke() -> None:
    part = read(song([pattern("a", note(0, 3), note(72, 3, note_off="true"), note(96, 3))], [["a"]]))
    assert [(n.tick // TICK, n.choke_ticks // TICK) for n in part.score] == [(0, 72), (96, 0)]


def test_what_does_not_sound_or_sounds_by_chance_is_told() -> None:
    band = instrument(0, "Kick", 36, "<isMuted>true</isMuted>") + instrument(1, "Snare", 38) + instrument(4, "Zing", 1)
    notes = [note(0, 0), note(24, 1, probability=0.5), note(48, 4), note(72, 1, velocity=0), note(96, 1, probability=0)]
    part = read(song([pattern("a", *notes)], [["a"]], "<humanize_time>0.2</humanize_time>", band))
    assert [n.piece for n in part.score] == [Piece.SNARE, Piece.PERCUSSION]
    assert part.lost == (
        "Hydrogen humanizes this song by chance; it is read as it is written",
        "notes of the muted instrument 'Kick': 1",
        "notes of 'Zing', read as percussion: 1",
        "notes that Hydrogen plays only now and then, read as always: 1",
    )


def test_where_one_instrument_plays_alone_the_others_are_silent() -> None:
    band = instrument(0, "Kick", 36) + instrument(1, "Snare", 38, "<isSoloed>true</isSoloed>")
    part = read(song([pattern("a", note(0, 0), note(24, 1))], [["a"]], instruments=band))
    assert [n.piece for n in part.score] == [Piece.SNARE]


def test_velocities_follow_the_songs_curve() -> None:
    curve = (
        '<automationPaths><path adjust="velocity"><point x="0" y="1"/><point x="1" y="0.5"/></path></automationPaths>'
    )
    part = read(song([pattern("a", note(0, velocity=1), note(96, 1, velocity=1))], [["a"]], curve))
    assert [n.velocity for n in part.score] == [127, 95]


def test_two_kicks_at_once_are_one_stroke() -> None:
    band = instrument(0, "Kick Long", 36) + instrument(1, "Kick Short", 37)
    part = read(song([pattern("a", note(0, 0, velocity=0.5), note(0, 1))], [["a"]], instruments=band))
    assert [(n.piece, n.velocity) for n in part.score] == [(Piece.KICK, 101)]


def test_old_songs_have_a_list_of_notes_an_instrument() -> None:
    lists = "".join(
        f"<sequence><noteList><note><position>{p}</position><instrument>{i}</instrument><velocity>0.8</velocity></note>"
        "</noteList></sequence>"
        for p, i in ((0, 0), (48, 1))
    )
    old = f"<pattern><name>a</name><size>192</size><sequenceList>{lists}</sequenceList></pattern>"
    assert ticks(read(song([old], [["a"]]))) == [0, 48]


def test_the_newest_have_their_kit_inside() -> None:
    plain = song([pattern("a", note(0, 1))], [["a"]]).decode()
    new = plain.replace("<instrumentList>", "<drumkit_info><instrumentList>")
    new = new.replace("</instrumentList>", "</instrumentList></drumkit_info>")
    assert [n.piece for n in read(new.encode()).score] == [Piece.SNARE]


def test_a_pattern_is_read_by_its_types_else_for_hydrogens_own_kit() -> None:
    body = pattern("Groove", note(0, 0), note(48, 2, type="Hi-hat Open"), note(96, 12))
    kit = "<drumkit_name>GMRockKit</drumkit_name>"
    data = (
        f'<drumkit_pattern xmlns="http://www.hydrogen-music.org/drumkit_pattern">{kit}{body}</drumkit_pattern>'.encode()
    )
    part = HYDROGEN_PATTERN.read(data, "groove.h2pattern")
    assert [(n.piece, n.openness) for n in part.score] == [(Piece.KICK, None), (Piece.HIHAT, 1.0), (Piece.RIDE, None)]
    assert part.score.title == "Groove"
    odd = HYDROGEN_PATTERN.read(data.replace(b"Hi-hat Open", b"China"), "groove.h2pattern")
    assert [n.piece for n in odd.score] == [Piece.KICK, Piece.CHINA, Piece.RIDE]
    other = HYDROGEN_PATTERN.read(data.replace(b"GMRockKit", b"TR808"), "groove.h2pattern")
    assert other.lost == ("the instruments of 'TR808' are not in a pattern; they are taken for those of GMRockKit",)


@pytest.mark.parametrize(("size", "bars"), [(768, 4), (384, 2), (432, 3), (192, 1), (288, 1), (144, 1)])
def test_a_long_pattern_is_several_bars(size: int, bars: int) -> None:
    """Hydrogen writes 192 ticks a whole note; 288 are 6/4, 432 are three bars of 3/4."""
    body = pattern("Groove", note(0, 0), note(size - 48, 2), size=size)
    part = HYDROGEN_PATTERN.read(f"<drumkit_pattern>{body}</drumkit_pattern>".encode(), "groove.h2pattern")
    assert part.score.bar_count == bars
    assert part.score.notes["tick"].tolist() == [0, (size - 48) * PPQ // 48]
    assert part.is_meter_said == (bars == 1)


@pytest.mark.parametrize(
    ("data", "place"),
    [
        (b"", "line 1"),
        (b"<kit/>", "line 1"),
        (song([pattern("a", note(-1))], [["a"]]), "line 3"),
        (song([pattern("a", note(0, velocity="loud"))], [["a"]]), "line 3"),
        (song([pattern("a", note(0), size=0)], [["a"]]), "line 3"),
        (song([pattern("a", note(0, leadlag="nan"))], [["a"]]), "line 3"),
        (song([pattern("a", *[note(0)] * 1000)], [["a"]] * 1000), ""),
    ],
)
def test_a_broken_song_is_refused_with_its_line(data: bytes, place: str) -> None:
    with pytest.raises(BadInput) as fault:
        read(data)
    assert (fault.value.source, fault.value.place) == ("test.h2song", place)


# --- writing ----------------------------------------------------------------------------------------------------------


def test_bars_that_are_alike_share_a_pattern() -> None:
    part = part_of(*(Note(bar * 4 * PPQ, Piece.KICK if bar != 2 else Piece.SNARE) for bar in range(4)), bars=4)
    assert HYDROGEN_SONG.write is not None
    root = fromstring(HYDROGEN_SONG.write(part).data)
    assert [p.findtext("name") for p in root.iterfind("patternList/pattern")] == ["Bar 1", "Bar 3"]
    columns = [group.findtext("patternID") for group in root.iterfind("patternSequence/group")]
    assert columns == ["Bar 1", "Bar 1", "Bar 3", "Bar 1"]
    kick = root.find("instrumentList/instrument")
    assert kick is not None
    assert (kick.findtext("name"), kick.findtext("drumkit"), kick.findtext("midiOutNote")) == (
        "Kick",
        "GMRockKit",
        "36",
    )
    files = [layer.findtext("filename") for layer in kick.iterfind("instrumentComponent/layer")]
    assert files == [f"Kick-{loudness}.wav" for loudness in ("Softest", "Soft", "Med", "Hard", "Hardest")]


def test_times_between_the_ticks_are_lead_and_lag() -> None:
    notes = [Note(i * PPQ // 7, Piece.SNARE, velocity=20 + i) for i in range(28)]
    back = written(part_of(*notes))
    assert [(n.tick, n.velocity) for n in back.score] == [(n.tick, n.velocity) for n in notes]


def test_every_velocity_comes_back() -> None:
    notes = [Note(i * PPQ // 32, Piece.SNARE, velocity=i) for i in range(1, 128)]
    assert [n.velocity for n in written(part_of(*notes)).score] == list(range(1, 128))


def test_tempo_meter_words_and_sections_come_back() -> None:
    tempo_map = TempoMap.build(
        [TempoChange(0, 612_345), TempoChange(3 * PPQ, 400_000)],
        [MeterChange(0, 3, 4), MeterChange(3 * PPQ, 7, 8)],
    )
    score = Score.from_notes([Note(0, Piece.KICK)], tempo_map, tempo_map.bar_start(3), "Ö & <b>")
    part = DrumPart(score, "A", "B", sections=(PartSection("one", 0, 0), PartSection("two", 1, 1)))
    back = written(part)
    assert back.score.tempo_map == tempo_map
    assert back.score.end_tick == score.end_tick
    assert (back.score.title, back.author, back.about, back.sections) == ("Ö & <b>", "A", "B", part.sections)


def test_zones_openness_chokes_and_buzzes_come_back() -> None:
    notes = [
        Note(0, Piece.CRASH_2, Zone.EDGE, choke_ticks=PPQ),
        Note(PPQ, Piece.HIHAT, Zone.EDGE, openness=0.5),
        Note(PPQ, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=PPQ // 2),
        Note(2 * PPQ, Piece.SNARE, Zone.RIM, articulation=Articulation.CROSS_STICK),
        Note(2 * PPQ, Piece.TOM_3, Zone.RIM),
        Note(3 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, articulation=Articulation.SPLASH, openness=1.0),
        Note(3 * PPQ, Piece.CHINA, Zone.BOW),
        Note(3 * PPQ, Piece.RIDE, Zone.BELL),
    ]
    part = part_of(*notes)
    assert lost(part) == set()
    fields = [(n.tick, n.piece, n.zone, n.articulation, n.choke_ticks, n.duration_ticks) for n in written(part).score]
    assert fields == [(n.tick, n.piece, n.zone, n.articulation, n.choke_ticks, n.duration_ticks) for n in part.score]


def test_swung_sixteenths_are_written_straight() -> None:
    swing = Swing(1.5, PPQ // 4)
    late = swing.swung(PPQ // 4, MeterChange(0, 4, 4)) - PPQ // 4
    part = part_of(Note(0, Piece.HIHAT), Note(PPQ // 4 + late, Piece.HIHAT, swing_ticks=late), swing=swing)
    assert HYDROGEN_SONG.write is not None
    root = fromstring(HYDROGEN_SONG.write(part).data)
    assert root.findtext("swing_factor") == "0.4"
    positions = [note.findtext("position") for note in root.iterfind("patternList/pattern/noteList/note")]
    assert positions == ["0", "12"]
    assert Feature.SWING not in lost(part)


def test_swung_eighths_are_written_where_they_sound() -> None:
    swing = Swing(1.5, PPQ // 2)
    late = swing.swung(PPQ // 2, MeterChange(0, 4, 4)) - PPQ // 2
    part = part_of(Note(PPQ // 2 + late, Piece.KICK, swing_ticks=late), swing=swing)
    assert lost(part) == {Feature.SWING}
    assert [n.tick for n in written(part).score] == [PPQ // 2 + late]


def test_a_flam_is_two_strokes() -> None:
    grace = Note(PPQ, Piece.SNARE, velocity=30, dynamic=Dynamic.GHOST, ornament=Ornament.FLAM, lead_ms=30)
    main = Note(PPQ, Piece.SNARE, ornament=Ornament.FLAM)
    back = written(part_of(grace, main)).score
    assert [round(ns / 1e6) for ns in back.onset_ns.tolist()] == [570, 600]  # a quarter at 100 bpm lasts 600 ms


def test_a_grace_stroke_before_the_song_is_left_out_and_told() -> None:
    """Hydrogen 1.2 plays nothing before its first tick: h2cli plays such a lead on the stroke itself."""
    grace = Note(0, Piece.SNARE, velocity=30, dynamic=Dynamic.GHOST, ornament=Ornament.FLAM, lead_ms=30)
    part = part_of(grace, Note(0, Piece.SNARE, velocity=10, ornament=Ornament.FLAM))
    assert [(n.tick, n.velocity) for n in written(part).score] == [(0, 10)]
    assert lost(part) == {Feature.FLAMS}


def test_what_lies_between_ticks_leads_and_never_lags() -> None:
    """Hydrogen 1.2 plays a lead and drops a lag when it exports: h2cli plays tick 12 with a lag of 0.1 at 12."""
    assert HYDROGEN_SONG.write is not None
    part = part_of(Note(13 * TICK + TICK // 10, Piece.KICK), Note(4 * PPQ - TICK // 2, Piece.KICK), bars=2)
    root = fromstring(HYDROGEN_SONG.write(part).data)
    found = [
        (int(note.findtext("position", "")), round(float(note.findtext("leadlag", "")), 3))
        for note in root.iterfind("patternList/pattern/noteList/note")
    ]
    assert found == [(14, -0.18), (191, 0.1)]  # the last has no tick of its bar after it
    assert [n.tick for n in written(part).score] == [13 * TICK + TICK // 10, 4 * PPQ - TICK // 2]


def test_what_lies_just_before_a_swung_sixteenth_is_not_swung() -> None:
    """A stroke 11.7 ticks after the beat is none of the sixteenths that Hydrogen's swing delays."""
    swing = Swing(1.5, PPQ // 4)
    early = 12 * TICK - 3 * TICK // 10
    back = written(part_of(Note(early, Piece.KICK), swing=swing))
    assert [(n.tick, n.swing_ticks) for n in back.score] == [(early, 0)]


def test_a_tempo_change_within_a_bar_is_told() -> None:
    tempo_map = TempoMap.build([TempoChange(0, 500_000), TempoChange(PPQ, 400_000)])
    assert lost(part_of(Note(0, Piece.KICK), tempo_map=tempo_map)) == {Feature.TEMPO}


def test_a_pattern_takes_the_nearest_instrument_of_the_kit() -> None:
    assert HYDROGEN_PATTERN.write is not None
    done = HYDROGEN_PATTERN.write(part_of(Note(0, Piece.CRASH_2, Zone.EDGE), Note(4 * PPQ, Piece.KICK), bars=2))
    back = HYDROGEN_PATTERN.read(done.data, "a.h2pattern")
    assert [(n.tick, n.piece) for n in back.score] == [(0, Piece.CRASH_1), (4 * PPQ, Piece.KICK)]
    assert {loss.feature for loss in done.lost} == {Feature.PIECES}


def test_the_fields_of_a_pattern_are_in_the_order_of_hydrogens_schema() -> None:
    """drumkit_pattern.xsd of 1.2, a sequence; one with more fields or others is read as of an older Hydrogen."""
    assert HYDROGEN_PATTERN.write is not None
    root = fromstring(HYDROGEN_PATTERN.write(part_of(Note(0, Piece.KICK))).data)
    names = [[child.tag.partition("}")[2] for child in element] for element in (root, root[3], root[3][5][0])]
    assert names == [
        ["drumkit_name", "author", "license", "pattern"],
        ["name", "info", "category", "size", "denominator", "noteList"],
        [
            "position",
            "leadlag",
            "velocity",
            "pan",
            "pitch",
            "key",
            "length",
            "instrument",
            "note_off",
            "probability",
        ],
    ]
