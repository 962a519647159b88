"""How much work a picture is worth, in three levels; lights and shadows make them dear, round rims are had at each."""

from dataclasses import dataclass

from station.render.kit.instrument_meshes import Detail


@dataclass(frozen=True, slots=True)
class Quality:
    """How much work a picture is worth: shader level 0–2, the shadow map's size, roundness, small hardware.

    `anisotropy` is how sharp the floor is where one looks along it: without a graphics card it takes a fifth of a
    picture's time, so the middle level does without. `is_layered`: what does not move is drawn once for each camera and
    kept.
    """

    level: int
    shadow_texels: int
    detail: Detail
    figure_cell: float
    samples: int
    anisotropy: float
    is_layered: bool = False


QUALITIES = (
    Quality(0, 1024, Detail(64, hardware=True, grooves=False), 2.5, 0, 8.0, is_layered=True),
    Quality(1, 1024, Detail(64, hardware=True), 1.5, 4, 1.0),
    Quality(2, 2048, Detail(80, hardware=True), 1.0, 4, 8.0),
)
"""Lowest to highest; `figure_cell` multiplies the cell size that the figure's surface is cut with. Circles of 64
segments look round (our choice): at the lowest level, where what stands is drawn once, 28 would save a twentieth."""
