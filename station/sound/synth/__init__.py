"""How the default kits' sounds are made: recipes as tables, and the few kinds of sound that they are made of.

In: a recipe. Out: layers of a sound, the same on every computer and at any rate.
The `…_recipes` modules are tables, `layers` makes a sound of one, `synth_kits` whole kits, `synth_cache` keeps them.
Read `recipe` first.
"""
