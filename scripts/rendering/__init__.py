"""Headless software renderer for trajectories: numpy only, deterministic, no GL and no display."""
