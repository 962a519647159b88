"""A right hand that holds a stick.

Axes are the hand's own: wrist at the origin, z to the fulcrum, y the back of the hand, x towards the thumb. The stick
passes the fulcrum at (0, 0, 0.151) and slants away below the palm.
"""

from functools import cache

import numpy as np

from station.render.geometry.implicit import Field, Surface, cone, egg, surface, united

_FINGERS = (
    # knuckle, middle joint, curl, tip; each with its radius
    ((0.022, 0.004, 0.092), (0.017, 0.000, 0.132), (0.006, -0.020, 0.152), (-0.007, -0.020, 0.138), 0.0105),
    ((0.004, 0.006, 0.096), (0.003, -0.006, 0.134), (0.001, -0.034, 0.130), (-0.001, -0.039, 0.104), 0.0108),
    ((-0.015, 0.003, 0.091), (-0.015, -0.010, 0.124), (-0.013, -0.041, 0.118), (-0.011, -0.044, 0.093), 0.0102),
    ((-0.032, -0.001, 0.082), (-0.032, -0.014, 0.109), (-0.029, -0.042, 0.103), (-0.026, -0.044, 0.082), 0.0092),
)
_THUMB = ((0.024, -0.008, 0.030), (0.038, -0.016, 0.070), (0.026, -0.018, 0.112), (0.012, -0.010, 0.142))


@cache
def hand_surface(fineness: float) -> Surface:
    """The hand's surface in cells of 4.2 mm times `fineness`."""
    palm: list[Field] = [
        cone((0, 0, -0.004), (0, 0, 0.02), 0.0235, 0.024),
        egg((-0.003, -0.004, 0.056), (0.041, 0.020, 0.050)),
        cone((0.022, 0.0, 0.088), (-0.030, -0.002, 0.080), 0.0145, 0.0125),
        cone((0.018, -0.014, 0.022), (0.030, -0.020, 0.062), 0.019, 0.015),
    ]
    fingers: list[Field] = []
    for *joints, radius in _FINGERS:
        taper = np.linspace(1.12, 0.86, 4) * radius
        fingers.append(united([cone(joints[i], joints[i + 1], taper[i], taper[i + 1]) for i in range(3)], 0.006))
    thumb = united(
        [
            cone(_THUMB[i], _THUMB[i + 1], r, s)
            for i, (r, s) in enumerate(((0.017, 0.0145), (0.0145, 0.0115), (0.0115, 0.010)))
        ],
        0.008,
    )
    flesh = united(palm, 0.022)
    whole = united([flesh, *fingers, thumb], 0.0045)
    return surface(whole, (-0.06, -0.065, -0.04), (0.065, 0.035, 0.18), 0.0042 * fineness)
