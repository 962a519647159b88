"""The demonstration on its player: what the engine is told, and that the picture waits for the sound.

Rock 1 is two bars of 4/4 at 80 beats a minute: 0.75 s a beat, 3 s a bar (its file says so).
"""

from dataclasses import replace

import numpy as np

from station.app.actions.player_actions import SetCountIn, SetDemoClick
from station.app.sessions.demo_drummer import DemonstratedLesson
from station.app.sessions.demo_player import LEAD_NS, Control, DemoPlayer
from station.core.named_view import NamedView
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S
from station.drills.lesson import BarCue
from station.drills.library import find_lesson
from station.drills.reading.lesson_file import parse_lesson
from station.engine.messages import Bus, Command, Play, Stop
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.demonstration.song_player import SongPlayer
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.leading_hand import with_sticking
from station.scenes.demonstrator import Demonstrator

BAR_NS = 3 * NS_PER_S
KIT = load_kit()
ROCK, PARADIDDLE = find_lesson("rock-1"), find_lesson("single-paradiddle")


def deck() -> tuple[DemoPlayer, list[Command]]:
    sent: list[Command] = []
    made = DemoPlayer(sent.append, DemonstratedLesson(ROCK, KIT))
    made.advance(NS_PER_S)
    return made, sent


def use(made: DemoPlayer, control: Control, held: bool = False) -> None:
    """A control, and the next frame, which comes at once."""
    made.do(control, held)
    made.advance(made.now_ns)


def plays(sent: list[Command]) -> list[Play]:
    return [command for command in sent if isinstance(command, Play)]


def test_played_forward_it_sounds_and_moves_with_its_sound() -> None:
    made, sent = deck()
    use(made, SongPlayer.played)
    [play] = plays(sent)
    assert play.start_in_ns == LEAD_NS
    assert np.count_nonzero(play.cues["bus"] == Bus.DEMONSTRATION) == 24
    assert np.count_nonzero(play.cues["bus"] == Bus.CLICK) == 8
    made.started(NS_PER_S + 80 * NS_PER_MS)
    made.advance(NS_PER_S + 380 * NS_PER_MS)
    assert made.player.position_ns(made.now_ns) == 300 * NS_PER_MS
    assert made.snapshot().position_s == 0.3


def test_the_word_on_the_first_beat_is_not_lost() -> None:
    sent: list[Command] = []
    made = DemoPlayer(sent.append, DemonstratedLesson(ROCK, KIT, click=replace(PLAIN, counts=True)))
    made.advance(NS_PER_S)
    use(made, SongPlayer.played)
    [play] = plays(sent)
    words = play.cues[play.cues["bus"] == Bus.CLICK]
    assert len(words) == 8
    assert play.start_in_ns + words["at_ns"][0] >= LEAD_NS, "there is time for it to reach the card"


def test_without_the_click_the_strokes_sound_on_from_where_it_is() -> None:
    made, sent = deck()
    use(made, SongPlayer.played)
    made.started(NS_PER_S)
    made.advance(NS_PER_S + BAR_NS)
    made.act(SetDemoClick(False))
    made.advance(made.now_ns)
    assert [type(command) for command in sent] == [Play, Stop, Play]
    assert set(plays(sent)[1].cues["bus"].tolist()) == {Bus.DEMONSTRATION}
    assert len(plays(sent)[1].cues) == 12, "the second bar"


def test_backwards_wound_stepped_or_held_it_is_silent() -> None:
    made, sent = deck()
    use(made, lambda player, now_ns: player.sought(now_ns, BAR_NS).reversed(now_ns, True).played(now_ns))
    use(made, lambda player, now_ns: player.wound(now_ns, 1))
    use(made, lambda player, now_ns: player.stepped(now_ns, made.step, 1))
    assert sent == []
    use(made, lambda player, now_ns: player.reversed(now_ns, False).played(now_ns))
    use(made, lambda player, now_ns: player.at_speed(now_ns, 50), held=True)
    assert [type(command) for command in sent] == [Play, Stop]
    use(made, lambda player, now_ns: player.at_speed(now_ns, 60))
    assert [type(command) for command in sent] == [Play, Stop, Play]


def test_a_loop_that_is_played_longer_than_was_sounded_sounds_on() -> None:
    made, sent = deck()
    use(made, lambda player, now_ns: player.looped(now_ns, (1, 1)).played(now_ns))
    made.advance(made.now_ns + 601 * NS_PER_S)
    made.advance(made.now_ns)
    assert [type(command) for command in sent] == [Play, Stop, Play]


