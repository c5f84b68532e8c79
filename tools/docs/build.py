#!/usr/bin/env python3
"""Writes the guide's pages: build.py FOLDER. Every warning of Sphinx is an error; all is read anew (-E), for the program may be another."""

import importlib.util
import pathlib
import subprocess
import sys

PACKAGES = {"sphinx": "python3-sphinx", "myst_parser": "python3-myst-parser", "furo": "furo"}

missing = [package for module, package in PACKAGES.items() if importlib.util.find_spec(module) is None]
if missing:
    sys.exit(f"The guide needs {' '.join(missing)}: tools/setup --developers installs them.")

here, folder = pathlib.Path(__file__).parent, pathlib.Path(sys.argv[1])
sys.exit(
    subprocess.run(
        [sys.executable, "-m", "sphinx", "-b", "html", "-W", "--keep-going", "-q", "-E", "-d", folder.parent / "doctrees", here, folder],
        check=False,
    ).returncode
)
