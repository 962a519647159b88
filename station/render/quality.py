"""How much work a picture is worth, in three levels."""

from dataclasses import dataclass

from station.render.kit.instrument_meshes import Detail


@dataclass(frozen=True, slots=True)
class Quality:
    """How much work a picture is worth: shader level 0–2, sizes of shadow map and floor, roundness, small hardware.

    `is_layered`: what does not move is drawn once for each camera and kept.
    """

    level: int
    shadow_texels: int
    floor_texels: int
    detail: Detail
    figure_cell: float
    samples: int
    is_layered: bool = False


QUALITIES = (
    Quality(0, 768, 768, Detail(28, hardware=False), 3.0, 0, is_layered=True),
    Quality(1, 1024, 1024, Detail(48, hardware=True), 1.5, 4),
    Quality(2, 2048, 1536, Detail(80, hardware=True), 1.0, 4),
)
"""Lowest to highest; `figure_cell` multiplies the cell size that the figure's surface is cut with."""
