import tracemalloc
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.sound_names import SoundName
from station.sound.bus_levels import LEVEL_SLEW_S
from station.sound.buses import Bus, ClickVoice
from station.sound.drum_kit import DrumKit, Frames
from station.sound.limiter import KNEE
from station.sound.mixer import (
    CHOKE_S,
    CLOSE_S,
    MAX_VOICES,
    PIECE_FRAMES,
    RETIRE_S,
    SAME_PIECE_VOICES,
    STEAL_S,
    Mixer,
)
from tests.unit.sound.kits import RATE_HZ, constant, impulse, mixer_of, sound_of

KICK = NoteMeaning(Piece.KICK)
SNARE = NoteMeaning(Piece.SNARE)
OPEN_HAT = NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=1.0)
HALF_HAT = NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=0.5)
CLOSED_HAT = NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=0.0)
CHICK = NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, 0.0)
FOOT_SPLASH = NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH)
CRASH = NoteMeaning(Piece.CRASH_1, Zone.EDGE)


def frames_in(seconds: float) -> int:
    return round(seconds * RATE_HZ)


def left(block: Frames) -> list[float]:
    return [float(x) for x in block[:, 0]]


def test_silence_is_exactly_silent() -> None:
    block = mixer_of().render(1000)
    assert block.shape == (1000, 2)
    assert block.dtype == np.float32
    assert not block.any()


def test_a_piece_has_a_level_and_a_place_of_its_own_whoever_plays_it() -> None:
    """By hand: half of 0.4 on the left alone; from the next stroke on, and of this piece alone."""
    mixer = mixer_of({SoundName.KICK: constant(0.4, 1000), SoundName.SNARE: impulse(0.4)})
    mixer.trigger(Bus.STUDENT, KICK, 127)
    mixer.render(1)
    mixer.set_piece(Piece.KICK, 0.5, -1.0)
    assert mixer.render(10)[9].tolist() == pytest.approx([0.4, 0.4])
    mixer.trigger(Bus.DEMONSTRATION, KICK, 127)
    assert mixer.render(1)[0].tolist() == pytest.approx([0.6, 0.4])
    mixer.silence()
    mixer.trigger(Bus.STUDENT, SNARE, 127)
    assert mixer.render(1)[0].tolist() == pytest.approx([0.4, 0.4])
    mixer.set_piece(Piece.KICK, 2.0)
    mixer.trigger(Bus.STUDENT, KICK, 100)
    assert mixer.render(1)[0].tolist() == pytest.approx([0.8 * (100 / 127) ** 2] * 2)


def test_a_piece_on_one_side_stays_there_while_it_is_stolen() -> None:
    mixer = mixer_of({SoundName.KICK: constant(0.5, 5000), SoundName.SNARE: impulse(0.0)}, voices=1)
    mixer.set_piece(Piece.KICK, 1.0, 1.0)
    mixer.trigger(Bus.STUDENT, KICK, 127)
    mixer.render(10)
    mixer.trigger(Bus.STUDENT, SNARE, 127)
    tail = mixer.render(frames_in(STEAL_S))
    assert tail[0, 1] > 0.4
    assert not tail[:, 0].any()


