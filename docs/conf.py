"""How Sphinx builds the documents: `make docs`; the pages go to build/docs."""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

project = "planemotion"
author = "The planemotion developers"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_click", "executed", "gallery_pages"]
exclude_patterns = ["reference/statuses.md"]  # a part of trust.md, no page of its own
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3
nb_execution_mode = "force"  # a fault in the notebook is one of the build
nb_execution_raise_on_error = True
nb_execution_timeout = 180
html_theme = "furo"
html_title = "planemotion"
html_static_path = ["static"]
html_css_files = ["pages.css"]
html_show_copyright = False
smartquotes = False  # "--set" and quoted words are what one types
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
# TOML has words of its own where Sphinx's lexer is asked for Python.
highlight_language = "text"
