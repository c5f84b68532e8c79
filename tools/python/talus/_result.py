"""Results: the JSON of the command line with its keys as attributes."""

import html
import json
import os

import numpy

from . import _core


class Result:
    """A result with the keys of the command line's JSON as attributes, in its units (``bracket_deg``: degrees).

    Objects in it (``provenance``, the entries of ``evidence``) are Results, too; null is None. ``result["name"]`` is the same as
    ``result.name``, also for keys that are no Python names. ``to_dict()`` gives plain dictionaries and lists. An unknown name
    raises AttributeError or KeyError.
    """

    def __init__(self, values):
        self.__dict__["_values"] = values

    @classmethod
    def of_json(cls, text):
        """The result of a JSON object's text, as the command line prints it."""
        return cls(json.loads(text))

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"this result has no {name}; it has {', '.join(self._values)}") from None

    def __setattr__(self, name, value):
        raise AttributeError("results are not changed")

    def __getitem__(self, name):
        return _shown(self._values[name])

    def __contains__(self, name):
        return name in self._values

    def __iter__(self):
        return iter(self._values)

    def __len__(self):
        return len(self._values)

    def __dir__(self):
        return [*super().__dir__(), *self._values]

    def __eq__(self, other):
        return isinstance(other, Result) and self._values == other._values

    __hash__ = None

    def __reduce__(self):
        return type(self), (self._values,)

    def to_dict(self):
        """Plain dictionaries and lists (a copy)."""
        return json.loads(json.dumps(self._values))

    def __repr__(self):
        return f"Result({', '.join(f'{name}={_short(value)}' for name, value in self._values.items())})"

    def _repr_html_(self):
        rows = "".join(
            f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
            f"<td style='text-align:left'>{html.escape(_short(value, 200))}</td></tr>"
            for name, value in self._values.items()
        )
        return f"{self._picture()}<table>{rows}</table>"

    def _picture(self):
        """The curve of a search with the replay of its kept run, or the report of a batch."""
        kept, page = (self._values.get("kept_run") or {}).get("file"), self._values.get("page")
        played = _core.Snapshots(kept).page() if kept and os.path.exists(kept) else ""
        if page and os.path.exists(page):
            with open(page, encoding="utf-8") as stream:
                played = stream.read()
        curve = _core.curve(json.dumps(self._values)) if "path" in self._values else ""
        return curve[curve.find("<svg") :] + (frame_of(played) if played else "")


class SearchResult(Result):
    """The result of ``critical_angle``, ``safety_factor`` or ``critical_acceleration``. Beside the answer and its bracket:

    - ``path``: the curve, an array of shape (n, 2): largest displacement of a block [m], load (in the answer's unit)
    - ``answer_interval``, ``answer_interval_reasons``: lowest and highest answer found, and their causes; None without an answer
    - ``failure_displacement``: displacement between neighbours that counts as failure [share of the median block size]
    - ``answers_by_displacement``: ``displacement`` and ``load`` where another failure displacement gives another answer
    - ``failing_volume_m3``, ``failing_mass_kg``: of the failing blocks [m^3, kg]
    - ``limit_equilibrium``: ``value``, ``kind``, ``blocks`` of the closed formula; None where none applies
    """

    def __getitem__(self, name):
        if name != "path":
            return super().__getitem__(name)
        points = [(point["displacement_m"], point["load"]) for point in self._values[name]]
        return numpy.array(points, dtype=float).reshape(-1, 2)


def frame_of(page):
    """A page embedded in a notebook."""
    return f'<iframe srcdoc="{html.escape(page)}" width="100%" height="640" style="border:0"></iframe>'


def _shown(value):
    if isinstance(value, dict):
        return Result(value)
    if isinstance(value, list):
        return [_shown(element) for element in value]
    return value


def _short(value, length=60):
    text = json.dumps(value, ensure_ascii=False) if isinstance(value, (dict, list)) else repr(value)
    return text if len(text) <= length else text[: length - 4] + " ..."