@pytest.mark.parametrize("at_frame", [0, 1, 63, 64, 249, 250, 251, 600])
@pytest.mark.parametrize("block", [16, 64, 250, 256, 1024])
def test_a_stroke_falls_on_the_frame_it_was_asked_for(at_frame: int, block: int) -> None:
    mixer = mixer_of({SoundName.KICK: impulse(0.5)})
    mixer.trigger(Bus.STUDENT, KICK, 127, at_frame)
    sound = np.concatenate([mixer.render(block) for _ in range(1 + at_frame // block)])
    assert np.flatnonzero(sound[:, 0]).tolist() == [at_frame]
    assert sound[at_frame].tolist() == [0.5, 0.5]


def test_the_frame_counts_from_the_next_block() -> None:
    mixer = mixer_of({SoundName.KICK: impulse(0.5)})
    mixer.render(100)
    mixer.trigger(Bus.STUDENT, KICK, 127, 7)
    assert mixer.frame == 100
    assert np.flatnonzero(mixer.render(64)[:, 0]).tolist() == [7]


def test_a_frame_in_the_past_is_now() -> None:
    mixer = mixer_of({SoundName.KICK: impulse(0.5)})
    mixer.trigger(Bus.STUDENT, KICK, 127, -20)
    assert np.flatnonzero(mixer.render(64)[:, 0]).tolist() == [0]


# 0.8 · (v/127)², by hand.
@pytest.mark.parametrize(("velocity", "level"), [(127, 0.8), (90, 0.40176), (90.5, 0.40623), (1, 0.0000496)])
def test_the_level_follows_the_velocity(velocity: float, level: float) -> None:
    mixer = mixer_of({SoundName.KICK: impulse(0.8)})
    mixer.trigger(Bus.STUDENT, KICK, velocity)
    assert mixer.render(1)[0, 0] == pytest.approx(level, rel=1e-3)


def test_strokes_on_one_frame_add_up() -> None:
    mixer = mixer_of({SoundName.KICK: constant(0.1), SoundName.SNARE: constant(0.25)})
    mixer.trigger(Bus.STUDENT, KICK, 127, 10)
    mixer.trigger(Bus.DEMONSTRATION, SNARE, 127, 10)
    assert left(mixer.render(12)) == pytest.approx([0.0] * 10 + [0.35] * 2)


def test_both_channels_keep_their_own_sound() -> None:
    sound = np.column_stack([np.full(50, 0.1), np.full(50, 0.3)]).astype(np.float32)
    mixer = mixer_of({SoundName.KICK: sound})
    mixer.trigger(Bus.STUDENT, KICK, 127)
    assert mixer.render(50) == pytest.approx(sound)


def test_a_sound_plays_to_its_last_frame_and_its_voice_is_free() -> None:
    ramp = np.repeat(np.linspace(0.5, 0.1, 300, dtype=np.float32)[:, None], 2, axis=1)
    mixer = mixer_of({SoundName.KICK: ramp})
    mixer.trigger(Bus.STUDENT, KICK, 127)
    sound = np.concatenate([mixer.render(64) for _ in range(6)])
    assert sound[:300] == pytest.approx(ramp)
    assert not sound[300:].any()
    assert mixer.ringing == 0


def test_takes_alternate() -> None:
    takes = (impulse(0.1), impulse(0.2))
    kit = DrumKit(
        "takes", RATE_HZ, {n: sound_of(*takes) for n in (SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED)}
    )
    mixer = Mixer(kit, {})
    heard = []
    for strike in (KICK, KICK, SNARE, KICK):
        mixer.trigger(Bus.STUDENT, strike, 127)
        heard.append(float(mixer.render(1)[0, 0]))
        mixer.render(200)
    assert heard == pytest.approx([0.1, 0.2, 0.1, 0.1])  # each sound takes its own turns


# --- clicks ----------------------------------------------------------------------------------------------------------


def test_clicks_sound_on_their_bus() -> None:
    mixer = mixer_of()
    mixer.set_level(Bus.STUDENT, 0.0)
    mixer.set_level(Bus.DEMONSTRATION, 0.0)
    mixer.render(1000)
    for frame, voice in enumerate(ClickVoice):
        mixer.click(voice, 127, frame)
    assert left(mixer.render(3)) == pytest.approx([0.1, 0.2, 0.3])


def test_a_click_has_a_velocity() -> None:
    mixer = mixer_of()
    mixer.click(ClickVoice.SUBDIVISION, 90)
    assert mixer.render(1)[0, 0] == pytest.approx(0.3 * 0.50220, rel=1e-3)  # (90/127)²


# --- chokes and the hi-hat's pedal -----------------------------------------------------------------------------------


def ringing(*strikes: NoteMeaning, bus: Bus = Bus.STUDENT) -> Mixer:
    """A mixer in which these ring at level 0.1 each, some milliseconds after their strokes, all sounds constant."""
    mixer = mixer_of(default=constant(0.1, 5 * RATE_HZ))
    for strike in strikes:
        mixer.trigger(bus, strike, 127)
    mixer.render(500)
    return mixer


def largest_step(sound: Frames) -> float:
    return float(np.abs(np.diff(sound[:, 0])).max())


def test_a_choke_fades_in_a_straight_line_within_its_time() -> None:
    mixer = ringing(CRASH)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1, at_frame=100)
    count = frames_in(CHOKE_S)
    sound = np.concatenate([mixer.render(64) for _ in range(60)])[:, 0]
    assert sound[:100] == pytest.approx(np.full(100, 0.1))
    assert sound[100 : 100 + count] == pytest.approx(0.1 * (1 - np.arange(count) / count), abs=1e-6)
    assert not sound[100 + count :].any()
    assert mixer.ringing == 0
    assert CHOKE_S <= 0.060


def test_a_choke_grabs_only_its_piece_and_bus() -> None:
    mixer = ringing(CRASH, NoteMeaning(Piece.RIDE))
    mixer.trigger(Bus.DEMONSTRATION, CRASH, 127)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1)
    mixer.render(frames_in(0.1))
    assert mixer.render(1)[0, 0] == pytest.approx(0.2)
    assert mixer.ringing == 2


def test_a_second_choke_does_not_lengthen_the_first() -> None:
    mixer = ringing(CRASH)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1)
    mixer.choke(Bus.STUDENT, Piece.CRASH_1, at_frame=frames_in(CHOKE_S) - 10)
    mixer.render(frames_in(CHOKE_S))
    assert mixer.ringing == 0


