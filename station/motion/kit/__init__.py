"""The drum kit as furniture: which pieces stand where, and how struck ones move.

In: a kit's TOML file (`motion/data/kits`). Out: `Kit` and `KitPiece`, in metres, and the swing of cymbals.
Read `kit`, then `piece`.
"""
