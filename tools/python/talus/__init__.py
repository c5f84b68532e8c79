"""Talus: rigid-block discrete elements for jointed rock slopes with water in their fissures.

    import talus
    model = talus.load("slope.toml")            # or talus.Model() and its methods
    result = talus.safety_factor(model)
    result.safety_factor, result.failure_mode   # the names of the command line's JSON

Units are SI; angles are degrees where a name ends in ``_deg``. Every function that computes takes ``threads`` (0: all cores; the
answer is the same to the bit) and ``progress``, called with (stage, fraction, detail) now and then. Python's lock is free while
it computes, and Ctrl-C stops it. What is wrong with the input is raised as ``talus.ScenarioError``.
"""

from . import _core
from ._errors import ScenarioError
from ._errors import path_of as _path_of
from ._model import Model
from ._result import Result, SearchResult
from ._run import Contacts, Run, Simulation, open

__version__ = _core.version
__all__ = [
    "Contacts",
    "Model",
    "Result",
    "Run",
    "ScenarioError",
    "SearchResult",
    "Simulation",
    "batch",
    "critical_acceleration",
    "critical_angle",
    "keyblocks",
    "kinematics",
    "limit_analysis",
    "load",
    "open",
    "report",
    "run",
    "safety_factor",
    "storm",
]


def load(file):
    """Reads a scenario file (TOML). Raises ScenarioError with every fault, its line and column."""
    return Model._loaded(_core.read(_path_of(file)))


def _model(model):
    """A model, or the file it is in."""
    return (model if isinstance(model, Model) else load(model))._read()


def _search(name, model, *, threads=0, progress=None, groups=1, ceiling=None, range=None, keep_run=None, keep_run_seconds=None,
            force=False, plot=None, picture=None):
    return SearchResult.of_json(
        _core.search(
            name,
            _model(model),
            groups=groups,
            ceiling=ceiling,
            range=range,
            keep_run=_path_of(keep_run) if keep_run is not None else "",
            keep_run_seconds=keep_run_seconds,
            force=force,
            plot=_path_of(plot) if plot is not None else "",
            picture=_path_of(picture) if picture is not None else "",
            threads=threads,
            progress=progress,
        )
    )


def critical_angle(model, *, threads=0, progress=None, ceiling=None, range=None, keep_run=None, keep_run_seconds=None, force=False,
                   plot=None, picture=None):
    """The tilt at which the assembly first fails: ``critical_angle_deg``, ``bracket_deg``, ``failure_mode``, ... [degrees]

    ceiling: True, False, or None: limit analysis beside it up to a model's size; range: likewise another loading history, for
    ``range`` and ``range_reason``. keep_run: a .mcap file for the run in which it
    fails, over keep_run_seconds or until it is plain to see; force replaces a finished one. plot, picture: .svg files for the curve
    of load against displacement and for the blocks that fail.
    """
    return _search("critical-angle", model, threads=threads, progress=progress, ceiling=ceiling, range=range, keep_run=keep_run,
                   keep_run_seconds=keep_run_seconds, force=force, plot=plot, picture=picture)


def safety_factor(model, *, threads=0, progress=None, groups=1, ceiling=None, range=None, keep_run=None, keep_run_seconds=None,
                  force=False, plot=None, picture=None):
    """The factor by which all strengths can be divided before it fails, at the model's own tilt: ``safety_factor``, ``bracket``.

    groups: how many groups of blocks to follow, one going after the other. The rest as of critical_angle.
    """
    return _search("safety-factor", model, threads=threads, progress=progress, groups=groups, ceiling=ceiling, range=range,
                   keep_run=keep_run, keep_run_seconds=keep_run_seconds, force=force, plot=plot, picture=picture)


def critical_acceleration(model, *, threads=0, progress=None, ceiling=None, range=None, keep_run=None, keep_run_seconds=None,
                          force=False, plot=None, picture=None):
    """The horizontal seismic coefficient at which it first fails, at the model's own tilt: ``critical_k`` [share of the weight].

    The rest as of critical_angle.
    """
    return _search("critical-acceleration", model, threads=threads, progress=progress, ceiling=ceiling, range=range, keep_run=keep_run,
                   keep_run_seconds=keep_run_seconds, force=force, plot=plot, picture=picture)


def limit_analysis(model, load="factor", *, max_points=_core.max_contact_points, threads=0, progress=None):
    """The limit of the associated rigid-block problem, which no other answer is above: ``lower``, ``upper``, ``moving_blocks``.

    load: what grows, "tilt" [degrees], "factor" or "horizontal" [share of the weight].
    """
    return Result.of_json(
        _core.limit_analysis(_model(model), load=load, max_points=max_points, threads=threads, progress=progress)
    )


