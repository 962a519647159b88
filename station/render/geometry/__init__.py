"""Shapes: transforms, triangle meshes, smoothly blended solids, what they are made of, the light.

In: numbers. Out: arrays of corners and matrices. No OpenGL.
Read `mesh` first.
"""
