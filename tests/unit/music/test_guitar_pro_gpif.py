"""`.gp` and `.gpx`: XML written by hand as Guitar Pro 7 writes it (alphaTab's test file), meaning read off by hand."""

import io
import zipfile
from collections.abc import Sequence
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Ornament, Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart, PartSection
from station.music.formats.format_table import read_part
from station.music.formats.guitar_pro.guitar_pro_format import read_packed_part
from station.music.formats.guitar_pro.score_gpif import read_gpif
from station.music.formats.guitar_pro.tab_part import part_of_song
from station.music.swing import Swing

_SHARED = Path("../shared/data/charts/guitarpro/visual-tests/special-tracks/percussion.gp")
_KIT = {"kick": (36, 36), "snare": (38, 38), "rim shot": (91, 38), "hat": (42, 42), "half": (92, 46), "crash": (49, 49)}
_ROWS = list(_KIT)

_Note = tuple[str, str]
"""The name of an articulation, and XML inside the note."""


def _note(name: str, inside: str = "") -> _Note:
    return name, inside


class _Gpif:
    """Builds a score of one drum track; every beat, note and rhythm has an id of its own."""

    def __init__(self) -> None:
        self.beats: list[str] = []
        self.notes: list[str] = []
        self.rhythms: list[str] = []
        self.masters: list[str] = []
        self.voices: list[list[int]] = []
        self.track_type = "<InstrumentSet><Type>drumKit</Type>"
        self.automations = ""
        self.anacrusis = ""

    def beat(self, *notes: _Note, value: str = "Quarter", rhythm: str = "", inside: str = "") -> "_Gpif":
        ids = []
        for name, more in notes:
            index = f"<InstrumentArticulation>{_ROWS.index(name)}</InstrumentArticulation>" if name in _ROWS else name
            ids.append(str(len(self.notes)))
            self.notes.append(f'<Note id="{ids[-1]}">{index}{more}</Note>')
        place = len(self.beats)
        self.rhythms.append(f'<Rhythm id="{place}"><NoteValue>{value}</NoteValue>{rhythm}</Rhythm>')
        written = f"<Notes>{' '.join(ids)}</Notes>" if ids else ""
        self.beats.append(f'<Beat id="{place}"><Dynamic>F</Dynamic><Rhythm ref="{place}"/>{written}{inside}</Beat>')
        self.voices[-1].append(place)
        return self

    def bar(self, inside: str = "", time: str = "4/4") -> "_Gpif":
        place = len(self.masters)
        self.masters.append(f"<MasterBar><Time>{time}</Time>{inside}<Bars>{place}</Bars></MasterBar>")
        self.voices.append([])
        return self

    def xml(self) -> bytes:
        kit = "".join(
            f"<Articulation><InputMidiNumbers>{i}</InputMidiNumbers><OutputMidiNumber>{o}</OutputMidiNumber></Articulation>"
            for i, o in _KIT.values()
        )
        elements = f"<Elements><Element><Articulations>{kit}</Articulations></Element></Elements></InstrumentSet>"
        bars = "".join(f'<Bar id="{i}"><Voices>{i} -1 -1 -1</Voices></Bar>' for i in range(len(self.voices)))
        voices = "".join(
            f'<Voice id="{i}"><Beats>{" ".join(map(str, beats))}</Beats></Voice>' for i, beats in enumerate(self.voices)
        )
        return (
            "<GPIF><Score><Title><![CDATA[Song]]></Title><Artist>Band</Artist></Score>"
            f"<MasterTrack><Tracks>0</Tracks><Automations>{self.automations}</Automations>{self.anacrusis}</MasterTrack>"
            f'<Tracks><Track id="0"><Name>Drums</Name>{self.track_type}{elements}</Track></Tracks>'
            f"<MasterBars>{''.join(self.masters)}</MasterBars><Bars>{bars}</Bars><Voices>{voices}</Voices>"
            f"<Beats>{''.join(self.beats)}</Beats><Notes>{''.join(self.notes)}</Notes>"
            f"<Rhythms>{''.join(self.rhythms)}</Rhythms></GPIF>"
        ).encode()

    def read(self) -> DrumPart:
        return part_of_song(read_gpif(self.xml(), "song.gp"), "song.gp")


