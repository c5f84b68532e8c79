"""Talus: rigid-block discrete elements for jointed rock slopes with water in their fissures.

    import talus
    model = talus.load("slope.toml")            # or talus.Model() and its methods
    result = talus.safety_factor(model)
    result.safety_factor, result.failure_mode   # the names of the command line's JSON

Units are SI; angles are degrees where a name ends in ``_deg``. A model is a ``talus.Model`` or the path of a scenario file.
Functions that compute take ``threads`` (0: all cores; the answer is the same to the bit) and ``progress``, a function called from
time to time with (stage, fraction 0..1, detail). They release Python's global lock, and Ctrl-C stops them.

Errors of all functions: ``talus.ScenarioError`` for faults of a model, a file or an argument, with all faults found; ``OSError``
for a file that cannot be written, or that exists and may not be replaced; ``KeyboardInterrupt`` after Ctrl-C.
"""

from . import _core
from ._errors import ScenarioError
from ._errors import path_of as _path_of
from ._map import FailureMap
from ._model import Model
from ._result import Result, SearchResult
from ._run import Contacts, Run, Simulation, open

__version__ = _core.version
__all__ = [
    "Contacts",
    "FailureMap",
    "Model",
    "Result",
    "Run",
    "ScenarioError",
    "SearchResult",
    "Simulation",
    "batch",
    "critical_acceleration",
    "critical_angle",
    "failure_map",
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
    """A scenario file (TOML) as a Model. Raises ScenarioError with the line and column of every fault."""
    return Model._loaded(_core.read(_path_of(file)))


def _model(model):
    """The scenario of a model or of a scenario file."""
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
    """The tilt at which the assembly first fails, as a SearchResult.

    Main entries: ``critical_angle_deg`` and ``bracket_deg`` (last stable and first failing tilt) [degrees], ``failure_mode``.

    ceiling: whether limit analysis gives an upper bound; None: for models up to a certain size.
    range: whether a second loading path gives the lower end of ``answer_interval``; None: for models up to a certain size.
    keep_run: a .mcap file for the failing run, over keep_run_seconds [s] or until the failure is plain to see.
    force: whether keep_run may replace a finished run.
    plot, picture: .svg files for the curve of load against displacement and for the failing blocks.

    Method: the equilibrium path with the tilt as an unknown; see "How a search decides" in the guide.
    """
    return _search("critical-angle", model, threads=threads, progress=progress, ceiling=ceiling, range=range, keep_run=keep_run,
                   keep_run_seconds=keep_run_seconds, force=force, plot=plot, picture=picture)


def safety_factor(model, *, threads=0, progress=None, groups=1, ceiling=None, range=None, keep_run=None, keep_run_seconds=None,
                  force=False, plot=None, picture=None):
    """The factor by which all strengths can be divided before the assembly fails at its own tilt, as a SearchResult.

    Main entries: ``safety_factor`` and ``bracket`` (last stable and first failing factor) [-], ``failure_mode``.

    groups: number of successive failure groups to find. Other arguments as in critical_angle.
    """
    return _search("safety-factor", model, threads=threads, progress=progress, groups=groups, ceiling=ceiling, range=range,
                   keep_run=keep_run, keep_run_seconds=keep_run_seconds, force=force, plot=plot, picture=picture)


def critical_acceleration(model, *, threads=0, progress=None, ceiling=None, range=None, keep_run=None, keep_run_seconds=None,
                          force=False, plot=None, picture=None):
    """The horizontal seismic coefficient at which the assembly first fails at its own tilt, as a SearchResult.

    Main entries: ``critical_k`` and ``bracket`` (last stable and first failing one) [share of the weight], ``failure_mode``.

    Arguments as in critical_angle.
    """
    return _search("critical-acceleration", model, threads=threads, progress=progress, ceiling=ceiling, range=range, keep_run=keep_run,
                   keep_run_seconds=keep_run_seconds, force=force, plot=plot, picture=picture)


def limit_analysis(model, load="factor", *, max_points=_core.max_contact_points, threads=0, progress=None):
    """The limit load of the associated rigid-block problem, an upper bound of every search's answer.

    Main entries: ``lower`` and ``upper`` (ends of its bracket, in the load's unit), ``moving_blocks`` (names).

    load: the load that grows, "tilt" [degrees], "factor" [-] or "horizontal" [share of the weight].
    max_points: largest number of contact points; a larger model raises ScenarioError.

    Source: the static theorem (Drucker 1954; for blocks Livesley 1978), as linear programmes.
    """
    return Result.of_json(
        _core.limit_analysis(_model(model), load=load, max_points=max_points, threads=threads, progress=progress)
    )


def keyblocks(model, *, most=_core.most_groups, threads=0, progress=None):
    """Block theory: removable blocks and groups that move together, by limit equilibrium in translation.

    Main entries: ``blocks`` (mode, direction and factor of safety of each free block), ``moving_groups`` (by ascending factor).

    most: number of groups to list, those with the least factors of safety.

    Sources: Goodman and Shi (1985) for removability, Warburton (1981) for the direction of motion.
    """
    return Result.of_json(_core.keyblocks(_model(model), most=most, threads=threads, progress=progress))


def kinematics(source, *, slope, friction, lateral=20.0, sets=0, scanline=None, bias_limit=None, stereonet=None, view="poles",
               net="equal-area", contours="fisher", counting_area=1.0):
    """Kinematic tests: which planes and lines of intersection of a slope can slide or topple.

    Main entries: ``planar``, ``wedge``, ``direct_toppling``, ``flexural_toppling`` (counts and percent), ``sets``.

    source: a table of poles (.csv, .tsv, .txt, .dat), a scenario file, or a model with a rock mass.
    slope: (dip, dip direction) of the face [degrees]. friction, lateral: friction angle and lateral limits [degrees].
    sets: number of sets to find; 0: those of the source.
    scanline: (trend, plunge) [degrees], for Terzaghi's weights. bias_limit: least angle for these weights [degrees].
    stereonet: an .svg file. view: "poles" or "intersections". net: "equal-area" or "equal-angle".
    contours: "fisher", "circle" or "none". counting_area: of the contours [% of the hemisphere].

    Sources: Markland (1972) and Hocking (1976) for sliding, Goodman and Bray (1976) and Hudson and Harrison (1997) for toppling.
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
    """Writes a page about a slope (.html), with its figures as SVG and CSV files.

    Main entries: ``page``, ``figures`` (paths), ``search``, ``key_blocks`` (results).

    output: the page. figures: their folder; by default FILE_figures beside the page.
    analysis: "safety-factor", "critical-angle" or "critical-acceleration"; by default that of the scenario.
    slope: (dip, dip direction) of the stereonet's face [degrees]; by default that of the model.
    groups: number of successive failure groups in a search for a factor of safety.
    sensitivity: change of friction and stiffness, each way, for repeated searches [%]; None: no such searches.
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

    step_s: between two times [s]. duration_s: the end, by default that of the tables of rain, inflow, levels and strength. plot,
    csv: an .svg file of factor and level over time, and a .csv file with a row for each time.
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
    """A time history of a model.

    Main entries: ``steps``, ``simulated_seconds`` [s], ``kinetic_energy_j`` [J], ``watch`` (watched blocks), ``state_hash``.

    output: a .mcap file for frames, or a .csv file for energies; None: no file.
    resume: a .mcap file of an earlier run, in place of the model; the run continues to the same bits.
    full_every: number of frames from one full state, with contacts, to the next.
    force: whether a finished file may be replaced.
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
    """A sweep or Monte Carlo simulation: many runs of one scenario in parallel, with results.csv and a report in a folder.

    Main entries: ``runs``, ``done``, ``failed`` (counts), ``results`` (the CSV file), ``summary``, ``page``.

    sweep: the sweep file (TOML). folder: of the results; the same call continues an interrupted batch.
    retry: whether failed runs are computed again.
    """
    return Result.of_json(
        _core.batch(_path_of(sweep), _path_of(folder), retry=retry, threads=threads, progress=progress)
    )


def failure_map(sweep, folder, *, cell_size=None, threads=0, progress=None):
    """The probability of failure over the face of a rock mass, from a finished batch, as a FailureMap.

    The same map as ``talus batch SWEEP -o FOLDER --map FILE``. No run is computed.

    sweep: the sweep file (TOML). folder: of its results, as given to ``talus.batch``.
    cell_size: of the cells [m]; None: some 2,000 cells.
    """
    return FailureMap(
        *_core.failure_map(_path_of(sweep), _path_of(folder), cell_size=cell_size, threads=threads, progress=progress)
    )
