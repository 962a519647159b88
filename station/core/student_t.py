"""Student's t, for intervals of means of a few values."""

_Z_95 = 1.959964


def t_quantile_95(freedom: float) -> float:
    """Two-sided 95 % point of Student's t (Abramowitz & Stegun 26.7.5: off by under 2 % from 3 degrees up)."""
    z, v = _Z_95, max(freedom, 1.0)
    g1 = (z**3 + z) / 4
    g2 = (5 * z**5 + 16 * z**3 + 3 * z) / 96
    g3 = (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / 384
    return z + g1 / v + g2 / v**2 + g3 / v**3
