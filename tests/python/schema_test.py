"""Every scenario and sweep of bench/ is one that the schemas take, and what the reader refuses they refuse, too."""

import json
import os
import subprocess
import tomllib
import unittest

from support import PROGRAM, ROOT

try:
    import jsonschema
except ImportError:  # Debian: python3-jsonschema
    jsonschema = None


def schema(what):
    return json.loads(subprocess.run([PROGRAM, "schema", what], capture_output=True, check=True).stdout)


@unittest.skipIf(jsonschema is None and "TALUS_NO_SKIP" not in os.environ, "python3-jsonschema is not installed")
class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario, cls.sweep = schema("scenario"), schema("sweep")
        for each in (cls.scenario, cls.sweep):
            jsonschema.Draft7Validator.check_schema(each)

    def test_examples(self):
        count = 0
        for file in sorted((ROOT / "bench").rglob("*.toml")):
            tables = tomllib.loads(file.read_text())
            is_sweep = "scenario" in tables
            with self.subTest(file=str(file)):
                jsonschema.Draft7Validator(self.sweep if is_sweep else self.scenario).validate(tables)
                count += 1
        self.assertGreater(count, 80)

    def test_faults(self):
        good = tomllib.loads((ROOT / "bench/paper/fissure-1.toml").read_text())
        validator = jsonschema.Draft7Validator(self.scenario)
        for change in (
            lambda t: t["joint"]["default"].update(friction_deg=95.0),
            lambda t: t["joint"]["default"].update(frictoin_deg=20.0),
            lambda t: t["stack"][0].pop("columns"),
            lambda t: t["stack"][0].update(block=[0.2, 0.1]),
            lambda t: t["water"][0].update(depth="deep"),
            lambda t: t.update(stacks=[]),
        ):
            tables = tomllib.loads((ROOT / "bench/paper/fissure-1.toml").read_text())
            change(tables)
            self.assertFalse(validator.is_valid(tables))
        self.assertTrue(validator.is_valid(good))


if __name__ == "__main__":
    unittest.main()
