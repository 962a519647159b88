"""A battle that is over as a video: `station battle --film FILE`, after it was played or with `--judge-again`."""

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from station.cli.animation.animate_options import LEVELS, picture_size
from station.cli.console import Progress, say
from station.cli.options.option_fields import choice, flag, number, option
from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.battle.battle_result import BattleResult

_ENDING = ".mp4"
_LEAST_FPS, _MOST_FPS = 1.0, 240.0
_MOST_DENOMINATOR = 1001
"""Of pictures a second: 59.94 are 60000/1001."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmOptions:
    """The video of a battle, and how it looks."""

    film: Path | None = option("FILE", "a video of the battle to keep, .mp4, with its sound", Path, None)
    film_size: tuple[int, int] = option("WxH", "in pixels (1280x720)", picture_size, (1280, 720))
    film_fps: float = option("N", "pictures a second (30)", number, 30.0)
    film_quality: int = choice(LEVELS, "how fine (low)", LEVELS["low"])
    fixed_camera: bool = flag("both drummers throughout, no cuts")
    no_crowd: bool = flag("nobody behind the drummers")


def check_film(options: FilmOptions) -> None:
    """Raises `BadInput` for a video that nobody can make, before anybody plays."""
    if options.film is None:
        return
    if options.film.suffix.lower() != _ENDING:
        raise BadInput(options.film, "", f"expected a name that ends in {_ENDING}")
    if not _LEAST_FPS <= options.film_fps <= _MOST_FPS:
        raise BadInput("--film-fps", f"{options.film_fps:g}", f"expected {_LEAST_FPS:g} to {_MOST_FPS:g}")
    if any(side % 2 for side in options.film_size):
        width, height = options.film_size
        raise BadInput("--film-size", f"{width}x{height}", "a video has an even number of columns and of rows")


def film_battle(result: BattleResult, options: FilmOptions, settings: Settings) -> None:
    """Make the video that is asked for; raises `BadInput` or `DeviceError`."""
    if options.film is None:
        return
    from station.cli.animation.animate_pictures import RATE_HZ
    from station.render.picture import Shot
    from station.render.quality import QUALITIES
    from station.scenes.battle.battle_film import BattleFilm, film_span, write_battle_film
    from station.scenes.battle.battle_scene import StageOptions
    from station.scenes.battle.cast import cast_of
    from station.scenes.battle.motion_chain import Body
    from station.scenes.demonstrator import demonstrator_of
    from station.scenes.soundtrack import Sounds
    from station.sound.samples.load_kit import load_kit

    player = demonstrator_of(settings, say)
    cast = cast_of(result.rules, Body(figure=player.figure, style=player.style))
    stage = StageOptions(cuts=not options.fixed_camera, crowd=not options.no_crowd)
    span = film_span(result, Fraction(options.film_fps).limit_denominator(_MOST_DENOMINATOR))
    shot = Shot(options.film_size, QUALITIES[options.film_quality])
    sounds = Sounds(load_kit(settings.drums, RATE_HZ), settings.click)
    progress = Progress(span.pictures)
    try:
        write_battle_film(BattleFilm(result, cast, span, stage), shot, sounds, options.film, progress.show)
    finally:
        progress.close()
    say(f"video    {options.film}")
