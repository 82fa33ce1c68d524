"""What the studies share: programs and what they cost, results, Markdown, meshes, the machine.

Scripts import it before numpy, which then computes on one thread, as do the programs that they start."""
import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
