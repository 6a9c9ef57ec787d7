# SPDX-License-Identifier: LGPL-2.1-or-later
"""The manual: HTML from doc/*.md and doc/manual/*.md by Sphinx and MyST.

Built by contrib/manual.sh. Formulas need no network if Debian's libjs-mathjax is
there: what they need of it is copied into the manual; else they are shown by
the MathJax of a server. The pages that are written for Doxygen, for readers of
the repository or by the program stay as they are; what Sphinx wants else of
them is done here.
"""
import pathlib
import re
import shutil

import myst_parser
from docutils import nodes
from pygments.lexer import RegexLexer, bygroups
from pygments.token import Comment, Keyword, Name, Operator, String, Text
from sphinx import addnodes

ROOT = pathlib.Path(__file__).resolve().parent.parent
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
# of MathJax 2: TeX in, drawings out; no fonts that a browser has to fetch
MATHJAX_PARTS = ("MathJax.js", "config/TeX-AMS_SVG-full.js", "extensions",
                 "jax/element", "jax/input/TeX", "jax/output/SVG/*.js",
                 "jax/output/SVG/autoload", "jax/output/SVG/fonts/TeX")

project = "Keyblock"
author = "the authors of Keyblock"
version = re.search(r"project\(keyblock VERSION ([\d.]+)",
                    (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
release = version
extensions = ["myst_parser", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
root_doc = "index"
exclude_patterns = ["benchmark", "pictures", "manual/pictures"]
highlight_language = "none"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_update_mathjax = False
# newer releases warn of links to files of the repository that are no pages; the
# test of documents looks whether they are there
if int(myst_parser.__version__.split(".")[0]) >= 1:
    suppress_warnings = ["myst.xref_missing"]
# formulas have their own numbers, \tag{n}
math_number_all = False
suppress_warnings = ["myst.header"]

html_theme = "alabaster"
html_title = f"Keyblock {version}"
html_static_path = ["manual/static"]
html_copy_source = False
html_use_index = False
html_show_copyright = False
html_show_sphinx = False
html_show_sourcelink = False
html_sidebars = {"**": ["about.html", "searchbox.html", "navigation.html"]}
html_theme_options = {
    "description": "Blocks of rock around tunnels and caverns",
    "page_width": "1100px", "sidebar_width": "250px",
    "fixed_sidebar": True, "show_powered_by": False, "show_relbars": True}
html_css_files = ["manual.css"]

if (MATHJAX / "MathJax.js").exists():
    # within _static, where copy_mathjax puts it
    mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_SVG-full"
    mathjax2_config = {"SVG": {"scale": 92}, "showMathMenu": False, "messageStyle": "none",
                       "tex2jax": {"inlineMath": [["\\(", "\\)"]],
                                   "displayMath": [["\\[", "\\]"]],
                                   "processClass": "math", "ignoreClass": "document"},
                       "TeX": {"equationNumbers": {"autoNumber": "none"}}}


class SceneLexer(RegexLexer):
    """Colours of scenes, `.prm`."""

    name = "scene"
    aliases = ["prm"]
    tokens = {"root": [
        (r"\s*#.*\n", Comment),
        (r"(\s*)(subsection|include)( +)(.*\n)", bygroups(Text, Keyword, Text, Name.Class)),
        (r"(\s*)(end)(\s*\n)", bygroups(Text, Keyword, Text)),
        (r"(\s*)(set)( +)([^=\n]+)(=)(.*\n)",
         bygroups(Text, Keyword, Text, Name.Attribute, Operator, String)),
        (r".*\n", Text)]}


def copy_mathjax(app, error):
    """What formulas need of MathJax, into the manual."""
    if error or app.builder.format != "html" or not MATHJAX.exists():
        return
    to = pathlib.Path(app.outdir) / "_static" / "mathjax"
    for pattern in MATHJAX_PARTS:
        for path in MATHJAX.glob(pattern):
            target = to / path.relative_to(MATHJAX)
            target.parent.mkdir(parents=True, exist_ok=True)
            if path.is_dir():
                shutil.copytree(path, target, dirs_exist_ok=True)
            else:
                shutil.copy(path, target)


def keep_numbers(app, document):
    """Displayed formulas as they are: \\tag is not for the inside of a split."""
    for node in document.findall(nodes.math_block):
        node["nowrap"] = True
        text = "\\[" + node.astext().strip() + "\\]"
        node.children = [nodes.Text(text)]
        node.rawsource = text


def name_what_is_outside(app, env, node, contnode):
    """Files of the repository that are no pages are named, not linked."""
    if node.get("reftype") not in ("myst", "any"):
        return None
    here = pathlib.Path(env.doc2path(node["refdoc"])).parent
    path = (here / node["reftarget"].split("#")[0]).resolve()
    if path.exists() and (ROOT / "doc" not in path.parents):
        return nodes.inline("", contnode.astext(), classes=["file"])
    return None


def name_downloads(app, document):
    """The same for those that Sphinx would copy, before it looks for them."""
    for node in list(document.findall(addnodes.download_reference)):
        node.replace_self(nodes.inline("", node.astext(), classes=["file"]))


def show_formulas_on_one_page(app):
    """All pages in one (for the PDF) have formulas, though the index has none."""
    if app.builder.name == "singlehtml":
        app.set_html_assets_policy("always")


def setup(app):
    """What Sphinx calls."""
    app.add_lexer("prm", SceneLexer)
    app.connect("doctree-read", keep_numbers)
    app.connect("doctree-read", name_downloads, priority=100)
    app.connect("missing-reference", name_what_is_outside)
    app.connect("builder-inited", show_formulas_on_one_page)
    app.connect("build-finished", copy_mathjax)