def _zipped(name: str, data: bytes) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, data)
    return file.getvalue()


def _strokes(part: DrumPart) -> list[tuple[float, Piece]]:
    return [(n.tick / PPQ, n.piece) for n in part.score if not n.lead_ms]


def _groove() -> _Gpif:
    return _Gpif().bar().beat(_note("kick"), _note("hat")).beat(_note("half")).beat(_note("rim shot")).beat()


def test_articulations_are_read_by_their_input_numbers() -> None:
    kick, closed, half, rim_shot = _groove().read().score
    assert (kick.piece, closed.piece, closed.openness) == (Piece.KICK, Piece.HIHAT, 0.0)
    assert (half.piece, half.openness, half.tick) == (Piece.HIHAT, 0.5, PPQ)
    assert (rim_shot.piece, rim_shot.articulation) == (Piece.SNARE, Articulation.RIM_SHOT)


def test_words_tempo_and_end() -> None:
    gpif = _groove()
    gpif.automations = (
        "<Automation><Type>Tempo</Type><Bar>0</Bar><Position>0</Position><Value>80 3</Value></Automation>"
        "<Automation><Type>Tempo</Type><Bar>0</Bar><Position>0.5</Position><Value>90 2</Value></Automation>"
    )
    part = gpif.read()
    assert (part.score.title, part.author, part.score.end_tick) == ("Song", "Band", 4 * PPQ)
    # 80 dotted quarters a minute are 120 quarters
    assert [(t.tick, t.us_per_quarter) for t in part.score.tempo_map.tempos] == [(0, 500_000), (2 * PPQ, 666_667)]


def test_accents_and_ghosts() -> None:
    gpif = _Gpif().bar()
    gpif.beat(_note("snare", "<Accent>8</Accent>")).beat(_note("snare", "<Accent>4</Accent>"))
    gpif.beat(_note("snare", "<AntiAccent>Normal</AntiAccent>")).beat(_note("snare", "<Accent>1</Accent>"))
    played = list(gpif.read().score)
    assert [n.dynamic for n in played] == [Dynamic.ACCENT, Dynamic.ACCENT, Dynamic.GHOST, Dynamic.NORMAL]
    assert [n.velocity for n in played] == [127, 127, 38, 95]


@pytest.mark.parametrize(("count", "ornament"), [(1, Ornament.FLAM), (2, Ornament.DRAG)])
def test_grace_beats_are_flams_and_drags_and_take_no_time(count: int, ornament: Ornament) -> None:
    gpif = _Gpif().bar().beat(_note("kick"))
    for _ in range(count):
        gpif.beat(_note("snare"), value="16th", inside="<GraceNotes>BeforeBeat</GraceNotes>")
    part = gpif.beat(_note("hat"), _note("snare")).read()
    assert _strokes(part) == [(0, Piece.KICK), (1, Piece.SNARE), (1, Piece.HIHAT)]
    graces = [n for n in part.score if n.lead_ms]
    assert [(n.piece, n.ornament) for n in graces] == [(Piece.SNARE, ornament)] * count


