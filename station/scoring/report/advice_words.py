"""What advice says of each fault: what was heard, and what to do about it; the texts are filled in by `advice`.

`{size}` is the effect without its sign, `{subject}` what the finding is about, `{where}` and `{at}` the bars,
`{slow}` and `{tempo}` are beats a minute.
"""

from types import MappingProxyType

HEARD = MappingProxyType(
    {
        "late_piece": "Your {subject} is {size:.0f} ms late{where}",
        "early_piece": "Your {subject} is {size:.0f} ms early{where}",
        "slow_hihat_foot": "Your hi-hat foot closes {size:.0f} ms late{where}",
        "early_hihat_foot": "Your hi-hat foot closes {size:.0f} ms early{where}",
        "late_left_hand": "Your left hand is {size:.0f} ms late{where}",
        "early_left_hand": "Your left hand is {size:.0f} ms early{where}",
        "late_right_hand": "Your right hand is {size:.0f} ms late{where}",
        "early_right_hand": "Your right hand is {size:.0f} ms early{where}",
        "late_offbeats": "Your off-beats are {size:.0f} ms late{where}",
        "early_offbeats": "Your off-beats are {size:.0f} ms early{where}",
        "swung_straight": "You swing what is written straight: the off-beats are {size:.0f} ms late{where}",
        "straight_swing": "Your swing is straighter than written, {subject}{where}",
        "hard_swing": "Your swing is sharper than written, {subject}{where}",
        "rush_fills": "You rush by {size:.0f} ms in the fills{where}",
        "drag_fills": "You drag by {size:.0f} ms in the fills{where}",
        "fill_lands_late": "Your fills land {size:.0f} ms late{where}",
        "fill_lands_early": "Your fills land {size:.0f} ms early{where}",
        "drag_slow": "After long waits you come in {size:.0f} ms late{where}",
        "rush_slow": "After long waits you come in {size:.0f} ms early{where}",
        "uneven_doubles": "The second stroke of your doubles comes {size:.0f} ms early{where}",
        "lazy_doubles": "The second stroke of your doubles comes {size:.0f} ms late{where}",
        "wide_flams": "Your flams are too wide, {subject} ms from the grace note to the main stroke{where}",
        "tight_flams": "Your flams are too tight, {subject} ms from the grace note to the main stroke{where}",
        "early": "You play {size:.0f} ms early throughout{where}",
        "late": "You play {size:.0f} ms late throughout{where}",
        "rushing": "You rush: your tempo rises by {size:.1f} % in eight bars",
        "dragging": "You drag: your tempo falls by {size:.1f} % in eight bars",
        "unsteady": "Your strokes spread by {size:.0f} ms where {subject} would do{where}",
        "unsteady_left_hand": "Your left hand is unsteady: its strokes spread by {size:.0f} ms{where}",
        "unsteady_right_hand": "Your right hand is unsteady: its strokes spread by {size:.0f} ms{where}",
        "unsteady_left_foot": "Your left foot is unsteady: its strokes spread by {size:.0f} ms{where}",
        "unsteady_right_foot": "Your right foot is unsteady: its strokes spread by {size:.0f} ms{where}",
        "weak_left": "Your left hand is {size:.1f} dB softer than your right{where}",
        "weak_right": "Your right hand is {size:.1f} dB softer than your left{where}",
        "weak_doubles": "The second stroke of your doubles is {size:.1f} dB too soft{where}",
        "loud_ghosts": "Your ghost notes are {size:.1f} dB too loud{where}",
        "flat_accents": "Your accents are {size:.1f} dB too soft{where}",
        "loud_graces": "Your grace notes are only {subject} dB softer than the main strokes{where}",
        "fades": "You fade: the end is {size:.0f} dB softer than the beginning",
        "grows": "You grow: the end is {size:.0f} dB louder than the beginning",
        "open_hats": "{size:.0f} % of your hi-hat strokes are open where they should be closed{where}",
        "closed_hats": "{size:.0f} % of your hi-hat strokes are closed where they should be open{where}",
        "stopped": "You stopped in {stops} and began again",
        "came_in_late": "You came in {subject} late{at}, and stayed there",
        "came_in_early": "You came in {subject} early{at}, and stayed there",
        "left_out_bars": "You left out {stops}",
        "repeated_bars": "You played {stops} again",
        "missed": "You leave out {size:.0f} % of the {subject}{where}",
        "extra": "{size:.0f} % of your strokes{subject} are not written",
        "wrong_sticking": "{size:.0f} % of your strokes come from the other hand than is written{where}",
        "wrong_piece": "{size:.0f} % of the time you strike {subject}{where}",
    }
)

_TOGETHER = "play it with the click alone at {slow:.0f} bpm, then add the rest"
_HAND = "play that hand alone with the click at {slow:.0f} bpm, then add the other"
_OFFBEATS = "set the click on the off-beats at {slow:.0f} bpm and meet it there"
_DOUBLES = "play the doubles at {slow:.0f} bpm and accent every second stroke"
_TRIPLETS = "play the ride alone at {slow:.0f} bpm and count triplets"
_LANDING = "loop the fill with the bar after it at {slow:.0f} bpm and listen for the one"
_STEADY = "play it alone with the click at {slow:.0f} bpm until it holds"
_PULSE = "play the same bars with a click that falls silent every other bar"
_LEVEL = "play two bars with your eye on the height of the sticks, and keep it to the end"

