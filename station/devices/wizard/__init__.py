"""Learns a kit from its owner, who strikes what is asked for."""
