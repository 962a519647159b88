"""Draws snapshots of the drummer, the kit and the score."""
