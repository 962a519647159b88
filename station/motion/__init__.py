"""SMED, the drummer: a score, a kit and a figure in, pose(t) out."""
