"""What the guide needs of Sphinx: formulas as MathML (no script, no network), help texts of commands."""

import re

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.utils.math import latex2mathml
from pygments.lexer import RegexLexer
from pygments.token import Number, Punctuation, Text

import reference


def visit_math(writer, node):
    writer.body.append(latex2mathml.tex2mathml(node.astext(), inline=True))
    raise nodes.SkipNode


class Csv(RegexLexer):
    """Tables as text: numbers and words between commas. Pygments has none."""

    name, aliases = "csv", ["csv"]
    tokens = {"root": [(r"-?[\d.]+(e-?\d+)?", Number), (r",", Punctuation), (r"[^,\d\n-]+|-", Text), (r"\n", Text)]}


def visit_math_block(writer, node):
    number = f'<span class="number">({node["number"]})</span>' if node["number"] else ""
    writer.body.append(f'<div class="math">{number}{latex2mathml.tex2mathml(node.astext(), inline=False)}</div>\n')
    raise nodes.SkipNode


class Commands(Directive):
    """The help text of every command."""

    def run(self):
        result = []
        for command in ("", *reference.commands()):
            title = f"talus {command}".strip()
            node = nodes.section(ids=[nodes.make_id(title)], names=[title])
            text = reference.program(*filter(None, (command,)), "--help")
            node += [nodes.title("", title), nodes.literal_block(text, text, language="none")]
            result.append(node)
        return result


# What the tests are told of a block (tests/docs/guide.py) that readers want to see, too: which file it is, or goes on with.
TOLD = re.compile(r"^<!-- (file|with): (\S+) -->\n((?:<!-- .* -->\n)*)```(\w+)\n", re.M)


def show_file_names(app, document, source):
    source[0] = TOLD.sub(
        lambda told: f"{told[3]}```{{code-block}} {told[4]}\n:caption: {'added to ' if told[1] == 'with' else ''}{told[2]}\n", source[0]
    )


def setup(app):
    app.connect("source-read", show_file_names)
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_math_block, None))
    app.add_lexer("csv", Csv)
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
