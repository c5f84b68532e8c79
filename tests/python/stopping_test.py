"""Long computations: others compute meanwhile, Ctrl-C stops them, callbacks are told and may fail."""

import os
import signal
import threading
import time
import unittest

import talus
from support import ROOT

LONG = ROOT / "bench/verification/rock-slope-842.toml"  # ten seconds and more, on any machine
SOON = 10.0  # [s] for a loaded machine; it takes a fraction of one


class Stopping(unittest.TestCase):
    def interrupted(self, compute):
        """How long a computation went on after Ctrl-C [s]."""
        sent = []

        def press():
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

        timer = threading.Timer(1.0, press)
        timer.start()
        try:
            with self.assertRaises(KeyboardInterrupt):
                compute()
        finally:
            timer.cancel()
        return time.monotonic() - sent[0]

    def test_a_search(self):
        model = talus.load(LONG)
        self.assertLess(self.interrupted(lambda: talus.safety_factor(model)), SOON)

    def test_steps(self):
        simulation = talus.Simulation(ROOT / "bench/paper/dry.toml")
        self.assertLess(self.interrupted(lambda: simulation.step(10**9)), SOON)
        steps = simulation.steps
        simulation.step(10)
        self.assertEqual(simulation.steps, steps + 10)

    def test_others_go_on_meanwhile(self):
        counted = 0
        done = threading.Event()

        def compute():
            talus.critical_angle(ROOT / "bench/paper/fissure-1.toml", threads=1)
            done.set()

        thread = threading.Thread(target=compute)
        thread.start()
        while not done.is_set():
            counted += 1
            time.sleep(0.001)
        thread.join()
        self.assertGreater(counted, 10)

    def test_progress(self):
        told = []
        talus.critical_angle(ROOT / "bench/paper/fissure-1.toml", progress=lambda *news: told.append(news))
        self.assertGreater(len(told), 1)
        for stage, fraction, detail in told:
            self.assertIsInstance(stage, str)
            self.assertGreaterEqual(fraction, 0)
            self.assertIsInstance(detail, str)

    def test_a_callback_that_fails(self):
        def fail(stage, fraction, detail):
            raise LookupError(stage)

        with self.assertRaises(LookupError):
            talus.critical_angle(ROOT / "bench/paper/fissure-1.toml", progress=fail)
        self.assertEqual(talus.critical_angle(ROOT / "bench/paper/fissure-1.toml").status, "found")


if __name__ == "__main__":
    unittest.main()
