"""Rows of the reference: what `talus schema` says of a scenario or a sweep, and what `talus COMMAND --help` prints."""

import collections
import json
import os
import subprocess

Key = collections.namedtuple("Key", "name kind allowed required meaning unit")
Section = collections.namedtuple("Section", "header meaning keys")


def program(*arguments):
    """What the program that is documented prints."""
    return subprocess.run([os.environ["TALUS_PROGRAM"], *arguments], capture_output=True, check=True, text=True).stdout


def sections(what):
    """The sections of a scenario or a sweep, in the schema's order; keys of no section stand under ""."""
    properties = json.loads(program("schema", what))["properties"]
    single, found = [], []
    for name, schema in properties.items():
        table, header = _table(name, schema)
        if table is None:
            single.append(_key(name, schema, False))
        else:
            found.append(Section(header, _split(schema)[0], list(_keys(table))))
    return ([Section("", "", single)] if single else []) + found


def _table(name, schema):
    """The table of a section and how its header is written; None where it is a value."""
    if schema.get("type") == "array" and "properties" in schema.get("items", {}):
        return schema["items"], f"[[{name}]]"
    if isinstance(schema.get("additionalProperties"), dict):
        return schema["additionalProperties"], f"[{name}.NAME]"
    return (schema, f"[{name}]") if "properties" in schema else (None, "")


def _keys(table, before=""):
    for name, schema in table.get("properties", {}).items():
        yield _key(before + name, schema, name in table.get("required", ()))
        for inner, mark in _inner(schema):
            yield from _keys(inner, f"{before}{name}{mark}.")


def _inner(schema):
    """Tables inside a value: { box = { min, max } }, or a list of tables."""
    for each in (schema, *schema.get("anyOf", ())):
        if "properties" in each:
            yield each, ""
        elif "properties" in each.get("items", {}):
            yield each["items"], "[]"


def _key(name, schema, required):
    meaning, unit = _split(schema)
    return Key(name, _kind(schema), _allowed(schema), required, meaning, unit)


def _split(schema):
    """What the schema describes it as: the words, and the unit in brackets at their end."""
    text = schema.get("description", "")
    if text.endswith("]") and " [" in text:
        words, _, unit = text[:-1].rpartition(" [")
        return words, unit
    return text, ""


def _kind(schema):
    if "anyOf" in schema:
        return " or ".join(dict.fromkeys(_kind(each) for each in schema["anyOf"]))
    if "enum" in schema:
        return "choice"
    if schema.get("type") == "array":
        count = schema.get("minItems") if schema.get("minItems") == schema.get("maxItems") else None
        return f"{count or 'list of'} {_plural(_kind(schema.get('items', {})))}"
    names = {"object": "table", "string": "text", "integer": "whole number", "boolean": "true or false"}
    kind = schema.get("type", "value")
    return "value" if isinstance(kind, list) else names.get(kind, kind)


def _plural(kind):
    """Of them: "numbers", "lists of 3 numbers"."""
    if kind.startswith("list of "):
        return "lists of " + kind.removeprefix("list of ")
    return f"lists of {kind}" if kind[0].isdigit() else kind if kind == "true or false" else kind + "s"


def _allowed(schema):
    if "enum" in schema:
        return ", ".join(f'"{each}"' for each in schema["enum"])
    least = f"at least {schema['minimum']:g}" if "minimum" in schema else ""
    least = f"above {schema['exclusiveMinimum']:g}" if "exclusiveMinimum" in schema else least
    most = f"at most {schema['maximum']:g}" if "maximum" in schema else ""
    most = f"below {schema['exclusiveMaximum']:g}" if "exclusiveMaximum" in schema else most
    return ", ".join(part for part in (least, most) if part)


def commands():
    """Names of the subcommands, as `talus --help` lists them."""
    lines = program("--help").partition("Subcommands:\n")[2].partition("\n\n")[0].splitlines()
    return [line.split()[0] for line in lines if line.startswith("  ") and not line.startswith("   ")]
