"""Where the user looks from: a named view, mirrored or not, a second picture, eight viewpoints; and how it is shown.

That is the score's form, the colours, how large the panels are, and how finely is drawn. It is kept in the settings as
words: `view`, `inset`, `score`, `theme` and `quality` by name, `viewpoints` as `1=x,y,z,azimuth,height,distance,angle`
for each that is kept (metres and degrees), apart by spaces.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import degrees, isfinite, radians

from station.core.counts import is_count
from station.core.errors import BadInput
from station.core.named_view import NamedView
from station.core.settings import LARGEST_PANELS, SMALLEST_PANELS, Settings, settings_path
from station.render.camera import Camera
from station.render.gpu.moving_parts import DoublePlace
from station.render.notation.screen.score_place import ScoreForm
from station.render.palette import Theme

SLOTS = 8
"""How many viewpoints a user may keep (as many as SMED's Viewer keeps)."""
INSETS = (None, NamedView.HANDS, NamedView.FEET)
"""What the second picture may show; None for no second picture."""
_FARTHEST_M = 10.0
"""No viewpoint in the settings lies farther out: the room is smaller (`camera`)."""

QUALITY_WORDS = ("swift", "fine", "finest")
"""The levels of `render.quality.QUALITIES`."""
SCALE_STEP = 0.25
"""How much larger or smaller the panels grow at a time (our choice: a step can be seen, and 1 is one of them)."""

Viewpoints = tuple[Camera | None, ...]
"""`SLOTS` cameras, None where none is kept."""


@dataclass(frozen=True, slots=True)
class ViewSettings:
    """The view, whether left and right are swapped, what the `inset` shows, the score's form, the viewpoints kept.

    `legend` is whether a staff says which line is which piece, `theme` the colours, `scale` how many times as large as
    the window asks for the panels are, `double` where the student's double is, `quality` a row of
    `render.quality.QUALITIES`, None for the highest that the machine holds.
    """

    view: NamedView = NamedView.SHOULDER
    mirrored: bool = False
    inset: NamedView | None = None
    score: ScoreForm = ScoreForm.PAGED
    viewpoints: Viewpoints = (None,) * SLOTS
    theme: Theme = Theme.NIGHT
    scale: float = 1.0
    double: DoublePlace = DoublePlace.NOWHERE
    legend: bool = True
    quality: int | None = None

    def keeping(self, slot: int, camera: Camera) -> "ViewSettings":
        """With `camera` as the viewpoint `slot`, from 0."""
        kept = (*self.viewpoints[:slot], replace(camera, mirrored=False), *self.viewpoints[slot + 1 :])
        return replace(self, viewpoints=kept)

    def next_score(self) -> "ViewSettings":
        """With the score in its next form."""
        return replace(self, score=ScoreForm((self.score + 1) % len(ScoreForm)))

    def scaled(self, steps: int) -> "ViewSettings":
        """With larger panels by so many steps, smaller where negative, within what the settings allow."""
        scale = round(self.scale / SCALE_STEP) * SCALE_STEP + steps * SCALE_STEP
        return replace(self, scale=min(max(scale, SMALLEST_PANELS), LARGEST_PANELS))

    def next_double(self) -> "ViewSettings":
        """With the student's double at the next place."""
        return replace(self, double=DoublePlace((self.double + 1) % len(DoublePlace)))

    def next_inset(self) -> "ViewSettings":
        """With what the second picture shows next."""
        return replace(self, inset=INSETS[(INSETS.index(self.inset) + 1) % len(INSETS)])


def view_settings_of(settings: Settings) -> ViewSettings:
    """The look that the settings speak of; raises `BadInput` that names the setting."""
    return ViewSettings(
        NamedView[_known("view", settings.view, [view.name.lower() for view in NamedView]).upper()],
        settings.mirrored,
        NamedView[_known("inset", settings.inset, _INSET_WORDS).upper()] if settings.inset else None,
        ScoreForm[_known("score", settings.score, [form.name.lower() for form in ScoreForm]).upper()],
        _viewpoints(settings.viewpoints),
        Theme(_known("theme", settings.theme, list(Theme))),
        settings.panel_scale,
        (DoublePlace.BESIDE if settings.double_beside else DoublePlace.OVER)
        if settings.double
        else DoublePlace.NOWHERE,
        settings.legend,
        QUALITY_WORDS.index(_known("quality", settings.quality, QUALITY_WORDS)) if settings.quality else None,
    )


def with_view_settings(settings: Settings, view_settings: ViewSettings) -> Settings:
    """The settings with `view_settings` in them."""
    return replace(
        settings,
        view=view_settings.view.name.lower(),
        mirrored=view_settings.mirrored,
        inset="" if view_settings.inset is None else view_settings.inset.name.lower(),
        score=view_settings.score.name.lower(),
        legend=view_settings.legend,
        theme=str(view_settings.theme),
        panel_scale=view_settings.scale,
        quality="" if view_settings.quality is None else QUALITY_WORDS[view_settings.quality],
        double=view_settings.double is not DoublePlace.NOWHERE,
        double_beside=view_settings.double is DoublePlace.BESIDE,
        viewpoints=" ".join(
            f"{slot}={_text(c)}" for slot, c in enumerate(view_settings.viewpoints, 1) if c is not None
        ),
    )


_INSET_WORDS = [view.name.lower() for view in INSETS if view is not None]


def _known(key: str, word: str, words: Sequence[str]) -> str:
    if word not in words:
        raise BadInput(settings_path(), key, f"expected one of {', '.join(words)}, found {word!r}")
    return word


def _viewpoints(text: str) -> Viewpoints:
    found: list[Camera | None] = [None] * SLOTS
    for entry in text.split():
        slot, _, numbers = entry.partition("=")
        camera = _camera(numbers)
        if not is_count(slot) or not 1 <= int(slot) <= SLOTS or camera is None:
            expected = f"expected 1…{SLOTS}=x,y,z,azimuth,height,distance,angle"
            raise BadInput(settings_path(), "viewpoints", f"{expected}, found {entry!r}")
        found[int(slot) - 1] = camera
    return tuple(found)


def _camera(text: str) -> Camera | None:
    """The camera that seven numbers mean; None for anything else."""
    try:
        x, y, z, azimuth, height, distance, angle = map(float, text.split(","))
    except ValueError:
        return None
    if not all(map(isfinite, (x, y, z, azimuth))) or max(map(abs, (x, y, z))) > _FARTHEST_M:
        return None
    if not (-90 < height < 90 and 0 < distance <= _FARTHEST_M and 0 < angle < 180):
        return None
    return Camera((x, y, z), radians(azimuth), radians(height), distance, radians(angle))


def _text(camera: Camera) -> str:
    angles = degrees(camera.azimuth_rad), degrees(camera.height_rad)
    numbers = (*camera.target, *angles, camera.distance_m, degrees(camera.fov_rad))
    return ",".join(f"{number:.4f}".rstrip("0").rstrip(".") for number in numbers)
