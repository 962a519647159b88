"""Signals of several channels, read from files.

In: `.csv` tables, `.amc` motion with its `.asf` skeleton, `.bvh` motion. Out: a `Signal`, of skeletons also the bones.
Read `signal_files` for the endings, `signal` for the value itself.
"""