def test_dots_and_tuplets() -> None:
    gpif = _Gpif().bar()
    gpif.beat(_note("kick"), rhythm='<AugmentationDot count="2"/>').beat(_note("snare"), value="16th")
    for _ in range(3):
        gpif.beat(_note("hat"), value="Eighth", rhythm='<PrimaryTuplet num="3" den="2"/>')
    for _ in range(5):
        gpif.beat(_note("hat"), value="16th", rhythm="<PrimaryTuplet><Num>5</Num><Den>4</Den></PrimaryTuplet>")
    thirds = [2 * PPQ + i * PPQ // 3 for i in range(3)]
    fifths = [3 * PPQ + i * PPQ // 5 for i in range(5)]
    assert [n.tick for n in gpif.read().score] == [0, 7 * PPQ // 4, *thirds, *fifths]


def test_tremolo_is_an_open_roll_and_goes_on_over_a_tie() -> None:
    tied = '<Tie origin="false" destination="true"/>'
    roll = "<Tremolo>1/8</Tremolo>"
    gpif = _Gpif().bar().beat(_note("snare"), inside=roll).beat(_note("snare", tied), inside=roll)
    gpif.beat(_note("snare", tied)).beat()
    played = list(gpif.read().score)
    assert [n.tick for n in played] == [i * PPQ // 8 for i in range(16)]
    assert {n.ornament for n in played} == {Ornament.ROLL}


def test_repeats_endings_sections_and_jumps() -> None:
    gpif = _Gpif()
    gpif.bar('<Repeat start="true" end="false" count="0"/><Section><Letter>A</Letter><Text>Verse</Text></Section>')
    gpif.beat(_note("kick"))
    gpif.bar('<Repeat start="false" end="true" count="2"/><AlternateEndings>1</AlternateEndings>').beat(_note("snare"))
    gpif.bar("<AlternateEndings>2</AlternateEndings>").beat(_note("hat"))
    gpif.bar("<Directions><Target>Fine</Target></Directions><Section><Text>End</Text></Section>").beat(_note("crash"))
    gpif.bar("<Directions><Jump>DaCapoAlFine</Jump></Directions>", time="3/4").beat(_note("half"))
    part = gpif.read()
    kinds = [Piece.KICK, Piece.SNARE, Piece.KICK, Piece.HIHAT, Piece.CRASH_1, Piece.HIHAT]
    assert [n.piece for n in part.score] == [*kinds, Piece.KICK, Piece.HIHAT, Piece.CRASH_1]
    assert part.score.end_tick == (8 * 4 + 3) * PPQ
    assert part.sections == (
        PartSection("A Verse", 0, 3),
        PartSection("End", 4, 5),
        PartSection("A Verse", 6, 7),
        PartSection("End", 8, 8),
    )


@pytest.mark.parametrize(
    ("bars", "order"),
    [
        (["|:", "1", ":|", "2", ""], [0, 1, 2, 0, 3, 4]),
        (["|:", "1 :|", "2 :|", "3"], [0, 1, 0, 2, 0, 3]),
        (["", ":|", "", ":|"], [0, 1, 0, 1, 2, 3, 2, 3]),
        (["|:", "1 :|", "2", "|: :|"], [0, 1, 0, 2, 3, 3]),
    ],
)
def test_an_ending_lasts_until_its_repeat_ends(bars: list[str], order: list[int]) -> None:
    """Bars of one to four eighths, so that an onset's distance to the next says which bar it was; orders by hand."""
    gpif = _Gpif()
    for i, signs in enumerate(bars):
        marks = {"start": "|:" in signs, "end": ":|" in signs}
        repeat = " ".join(f'{name}="{str(value).lower()}"' for name, value in marks.items())
        endings = "".join(c for c in signs if c.isdigit())
        gpif.bar(
            f'<Repeat {repeat} count="2"/>' + (f"<AlternateEndings>{endings}</AlternateEndings>" if endings else ""),
            time=f"{i + 1}/8",
        ).beat(_note("kick"))
    score = gpif.read().score
    ends = [*score.notes["tick"].tolist()[1:], score.end_tick]
    lengths = [end - n.tick for n, end in zip(score, ends, strict=True)]
    assert [2 * length // PPQ - 1 for length in lengths] == order


@pytest.mark.parametrize(
    ("feel", "swing", "second"),
    [
        ("Triplet8th", Swing(2.0, PPQ // 2), 2 * PPQ // 3),
        ("Dotted8th", Swing(3.0, PPQ // 2), 3 * PPQ // 4),
        ("Scottish8th", Swing(), PPQ // 4),
        ("NoTripletFeel", Swing(), PPQ // 2),
    ],
)
def test_feels(feel: str, swing: Swing, second: int) -> None:
    gpif = _Gpif().bar(f"<TripletFeel>{feel}</TripletFeel>")
    gpif.beat(_note("hat"), value="Eighth").beat(_note("snare"), value="Eighth")
    part = gpif.read()
    assert part.swing == swing
    assert [n.tick for n in part.score] == [0, second]
    assert bool(part.lost) == (feel == "Scottish8th")


@pytest.mark.parametrize(
    ("track", "is_drums"),
    [
        ("<InstrumentSet><Type>drumKit</Type>", True),
        ("<MidiConnection><PrimaryChannel>9</PrimaryChannel></MidiConnection><InstrumentSet>", True),
        ("<MidiConnection><PrimaryChannel>0</PrimaryChannel></MidiConnection><InstrumentSet>", False),
        ("<InstrumentSet><Type>electricGuitar</Type>", False),
    ],
)
def test_a_drum_track_is_known_by_its_instrument_or_its_channel(track: str, is_drums: bool) -> None:
    gpif = _groove()
    gpif.track_type = track
    if is_drums:
        assert len(gpif.read().score) == 4
    else:
        with pytest.raises(BadInput, match="no drum track"):
            gpif.read()


def test_an_upbeat_is_as_long_as_its_notes() -> None:
    gpif = _Gpif().bar().beat(_note("snare"), value="Eighth").bar().beat(_note("kick"))
    gpif.anacrusis = "<Anacrusis/>"
    part = gpif.read()
    assert _strokes(part) == [(0, Piece.SNARE), (0.5, Piece.KICK)]
    assert part.score.bar.tolist() == [0, 1]


def test_guitar_pro_6_says_element_and_variation() -> None:
    def six(element: int, variation: int) -> _Note:
        values = (("Element", element), ("Variation", variation))
        properties = "".join(f'<Property name="{n}"><{n}>{v}</{n}></Property>' for n, v in values)
        return f"<Properties>{properties}</Properties>", ""

    gpif = _Gpif().bar()
    gpif.track_type = '<GeneralMidi table="Percussion"/><InstrumentSet>'
    gpif.beat(six(0, 0)).beat(six(1, 2)).beat(six(10, 2)).beat(six(13, 0))
    kick, side_stick, open_hat, crash = gpif.read().score
    assert (kick.piece, side_stick.articulation) == (Piece.KICK, Articulation.CROSS_STICK)
    assert (open_hat.piece, open_hat.openness, crash.piece) == (Piece.HIHAT, 1.0, Piece.CRASH_1)


@pytest.mark.parametrize("size", [0, 5000])
def test_zip_and_both_containers_give_the_same(size: int) -> None:
    xml = _groove().xml() + b" " * size
    plain = _sectors(xml)
    parts = [read_packed_part(data, "song.gp") for data in (_zipped("Content/score.gpif", xml), plain, _packed(plain))]
    assert [_strokes(part) for part in parts] == [_strokes(_groove().read())] * 3


def _sectors(xml: bytes) -> bytes:
    """`BCFS`: an empty sector, the entry of score.gpif, its sectors."""
    count = -(-len(xml) // 0x1000)
    entry = (2).to_bytes(4, "little") + b"score.gpif".ljust(0x88, b"\0") + len(xml).to_bytes(4, "little") + bytes(4)
    entry += b"".join((2 + i).to_bytes(4, "little") for i in range(count))
    return b"BCFS" + b"\xff" * 0x1000 + entry.ljust(0x1000, b"\0") + xml.ljust(count * 0x1000, b"\0")


def _packed(plain: bytes) -> bytes:
    """`BCFZ`: every run of 4 equal bytes or more as one byte and copies, the rest as it stands."""
    bits: list[str] = []

    def reversed_bits(value: int, width: int) -> str:
        return f"{value:0{width}b}"[::-1]

    at = 0
    while at < len(plain):
        run = next((n for n in range(1, 16) if plain[at : at + n + 1] != plain[at : at + 1] * (n + 1)), 15)
        if (
            run >= 4
            and at
            and plain[at - 1 : at] * run == plain[at : at + run]
            and plain[max(0, at - 15) : at] == (plain[at : at + 1] * 15)
        ):
            bits.append("1" + f"{4:04b}" + reversed_bits(15, 4) + reversed_bits(run, 4))
            at += run
        else:
            bits.append("0" + reversed_bits(1, 2) + f"{plain[at]:08b}")
            at += 1
    stream = "".join(bits)
    stream += "0" * (-len(stream) % 8)
    body = int(stream, 2).to_bytes(len(stream) // 8, "big")
    return b"BCFZ" + len(plain).to_bytes(4, "little") + body


def test_the_marked_ends_of_a_hostile_file_are_refused() -> None:
    gpif = _groove()
    gpif.masters *= 5_001
    with pytest.raises(BadInput, match="5001 bars; expected at most 5000"):
        gpif.read()


def test_a_voice_that_many_bars_share_is_counted_each_time() -> None:
    gpif = _Gpif()
    for _ in range(3000):
        gpif.bar()
    gpif.beat(_note("kick"))
    gpif.voices = [[0] * 100] * 3000
    with pytest.raises(BadInput, match=r"bar \d+: more than 50000 drum beats and notes"):
        gpif.read()


@pytest.mark.parametrize(
    ("data", "fault"),
    [
        (b"", "neither the zip file"),
        (b"PK\x03\x04junk", "no zip file"),
        (_zipped("Content/other.xml", b"<x/>"), "no member Content/score.gpif"),
        (_zipped("Content/score.gpif", b"<GPIF>"), "line 1: not XML"),
        (_zipped("Content/score.gpif", b"<!DOCTYPE x [<!ENTITY a 'b'>]><GPIF/>"), "document type"),
        (_zipped("Content/score.gpif", b"<GPIF/>"), "no drum track"),
        (_zipped("Content/score.gpif", b" " * (17 << 20)), "larger than 16 MiB"),
        (b"BCFS", "no score.gpif"),
        (b"BCFZ\xff\xff\xff\x7f", "2147483647 bytes when unpacked"),
        (b"BCFZ\x00\x01\x00\x00\xff\xff\xff", "copies from before its beginning"),
    ],
)
def test_what_is_no_guitar_pro_file_is_refused(data: bytes, fault: str) -> None:
    with pytest.raises(BadInput, match=f"song.gp: .*{fault}"):
        read_packed_part(data, "song.gp")


@pytest.mark.parametrize(
    ("old", "new", "fault"),
    [
        (b'<Voice id="0">', b'<Voice id="7">', "bar 1: refers to the voice 0, which is nowhere"),
        (b"<Time>4/4", b"<Time>0/4", "bar 1: a meter of 0/4"),
        (b"<NoteValue>Quarter", b"<NoteValue>Fish", "bar 1: a note value of 'Fish'"),
    ],
)
def test_faults_name_their_bar(old: bytes, new: bytes, fault: str) -> None:
    with pytest.raises(BadInput, match=f"song.gp: {fault}"):
        read_gpif(_groove().xml().replace(old, new), "song.gp")


def test_alphatabs_file_of_special_tracks_reads() -> None:
    """Its three tracks play cabasa, maracas and cowbells, two, four and six strokes; read off in its XML."""
    if not _SHARED.exists():
        pytest.skip(f"{_SHARED} is not here")
    part = read_part(_SHARED)
    numbers: Sequence[int] = [n.midi_note for n in part.score]
    assert numbers == [99, 100, 56, 101, 102, 103]
    assert {n.piece for n in part.score} == {Piece.COWBELL}
    assert part.lost == ("another drum track: Single Line", "another drum track: Two Lines")
