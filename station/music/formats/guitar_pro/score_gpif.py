"""`score.gpif`, the XML inside `.gp` and `.gpx`: to a `TabSong`.

Everything has an id and is told once: bars have voices, voices beats, beats notes and a rhythm. A note of a drum track
is an index into the track's articulations (GP 7 and 8), or an element with a variation (GP 6). Of several drum tracks
the one with most strokes is taken.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType
from xml.etree.ElementTree import Element

from station.core.errors import BadInput
from station.core.pieces import Dynamic
from station.core.units import PPQ
from station.music.formats.guitar_pro.gpif_elements import (
    DrumTrack,
    decimal,
    is_for_drums,
    master_bar,
    number_of_articulation,
    number_of_note,
    tuplet_of,
    whole,
    with_graces,
)
from station.music.formats.guitar_pro.tab_song import TabBar, TabBeat, TabNote, TabSong
from station.music.formats.guitar_pro.tab_words import bpm_to_us, checked_meter, within
from station.music.formats.playing_order import MOST_BARS
from station.music.formats.safe_xml import parse_xml, text_of
from station.music.tempo import METER_UNITS, MeterChange

_NONE = "-1"
_DEFAULT_BPM = 120.0
_MOST_DOTS = 3
_MOST_DRUM_BEATS = 50_000
"""Beats and notes of the drum tracks as they are written (our choice: 1,000 bars of sixteenths, two notes each)."""
_MOST_NOTES = 32
"""Notes of one beat that are read; more than a kit has."""
_HEAVY_ACCENT, _ACCENT = 0x04, 0x08

_VELOCITIES = {name: 15 + 16 * i for i, name in enumerate(("PPP", "PP", "P", "MP", "MF", "F", "FF", "FFF"))}
"""As Guitar Pro 5 has them (PyGuitarPro, `Velocities`)."""
_USUAL_DYNAMIC = "MF"
_QUARTERS: Mapping[str, Fraction] = MappingProxyType(
    {
        "Long": Fraction(16),
        "DoubleWhole": Fraction(8),
        "Whole": Fraction(4),
        "Half": Fraction(2),
        "Quarter": Fraction(1),
        "Eighth": Fraction(1, 2),
        **{f"{n}{'nd' if n == 32 else 'th'}": Fraction(4, n) for n in (16, 32, 64, 128, 256)},
    }
)
_TREMOLO_TICKS = {"1/2": PPQ // 2, "1/4": PPQ // 4, "1/8": PPQ // 8}
"""Strokes of an eighth, a sixteenth and a 32nd, as parts of a quarter note."""
_BEAT_OF_TEMPO = {1: Fraction(1, 2), 2: Fraction(1), 3: Fraction(3, 2), 4: Fraction(2), 5: Fraction(3)}
"""The note that a tempo counts, in quarter notes: eighth, quarter, dotted quarter, half, dotted half."""
_SIMILE_BARS = {"Simple": 1, "FirstOfDouble": 2, "SecondOfDouble": 2}
"""How many bars before stands the bar that a repeat sign repeats."""


def read_gpif(data: bytes, source: str) -> TabSong:
    """The drums of a `score.gpif`; raises `BadInput`."""
    return _Song(parse_xml(data, source, ("GPIF",)), source).read()


@dataclass(frozen=True, slots=True)
class _Beat:
    """A beat by itself: how many quarter notes it lasts, and what it strikes; a grace beat takes no time."""

    quarters: Fraction
    is_tuplet: bool
    notes: tuple[TabNote, ...]
    is_grace: bool


class _Song:
    """The tables of one file, and its parts by their ids."""

    def __init__(self, root: Element, source: str) -> None:
        self.root, self.source = root, source
        self.bars, self.voices, self.beats, self.notes, self.rhythms = (
            {e.get("id", ""): e for e in root.findall(f"{kind}s/{kind}")}
            for kind in ("Bar", "Voice", "Beat", "Note", "Rhythm")
        )
        self.masters = root.findall("MasterBars/MasterBar")
        self.beat_count = 0
        self.known_beats: dict[tuple[int, str], _Beat] = {}
        self.known_rhythms: dict[str, tuple[Fraction, bool]] = {}

    def read(self) -> TabSong:
        if len(self.masters) > MOST_BARS:
            raise BadInput(self.source, "", f"{len(self.masters)} bars; expected at most {MOST_BARS}")
        tracks = list(self._drum_tracks())
        if not tracks:
            raise BadInput(self.source, "", "no drum track among its tracks")
        played = [list(self._track_bars(track)) for track in tracks]
        counts = [sum(len(beat.notes) for bar in bars for beat in bar.beats) for bars in played]
        best = counts.index(max(counts))
        others = [t.name for t, count in zip(tracks, counts, strict=True) if count and t is not tracks[best]]
        words = [text_of(self.root, f"Score/{name}") for name in ("SubTitle", "Instructions", "Notices")]
        return TabSong(
            text_of(self.root, "Score/Title") or Path(self.source).stem,
            text_of(self.root, "Score/Artist") or text_of(self.root, "Score/Music"),
            " ".join(" ".join(words).split()),
            tuple(played[best]),
            (*(f"another drum track: {name}" for name in others), *self._lost()),
        )

    # --- tracks -------------------------------------------------------------------------------------------------------

    def _drum_tracks(self) -> Iterator[DrumTrack]:
        by_id = {track.get("id", ""): track for track in self.root.findall("Tracks/Track")}
        order = [by_id[i] for i in text_of(self.root, "MasterTrack/Tracks").split() if i in by_id]
        column = 0
        for track in order or by_id.values():
            if is_for_drums(track):
                articulations = track.findall("InstrumentSet/Elements/Element/Articulations/Articulation")
                numbers = tuple(number_of_articulation(a) for a in articulations)
                yield DrumTrack(text_of(track, "Name") or "?", column, numbers)
            column += max(len(track.findall("Staves/Staff")), 1)

    # --- bars ---------------------------------------------------------------------------------------------------------

    def _track_bars(self, track: DrumTrack) -> Iterator[TabBar]:
        """The bars of one track with what the master bars say over them."""
        tempos = self._tempos()
        us = bpm_to_us(_DEFAULT_BPM, self.source, 0)
        content: list[tuple[TabBeat, ...]] = []
        for i, master in enumerate(self.masters):
            beats, simile = self._bar_beats(track, master, i)
            content.append(content[i - simile] if 0 < simile <= i else beats)
            meter = self._meter(master, i, content[-1])
            changes = [(round(share * meter.bar_ticks), rate) for share, rate in sorted(tempos.get(i, []))]
            bar_tempos = (*([] if changes and changes[0][0] == 0 else [(0, us)]), *changes)
            us = bar_tempos[-1][1]
            bar = master_bar(master, meter)
            yield replace(bar, beats=tuple(within(content[-1], meter)), tempos=bar_tempos)

    def _meter(self, master: Element, i: int, beats: Sequence[TabBeat]) -> MeterChange:
        """The meter of a bar; of an upbeat as long as its content."""
        count, _, unit = text_of(master, "Time", "4/4").partition("/")
        meter = checked_meter(whole(count), whole(unit), self.source, i)
        length = max((b.tick + b.length_ticks for b in beats), default=0)
        if i or self.root.find("MasterTrack/Anacrusis") is None or not 0 < length < meter.bar_ticks:
            return meter
        exact = next((u for u in METER_UNITS if u >= meter.unit and length * u % (4 * PPQ) == 0), None)
        return MeterChange(0, length * exact // (4 * PPQ), exact) if exact else meter

    def _tempos(self) -> dict[int, list[tuple[float, int]]]:
        """For each bar the tempos in it, (share of the bar, µs a quarter)."""
        found: dict[int, list[tuple[float, int]]] = {}
        for automation in self.root.findall("MasterTrack/Automations/Automation"):
            if text_of(automation, "Type") != "Tempo":
                continue
            bar = whole(text_of(automation, "Bar"))
            value, _, beat = text_of(automation, "Value").partition(" ")
            quarters = _BEAT_OF_TEMPO.get(whole(beat), Fraction(1))
            us = bpm_to_us(decimal(value) * float(quarters), self.source, bar)
            found.setdefault(bar, []).append((min(max(decimal(text_of(automation, "Position")), 0.0), 1.0), us))
        return found

    def _lost(self) -> Iterator[str]:
        if any(text_of(a, "Linear") == "true" for a in self.root.findall("MasterTrack/Automations/Automation")):
            yield "tempos that change gradually: each holds until the next"
        if any(master.find("Fermatas/Fermata") is not None for master in self.masters):
            yield "fermatas"
        if any(beat.find("Hairpin") is not None for beat in self.beats.values()):
            yield "hairpins"

    # --- beats --------------------------------------------------------------------------------------------------------

    def _bar_beats(self, track: DrumTrack, master: Element, i: int) -> tuple[tuple[TabBeat, ...], int]:
        """The beats of all voices of a bar, and how many bars before it stands what it repeats."""
        ids = text_of(master, "Bars").split()
        if track.column >= len(ids):
            raise BadInput(self.source, f"bar {i + 1}", f"has no bar for the track {track.name}")
        bar = self._find(self.bars, ids[track.column], "bar", i)
        voices = [v for v in text_of(bar, "Voices").split() if v != _NONE]
        beats = [beat for v in voices for beat in self._voice_beats(track, self._find(self.voices, v, "voice", i), i)]
        return tuple(beats), _SIMILE_BARS.get(text_of(bar, "SimileMark"), 0)

    def _voice_beats(self, track: DrumTrack, voice: Element, i: int) -> Iterator[TabBeat]:
        at, graces = Fraction(0), []  # type: Fraction, list[int]
        for beat_id in text_of(voice, "Beats").split():
            beat = self._beat(track, beat_id, i)
            self.beat_count += 1 + len(beat.notes)
            if self.beat_count > _MOST_DRUM_BEATS:
                raise BadInput(self.source, f"bar {i + 1}", f"more than {_MOST_DRUM_BEATS} drum beats and notes")
            if beat.is_grace:
                graces += [note.number for note in beat.notes]
                continue
            if beat.notes:
                start, end = round(at * PPQ), round((at + beat.quarters) * PPQ)
                notes = tuple(with_graces(beat.notes, graces)) if graces else beat.notes
                yield TabBeat(start, max(end - start, 1), notes, beat.is_tuplet)
            at, graces = at + beat.quarters, []

    def _beat(self, track: DrumTrack, beat_id: str, i: int) -> _Beat:
        """A beat for one track; bars that are alike share theirs, so each is read once."""
        key = (track.column, beat_id)
        if key not in self.known_beats:
            beat = self._find(self.beats, beat_id, "beat", i)
            ids = [n for n in text_of(beat, "Notes").split() if n != _NONE][:_MOST_NOTES]
            notes = tuple(self._note(track, beat, self._find(self.notes, n, "note", i)) for n in ids)
            is_grace = beat.find("GraceNotes") is not None
            self.known_beats[key] = _Beat(*self._rhythm(beat, i), notes, is_grace)
        return self.known_beats[key]

    def _find(self, table: Mapping[str, Element], key: str, what: str, i: int) -> Element:
        if key not in table:
            raise BadInput(self.source, f"bar {i + 1}", f"refers to the {what} {key[:20]}, which is nowhere")
        return table[key]

    def _rhythm(self, beat: Element, i: int) -> tuple[Fraction, bool]:
        """How many quarter notes a beat lasts, and whether it stands in a tuplet."""
        reference = beat.find("Rhythm")
        key = "" if reference is None else reference.get("ref", "")
        if key not in self.known_rhythms:
            self.known_rhythms[key] = self._length(self._find(self.rhythms, key, "rhythm", i), i)
        return self.known_rhythms[key]

    def _length(self, rhythm: Element, i: int) -> tuple[Fraction, bool]:
        name = text_of(rhythm, "NoteValue", "Quarter")
        if name not in _QUARTERS:
            raise BadInput(self.source, f"bar {i + 1}", f"a note value of {name[:20]!r}")
        dots = rhythm.find("AugmentationDot")
        count = 0 if dots is None else min(whole(dots.get("count", "1")), _MOST_DOTS)
        quarters = _QUARTERS[name] * (2 - Fraction(1, 2**count))
        ratio = tuplet_of(rhythm.find("PrimaryTuplet")) * tuplet_of(rhythm.find("SecondaryTuplet"))
        return quarters * ratio, ratio != 1

    def _note(self, track: DrumTrack, beat: Element, note: Element) -> TabNote:
        velocity = _VELOCITIES.get(text_of(beat, "Dynamic", _USUAL_DYNAMIC), _VELOCITIES[_USUAL_DYNAMIC])
        accent = whole(text_of(note, "Accent", "0"))
        is_ghost = text_of(note, "AntiAccent").lower() == "normal"
        dynamic = (
            Dynamic.ACCENT if accent & (_ACCENT | _HEAVY_ACCENT) else (Dynamic.GHOST if is_ghost else Dynamic.NORMAL)
        )
        tie = note.find("Tie")
        return TabNote(
            number_of_note(track, note),
            velocity,
            dynamic,
            tremolo_ticks=_TREMOLO_TICKS.get(text_of(beat, "Tremolo"), 0),
            is_tied=tie is not None and tie.get("destination", "").lower() == "true",
        )