def test_until_the_next_frame_it_waits_where_it_is_however_long_that_takes() -> None:
    """The drummer may have to be made first."""
    made, sent = deck()
    made.do(SongPlayer.played)
    assert sent == []
    made.advance(made.now_ns + 2 * NS_PER_S)
    assert (len(plays(sent)), made.player.position_ns(made.now_ns)) == (1, 0)


def test_a_flag_that_is_kept_does_not_break_the_sound() -> None:
    made, sent = deck()
    use(made, SongPlayer.played)
    made.started(made.now_ns)
    made.advance(made.now_ns + NS_PER_S)
    use(made, lambda player, now_ns: player.flagged(now_ns, 0))
    assert [type(command) for command in sent] == [Play]
    assert made.player.flags[0] == NS_PER_S


def test_another_lesson_stops_it_and_flags_are_kept_for_each() -> None:
    made, sent = deck()
    use(
        made,
        lambda player, now_ns: player.sought(now_ns, BAR_NS).flagged(now_ns, 2).at_speed(now_ns, 50).played(now_ns),
    )
    made.load(DemonstratedLesson(PARADIDDLE, KIT), None)
    assert isinstance(sent[-1], Stop)
    assert (made.player.playing, made.player.position_ns(made.now_ns), made.player.speed_percent) == (False, 0, 50)
    assert made.player.flags == (None,) * 8
    made.load(DemonstratedLesson(ROCK, KIT), (1, 2))
    back = made.player
    assert (back.flags[2], back.loop) == (BAR_NS, (0, 1))


def test_the_picture_is_the_demonstration_s_once_the_player_is_used() -> None:
    made, _ = deck()
    before = made.is_shown
    use(made, lambda player, now_ns: player.sought(now_ns, BAR_NS + 1600 * NS_PER_MS).at_speed(now_ns, 50))
    assert (before, made.is_shown) == (False, True)
    hud = made.snapshot().hud
    assert (hud.bar, hud.beat, hud.phase, hud.beats_a_minute) == (2, 3, "Demonstration at 50 %", 40.0)


def test_another_manner_or_body_is_in_the_next_picture() -> None:
    """A drummer made from nothing says where the sticks must be."""
    made, _ = deck()
    made.do(lambda player, now_ns: player.sought(now_ns, BAR_NS + 200 * NS_PER_MS))
    large = Demonstrator(style=Style(amplitude_gain=95.0, posture_deg=-5.0))
    for demonstrator in (Demonstrator(), large, Demonstrator(figure_of(1.9), large.style)):
        made.perform_as(demonstrator)
        shown = made.snapshot()
        expected = Drummer(with_sticking(ROCK.score, KIT, None), KIT, demonstrator.figure, demonstrator.style).pose(
            shown.position_s
        )
        assert shown.pose is not None
        assert np.allclose(shown.pose.row, expected.row)
        assert shown.figure == demonstrator.figure


# --- count-in ---------------------------------------------------------------------------------------------------------


def counting_deck(*controls: Control) -> tuple[DemoPlayer, list[Command]]:
    """A deck that counts in, and was pressed to play."""
    made, sent = deck()
    for control in controls:
        use(made, control)
    made.act(SetCountIn(True))
    use(made, SongPlayer.played)
    return made, sent