@pytest.mark.parametrize("closer", [CLOSED_HAT, CHICK])
def test_closing_the_hihat_cuts_the_open_one(closer: NoteMeaning) -> None:
    mixer = ringing(OPEN_HAT)
    mixer.trigger(Bus.STUDENT, closer, 127)
    mixer.render(frames_in(CLOSE_S) + 1)
    assert mixer.ringing == 1  # the closer itself
    assert mixer.render(1)[0, 0] == pytest.approx(0.1)


def test_an_open_stroke_leaves_what_rings() -> None:
    mixer = ringing(CLOSED_HAT, OPEN_HAT)
    mixer.trigger(Bus.STUDENT, OPEN_HAT, 127)
    mixer.render(frames_in(1.0))
    assert mixer.ringing == 3


def test_a_foot_splash_rings_until_the_foot_closes() -> None:
    mixer = ringing(FOOT_SPLASH)
    mixer.render(frames_in(1.0))
    assert mixer.ringing == 1
    mixer.pedal(Bus.STUDENT, 0.0)
    mixer.render(frames_in(CLOSE_S))
    assert mixer.ringing == 0


def test_the_pedal_damps_the_more_the_further_it_closes() -> None:
    silent_after = []
    for openness in (0.0, 0.2, 0.4):
        mixer = ringing(OPEN_HAT)
        mixer.pedal(Bus.STUDENT, openness)
        blocks = 0
        while mixer.ringing:
            mixer.render(64)
            blocks += 1
        silent_after.append(blocks)
    assert silent_after == sorted(set(silent_after))


def test_opening_the_pedal_damps_nothing() -> None:
    mixer = ringing(HALF_HAT)
    mixer.pedal(Bus.STUDENT, 0.9)
    mixer.render(frames_in(1.5))
    assert mixer.ringing == 1


def test_the_pedal_of_one_bus_leaves_the_other() -> None:
    mixer = ringing(OPEN_HAT, bus=Bus.DEMONSTRATION)
    mixer.pedal(Bus.STUDENT, 0.0)
    mixer.trigger(Bus.STUDENT, CLOSED_HAT, 127)
    mixer.render(frames_in(0.2))
    assert mixer.ringing == 2