def keyblocks(model, *, most=_core.most_groups, threads=0, progress=None):
    """Block theory: removable ``blocks`` and ``moving_groups`` with their factors, by limit equilibrium (translation only).

    most: how many groups to list, those with the least factors of safety.
    """
    return Result.of_json(_core.keyblocks(_model(model), most=most, threads=threads, progress=progress))


def kinematics(source, *, slope, friction, lateral=20.0, sets=0, scanline=None, bias_limit=None, stereonet=None, view="poles",
               net="equal-area", contours="fisher", counting_area=1.0):
    """What of a slope's planes can slide or topple: ``planar``, ``wedge``, ``direct_toppling``, ``flexural_toppling``, ``sets``.

    source: a table of poles (.csv, .tsv, .txt, .dat), a scenario file, or a model with a rock mass. slope: dip and dip direction of
    the face [degrees]; friction and lateral limits [degrees]. sets: so many are found, in place of those of the source.
    scanline: trend and plunge [degrees], for Terzaghi's weights, down to bias_limit. stereonet: an .svg file, of the "poles" or
    the "intersections", on an "equal-area" or "equal-angle" net; contours by "fisher", "circle" or "none", per counting_area [%].
    """
    table = not isinstance(source, Model) and _core.is_pole_table(_path_of(source))
    return Result.of_json(
        _core.kinematics(
            None if table else _model(source),
            _path_of(source) if table else "",
            slope=slope,
            friction=friction,
            lateral=lateral,
            sets=sets,
            scanline=scanline,
            bias_limit=bias_limit,
            stereonet=_path_of(stereonet) if stereonet is not None else "",
            view=view,
            net=net,
            contours=contours,
            counting_area=counting_area,
        )
    )


def report(model, output, *, figures=None, analysis=None, slope=None, groups=1, sensitivity=None, threads=0, progress=None):
    """One page about a slope (.html), its figures as SVG and CSV beside it: ``page``, ``figures``, ``search``, ``key_blocks``.

    figures: their folder, by default FILE_figures beside the page. analysis: "safety-factor", "critical-angle" or
    "critical-acceleration", by default that of the scenario. slope: dip and dip direction of the stereonet's face [degrees],
    by default that of the model. groups: how many a search for a factor of safety follows. sensitivity: search again with
    friction and stiffness less and more by so many percent.
    """
    return Result.of_json(
        _core.report(
            _model(model),
            output=_path_of(output),
            figures=_path_of(figures) if figures is not None else "",
            analysis=analysis or "",
            slope="" if slope is None else f"{float(slope[0])}/{float(slope[1])}",
            groups=groups,
            sensitivity=sensitivity,
            threads=threads,
            progress=progress,
        )
    )


def storm(model, *, step_s=600.0, duration_s=None, plot=None, csv=None, threads=0, progress=None):
    """The factor of safety over a rain: ``times`` (``time_s``, ``level_m``, ``safety_factor``), ``least``, ``failure_time_s``.

    step_s: between two times [s]. duration_s: the end, by default that of the tables of rain, inflow and levels. plot, csv: an .svg
    file of factor and level over time, and a .csv file with a row for each time.
    """
    return Result.of_json(
        _core.storm(
            _model(model),
            step=step_s,
            duration=duration_s,
            plot=_path_of(plot) if plot is not None else "",
            csv=_path_of(csv) if csv is not None else "",
            threads=threads,
            progress=progress,
        )
    )


def run(model=None, output=None, *, resume=None, full_every=10, force=False, threads=0, progress=None):
    """Time history: ``steps``, ``kinetic_energy_j``, ``watch``, ``state_hash``, ...; frames go to a .mcap file, energies to a .csv.

    output: that file, or None. resume: a .mcap file that was begun earlier, in place of the model; it goes on to the same bits.
    full_every: the full state, with contacts, every so many frames. force replaces a finished file.
    """
    if (model is None) == (resume is None):
        raise TypeError("give either a model or resume=FILE, which brings its own")
    return Result.of_json(
        _core.run(
            None if model is None else _model(model),
            output=_path_of(output) if output is not None else "",
            resume=_path_of(resume) if resume is not None else "",
            full_every=full_every,
            force=force,
            threads=threads,
            progress=progress,
        )
    )


def batch(sweep, folder, *, retry=False, threads=0, progress=None):
    """A sweep or Monte Carlo: many runs of one scenario side by side, results.csv and a report in a folder.

    sweep: its file; the same call goes on where it was stopped. retry computes failed runs again.
    Gives ``runs``, ``done``, ``failed``, ``results`` (the CSV file), ``summary`` and ``page``.
    """
    return Result.of_json(
        _core.batch(_path_of(sweep), _path_of(folder), retry=retry, threads=threads, progress=progress)
    )
