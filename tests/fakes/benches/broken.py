"""An area that cannot be imported on this computer."""

raise ImportError("no such card")