# --- levels ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("level", "pan", "channels"),
    [
        (1.0, 0.0, (0.1, 0.1)),
        (0.5, 0.0, (0.05, 0.05)),
        (1.0, 1.0, (0.0, 0.1)),
        (1.0, -1.0, (0.1, 0.0)),
        (1.0, 0.5, (0.05, 0.1)),
        (0.5, -0.5, (0.05, 0.025)),
        (7.0, -3.0, (0.1, 0.0)),
    ],
)
def test_a_bus_has_level_and_balance(level: float, pan: float, channels: tuple[float, float]) -> None:
    mixer = ringing(CRASH)
    mixer.set_level(Bus.STUDENT, level, pan)
    mixer.render(frames_in(LEVEL_SLEW_S))
    assert mixer.render(3)[-1] == pytest.approx(channels, abs=1e-6)


def test_a_level_moves_without_a_step() -> None:
    mixer = ringing(CRASH)
    mixer.set_level(Bus.STUDENT, 0.0)
    sound = np.concatenate([mixer.render(100) for _ in range(10)])
    assert largest_step(sound) <= 0.1 / frames_in(LEVEL_SLEW_S) * 1.01
    assert not sound[frames_in(LEVEL_SLEW_S) + 1 :].any()


def test_levels_of_the_buses_are_their_own() -> None:
    mixer = ringing(CRASH)
    mixer.trigger(Bus.DEMONSTRATION, CRASH, 127)
    mixer.set_level(Bus.DEMONSTRATION, 0.5)
    mixer.render(1000)
    assert mixer.render(1)[0, 0] == pytest.approx(0.15)


# --- more than it has voices for -------------------------------------------------------------------------------------

PIECES = [piece for piece in Piece if piece not in (Piece.HIHAT, Piece.HIHAT_PEDAL)]


def full_mixer(level: float) -> Mixer:
    """Every voice of a mixer rings at `level`, some louder and one, the ride's, at a quarter of it; none is new."""
    mixer = mixer_of({SoundName.RIDE_BOW: constant(level / 4), SoundName.COWBELL: impulse(0.5)}, constant(level))
    others = [piece for piece in PIECES if piece not in (Piece.RIDE, Piece.COWBELL)]
    for index in range(MAX_VOICES - 1):
        mixer.trigger(Bus.STUDENT, NoteMeaning(others[index % len(others)]), 127)
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.RIDE), 127)
    mixer.render(300)
    return mixer


def test_the_quietest_voice_makes_room() -> None:
    mixer = full_mixer(0.01)
    assert mixer.ringing == MAX_VOICES
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.COWBELL), 127)
    mixer.render(frames_in(STEAL_S) + 100)
    assert mixer.render(1)[0, 0] == pytest.approx(0.01 * (MAX_VOICES - 1), rel=1e-4)  # the ride went


def test_a_stolen_voice_fades_without_a_step() -> None:
    mixer = full_mixer(0.02)
    sound = mixer.render(100)
    mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.TOM_1), 1, 0)  # itself a step of 0.02/127²
    sound = np.concatenate([sound, *(mixer.render(64) for _ in range(10))])
    assert largest_step(sound) <= 0.005 / frames_in(STEAL_S) + 2e-6
    assert sound[99, 0] - sound[-1, 0] == pytest.approx(0.005, abs=1e-5)


def test_a_burst_of_strokes_never_exceeds_the_voices_nor_full_scale() -> None:
    mixer = mixer_of(default=constant(0.5, 20_000))
    for index in range(500):
        mixer.trigger(Bus(index % 3), NoteMeaning(PIECES[index % len(PIECES)]), 127, index)
    for _ in range(40):
        block = mixer.render(64)
        assert mixer.ringing <= MAX_VOICES
        assert np.abs(block).max() <= 1.0


