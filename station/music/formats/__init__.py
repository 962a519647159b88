"""File formats of music, one module each."""
