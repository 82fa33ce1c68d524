"""Checkpoints that were changed, with digests that are right: exit code 4, or 5 where only the motion is another."""
import json
import os
import random
import shutil
import struct
import subprocess
import unittest

from resigned import limit_memory, sign_checkpoint, state_of
from simulation_case import LIMIT, SimulationCase, program

CHANGES = 30
EDGES = [0, 1, 2, 3, 2**31, 2**32, 2**35, 2**62, 2**63, 2**64 - 1]


class HostileCheckpoints(SimulationCase):
    def setUp(self):
        super().setUp()
        self.touching_scene()
        self.scene["duration"] = 0.1
        self.scene_file.write_text(json.dumps(self.scene))
        program("bemsim", self.scene_file, "-o", self.folder / "good", "-q", "--checkpoint-every", 4, "--steps", 4)
        self.good = (self.folder / "good" / "checkpoint.bin").read_bytes()
        self.state = state_of(self.good)
        self.first = self.end_of_identity()

    def end_of_identity(self):
        """Three texts and the number of steps come first: whether it is of this scene at all."""
        at = 0
        for _ in range(3):
            at += 8 + struct.unpack_from("<Q", self.state, at)[0]
        return at + 8

    def resume(self, state):
        """Exit code of going on from a state, in little memory."""
        out = self.folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        shutil.copytree(self.folder / "good", out)
        (out / "checkpoint.bin").write_bytes(sign_checkpoint(self.good, bytes(state)))
        done = subprocess.run([os.environ["BEMSIM"], self.scene_file, "-o", out, "--resume", "--threads", "1", "-q"],
                              capture_output=True, text=True, timeout=LIMIT, preexec_fn=limit_memory)
        if done.returncode != 0:
            errors = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
            self.assertEqual(len(errors), 1, done.stderr)
        return done.returncode

    def test_a_signed_copy_is_good(self):
        self.assertEqual(self.resume(self.state), 0)

    def test_more_or_less_than_a_state(self):
        for state in (self.state[:-1], self.state[:-8], self.state[:self.first], self.state + b"\0"):
            self.assertEqual(self.resume(state), 4)

    def test_sizes(self):
        """Every number that may be a size, as one that is not."""
        places = [at for at in range(self.first, len(self.state) - 8)
                  if 0 < struct.unpack_from("<Q", self.state, at)[0] < 2000]
        self.assertGreater(len(places), 100)
        rng = random.Random(4)
        codes = []
        for number in range(CHANGES):
            at, value = rng.choice(places), rng.choice(EDGES)
            changed = bytearray(self.state)
            changed[at:at + 8] = struct.pack("<Q", value)
            with self.subTest(at=at, value=value):
                codes.append(self.resume(changed))
                self.assertIn(codes[-1], (0, 4, 5))
        self.assertGreater(codes.count(4), CHANGES // 3)

    def test_bytes(self):
        rng = random.Random(5)
        for number in range(CHANGES):
            at, value = rng.randrange(self.first, len(self.state)), rng.randrange(256)
            changed = bytearray(self.state)
            changed[at] = value
            with self.subTest(at=at, value=value):
                self.assertIn(self.resume(changed), (0, 4, 5))

    def numbers(self):
        """Places of numbers in [1e-6, 1e6), among the many displacements of the histories."""
        for at in range(self.first, len(self.state) - 8, 1):
            if 1e-6 < abs(struct.unpack_from("<d", self.state, at)[0]) < 1e6:
                yield at

    def test_numbers(self):
        """What is not finite is no state; what is absurd ends as a simulation does that goes wrong."""
        rng = random.Random(6)
        places = rng.sample(list(self.numbers()), 8)
        for at in places:
            for value in (float("nan"), float("inf"), 1e308, -1e300):
                changed = bytearray(self.state)
                changed[at:at + 8] = struct.pack("<d", value)
                with self.subTest(at=at, value=value):
                    self.assertIn(self.resume(changed), (0, 4, 5))


if __name__ == "__main__":
    unittest.main()