def test_a_bar_is_counted_before_the_first_stroke_and_the_picture_waits_for_it() -> None:
    made, sent = counting_deck()
    [play] = plays(sent)
    clicks = play.cues[play.cues["bus"] == Bus.CLICK]
    assert clicks["at_ns"][:5].tolist() == [beat * BAR_NS // 4 for beat in range(5)]
    assert play.cues["at_ns"][play.cues["bus"] == Bus.DEMONSTRATION].min() == BAR_NS
    made.started(2 * NS_PER_S)
    seen = []
    for beat in range(4):
        made.advance(2 * NS_PER_S + beat * BAR_NS // 4 + NS_PER_MS)
        hud = made.snapshot().hud
        seen.append((hud.phase, hud.count_in, made.player.position_ns(made.now_ns)))
    assert seen == [("Count-in", beat, 0) for beat in (1, 2, 3, 4)]
    made.advance(2 * NS_PER_S + BAR_NS + 300 * NS_PER_MS)
    assert (made.player.position_ns(made.now_ns), made.snapshot().hud.count_in) == (300 * NS_PER_MS, None)


def test_while_the_beginning_is_counted_the_drummer_has_not_struck_yet() -> None:
    made, _ = counting_deck()
    made.started(2 * NS_PER_S)
    made.advance(2 * NS_PER_S)
    pose = made.snapshot().pose
    assert pose is not None
    assert np.array_equal(pose.row, made.drummer.pose(-3.0).row)


def test_from_the_middle_of_a_bar_its_first_beats_are_counted_too_at_half_the_tempo() -> None:
    """From the third beat: six clicks of 1.5 s, "one two three four, one two"."""
    made, sent = counting_deck(lambda player, now_ns: player.sought(now_ns, BAR_NS // 2).at_speed(now_ns, 50))
    [play] = plays(sent)
    assert play.cues["at_ns"][play.cues["bus"] == Bus.DEMONSTRATION].min() == 9 * NS_PER_S
    clicks = play.cues["at_ns"][play.cues["bus"] == Bus.CLICK]
    assert clicks[:7].tolist() == [beat * 3 * NS_PER_S // 2 for beat in range(7)]
    made.started(NS_PER_S)
    made.advance(NS_PER_S + 8 * NS_PER_S)
    assert made.snapshot().hud.count_in == 2


def test_only_the_beginning_is_counted_and_anew_where_it_is_changed_meanwhile() -> None:
    made, sent = counting_deck()
    made.started(made.now_ns)
    made.advance(made.now_ns + NS_PER_S)
    use(made, lambda player, now_ns: player.at_speed(now_ns, 200))
    assert plays(sent)[-1].cues["at_ns"][4] == BAR_NS // 2, "while it is counted it begins anew"
    made.started(made.now_ns)
    made.advance(made.now_ns + BAR_NS)
    use(made, lambda player, now_ns: player.at_speed(now_ns, 100))
    assert plays(sent)[-1].cues["at_ns"][plays(sent)[-1].cues["bus"] == Bus.DEMONSTRATION].min() < BAR_NS // 4
    made.advance(made.now_ns + 700 * NS_PER_S)
    assert not made.player.playing


def test_a_loop_is_counted_in_once_however_long_it_is_played() -> None:
    made, sent = counting_deck(lambda player, now_ns: player.looped(now_ns, (0, 0)))
    made.started(made.now_ns)
    made.advance(made.now_ns + 604 * NS_PER_S)
    made.advance(made.now_ns)
    first, again = plays(sent)
    assert first.cues["at_ns"][first.cues["bus"] == Bus.DEMONSTRATION].min() == BAR_NS
    assert again.cues["at_ns"][again.cues["bus"] == Bus.DEMONSTRATION].min() < BAR_NS // 4


def test_a_lesson_is_watched_with_its_cues_and_to_its_landing() -> None:
    """The lesson's two bars, and the landing's."""
    crash = Score.from_notes([Note(0, Piece.CRASH_1, Zone.EDGE)], TempoMap()).notes
    cues = (BarCue(1, say="Ghosts low", camera="feet"),)
    lesson = replace(ROCK, landing=crash, cues=cues, loop=(0, ROCK.score.bar_count - 1))
    sent: list[Command] = []
    made = DemoPlayer(sent.append, DemonstratedLesson(lesson, KIT))
    made.advance(NS_PER_S)
    assert (made.snapshot().view, made.snapshot().hud.say) == (None, "")
    use(made, SongPlayer.played)
    [play] = plays(sent)
    crashes = play.cues["at_ns"][play.cues["piece"] == Piece.CRASH_1]
    assert crashes[-1] == lesson.score.length_ns
    use(made, lambda player, now_ns: player.stopped(now_ns).sought(now_ns, BAR_NS))
    second = made.snapshot()
    assert (second.view, second.hud.say, second.hud.bar_count) == (NamedView.FEET, "Ghosts low", 3)


def test_a_lesson_that_is_changed_plays_on_from_where_it_is() -> None:
    """Rock 1 at 80 beats a minute; 700 ms in it is changed to 100, and sounds anew 50 ms later, on the second beat."""
    made, sent = deck()
    use(made, SongPlayer.played)
    made.started(NS_PER_S)
    made.advance(NS_PER_S + 700 * NS_PER_MS)
    changed = parse_lesson(ROCK.text.replace("tempo_bpm = 80", "tempo_bpm = 100", 1), "x", ROCK.name).lesson
    assert changed is not None
    sent.clear()
    made.revise(DemonstratedLesson(changed, KIT), (1, 2))
    assert [type(command) for command in sent] == [Stop, Play]
    assert made.player.playing
    assert made.player.loop == (0, 1)
    second_beat_ns = made.player.position_ns(made.now_ns + LEAD_NS)
    assert abs(second_beat_ns - 600 * NS_PER_MS) < NS_PER_MS
    made.advance(made.now_ns + 10 * NS_PER_MS)
    assert len(made.snapshot().score) == len(changed.played_once)
