"""What a `<direction>` or `<sound>` says: loudness, tempo, swing, sections, the order of bars, letters of hands.

It stands in the bar that is read, at its place; from one bar to the next goes how loud an unmarked note is.
"""

import re
from collections.abc import Mapping
from fractions import Fraction
from xml.etree.ElementTree import Element

from station.core.pieces import Limb
from station.core.units import PPQ
from station.music.formats.music_xml.reading.note_reading import velocity_of
from station.music.formats.music_xml.written_bars import NUMBER, STOP, LostMarks, WrittenBar
from station.music.formats.safe_xml import text_of
from station.music.formats.words_of_swing import swing_in_words
from station.music.loudness_marks import FADE, GROW, USUAL
from station.music.swing import MAX_RATIO, MIN_RATIO, STRAIGHT, Swing
from station.music.tempo import TempoChange

VELOCITY_OF_MARK: Mapping[str, int] = {
    "ppp": 16, "pp": 33, "p": 49, "mp": 64, "mf": 80, "f": 96, "ff": 112, "fff": 126
}  # fmt: skip
"""What MuseScore and others play a mark with; ours are the words of this table."""
_LOUDER_WORDS = {"pppp": "ppp", "ffff": "fff", "sf": "f", "sfz": "f", "fz": "f", "fp": "p", "sfp": "p", "rfz": "f"}
_WEDGES = {"crescendo": GROW, "diminuendo": FADE, "stop": STOP}
_BEAT_UNITS = {
    name: Fraction(4 * PPQ, 2**k) for k, name in enumerate(("whole", "half", "quarter", "eighth", "16th", "32nd"))
}
_SWING_UNITS = {"eighth": PPQ // 2, "16th": PPQ // 4}
_STICK = re.compile(r"\s*([RL])\s*")
_SLOWEST_BPM, _FASTEST_BPM = 0.1, 10_000.0
"""What is outside is no tempo (our choice)."""
_TEMPO_WORDS = re.compile(r"rit|rall|accel|a tempo")
"""What these ask for the tempos of the file say."""
_ORDER = {"dacapo", "dalsegno", "tocoda", "fine", "segno", "coda"}


class DirectionReader:
    """Reads what stands beside the notes of one part; `base_velocity` (1–127) is an unmarked note's by now.

    `is_drums` False: another part's, whose words are not counted as lost.
    """

    def __init__(self, lost: LostMarks, is_drums: bool) -> None:
        self._lost, self._is_drums = lost, is_drums
        self.base_velocity = VELOCITY_OF_MARK[USUAL]

    def read(self, direction: Element, place: Fraction, bar: WrittenBar) -> None:
        """Read a `<direction>` that stands at `place` of `bar`."""
        sound = direction.find("sound")
        for kind in direction.iter("direction-type"):
            for sign in kind:
                self._read_sign(sign, place, bar, sound)
        if sound is not None:
            self.read_sound(sound, place, bar)

    def read_sound(self, sound: Element, place: Fraction, bar: WrittenBar) -> None:
        """Read a `<sound>` at `place` of `bar`: what a player does, whatever is printed."""
        signs = bar.signs
        if (tempo := NUMBER.fullmatch(sound.get("tempo", ""))) is not None:
            self._add_tempo(float(tempo[1]), place, bar)
        if (velocity := velocity_of(sound.get("dynamics"))) is not None:
            self.base_velocity = velocity
        signs.da_capo |= sound.get("dacapo") == "yes"
        signs.fine |= sound.get("fine") not in (None, "no")
        signs.repeat_from |= sound.get("forward-repeat") == "yes"
        signs.segno = signs.segno if (label := sound.get("segno")) is None else label[:20]
        signs.coda = signs.coda if (label := sound.get("coda")) is None else label[:20]
        signs.dal_segno = signs.dal_segno if (label := sound.get("dalsegno")) is None else label[:20]
        signs.to_coda = signs.to_coda if (label := sound.get("tocoda")) is None else label[:20]
        swing = sound.find("swing")
        if swing is not None:
            self._read_swing(swing, place, bar)

    def _read_sign(self, sign: Element, place: Fraction, bar: WrittenBar, sound: Element | None) -> None:
        if sign.tag == "dynamics":
            self._read_dynamics(sign, place, bar)
        elif sign.tag == "wedge" and sign.get("type") in _WEDGES:
            bar.loudness.append((place, _WEDGES[sign.get("type", "")]))
        elif sign.tag == "metronome":
            self._read_metronome(sign, place, bar, sound)
        elif sign.tag == "rehearsal":
            bar.section = " ".join((sign.text or "").split())[:100]
        elif sign.tag == "segno" and sound is None:
            bar.signs.segno = ""
        elif sign.tag == "coda" and sound is None:
            bar.signs.coda = ""
        elif sign.tag == "words" and (stick := _STICK.fullmatch(sign.text or "")):
            bar.letters.append((place, Limb.RIGHT_HAND if stick[1] == "R" else Limb.LEFT_HAND))
        elif sign.tag == "words":
            self._read_words(" ".join((sign.text or "").lower().split()), place, bar, sound)
        elif sign.tag in ("octave-shift", "pedal", "damp", "damp-all", "percussion"):
            self._lost.add(f"{sign.tag} signs", bar.name)

    def _read_words(self, words: str, place: Fraction, bar: WrittenBar, sound: Element | None) -> None:
        """What words say of swing and of the order where no `sound` does; all others are only words."""
        signs = bar.signs
        if (swing := swing_in_words(words)) is not None and (sound is None or sound.find("swing") is None):
            bar.swings.append((place, swing))
            return
        if sound is not None and set(sound.attrib) & _ORDER:
            return
        if re.match(r"d\. ?c\.|da capo", words):
            signs.da_capo = True
        elif re.match(r"d\. ?s\.|dal segno", words):
            signs.dal_segno = ""
        elif re.match(r"to coda", words):
            signs.to_coda = ""
        elif words == "fine":
            signs.fine = True
        elif words and sound is None and not _TEMPO_WORDS.match(words) and self._is_drums:
            self._lost.add("words", bar.name)

    def _read_dynamics(self, sign: Element, place: Fraction, bar: WrittenBar) -> None:
        for each in sign:
            word = _LOUDER_WORDS.get(each.tag, each.tag)
            if word not in VELOCITY_OF_MARK:
                self._lost.add("loudness marks of other words", bar.name)
                continue
            bar.loudness.append((place, word))
            self.base_velocity = VELOCITY_OF_MARK[word]

    def _read_metronome(self, sign: Element, place: Fraction, bar: WrittenBar, sound: Element | None) -> None:
        unit = _BEAT_UNITS.get(text_of(sign, "beat-unit"))
        number = re.search(r"\d{1,4}(?:\.\d{1,6})?", sign.findtext("per-minute") or "")
        if unit is None or number is None or len(sign.findall("beat-unit")) > 1:
            self._lost.add("metronome marks without a number", bar.name)
            return
        dots = len(sign.findall("beat-unit-dot"))
        beat = unit * (2 - Fraction(1, 2 ** min(dots, 2)))
        bar.beat_ticks = int(beat)
        if sound is None or sound.get("tempo") is None:
            self._add_tempo(float(number[0]) * float(beat / PPQ), place, bar)

    def _add_tempo(self, tempo_bpm: float, place: Fraction, bar: WrittenBar) -> None:
        if not _SLOWEST_BPM <= tempo_bpm <= _FASTEST_BPM:
            self._lost.add("tempos that are none", bar.name)
            return
        bar.tempos.append((place, TempoChange.from_bpm(0, tempo_bpm).us_per_quarter))

    def _read_swing(self, swing: Element, place: Fraction, bar: WrittenBar) -> None:
        if swing.find("straight") is not None:
            bar.swings.append((place, Swing()))
            return
        first, second = text_of(swing, "first"), text_of(swing, "second")
        unit = _SWING_UNITS.get(text_of(swing, "swing-type", "eighth"))
        are_numbers = re.fullmatch(r"[1-9]\d{0,5}", first) and re.fullmatch(r"[1-9]\d{0,5}", second)
        ratio = int(first) / int(second) if are_numbers else 0.0
        if unit is None or not MIN_RATIO <= ratio <= MAX_RATIO:
            self._lost.add("swings that nobody plays", bar.name)
            return
        bar.swings.append((place, Swing(ratio, unit) if ratio != STRAIGHT else Swing()))
