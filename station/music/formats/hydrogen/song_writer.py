"""Songs and patterns as the XML that Hydrogen 1.2 opens.

Instruments bear the recordings of Hydrogen's own kit, which every Hydrogen has; those that the kit lacks borrow what
stands in for them.
"""

from xml.etree.ElementTree import Element, SubElement, indent, tostring

from station.core.sound_names import SoundName
from station.core.sound_naming import sound_named
from station.music.formats.hydrogen.rock_kit import KIT, ROCK_KIT, kit_id
from station.music.formats.hydrogen.song_contents import HydrogenSong, Instrument, Pattern, PatternNote

_NAMESPACE = "http://www.hydrogen-music.org/drumkit_pattern"
_VERSION = "1.2.0"
_SYSTEM_KIT = 2
"""Where Hydrogen looks for a kit: among those that came with it."""
_HIHATS, _NO_GROUP = 0, -1
_Fields = tuple[tuple[str, str], ...]

_HEAD: _Fields = (
    ("volume", "0.5"),
    ("metronomeVolume", "0.5"),
)
_MODE: _Fields = (
    ("license", "undefined license"),
    ("loopEnabled", "true"),
    ("patternModeMode", "true"),
    ("playbackTrackFilename", ""),
    ("playbackTrackEnabled", "false"),
    ("playbackTrackVolume", "0"),
    ("action_mode", "0"),
    ("isPatternEditorLocked", "false"),
    ("mode", "song"),
    ("pan_law_type", "RATIO_STRAIGHT_POLYGONAL"),
    ("pan_law_k_norm", "1.33333"),
    ("humanize_time", "0"),
    ("humanize_velocity", "0"),
)
_SOUND: _Fields = (
    ("volume", "1"),
    ("isMuted", "false"),
    ("isSoloed", "false"),
    ("pan", "0"),
    ("gain", "1"),
    ("applyVelocity", "true"),
    ("filterActive", "false"),
    ("filterCutoff", "1"),
    ("filterResonance", "0"),
    *((f"FX{i}Level", "0") for i in range(1, 5)),
    ("Attack", "0"),
    ("Decay", "0"),
    ("Sustain", "1"),
    ("Release", "1000"),
    ("pitchOffset", "0"),
    ("randomPitchFactor", "0"),
)
_LAYER: _Fields = (
    ("ismodified", "false"),
    ("smode", "forward"),
    *((name, "0") for name in ("startframe", "loopframe", "loops", "endframe", "userubber")),
    ("rubberdivider", "1"),
    ("rubberCsettings", "4"),
    ("rubberPitch", "1"),
)
_EFFECT: _Fields = (("name", "no plugin"), ("filename", "-"), ("enabled", "false"), ("volume", "0.0"))


def song_bytes(song: HydrogenSong) -> bytes:
    """`song` as an `.h2song`."""
    root = Element("song")
    _fill(root, (("version", _VERSION), ("bpm", _number(song.bpm)), *_HEAD))
    _fill(root, (("name", song.name), ("author", song.author), ("notes", song.about), *_MODE))
    _fill(root, (("swing_factor", _number(song.swing_factor)),))
    _fill(root, (("isTimelineActivated", "true" if song.tempos else "false"), ("last_loaded_drumkit_name", ROCK_KIT)))
    components = SubElement(SubElement(root, "componentList"), "drumkitComponent")
    _fill(components, (("id", "0"), ("name", "Main"), ("volume", "1")))
    band = SubElement(root, "instrumentList")
    for instrument in song.instruments:
        _write_instrument(band, instrument)
    patterns = SubElement(root, "patternList")
    for pattern in song.patterns:
        element = SubElement(patterns, "pattern")
        _fill(element, (("name", pattern.name), ("category", "not_categorized"), *_size(pattern), ("info", "")))
        _write_notes(element, pattern)
    SubElement(root, "virtualPatternList")
    sequence = SubElement(root, "patternSequence")
    for names in song.columns:
        _fill(SubElement(sequence, "group"), tuple(("patternID", name) for name in names))
    effects = SubElement(root, "ladspa")
    for _ in range(4):
        _fill(SubElement(effects, "fx"), _EFFECT)
    timeline, tags = SubElement(root, "BPMTimeLine"), SubElement(root, "timeLineTag")
    for bar, bpm in song.tempos:
        _fill(SubElement(timeline, "newBPM"), (("BAR", str(bar)), ("BPM", _number(bpm))))
    for bar, name in song.tags:
        _fill(SubElement(tags, "newTAG"), (("BAR", str(bar)), ("TAG", name)))
    SubElement(SubElement(root, "automationPaths"), "path", adjust="velocity")
    return _xml(root)


