"""How the default kit's sounds are made: recipes as tables, and the few kinds of sound that they are made of."""
