"""The take as a fragment of HTML that carries all it needs: model, sound, times and the viewer's scripts.

Everything that is said goes through a template that escapes it; scripts are our own files and the library's, which hold
nothing that would end them (a test reads them).
"""

import base64
import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from types import MappingProxyType

from jinja2 import Environment, StrictUndefined, Template
from markupsafe import Markup

from station.render.files.opus_file import MIME_TYPE
from station.render.report.take.shown_take import ShownTake

_LEGEND = (
    ("match", "on time"),
    ("early", "early"),
    ("late", "late"),
    ("wrong_piece", "wrong piece, or extra"),
)
_ESCAPES: Mapping[int, str] = MappingProxyType({ord(sign): f"\\u{ord(sign):04x}" for sign in "<>&\u2028\u2029"})
"""What may mean something to HTML or end a line of a script, as JSON may write it."""


def take_part(take: ShownTake) -> Markup:
    """The fragment; a page holds at most one, and its bars may stand before or behind it."""
    return Markup(
        _template().render(
            take=take,
            legend=_LEGEND,
            style=_own("take.css"),
            library=_own("three.js"),
            viewer=_own("take.js"),
            sound=_base64(take.sound),
            sound_type=MIME_TYPE,
            model=_base64(take.model),
            times=script_json(_times(take)),
        )
    )


def no_take_part(fault: str) -> Markup:
    """What stands in its place where a take could not be made."""
    return Markup("<p>The take cannot be shown: {}.</p>").format(fault)


def script_json(value: object) -> Markup:
    """JSON that may stand in a `<script>`: no sign in it ends that, or a line."""
    return Markup(json.dumps(value, separators=(",", ":")).translate(_ESCAPES))


def _times(take: ShownTake) -> dict[str, object]:
    return {
        "length_s": _ms(take.length_s),
        "passes": [
            {
                "ticks": [[_ms(time_s), round(tick)] for time_s, tick in one.ticks],
                "notes": [[note, _ms(time_s), state] for note, time_s, state in one.notes],
            }
            for one in take.passes
        ],
        "strokes": [[_ms(s.time_s), s.node, s.velocity, s.state] for s in take.strokes],
        "views": [
            {"name": v.name, "eye": v.eye, "target": v.target, "fov": v.fov_deg, "narrow": v.narrow} for v in take.views
        ],
    }


def _ms(time_s: float) -> float:
    return round(time_s, 4)


def _base64(data: bytes) -> Markup:
    return Markup(base64.b64encode(data).decode("ascii"))


@cache
def _own(name: str) -> Markup:
    return Markup(_text(name))


def _text(name: str) -> str:
    return (files(__package__) / "viewer" / name).read_text(encoding="utf-8")


@cache
def _template() -> Template:
    return Environment(autoescape=True, undefined=StrictUndefined).from_string(_text("take.html"))