DO = MappingProxyType(
    {
        "late_piece": _TOGETHER,
        "early_piece": _TOGETHER,
        "slow_hihat_foot": "tap the foot alone on the click at {slow:.0f} bpm, heel up, then add the rest",
        "early_hihat_foot": "tap the foot alone on the click at {slow:.0f} bpm, then add the rest",
        **dict.fromkeys(("late_left_hand", "early_left_hand", "late_right_hand", "early_right_hand"), _HAND),
        **dict.fromkeys(("late_offbeats", "early_offbeats"), _OFFBEATS),
        "swung_straight": "count even eighths aloud at {slow:.0f} bpm",
        **dict.fromkeys(("straight_swing", "hard_swing"), _TRIPLETS),
        "rush_fills": "loop the fill with the bar before it at {slow:.0f} bpm and count its subdivision aloud",
        "drag_fills": "loop the fill with the bar before it at {slow:.0f} bpm and lead with the sticking",
        **dict.fromkeys(("fill_lands_late", "fill_lands_early"), _LANDING),
        "drag_slow": "count the rest aloud in 16ths at {tempo:.0f} bpm before you come in",
        "rush_slow": "count the rest aloud in 16ths at {tempo:.0f} bpm and let it pass",
        "uneven_doubles": _DOUBLES,
        "lazy_doubles": "play the doubles at {slow:.0f} bpm and let the second stroke rebound",
        "wide_flams": "start the grace hand lower, at {slow:.0f} bpm, so that both sticks fall together",
        "tight_flams": "lift the main hand higher, at {slow:.0f} bpm, so that the grace note leads",
        "early": "wait for the click, or measure the latency once if you play on it",
        "late": "play ahead of where you feel the click, or measure the latency once",
        **dict.fromkeys(("rushing", "dragging"), _PULSE),
        "unsteady": "go down to {slow:.0f} bpm and up again by 5 % once it holds",
        **dict.fromkeys(
            ("unsteady_left_hand", "unsteady_right_hand", "unsteady_left_foot", "unsteady_right_foot"), _STEADY
        ),
        "weak_left": "lead the same bars with the left hand at {slow:.0f} bpm, at the right hand's height",
        "weak_right": "lead the same bars with the right hand at {slow:.0f} bpm, at the left hand's height",
        "weak_doubles": _DOUBLES,
        "loud_ghosts": "play them at {slow:.0f} bpm from three centimetres above the head",
        "flat_accents": "play them at {slow:.0f} bpm from full height and drop back at once",
        "loud_graces": "start the grace hand from three centimetres above the head, at {slow:.0f} bpm",
        **dict.fromkeys(("fades", "grows"), _LEVEL),
        "open_hats": "keep the heel of the hi-hat foot down for one pass and listen to every stroke",
        "closed_hats": "lift the foot in time without playing, then add the stick at {slow:.0f} bpm",
        "stopped": "play the bars around it at {slow:.0f} bpm until you get through",
        **dict.fromkeys(
            ("came_in_late", "came_in_early"), "count the bar before it aloud, and come in on the one with the click"
        ),
        "left_out_bars": "play into these bars from the one before at {slow:.0f} bpm, and count the bars",
        "repeated_bars": "count the bars aloud through the whole form",
        "missed": "play it at {slow:.0f} bpm until every stroke is there",
        "extra": "leave out all that is not written for one pass; if you did not strike it, raise that pad's threshold",
        "wrong_sticking": "say the sticking aloud while you play it at {slow:.0f} bpm",
        "wrong_piece": "loop that move alone at {slow:.0f} bpm",
    }
)

OR = MappingProxyType(
    {
        **{
            f"{side}_{hand}": f"your {hand.replace('_', ' ')}"
            for side in ("late", "early")
            for hand in ("left_hand", "right_hand")
        },
        "late_offbeats": "your off-beats",
        "early_offbeats": "your off-beats",
        "swung_straight": "a swing that is not written",
        "slow_hihat_foot": "your hi-hat foot",
        "early_hihat_foot": "your hi-hat foot",
        "late": "all of it",
        "early": "all of it",
        "stopped": "you stopped there and came in again",
        "repeated_bars": "you played the bars twice",
        "weak_left": "your left hand",
        "weak_right": "your right hand",
        "weak_doubles": "the second strokes of your doubles",
        "flat_accents": "your accents",
        "loud_ghosts": "your ghost notes",
        "fades": "a fade",
        "grows": "a rise",
        **dict.fromkeys(("rush_fills", "drag_fills"), "the fills"),
        **dict.fromkeys(("fill_lands_late", "fill_lands_early"), "where the fills land"),
        **dict.fromkeys(("drag_slow", "rush_slow"), "the strokes after long waits"),
        **dict.fromkeys(("uneven_doubles", "lazy_doubles"), "the second strokes of your doubles"),
        **dict.fromkeys(("straight_swing", "hard_swing"), "the swing"),
    }
)
"""Other explanations as they are said in brackets; pieces by their own names."""
