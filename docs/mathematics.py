"""Formulas as MathML, which browsers draw by themselves: no script, no network."""

from latex2mathml.converter import convert


def setup(app):
    """Take the place of Sphinx's own writers of formulas."""
    app.add_html_math_renderer("mathml", (inline, None), (displayed, None))
    app.config.html_math_renderer = "mathml"


def inline(translator, node):
    """Formula within a line."""
    translator.body.append(convert(node.astext()))
    raise nodes().SkipNode


def displayed(translator, node):
    """Formula on lines of its own; wide ones scroll."""
    formula = convert(node.astext(), display="block")
    translator.body.append(f'<div class="math" style="overflow: auto hidden">{formula}</div>')
    raise nodes().SkipNode


def nodes():
    """Docutils, loaded when a formula comes."""
    from docutils import nodes

    return nodes
