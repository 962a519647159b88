"""The table of the demonstrator's controls as a person sees them: groups, labels, and what each does to the movement.

Names are those of `motion.style.Style`; ranges and words are there too. The grouping is the thesis's (§ 4.1.1, figure
4.3): the arm's amplitudes and frequencies with their gains and shares, then what it drives beside the arms.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True, slots=True)
class Control:
    """A number: its field in `Style`, what is written on its slider, what it does, how its value is written.

    The slider of an `is_curved` one gives the low values more room.
    """

    name: str
    label: str
    about: str
    form: str = "%.0f"
    is_curved: bool = False


@dataclass(frozen=True, slots=True)
class ControlGroup:
    """Controls under one heading of a page."""

    title: str
    controls: tuple[Control, ...]


@dataclass(frozen=True, slots=True)
class ControlTab:
    """A page of groups."""

    title: str
    groups: tuple[ControlGroup, ...]


_SHARE = "Its share of the gain. The other two give way and keep their ratio, unless each is set for itself"
_DEGREES, _HUNDREDTHS = "%.0f°", "%.2f"

TABS: tuple[ControlTab, ...] = (
    ControlTab(
        "Arms",
        (
            ControlGroup(
                "Amplitude: how far the arm goes",
                (
                    Control("amplitude_gain", "gain", "How far wrist, elbow and shoulder move, all together"),
                    Control("amplitude_wrist", "wrist", _SHARE),
                    Control("amplitude_elbow", "elbow", _SHARE),
                    Control("amplitude_shoulder", "shoulder", _SHARE),
                    Control("amplitude_fingers", "fingers", "How far the stick rises in the open hand"),
                ),
            ),
            ControlGroup(
                "Frequency: how quick the stroke is",
                (
                    Control("frequency_gain", "gain", "How late the stroke begins: high is a snap, low flows"),
                    Control("frequency_wrist", "wrist", _SHARE),
                    Control("frequency_elbow", "elbow", _SHARE),
                    Control("frequency_shoulder", "shoulder", _SHARE),
                    Control("whip", "whip", "How long wrist and stick lag behind shoulder and elbow"),
                ),
            ),
        ),
    ),
    ControlTab(
        "Head",
        (
            ControlGroup(
                "Neck",
                (
                    Control("amplitude_neck", "nod", "How far the head bobs to the beat"),
                    Control("frequency_neck", "snap", "How late, and then how quickly, the head falls to the beat"),
                    Control(
                        "bobs_per_beat", "nods/beat", "Under 0.75 every other beat, from 1.5 on half beats", "%.1f"
                    ),
                    Control("amplitude_head_side", "tilt", "How far the head leans from side to side"),
                    Control("backbeat", "backbeat", "0 nods on 1 and 3, 50 on every beat, 100 on 2 and 4"),
                    Control("chin", "chin", "How far the neck pushes forward on the beat"),
                    Control("headbang", "head-banging", "How far the whole head swings down on the beat and back"),
                ),
            ),
            ControlGroup(
                "Eyes",
                (
                    Control("amplitude_gaze", "gaze", "How far the head turns to the piece that comes next"),
                    Control("look_around", "look around", "How often the drummer looks up from what is played"),
                ),
            ),
            ControlGroup(
                "Face",
                (Control("expression", "expression", "How much the face shows of the mood and of the music"),),
            ),
        ),
    ),
    ControlTab(
        "Body",
        (
            ControlGroup(
                "Back",
                (
                    Control("amplitude_back", "sway", "How far the back leans forward on the beat"),
                    Control("frequency_back", "snap", "How late, and then how quickly, the back falls to the beat"),
                    Control(
                        "half_time_bpm",
                        "half time from",
                        "Faster than this the back sways every other beat",
                        "%.0f",
                        is_curved=True,
                    ),
                    Control("amplitude_side", "side to side", "How far the back sways to the sides"),
                    Control("amplitude_twist", "twist", "How far the torso turns to the struck piece"),
                    Control("shimmy", "shimmy", "How far the shoulders turn to and fro with the beat"),
                    Control("phrase", "phrase", "How far the body sways over four bars"),
                    Control("fill_lean", "fills", "How far the body leans into fills and falls onto crashes"),
                    Control("lay_back_ms", "lay back", "How long after the beat body and head reach it", "%.0f ms"),
                    Control(
                        "twist_deg_s", "twist speed", "The torso turns no faster than so many degrees a second", "%.0f"
                    ),
                ),
            ),
            ControlGroup(
                "Posture",
                (
                    Control("posture_deg", "lean", "Upright and back, or bent forward, throughout", _DEGREES),
                    Control("wing_deg", "wing", "Elbows in to the body, or outward", _DEGREES),
                    Control("hunch_deg", "hunch", "An arched back, or a round one", _DEGREES),
                    Control("stand", "stand", "0 sits, 1 stands", _HUNDREDTHS),
                    Control("rise", "rise", "How far the drummer stands up for crashes"),
                    Control("shrug", "shrug", "How far the shoulders rise with loud strokes"),
                    Control("breathing", "breathing", "How deeply the drummer breathes"),
                    Control(
                        "amplitude_heel", "heels", "How far the heels rise and fall to the beat where the feet rest"
                    ),
                    Control("flourish", "flourish", "How often a stick is spun or tossed in a rest"),
                    Control("variation", "variation", "How much chance makes of strokes, sway and nods"),
                ),
            ),
        ),
    ),
)
"""All numbers, each once."""

CONTROLS: Mapping[str, Control] = MappingProxyType(
    {control.name: control for tab in TABS for group in tab.groups for control in group.controls}
)

WORD_LABELS: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "grip_right": ("right grip", "How the right hand holds the stick"),
        "grip_left": ("left grip", "How the left hand holds the stick"),
        "held": ("plays with", "What the hands hold: sticks, brushes, mallets, or nothing"),
        "heel": ("heels", "Whether the heel stays on the board or is lifted with the thigh"),
        "mood": ("mood", "What the face says"),
        "attention": ("looks at", "Where the eyes go while the hands play on"),
        "beater": ("beater", "Whether the kick's beater comes back at once or stays at the head"),
        "drummer": ("style's drummer", "Who plays in this style where the drummer above is left to the style"),
    }
)
"""Every control that is a word: its label and what it does."""