def pattern_bytes(song: HydrogenSong) -> bytes:
    """The one pattern of `song` as an `.h2pattern` for Hydrogen's own kit."""
    pattern = song.patterns[0]
    root = Element("drumkit_pattern", xmlns=_NAMESPACE)
    _fill(root, (("drumkit_name", ROCK_KIT), ("author", song.author), ("license", "undefined license")))
    element = SubElement(root, "pattern")
    head = (("name", pattern.name), ("info", song.about), ("category", "not_categorized"), *_size(pattern))
    _fill(element, head)
    _write_notes(element, pattern)
    return _xml(root)


def _xml(root: Element) -> bytes:
    indent(root, " ")
    written: bytes = tostring(root, encoding="UTF-8", xml_declaration=True)
    return written + b"\n"


def _fill(element: Element, fields: _Fields) -> None:
    for name, text in fields:
        SubElement(element, name).text = text


def _number(value: float) -> str:
    return f"{value:.12g}"


def _size(pattern: Pattern) -> _Fields:
    return (("size", str(pattern.size)), ("denominator", str(pattern.denominator)))


def _write_instrument(band: Element, instrument: Instrument) -> None:
    sound = sound_named(instrument.name) or SoundName.PERCUSSION
    model = KIT[kit_id(sound)]
    element = SubElement(band, "instrument")
    head = (("id", str(instrument.id)), ("name", instrument.name), ("drumkit", ROCK_KIT))
    _fill(element, (*head, ("drumkitLookup", str(_SYSTEM_KIT)), *_SOUND))
    mute_group = _HIHATS if model.name.startswith("Hat") else _NO_GROUP
    _fill(element, (("muteGroup", str(mute_group)), ("isStopNote", "false"), ("sampleSelectionAlgo", "VELOCITY")))
    _fill(element, (("midiOutChannel", "-1"), ("midiOutNote", str(instrument.midi_note or 0)), ("isHihat", "-1")))
    _fill(element, (("lower_cc", "0"), ("higher_cc", "127")))
    component = SubElement(element, "instrumentComponent")
    _fill(component, (("component_id", "0"), ("gain", "1")))
    count = len(model.recordings)
    for i, recording in enumerate(model.recordings):
        reach = (("min", _number(i / count)), ("max", _number((i + 1) / count)), ("gain", "1"), ("pitch", "0"))
        _fill(SubElement(component, "layer"), (("filename", recording), *_LAYER, *reach))


def _write_notes(element: Element, pattern: Pattern) -> None:
    notes = SubElement(element, "noteList")
    for note in pattern.notes:
        _fill(SubElement(notes, "note"), _note(note))


def _note(note: PatternNote) -> _Fields:
    """Without the type that newer patterns may have: no pattern with one is a pattern by the schema of 1.2."""
    return (
        ("position", str(note.position)),
        ("leadlag", _number(note.lead_lag)),
        ("velocity", _number(note.velocity)),
        ("pan", "0"),
        ("pitch", "0"),
        ("key", "C0"),
        ("length", str(note.length)),
        ("instrument", str(note.instrument)),
        ("note_off", "true" if note.is_stop else "false"),
        ("probability", _number(note.probability)),
    )
