// Nothing: a target that owns the precompiled headers of all programs.
