# The guide's Sphinx configuration: `cmake --build build --target docs` (CMakeLists.txt says with which program).
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent / "ext"))

project = "Talus"
author = "The Talus developers"
copyright = "The Talus developers"
release = version = os.environ.get("TALUS_VERSION", "")

extensions = ["myst_parser", "guide"]
myst_enable_extensions = ["dollarmath", "amsmath", "deflist"]
myst_heading_anchors = 3

html_theme = "furo"
html_title = "Talus"
html_static_path = ["_static"]
html_css_files = ["guide.css"]
html_copy_source = html_show_sourcelink = html_show_sphinx = False
html_math_renderer = "mathml"
highlight_language = "none"
smartquotes = False  # quotes are part of what to write
exclude_patterns = ["ext", "README.md"]
