"""Where in its cycle a repeated motion is: the phase tracker of Boyd and Godbout 2012, and beyond it.

In: an exemplar, later the signal sample by sample or as a whole. Out: a `PeriodicModel`; of each sample a `PhaseStep`:
phase, quality, confidence, cadence, and whether the tracker has locked.
Read `periodic_model` for the model, `phase_tracker` for the formulas; docs/phase.md has figures.
"""
