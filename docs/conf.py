"""Configuration of the documentation: ``sphinx-build -W docs site`` writes static HTML."""

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

import executed  # noqa: E402
import mathematics  # noqa: E402
import pages  # noqa: E402

project, author, language = "contactstudy", "contactstudy developers", "en"
html_title, html_theme = "contactstudy", "furo"
html_copy_source = html_show_sourcelink = False
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
extensions += ["sphinx_gallery.gen_gallery"]
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
napoleon_google_docstring = False
napoleon_use_rtype = False
autodoc_typehints = "none"  # numpydoc's sections say it, with shapes and units
autodoc_member_order = "bysource"
exclude_patterns = ["site", "gallery", "tutorials/made"]
html_static_path = ["static", "generated"]
html_css_files = ["explorer.css", "formulas.css", "gallery.css", "tables.css"]
html_show_search_summary = False  # it asks for pages as a server gives them, not from disk
html_show_copyright = False
smartquotes = False  # what stands in quotation marks is often a value to copy
# the studies and scripts of these pages stand in files that are not part of the site
suppress_warnings = ["myst.xref_missing"]
html_theme_options = {"sidebar_hide_name": False}
sphinx_gallery_conf = {
    "examples_dirs": "gallery",
    "gallery_dirs": "examples",
    "abort_on_example_error": True,
    "run_stale_examples": True,  # the program may have changed; what has not, is in the store
    "image_srcset": ["2x"],
    # nothing on the pages depends on the machine
    "min_reported_time": 1e9,
    "show_memory": False,
    "write_computation_times": False,
    "show_signature": False,
    "download_all_examples": False,
    "capture_repr": (),
}


def setup(app):
    """Generate what is generated, and write formulas as MathML."""
    pages.write(HERE)
    executed.run_all(HERE)
    mathematics.setup(app)
    app.connect("autodoc-process-signature", without_private)


def without_private(app, what, name, thing, options, signature, returned):
    """Signature without arguments that are the program's own."""
    return re.sub(r", _\w+=[^,)]*", "", signature or ""), returned
