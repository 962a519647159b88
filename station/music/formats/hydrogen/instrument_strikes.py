"""Which instrument of a Hydrogen song plays a stroke, what it is called, and what of the stroke it does not say."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.core.note_map import NoteMeaning, general_midi_note
from station.core.pieces import Articulation, Piece, Zone
from station.core.sound_names import HIHAT_STEPS, SoundName, choose_sound, strike_of_sound
from station.music.formats.hydrogen.rock_kit import KIT, NAMES, kit_id
from station.music.formats.hydrogen.song_contents import Instrument
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature
from station.music.score import Note

_ADDITIONS: Mapping[tuple[SoundName, Zone], str] = MappingProxyType(
    {
        **{(step, Zone.EDGE): " Edge" for step in HIHAT_STEPS},
        **{
            (sound, Zone.BOW): " Bow"
            for sound in (SoundName.CRASH_1, SoundName.CRASH_2, SoundName.SPLASH, SoundName.CHINA)
        },
    }
)
"""What is added to an instrument's name where it is struck elsewhere than usual."""
_OF_THE_RIM = (Articulation.CROSS_STICK, Articulation.RIM_SHOT)
_ARTICULATIONS: Mapping[Articulation, Feature] = MappingProxyType(
    {
        Articulation.CROSS_STICK: Feature.CROSS_STICKS,
        Articulation.RIM_SHOT: Feature.RIM_SHOTS,
        Articulation.SPLASH: Feature.FOOT_SPLASHES,
        Articulation.BUZZ: Feature.BUZZES,
    }
)
_SENTENCES: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.PIECES: "pieces that Hydrogen's kit has not become the nearest",
        Feature.ZONES: "zones that have no instrument",
        Feature.RIM_SHOTS: "rim shots become plain strokes",
        Feature.CROSS_STICKS: "cross-sticks of other pieces than the snare",
        Feature.OPENNESS: "openings between those that have an instrument",
        Feature.FOOT_SPLASHES: "splashes of the hi-hat foot",
        Feature.BUZZES: "buzzes that are not of the snare, or no whole number of ticks long",
    }
)


@dataclass(frozen=True, slots=True)
class InstrumentStrike:
    """What an instrument is for: the sound that it has, and what its name adds to the sound's."""

    sound: SoundName
    addition: str = ""

    @property
    def name(self) -> str:
        """What the instrument is called."""
        return NAMES[self.sound] + self.addition


def instrument_for(note: Note, bar: int, losses: LostBars, for_kit: bool) -> InstrumentStrike:
    """The instrument for a stroke; what that does not say is told."""
    sound = choose_sound(NoteMeaning(note.piece, note.zone, note.articulation, note.openness)).sound
    own = InstrumentStrike(sound, _ADDITIONS.get((sound, note.zone), ""))
    strike = InstrumentStrike(KIT[kit_id(sound)].sound) if for_kit else own
    said = strike_of_sound(strike.sound)
    if said.piece is not note.piece:
        losses.add(Feature.PIECES, _SENTENCES[Feature.PIECES], bar)
    if said.zone is not note.zone and not strike.addition and note.articulation not in _OF_THE_RIM:
        losses.add(Feature.ZONES, _SENTENCES[Feature.ZONES], bar)
    if note.piece is Piece.HIHAT and said.openness != note.openness:
        losses.add(Feature.OPENNESS, _SENTENCES[Feature.OPENNESS], bar)
    for articulation, feature in _ARTICULATIONS.items():
        if (said.articulation is articulation) != (note.articulation is articulation):
            losses.add(feature, _SENTENCES[feature], bar)
    return strike


def instrument_of(number: int, strike: InstrumentStrike) -> Instrument:
    """The instrument `number` of a song."""
    meant = strike_of_sound(strike.sound)
    midi_note = general_midi_note(meant.piece, meant.zone, meant.articulation, meant.openness)
    return Instrument(number, strike.name, KIT[kit_id(strike.sound)].kind, midi_note)
