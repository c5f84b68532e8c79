#include "schema/descriptions.h"

#include <algorithm>

namespace talus::formats::schema {

namespace {

// Numbers of a joint are described in talus/joint.h.
constexpr Description kScenario[] = {
    {"format", "version of the file format"},

    {"analysis", "what searches vary, and how finely"},
    {"analysis.start_deg", "critical-angle: tilt where the search starts; default gravity.tilt_deg"},
    {"analysis.stop_deg", "critical-angle: tilt where the search ends; default 45"},
    {"analysis.tolerance_deg", "critical-angle: width of the bracket; default 0.01"},
    {"analysis.factor_tolerance", "safety-factor: width of the bracket; default 0.001"},
    {"analysis.acceleration_tolerance", "critical-acceleration: width of the bracket; default 0.0001"},
    {"analysis.least_mass_share",
     "searches: a failing group with less than this share of the free blocks' mass is removed and named, and "
     "the search continues with the rest; default 0.01 with [rock_mass], otherwise 0: nothing is removed"},
    {"analysis.failure_displacement",
     "searches: a slope has failed if neighbouring blocks part by more than this before they reach a new "
     "equilibrium; share of the median block size; default 0.0003"},
    {"analysis.reduce_tensile_strength",
     "whether the factor of safety also divides tensile strengths; default false"},
    {"analysis.time_scaling",
     "searches scale the inertia of each block to the same time step, which is faster and does not change "
     "the answer; default true"},

    {"run", "the time history of `talus run`"},
    {"run.duration_s", "duration; default that of the ground motion's record"},
    {"run.time_step_s", "time step; default: the longest one that stiffnesses and masses allow"},
    {"run.frame_interval_s", "time between two frames of the snapshot file"},
    {"run.watch", "names of blocks that the result and histories report"},
    {"run.start",
     "\"equilibrium\" under weight and water if there is one (default; coupled flow needs one), or "
     "\"unstressed\": weight and water are applied at once"},

    {"gravity", "magnitude and direction of gravity"},
    {"gravity.magnitude", "default 9.81"},
    {"gravity.tilt_deg",
     "angle by which gravity is turned about y; downhill is -x if it is positive; default 0"},
    {"gravity.direction", "instead of tilt_deg: direction of gravity, x y z, of any length"},

    {"contact", "contact points of faces that touch"},
    {"contact.points",
     "\"vertex\" (default: nine on a rectangle), \"corner\" (four), \"quarter\" (the paper's rule), \"grid "
     "N\" (N x N, rectangles only)"},

    {"material", "material of blocks"},
    {"material.NAME.density", "mass per volume"},

    {"joint", "strength and stiffness of interfaces; [joint.default] applies where none is named"},
    {"joint.NAME.law", "how strength follows the normal stress; default \"coulomb\""},
    {"joint.NAME.shear_strength",
     "law \"envelope\": points [normal stress, strength] in Pa; normal stress begins at 0 and increases, "
     "strength does not decrease"},
    {"joint.NAME.strength_over_time",
     "factor of all strengths over time, [time s, factor], for `talus run` and `talus storm`; searches use "
     "the factor at time 0; default 1"},

    {"stack", "a regular stack of blocks on a fixed floor"},
    {"stack[].name", "prefix of its blocks' names, needed when there are several stacks"},
    {"stack[].origin",
     "the toe's lower corner: x of the toe face, y of the first slice, z of the floor's top; default 0 0 0"},
    {"stack[].columns", "along x, numbered from the toe"},
    {"stack[].rows", "along z, numbered from the floor"},
    {"stack[].slices", "along y"},
    {"stack[].block", "size of one block, x y z"},
    {"stack[].bond", "\"stack\" (default), or \"running\": every second row shifted by half a block uphill"},
    {"stack[].heights", "rows of each column, at most `rows`; default all"},
    {"stack[].bed_joint", "joint between rows and with the floor"},
    {"stack[].side_joint", "joint between slices"},
    {"stack[].joint", "joint between columns"},
    {"stack[].bed_friction_deg",
     "friction angle of each bed from the floor up, or of each bed and column, [bed][column]"},
    {"stack[].row_material", "material of each row from the floor up"},

    {"block", "a block placed by hand: box, vertices, parts or mesh"},
    {"block[].name", "name in messages, results and other tables"},
    {"block[].parts", "parts of one body: boxes or hulls that share faces and do not overlap"},
    {"block[].mesh",
     "closed mesh with faces outwards: .obj, .stl, .ply or .dxf (text); path relative to the scenario's "
     "folder"},
    {"block[].scale", "factor from the mesh's unit to metres; default 1"},
    {"block[].tolerance",
     "vertices closer to each other than this are merged; default 1e-6 of the longest side, with repair "
     "1e-4"},
    {"block[].repair",
     "whether to drop doubled triangles, turn triangles to face alike and close small holes; default false"},
    {"block[].largest_hole", "with repair: widest hole that is closed; default 0.05 of the longest side"},
    {"block[].layer", "of a DXF file: only faces on this layer"},
    {"block[].each_solid",
     "whether every solid of the mesh is a block, named by `name` and its own name or number; default false"},
    {"block[].joint",
     "joint of its faces; between blocks with different joints, the one with less friction applies"},
    {"block[].fixed", "whether it does not move; default false"},
    {"block[].driven", "whether it keeps its velocity under any force; default false"},
    {"block[].velocity", "velocity at the start, x y z; default 0 0 0"},
    {"block[].angular_velocity",
     "angular velocity of a free block at the start, x y z, right-handed, about its centroid; default 0 0 0"},

    {"rock_mass", "a region that joints cut into blocks"},
    {"rock_mass.name", "prefix of its blocks' names"},
    {"rock_mass.region", "region to cut: a box, a profile with y, or a surface from a file"},
    {"rock_mass.region.profile", "corners [x, z] of a simple polygon, extruded along y"},
    {"rock_mass.region.y", "extent of the profile along y: from, to"},
    {"rock_mass.region.slope_azimuth_deg",
     "azimuth that the profile's lower end faces, clockwise from north (+y); the region is turned about the "
     "vertical; default 270 where that is the -x end, else 90"},
    {"rock_mass.region.mesh",
     "surface file: .stl, .obj, .ply, .dxf (text), .asc (ESRI ASCII grid) or .xyz (points) by the end of its "
     "name; path relative to the "
     "scenario's folder"},
    {"rock_mass.region.stl", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.obj", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.ply", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.asc", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.dxf", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.xyz", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.scale", "factor from the file's unit to metres; default 1"},
    {"rock_mass.region.shift", "subtracted from all coordinates of the file, x y z"},
    {"rock_mass.region.base", "closes an open terrain by vertical sides and a level base at this elevation"},
    {"rock_mass.region.tolerance",
     "vertices closer to each other than this are merged; default 1e-6 of the longest side, with repair "
     "1e-4"},
    {"rock_mass.region.repair",
     "whether to drop doubled triangles, turn triangles to face alike and close small holes; default false"},
    {"rock_mass.region.largest_hole",
     "with repair: widest hole that is closed; default 0.05 of the longest side"},
    {"rock_mass.region.layer", "of a DXF file: only faces on this layer"},
    {"rock_mass.region.cell_m", "of points: side of the square cells, each of which has one height"},
    {"rock_mass.region.cell_height", "of points: \"mean\" (default) or \"median\" of those in a cell"},
    {"rock_mass.region.simplify", "coarsens the surface; no part of it moves by more than this distance"},
    {"rock_mass.joint", "strength of the ground and of all faces that no joint made; default \"default\""},
    {"rock_mass.min_thickness", "smallest thickness of a part that a cut may leave"},
    {"rock_mass.slivers",
     "a cut that leaves a thinner part: \"merge\" omits it with a warning (default), \"refuse\" makes it an "
     "error"},
    {"rock_mass.seed", "seed of the random numbers; default 1"},
    {"rock_mass.fixed", "blocks that do not move, by box, plane, joint, boundary or name"},
    {"rock_mass.fixed[].box", "blocks with their centroid inside this box"},
    {"rock_mass.fixed[].plane", "blocks that lie entirely below a plane, or on `side` of it"},
    {"rock_mass.fixed[].plane.point", "point of the plane, x y z"},
    {"rock_mass.fixed[].joint", "blocks that lie entirely below this joint, or on `side` of it"},
    {"rock_mass.fixed[].boundary", "blocks with a face on this side of the region's bounds"},
    {"rock_mass.fixed[].name", "name of a block"},
    {"rock_mass.fixed[].side", "side of the plane or joint: \"below\" (default), \"above\", \"touching\""},
    {"rock_mass.names", "names = { NAME = [x, y, z] }: name of the block at a point [m]"},
    {"rock_mass.names.NAME", "a point inside the block, x y z"},
    {"rock_mass.bridge",
     "joint with the strength of intact rock beyond finite joints; default: the strength of the joint "
     "itself"},
    {"rock_mass.max_blocks",
     "largest number of blocks; a model with more is refused before it is cut; default 2000000"},

    {"joint_set", "parallel, or scattered, planes that cut the rock mass"},
    {"joint_set[].name", "name; it takes the strength [joint.NAME], if there is one"},
    {"joint_set[].spacing", "mean distance between planes, measured normal to them"},
    {"joint_set[].origin", "point on plane 0; default the lower corner of the region's bounds"},
    {"joint_set[].offset", "shift of plane 0 along the upward normal; default 0"},
    {"joint_set[].spacing_law", "\"constant\" (default), \"uniform\", \"exponential\""},
    {"joint_set[].spacing_spread",
     "uniform: spacings range from spacing (1 - this) to spacing (1 + this); default 0.5"},
    {"joint_set[].ends_at",
     "name of the joint set, or single joint, at whose planes these joints end; between each two of its "
     "planes they begin at a random place"},
    {"joint_set[].joint", "strength, instead of the one by its name"},

    {"single_joint", "one plane, disc or convex polygon that cuts the rock mass"},
    {"single_joint[].name", "name, also for [[water]]; it takes the strength [joint.NAME], if there is one"},
    {"single_joint[].point", "point of the plane; centre of the disc"},
    {"single_joint[].radius", "radius of a disc; default none: an infinite plane"},
    {"single_joint[].polygon", "instead: corners [x, y, z] of a convex plane polygon [m]"},
    {"single_joint[].joint", "strength, instead of the one by its name"},

    {"fracture_set", "discs drawn at random, or read from a file, that cut the rock mass"},
    {"fracture_set[].name", "name; it takes the strength [joint.NAME], if there is one"},
    {"fracture_set[].joint", "strength, instead of the one by its name"},
    {"fracture_set[].file",
     "discs from a table: x_m, y_m, z_m; an orientation as in pole tables; radius_m, diameter_m or trace_m, "
     "or "
     "of ellipses semi_major_m, semi_minor_m and rake_deg; or traces from a .dxf file"},
    {"fracture_set[].layer", "of a .dxf file: only traces on this layer"},
    {"fracture_set[].radius_law", "\"constant\" (default), \"lognormal\", \"power\""},
    {"fracture_set[].radius", "constant: radius of all discs; lognormal: mean radius"},
    {"fracture_set[].radius_deviation", "lognormal: standard deviation of the radius"},
    {"fracture_set[].radius_exponent", "power: exponent; the density decreases as radius^-exponent"},
    {"fracture_set[].radius_min", "smallest radius"},
    {"fracture_set[].radius_max", "largest radius"},
    {"fracture_set[].p32", "area of discs inside the region over its volume"},
    {"fracture_set[].count", "instead of p32: number of discs with their centre inside the region"},

    {"water",
     "water in a joint of a stack, between two blocks, on a face, in a joint of the rock mass, or below a "
     "surface"},
    {"water[].fissure",
     "number N of the fissure between columns N and N + 1 of a stack; 0 is the free face of the toe, "
     "`columns` that of the back"},
    {"water[].stack", "name of the stack, if there are several"},
    {"water[].between", "two blocks; uplift on their interface by `head`"},
    {"water[].block", "a block whose `face` is wet"},
    {"water[].joint", "name of a single joint or a joint set of the rock mass"},
    {"water[].plane", "number of a joint set's plane"},
    {"water[].depth", "height of the water from `base`, along the joint's steepest line"},
    {"water[].elevation", "instead of depth: height of the water table above the model's origin"},
    {"water[].levels", "instead of depth: depth over time, [time s, depth m]"},
    {"water[].elevations", "instead of depth: elevation over time, [time s, elevation m]"},
    {"water[].head",
     "head at the +x and the -x end of the contact (+z and -z if it is vertical), linear in between"},
    {"water[].base", "lower end of the water, above the floor; default the joint's lowest point"},
    {"water[].drains_at_aperture", "aperture beyond which the joint drains for good; default never"},
    {"water[].density", "default 1000"},
    {"water[].volume",
     "\"held\" (default): the level stays as given; \"closed\": in talus run it follows from the volume that "
     "the walls of the fissure enclose"},
    {"water[].opening", "closed volume: width of the fissure while its walls stand as built"},
    {"water[].inflow",
     "closed volume: flows in, per m of the fissure's horizontal width, or over time: [time s, m3/s per m]; "
     "default none"},
    {"water[].overflow",
     "closed volume: level above which it runs over, measured like the depth or the elevation; default the "
     "upper end of the fissure's lower wall"},
    {"water[].rain", "closed volume: rain on its catchment, or over time: [time s, mm/h]; default none"},
    {"water[].catchment",
     "with rain: length of the slope that drains into the fissure, m2 per m of its horizontal width"},
    {"water[].leak_aperture",
     "closed volume: hydraulic aperture of the joint through which its foot leaks by the cubic law, while "
     "the walls stand as built; default no leak"},
    {"water[].leak_length",
     "with leak_aperture: length of the path from the foot to where the water leaves the rock, at the foot's "
     "height"},
    {"water[].surface", "phreatic surface: points [x, z] of a line that is extruded along y [m]"},
    {"water[].obj",
     "phreatic surface from a mesh (OBJ) over all free blocks; path relative to the scenario's folder"},
    {"water[].percent_filled",
     "instead of elevation: water level in % of the height over which the joint and its crack bound free "
     "blocks, 0 to 100; with peak = \"crack-base\" in % of the height of the crack alone"},
    {"water[].crack",
     "with percent_filled: the single joint that is a tension crack; it is filled to the same level"},
    {"water[].peak",
     "with percent_filled: where the pressure on the joint is greatest. \"crack-base\": it decreases "
     "linearly from there to zero at the lower end; \"half-height\": it decreases from half of the wet "
     "height; \"toe\": it is hydrostatic down to the lower end"},
    {"water[].daylights",
     "how the pressure decreases to zero where the joint daylights: \"straight\" (linearly), or "
     "\"half-height\": it increases with depth to half of the height and decreases from there"},
    {"water[].factor", "phreatic surface: factor on the head (H_u); default 1"},

    {"interface", "strength of one interface"},
    {"interface[].between", "its two blocks"},

    {"seismic", "pseudo-static earthquake"},
    {"seismic.horizontal", "k_h: horizontal force on each free block over its weight; default 0"},
    {"seismic.direction_deg",
     "direction of the force, clockwise from north (+y); default 270, towards -x, or slope_azimuth_deg"},
    {"seismic.vertical", "k_v: vertical force over the weight, positive upwards; default 0"},

    {"damping", "damping of time histories; default none. Searches choose their own"},
    {"damping.mass", "damping of translation: c_m over the mass; default 0"},
    {"damping.rotation", "damping of rotation: c_I over the inertia; default 0"},
    {"damping.contact", "damping at contact points (dashpots): c_k over the stiffness; default 0"},
    {"damping.local", "Cundall's local damping, a share of the out-of-balance force; default 0"},

    {"flow", "steady flow of water in the joint network; its pressure acts on the walls of joints"},
    {"flow.aperture", "hydraulic aperture b of the joints: transmissivity rho g b^3 / (12 viscosity)"},
    {"flow.viscosity", "dynamic viscosity; default 0.001307, water at 10 degrees C"},
    {"flow.density", "density of the water; default 1000"},
    {"flow.free_surface",
     "whether joints are dry above a free surface, which is found (default); false: all joints are full"},
    {"flow.refinements",
     "how many times each triangle of the mesh is divided into four; default 0; with coupled = true searches "
     "and talus flow refine further"},
    {"flow.coupled",
     "true: hydraulic apertures follow what joints open and close from equilibrium to equilibrium; default "
     "false"},
    {"flow.residual_aperture_share",
     "coupled: residual aperture of a joint that closes, as a share of its aperture; default 0.1"},
    {"flow.coupling_tolerance",
     "coupled: change of pressure between two passes, over the largest pressure, at which flow and opening "
     "agree; default 0.001"},
    {"flow.coupling_passes",
     "coupled: most passes at one equilibrium, beyond which the result has a warning; default 30"},
    {"flow.joint", "joints with an aperture of their own, by the name of their [joint.NAME]"},
    {"flow.joint.NAME.aperture", "hydraulic aperture of this joint"},
    {"flow.boundary", "where water enters or leaves; elsewhere the network is closed"},
    {"flow.boundary[].head",
     "hydraulic head, as an elevation above the model's origin; places above it are an outlet"},
    {"flow.boundary[].outlet",
     "true: a seepage face or a drain; no pressure where water flows out, and no inflow"},
    {"flow.boundary[].face",
     "only the open ends of joints on rock faces that look within 60 degrees of this direction, which turns "
     "with the profile; default all of the joints"},
    {"flow.boundary[].joint", "only in this joint, by the name of its [joint.NAME]; default all joints"},
    {"flow.boundary[].box", "only inside this box along the axes"},

    {"load", "a force on a block, a pressure on its face or on free faces inside a box"},
    {"load[].block", "block that it acts on"},
    {"load[].force", "force, x y z; it keeps its direction, and its point moves with the block"},
    {"load[].point", "point where the force acts at the start; default the block's centroid"},
    {"load[].box", "pressure on all free faces inside this box with a normal within 60 degrees of `face`"},
    {"load[].pressure", "pressure, positive towards the face"},
    {"load[].factor", "factor over time in `talus run`: [time s, factor]; searches use the factor at time 0"},

    {"bolt", "a straight bar between two blocks"},
    {"bolt[].head", "point in the block that it holds, or on the face of that block, x y z"},
    {"bolt[].end", "point in another block, x y z"},
    {"bolt_pattern", "bolts in a grid over free faces"},
    {"bolt_pattern[].box",
     "box with the heads; they lie on free faces with a normal within 60 degrees of `face`"},
    {"bolt_pattern[].spacing", "spacing along and up the face, counted from its middle"},
    {"bolt_pattern[].length", "length of each bolt"},
    {"bolt_pattern[].plunge_deg", "angle of the bolts below the horizontal"},
    {"bolt_pattern[].trend_deg", "direction of the bolts, clockwise from north (+y)"},

    {"ground_motion", "an earthquake's record that moves all fixed blocks in `talus run`"},
    {"ground_motion.file", "CSV: time_s and any of ax_m_s2, ay_m_s2, az_m_s2, or of vx_m_s, vy_m_s, vz_m_s"},
    {"ground_motion.acceleration", "instead of file: rows [time s, x, y, z] with increasing times"},
    {"ground_motion.scale", "factor on the record; default 1"},
    {"ground_motion.baseline",
     "subtracted from the accelerations: \"none\" (default), their \"mean\", or a \"line\" (least squares)"},

    {"*.name", "name in results; for a pattern, the prefix of its bolts' names"},
    {"*.kind", "\"anchored\": free between head and end; \"grouted\": bonded over its length"},
    {"*.area", "cross section of the bar"},
    {"*.modulus", "Young's modulus of the bar"},
    {"*.yield_force", "force at which the bar yields; beyond it the force is constant"},
    {"*.pretension", "tension applied together with the weight; default 0"},
    {"*.rupture_strain", "strain at which it breaks; default none"},
    {"*.bond_stiffness", "grouted: shear stiffness of the grout per length"},
    {"*.bond_strength", "grouted: shear strength of the grout per length"},
    {"*.shear_stiffness", "grouted: stiffness across each joint that it crosses; default 0"},
    {"*.plate", "grouted: whether it has a plate at its head; default false"},
    {"*.face", "the face whose normal is nearest to this direction"},
    {"*.box", "box along the axes, by its lower and its upper corner"},
    {"*.min", "lower corner, x y z"},
    {"*.max", "upper corner, x y z"},
    {"*.vertices", "corners [x, y, z]; the block is their convex hull"},
    {"*.material", "name of a [material.NAME]; may be omitted if there is only one"},
    {"*.joint", "name of a [joint.NAME]; default \"default\""},
    {"*.dip_deg", "steepest angle of the plane below the horizontal"},
    {"*.dip_direction_deg", "dip direction of the plane, clockwise from north (+y)"},
    {"*.fisher", "Fisher constant of scattered orientations; default none: parallel planes"},
};

constexpr Description kSweep[] = {
    {"format", "version of the file format"},
    {"scenario", "scenario file; path relative to this file's folder"},
    {"analysis", "analysis that each run computes"},
    {"groups", "safety-factor: number of groups of blocks to find that fail one after the other; default 1"},
    {"range", "whether each search also looks for a lower answer on another loading path; default false"},
    {"correlation", "correlated random variables"},
    {"correlation.fields", "random variables drawn per run or per joint, each named by its first field"},
    {"correlation.matrix",
     "correlation of their normal scores: symmetric, with ones on the diagonal, positive definite"},
    {"samples", "number of samples of the random variables; default 1"},
    {"seed", "seed of the random numbers; default 1"},
    {"sampling", "\"random\" (default), or \"latin-hypercube\""},
    {"grid", "values of a field, combined with all values of the other grids"},
    {"grid[].values", "numbers, texts, true or false"},
    {"grid[].from", "instead of values: first value"},
    {"grid[].to", "last value"},
    {"grid[].count", "number of evenly spaced values"},
    {"grid[].step", "instead of count: difference between two values"},
    {"table", "table with one case per row"},
    {"table.file", "CSV file whose header names the fields; a column `name` names the cases"},
    {"table.columns", "instead of file: names of the fields"},
    {"table.rows", "their values, a list for each case"},
    {"random", "a random variable"},
    {"random[].per", "one draw a run (\"run\", default), for each \"joint\" or for each \"interface\""},
    {"random[].distribution", "distribution; its parameters have the field's unit"},
    {"random[].min", "smallest value"},
    {"random[].max", "largest value"},
    {"random[].mean", "normal (before truncation) and lognormal: mean"},
    {"random[].sd", "normal (before truncation) and lognormal: standard deviation"},
    {"random[].mode", "triangular: most likely value"},
    {"random[].alpha", "beta: first exponent"},
    {"random[].beta", "beta: second exponent"},
    {"report", "figures of the answers in the summary and the report"},
    {"report.confidence", "confidence level of the intervals; default 0.95"},
    {"report.tilt_deg", "critical-angle: tilts for which to give the probability of failure [deg]"},
    {"report.factor", "safety-factor: factors for which to give the probability of a lower one"},
    {"report.horizontal", "critical-acceleration: k_h for which to give the probability of failure"},
    {"*.field", "a field of the scenario, or a list of fields that get the same value"},
};

std::string_view lineOf(std::span<const Description> lines, std::string_view field) {
    const auto line =
        std::find_if(lines.begin(), lines.end(), [&](const Description& one) { return one.field == field; });
    return line == lines.end() ? std::string_view() : line->text;
}

}  // namespace

std::span<const Description> scenarioDescriptions() { return kScenario; }
std::span<const Description> sweepDescriptions() { return kSweep; }

std::string_view descriptionOf(std::span<const Description> lines, std::string_view field) {
    if (const std::string_view own = lineOf(lines, field); !own.empty()) return own;
    const std::string key(field.substr(field.rfind('.') + 1));
    return field == key ? std::string_view() : lineOf(lines, std::string(kAnywhere) + key);
}

}  // namespace talus::formats::schema
