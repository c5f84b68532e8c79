"""The picture beside a search's result: what it probed, what stood and what failed, as SVG."""

import html

_COLOURS = {"stable": "#2b7bba", "failing": "#c8322b", "undecided": "#8a8a8a"}
_WORDS = {"stable": "stands", "failing": "fails", "undecided": "undecided"}
_MARKS = ("ceiling", "theory_deg", "theory_factor", "theory_k")
_WIDTH, _LEFT, _RIGHT, _ROW = 560, 24, 24, 20


def probes(values):
    """The loads that were probed, one below the other in their order; "" where there are none.

    values: a search's result as dictionaries. Beside the probes stand the closed formula and limit analysis' ceiling.
    """
    listed = values.get("probe_list") or []
    loads = [_load(probe) for probe in listed]
    if not listed or None in loads:
        return ""
    marks = [(value, name.split("_")[0]) for name, value in values.items() if name in _MARKS and value is not None]
    low, high = min(loads + [value for value, _ in marks]), max(loads + [value for value, _ in marks])
    span = high - low or 1.0

    def x(load):
        return _LEFT + (load - low) / span * (_WIDTH - _LEFT - _RIGHT)

    height = 34 + _ROW * len(listed) + 16 * len(marks)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {height}" style="max-width:{_WIDTH}px" font-size="11" font-family="sans-serif">']
    for k, (value, word) in enumerate(marks):
        y = 12 + 16 * k
        anchor = "end" if x(value) > _WIDTH / 2 else "start"
        parts.append(f'<line x1="{x(value):.1f}" x2="{x(value):.1f}" y1="{y + 3}" y2="{height - 18}" stroke="#888" stroke-dasharray="3 3"/>')
        parts.append(f'<text x="{x(value):.1f}" y="{y}" text-anchor="{anchor}" fill="#666">{word} {value:.6g}</text>')
    for k, (probe, load) in enumerate(zip(listed, loads)):
        y = 18 + 16 * len(marks) + _ROW * k
        verdict = probe.get("verdict", "undecided")
        colour = _COLOURS.get(verdict, _COLOURS["undecided"])
        side, anchor = (-8, "end") if x(load) > _WIDTH / 2 else (8, "start")
        words = f"{load:.6g} {_WORDS.get(verdict, verdict)}"
        parts.append(f'<circle cx="{x(load):.1f}" cy="{y}" r="4.5" fill="{colour}"><title>{html.escape(probe.get("reason", words))}</title></circle>')
        parts.append(f'<text x="{x(load) + side:.1f}" y="{y + 4}" text-anchor="{anchor}" fill="{colour}">{html.escape(words)}</text>')
    name = next(key for key in listed[0] if _is_load(key))
    parts.append(f'<text x="{_WIDTH / 2}" y="{height - 4}" text-anchor="middle" fill="#666">{html.escape(_title(name))}</text></svg>')
    return "".join(parts)


def _is_load(key):
    return key in ("tilt_deg", "factor", "horizontal", "k")


def _load(probe):
    return next((value for key, value in probe.items() if _is_load(key)), None)


def _title(name):
    return {"tilt_deg": "tilt [deg]", "factor": "factor of safety", "horizontal": "k_h"}.get(name, name)