def test_a_roll_on_one_piece_keeps_to_its_share() -> None:
    mixer = mixer_of(default=constant(0.01, 5 * RATE_HZ))
    for _ in range(20):
        mixer.trigger(Bus.STUDENT, CRASH, 127)
        mixer.render(frames_in(RETIRE_S) + 1)
    assert mixer.ringing == SAME_PIECE_VOICES


def test_too_loud_is_bent_and_loud_enough_is_not() -> None:
    mixer = mixer_of(default=constant(0.39))
    for piece in (Piece.KICK, Piece.SNARE):
        mixer.trigger(Bus.STUDENT, NoteMeaning(piece), 127)
    assert mixer.render(10)[-1, 0] == np.float32(0.39) + np.float32(0.39)
    assert KNEE > 0.78
    for piece in (Piece.TOM_1, Piece.TOM_2, Piece.CRASH_1):
        mixer.trigger(Bus.STUDENT, NoteMeaning(piece), 127)
    assert KNEE < mixer.render(10)[-1, 0] <= 1.0


# --- any block size --------------------------------------------------------------------------------------------------

Action = Callable[[Mixer, int], None]


def _trigger(bus: Bus, strike: NoteMeaning, velocity: int) -> Action:
    return lambda mixer, at: mixer.trigger(bus, strike, velocity, at)


def _choke(bus: Bus, piece: Piece) -> Action:
    return lambda mixer, at: mixer.choke(bus, piece, at)


def _pedal(bus: Bus, openness: float) -> Action:
    return lambda mixer, at: mixer.pedal(bus, openness, at)


STRIKES = [KICK, SNARE, OPEN_HAT, HALF_HAT, CLOSED_HAT, CHICK, FOOT_SPLASH, CRASH]
actions = st.one_of(
    st.builds(_trigger, st.sampled_from(Bus), st.sampled_from(STRIKES), st.integers(1, 127)),
    st.builds(_choke, st.sampled_from(Bus), st.sampled_from([Piece.CRASH_1, Piece.HIHAT])),
    st.builds(_pedal, st.sampled_from(Bus), st.floats(0.0, 1.0)),
)
TOTAL = 3000
VOICES = 8


def _noise_mixer() -> Mixer:
    rng = np.random.default_rng(3)
    sounds = {name: rng.uniform(-0.03, 0.03, (int(rng.integers(50, 5000)), 2)).astype(np.float32) for name in SoundName}
    return mixer_of(sounds, voices=VOICES)


@settings(max_examples=30, deadline=None)
@given(
    st.lists(st.tuples(st.integers(0, TOTAL), actions), max_size=VOICES),  # so that none is stolen
    st.lists(st.integers(7, 700), min_size=1, max_size=12),
)
def test_the_same_actions_give_the_same_sound_however_it_is_asked_for(
    plan: list[tuple[int, Action]], sizes: list[int]
) -> None:
    whole, pieces = _noise_mixer(), _noise_mixer()
    for mixer in (whole, pieces):
        for at, action in plan:
            action(mixer, at)
    blocks: list[Frames] = []
    while sum(map(len, blocks)) < TOTAL:
        blocks.append(pieces.render(sizes[len(blocks) % len(sizes)]))
    assert np.concatenate(blocks)[:TOTAL] == pytest.approx(whole.render(TOTAL), abs=2e-6)


def test_long_blocks_are_mixed_in_short_pieces() -> None:
    assert 2 * PIECE_FRAMES <= 500  # beyond this numpy gives up the interpreter lock


def test_playing_on_holds_no_more_memory() -> None:
    mixer = mixer_of(default=constant(0.01, 3000))

    def play(strokes: int) -> None:
        for index in range(strokes):
            mixer.trigger(Bus.STUDENT, NoteMeaning(PIECES[index % len(PIECES)]), 100, index % 64)
            mixer.render(64)

    play(100)
    tracemalloc.start()
    try:
        play(50)
        before, _ = tracemalloc.get_traced_memory()
        play(400)
        after, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert after - before < 20_000
