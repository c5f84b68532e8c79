"""Tables as TOML text for the scenario reader; Python's library reads TOML only."""

import json
import math
import re

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def text_of(tables):
    """The text of a scenario given as dictionaries and lists, in their order."""
    plain = {key: plain_value(value) for key, value in tables.items()}
    lines = [f"{_key(key)} = {_value(value)}" for key, value in plain.items() if not _is_section(value)]
    for key, value in plain.items():
        if isinstance(value, dict):
            lines += _section(_key(key), value)
        elif _is_section(value):
            for table in value:
                lines += [f"[[{_key(key)}]]", *_entries(table), ""]
    return "\n".join(lines) + "\n"


def plain_value(value):
    """numpy's numbers and arrays as Python's; tuples as lists."""
    if isinstance(value, dict):
        return {str(key): plain_value(each) for key, each in value.items()}
    if hasattr(value, "tolist"):
        return plain_value(value.tolist())
    if isinstance(value, (list, tuple)):
        return [plain_value(each) for each in value]
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    raise TypeError(f"a scenario cannot hold {value!r}")


def _is_section(value):
    return isinstance(value, dict) or (
        isinstance(value, list) and bool(value) and all(isinstance(each, dict) for each in value)
    )


def _section(name, table):
    """[name], or [name.KEY] for tables of named tables."""
    named = {key: value for key, value in table.items() if isinstance(value, dict)}
    if named and len(named) == len(table):
        return [line for key, value in named.items() for line in _section(f"{name}.{_key(key)}", value)]
    return [f"[{name}]", *_entries(table), ""]


def _entries(table):
    return [f"{_key(key)} = {_value(value)}" for key, value in table.items() if value is not None]


def _key(key):
    return key if _BARE.fullmatch(key) else _string(key)


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(_entries(value)) + " }" if value else "{}"
    return "[" + ", ".join(_value(each) for each in value) + "]"


def _number(value):
    """The shortest text that reads back as the same bits."""
    if not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    return repr(value)


def _string(text):
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007F")
