"""The half of the engine that the sound card drives: cues on their frame, strokes at once.

One thread hands things in (`play`, `strike`, …), another asks for blocks (`render`); between them lies a queue whose
operations are atomic, so neither ever waits for the other and the mixer is touched by the asking thread alone. Without
a mixer nothing sounds: then `pass_by` stands in for `render` and the transport runs on the clock that it is told.

Block times are when a block's first frame is heard, in session time; the card's drift against that clock thus never
moves a cue.
"""

from collections import deque
from collections.abc import Callable, Mapping
from functools import partial
from math import isnan

import numpy as np
from numpy.typing import NDArray

from station.core.events import Choke, DeviceEvent, Hit, PedalMoved
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_S
from station.engine.cue_queue import Cue, CueQueue, CueRun
from station.sound.buses import Bus, ClickVoice
from station.sound.drum_kit import DrumKit, Frames
from station.sound.mixer import Mixer
from station.sound.track import Track

Level = tuple[float, float]
_FULL: Level = (1.0, 0.0)


class SoundPlayer:
    """Sounds strokes and cues."""

    def __init__(self, mixer: Mixer | None = None) -> None:
        self._inbox: deque[Callable[[int], None]] = deque()
        self._zeros: deque[int] = deque()
        self._playback = CueQueue()
        self._levels = dict.fromkeys(Bus, _FULL)
        self._master = 1.0
        self._of_pieces: dict[Piece, Level] = {}
        self._passed_ns = 0
        self._track: Track | None = None
        self._track_at_ns = 0
        self._track_plays = False
        self._mixer: Mixer | None = None
        self.attach(mixer)

    # --- handing in --------------------------------------------------------------------------------------------------

    def attach(self, mixer: Mixer | None) -> None:
        """Sound through `mixer` from now on, None for not at all; only while nobody calls `render`."""
        self._mixer = mixer
        self._track_plays = False
        if mixer is not None:
            for bus, (level, pan) in self._levels.items():
                mixer.set_level(bus, self._master * level, pan)
            for piece, (level, pan) in self._of_pieces.items():
                mixer.set_piece(piece, level, pan)

    @property
    def is_silent(self) -> bool:
        """Whether nothing sounds."""
        return self._mixer is None

    @property
    def rate_hz(self) -> int | None:
        """The rate of what sounds; None where nothing does."""
        return self._mixer.kit.rate_hz if self._mixer is not None else None

    @property
    def has_cues(self) -> bool:
        """Whether the transport runs and something is still to sound."""
        return self._playback.has_cues

    @property
    def late_cues(self) -> int:
        """Cues dropped because their time had passed, since the start."""
        return self._playback.late

    def play(self, run: CueRun, asked_ns: int) -> None:
        """Start the transport with its zero at `asked_ns`, or at the next block if that is later."""
        self._inbox.append(partial(self._start, run, asked_ns))

    def resume(self, run: CueRun, zero_ns: int) -> None:
        """Run the transport on whose zero was heard at `zero_ns`; what lies behind the next block is over."""
        self._inbox.append(lambda block_ns: self._playback.resume(run, zero_ns, block_ns))

    def add(self, run: CueRun) -> None:
        """Let `run` sound too in the transport that runs, or that was handed in to start."""
        self._inbox.append(lambda _: self._playback.add(run))

    def stop(self) -> None:
        """Stop the transport; what rings, rings out."""
        self._inbox.append(lambda _: self._stop())

    def set_track(self, track: Track | None, at_ns: int) -> None:
        """Play `track` from `at_ns` of transport time on, whenever the transport runs; one of another rate is mute."""
        self._inbox.append(lambda _: self._change_track(track, at_ns))

    def set_level(self, bus: Bus, level: float, pan: float) -> None:
        """Set a bus's level and pan."""
        self._levels[bus] = level, pan
        heard = self._master * level
        self._to_mixer(lambda mixer: mixer.set_level(bus, heard, pan))

    def set_master(self, level: float) -> None:
        """Set the level of all that sounds."""
        self._master = min(1.0, max(0.0, level))
        for bus, (own, pan) in self._levels.items():
            self.set_level(bus, own, pan)

    def use_sounds(self, kit: DrumKit, clicks: Mapping[ClickVoice, Frames]) -> None:
        """Sound by another kit and other clicks from the next block on; of another rate than the mixer's: ignored."""
        self._to_mixer(lambda mixer: mixer.use(kit, clicks) if mixer.kit.rate_hz == kit.rate_hz else None)

    def set_piece(self, piece: Piece, level: float, pan: float) -> None:
        """Set a piece's level and pan."""
        self._of_pieces[piece] = level, pan
        self._to_mixer(lambda mixer: mixer.set_piece(piece, level, pan))

    def sound(self, event: DeviceEvent) -> None:
        """Sound what the student did with the next block."""
        match event:
            case Hit():
                self.strike(
                    NoteMeaning(event.piece, event.zone, event.articulation, event.openness), event.fine_velocity
                )
            case Choke():
                self.choke(event.piece)
            case PedalMoved():
                self.pedal(event.openness)
            case _:
                pass

    def strike(self, strike: NoteMeaning, velocity: float) -> None:
        """Sound the student's stroke with the next block."""
        self._to_mixer(lambda mixer: mixer.trigger(Bus.STUDENT, strike, velocity))

    def choke(self, piece: Piece) -> None:
        """Grab the student's ringing cymbal."""
        self._to_mixer(lambda mixer: mixer.choke(Bus.STUDENT, piece))

    def pedal(self, openness: float) -> None:
        """Move the student's hi-hat pedal."""
        self._to_mixer(lambda mixer: mixer.pedal(Bus.STUDENT, openness))

    def pop_zeros_ns(self) -> list[int]:
        """The transport's zeros since the last call, one for every start that has taken effect."""
        zeros = []
        while self._zeros:
            zeros.append(self._zeros.popleft())
        return zeros

    # --- sounding ----------------------------------------------------------------------------------------------------

    def render(self, frames: int, dac_ns: int) -> NDArray[np.float32]:
        """The next block: float32 (frames, 2), whose first frame is heard at `dac_ns`."""
        assert self._mixer is not None, "whoever renders has attached a mixer"
        rate_hz = self._mixer.kit.rate_hz
        self._empty_inbox(dac_ns)
        self._place_track(self._mixer, dac_ns, frames)
        for cue in self._playback.pop_due(dac_ns, dac_ns + frames * NS_PER_S // rate_hz):
            at_frame = round((cue.at_ns - dac_ns) * rate_hz / NS_PER_S)
            _sound(self._mixer, cue, max(0, at_frame))
        return self._mixer.render(frames)

    def pass_by(self, now_ns: int) -> None:
        """Stand in for the card where nothing sounds: what is due between the last call and `now_ns` is over.

        What was handed in takes effect now: while a card played, the last call may have been long ago.
        """
        self._empty_inbox(now_ns)
        self._playback.pop_due(self._passed_ns, now_ns)
        self._passed_ns = now_ns

    def _empty_inbox(self, block_ns: int) -> None:
        while self._inbox:
            self._inbox.popleft()(block_ns)

    def _start(self, run: CueRun, asked_ns: int, block_ns: int) -> None:
        zero_ns = max(asked_ns, block_ns)
        self._playback.start(run, zero_ns)
        self._zeros.append(zero_ns)
        self._track_plays = False

    def _stop(self) -> None:
        self._playback.stop()
        self._silence_track()

    def _change_track(self, track: Track | None, at_ns: int) -> None:
        self._silence_track()
        self._track, self._track_at_ns = track, at_ns

    def _silence_track(self) -> None:
        self._track_plays = False
        if self._mixer is not None:
            self._mixer.stop_track()

    def _place_track(self, mixer: Mixer, dac_ns: int, frames: int) -> None:
        """Start the track on its frame, and from then on keep it where the transport is."""
        zero_ns, rate_hz = self._playback.zero_ns, mixer.kit.rate_hz
        if self._track is None or zero_ns is None or self._track.rate_hz != rate_hz:
            return
        ahead = round((zero_ns + self._track_at_ns - dac_ns) * rate_hz / NS_PER_S)
        if self._track_plays:
            mixer.keep_track_at(-ahead)
        elif ahead < frames:
            mixer.play_track(self._track, max(0, ahead))
            self._track_plays = True

    def _to_mixer(self, action: Callable[[Mixer], None]) -> None:
        def act(_: int) -> None:
            if self._mixer is not None:
                action(self._mixer)

        self._inbox.append(act)


def _sound(mixer: Mixer, cue: Cue, at_frame: int) -> None:
    bus = Bus(cue.bus)
    if bus is Bus.CLICK:
        mixer.click(ClickVoice(cue.piece), cue.velocity, at_frame)
    elif cue.velocity == 0:
        mixer.choke(bus, Piece(cue.piece), at_frame)
    else:
        openness = None if isnan(cue.openness) else cue.openness
        strike = NoteMeaning(Piece(cue.piece), Zone(cue.zone), Articulation(cue.articulation), openness)
        mixer.trigger(bus, strike, cue.velocity, at_frame)
