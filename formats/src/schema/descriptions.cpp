#include "schema/descriptions.h"

#include <algorithm>

namespace talus::formats::schema {

namespace {

// Numbers of a joint explain themselves in talus/joint.h.
constexpr Description kScenario[] = {
    {"format", "version of the file format"},

    {"analysis", "what searches vary, and how finely"},
    {"analysis.start_deg", "critical-angle: tilt where the search starts; default gravity.tilt_deg"},
    {"analysis.stop_deg", "critical-angle: tilt where the search ends; default 45"},
    {"analysis.tolerance_deg", "critical-angle: width of the bracket; default 0.01"},
    {"analysis.factor_tolerance", "safety-factor: width of the bracket; default 0.001"},
    {"analysis.acceleration_tolerance", "critical-acceleration: width of the bracket; default 0.0001"},
    {"analysis.least_mass_share",
     "searches: what fails and has less than this share of the free blocks' mass is taken out and named, and "
     "the search goes on with the rest; default 0.01 with [rock_mass], else 0: whatever fails is the answer"},
    {"analysis.failure_displacement",
     "searches: neighbouring blocks that part by more before equilibrium is found again have failed; share "
     "of "
     "the median block size; default 0.0003"},
    {"analysis.reduce_tensile_strength",
     "the factor of safety divides tensile strengths, too; default false"},
    {"analysis.time_scaling",
     "searches give all blocks inertia for the same time step, which is faster and does not move the answer; "
     "default true"},

    {"run", "the time history of `talus run`"},
    {"run.duration_s", "how long; default that of the ground motion's record"},
    {"run.time_step_s", "default: the longest that stiffness and masses allow"},
    {"run.frame_interval_s", "between two frames of the snapshot file"},
    {"run.watch", "names of blocks that the result and histories report"},
    {"run.start",
     "\"equilibrium\" under weight and water where there is one (default), or \"unstressed\": all laid on at "
     "once"},

    {"gravity", "how strong gravity is and which way it pulls"},
    {"gravity.magnitude", "default 9.81"},
    {"gravity.tilt_deg", "turns gravity about y; positive: downhill is -x; default 0"},
    {"gravity.direction", "instead of tilt_deg: the way it pulls, x y z, of any length"},

    {"contact", "where faces that touch are felt"},
    {"contact.points",
     "\"vertex\" (default: nine on a rectangle), \"corner\" (four), \"quarter\" (the paper's rule), \"grid "
     "N\" (N x N, rectangles only)"},

    {"material", "what blocks are made of"},
    {"material.NAME.density", "mass per volume"},

    {"joint", "strength and stiffness of interfaces; [joint.default] is taken where none is named"},
    {"joint.NAME.law", "how strength follows the normal stress; default \"coulomb\""},
    {"joint.NAME.shear_strength",
     "law \"envelope\": points [normal stress, strength] in Pa, from 0 upwards, not falling"},

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
    {"stack[].bed_friction_deg", "friction of each bed, floor up; or of each bed and column, [bed][column]"},
    {"stack[].row_material", "a material of each row, floor up"},

    {"block", "a block placed by hand: box, vertices, parts or mesh"},
    {"block[].name", "what messages, results and other tables call it"},
    {"block[].parts", "parts of one body: boxes or hulls that share faces and do not overlap"},
    {"block[].mesh", "closed mesh facing outwards: .obj, .stl or .ply, path from the scenario's folder"},
    {"block[].scale", "from the mesh's unit to metres; default 1"},
    {"block[].joint", "joint of its faces; between blocks of two joints the one with less friction counts"},
    {"block[].fixed", "does not move; default false"},
    {"block[].driven", "keeps its velocity whatever pushes it; default false"},
    {"block[].velocity", "at the start, x y z; default 0 0 0"},

    {"rock_mass", "a region that joints cut into blocks"},
    {"rock_mass.name", "prefix of its blocks' names"},
    {"rock_mass.region", "what is cut: box, profile with y, or a surface from a file"},
    {"rock_mass.region.profile", "corners [x, z] of a simple polygon, extruded along y"},
    {"rock_mass.region.y", "from, to of that"},
    {"rock_mass.region.mesh",
     ".stl, .obj, .ply or .asc (ESRI ASCII grid), by the end of its name, from the scenario's folder"},
    {"rock_mass.region.stl", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.obj", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.ply", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.asc", "instead of mesh, whatever the name ends in"},
    {"rock_mass.region.scale", "from the file's unit to metres; default 1"},
    {"rock_mass.region.shift", "taken off all coordinates of the file, x y z"},
    {"rock_mass.region.base",
     "the surface is an open terrain, closed by upright sides and a level base at this elevation"},
    {"rock_mass.region.tolerance",
     "vertices nearer to each other become one; default 1e-6 of the longest side"},
    {"rock_mass.region.simplify", "makes the surface coarser, by at most this distance"},
    {"rock_mass.joint", "strength of the ground and of whatever no joint made; default \"default\""},
    {"rock_mass.min_thickness", "no cut leaves a part thinner than this"},
    {"rock_mass.slivers",
     "\"merge\": such a cut is left out with a warning (default), \"refuse\": it is an error"},
    {"rock_mass.seed", "of what is drawn at random; default 1"},
    {"rock_mass.fixed", "blocks that do not move, by box, plane, joint, boundary or name"},
    {"rock_mass.fixed[].box", "blocks whose centroid is inside"},
    {"rock_mass.fixed[].plane", "blocks wholly below a plane, or on `side`"},
    {"rock_mass.fixed[].plane.point", "on the plane, x y z"},
    {"rock_mass.fixed[].joint", "blocks wholly below this joint, or on `side`"},
    {"rock_mass.fixed[].boundary", "blocks with a face on this side of the region's bounds"},
    {"rock_mass.fixed[].name", "this block"},
    {"rock_mass.fixed[].side", "of plane or joint: \"below\" (default), \"above\", \"touching\""},
    {"rock_mass.names", "names = { NAME = [x, y, z] }: the block at a point [m]"},
    {"rock_mass.names.NAME", "a point inside the block, x y z"},
    {"rock_mass.bridge",
     "joint that stands for the intact rock between finite joints; default: their own strength goes on"},
    {"rock_mass.max_blocks", "more are refused before they are cut; default 2000000"},

    {"joint_set", "parallel, or scattered, planes that cut the rock mass"},
    {"joint_set[].name", "takes the strength [joint.NAME], if there is one"},
    {"joint_set[].spacing", "between planes, measured normal to them; their mean"},
    {"joint_set[].origin", "plane 0 goes through it; default the lower corner of the region's bounds"},
    {"joint_set[].offset", "moves plane 0 along the upward normal; default 0"},
    {"joint_set[].spacing_law", "\"constant\" (default), \"uniform\", \"exponential\""},
    {"joint_set[].spacing_spread", "uniform: spacing times 1 +- this; default 0.5"},
    {"joint_set[].joint", "its strength, instead of by its name"},

    {"single_joint", "one plane, disc or convex polygon that cuts the rock mass"},
    {"single_joint[].name", "takes the strength [joint.NAME], if there is one; water calls it so"},
    {"single_joint[].point", "on the plane; the disc's middle"},
    {"single_joint[].radius", "of a disc; default none: a plane without end"},
    {"single_joint[].polygon", "instead: corners [x, y, z] of a convex plane polygon [m]"},
    {"single_joint[].joint", "its strength, instead of by its name"},

    {"fracture_set", "discs drawn at random, or read from a file, that cut the rock mass"},
    {"fracture_set[].name", "takes the strength [joint.NAME], if there is one"},
    {"fracture_set[].joint", "its strength, instead of by its name"},
    {"fracture_set[].file", "discs from a CSV file: x_m, y_m, z_m, dip_deg, dip_direction_deg, radius_m"},
    {"fracture_set[].radius_law", "\"constant\" (default), \"lognormal\", \"power\""},
    {"fracture_set[].radius", "constant: of all; lognormal: their mean"},
    {"fracture_set[].radius_deviation", "lognormal: standard deviation"},
    {"fracture_set[].radius_exponent", "power: density falls as radius to minus this"},
    {"fracture_set[].radius_min", "smallest"},
    {"fracture_set[].radius_max", "largest"},
    {"fracture_set[].p32", "area of discs inside the region over its volume"},
    {"fracture_set[].count", "instead of p32: how many have their middle inside the region"},

    {"water",
     "water in a joint of a stack, between two blocks, on a face, in a joint of the rock mass, or below a "
     "surface"},
    {"water[].fissure",
     "between columns N and N + 1 of a stack; 0 is the toe's free face, `columns` the back's"},
    {"water[].stack", "name of that stack, where there are several"},
    {"water[].between", "two blocks: uplift on their interface by `head`"},
    {"water[].block", "a block whose `face` is wet"},
    {"water[].joint", "name of a single joint or a joint set of the rock mass"},
    {"water[].plane", "number of a joint set's plane"},
    {"water[].depth", "up along the joint's steepest line, from `base`"},
    {"water[].elevation", "instead of depth: height of the water table above the model's origin"},
    {"water[].levels", "instead of depth, over time: [time s, depth m]"},
    {"water[].head", "at the +x and the -x end of the contact (+z and -z of upright ones), linear between"},
    {"water[].base", "lower end of the water, above the floor; default the joint's lowest point"},
    {"water[].drains_at_aperture", "runs out for good once the joint opens wider; default never"},
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
    {"water[].surface", "phreatic surface: points [x, z] of a line that is extruded along y [m]"},
    {"water[].obj",
     "phreatic surface from a mesh (OBJ) over all free blocks, path from the scenario's folder"},
    {"water[].percent_filled",
     "instead of elevation: level over the height at which the joint and its crack bound free blocks, 0 to "
     "100; with "
     "peak = \"crack-base\" of the crack alone"},
    {"water[].crack",
     "with percent_filled: the single joint of a tension crack, which is filled to the same level"},
    {"water[].peak",
     "with percent_filled: where the pressure on the joint is greatest. \"crack-base\": it falls from there "
     "in a "
     "straight line to nothing at the lower end; \"half-height\": it falls from half of the wet height; "
     "\"toe\": "
     "hydrostatic to the lower end"},
    {"water[].daylights",
     "how the pressure falls to nothing where the joint daylights: \"straight\", or \"half-height\": it "
     "rises with depth to "
     "the middle and falls from there"},
    {"water[].factor", "phreatic surface: times the head (H_u); default 1"},

    {"interface", "strength of one interface by hand"},
    {"interface[].between", "its two blocks"},

    {"seismic", "pseudo-static earthquake"},
    {"seismic.horizontal", "k_h: each free block is pushed with this share of its weight; default 0"},
    {"seismic.direction_deg", "the way it pushes, clockwise from north (+y); default 270, towards -x"},
    {"seismic.vertical", "k_v, positive upwards; default 0"},

    {"damping", "of time histories; default none. Searches choose their own"},
    {"damping.mass", "c_m over the mass; default 0"},
    {"damping.rotation", "c_I over the inertia; default 0"},
    {"damping.contact", "c_k over a contact point's stiffness (dashpots); default 0"},
    {"damping.local", "Cundall's local damping, a share of the force out of balance; default 0"},

    {"load", "a force on a block, a pressure on its face or on free faces inside a box"},
    {"load[].block", "what it pushes on"},
    {"load[].force", "x y z; keeps its direction and follows its point of the block"},
    {"load[].point", "of the model at the start; default the block's centroid"},
    {"load[].box", "a pressure on all free faces inside that look the way of `face` within 60 degrees"},
    {"load[].pressure", "pushing on the face"},
    {"load[].factor", "over time in `talus run`: [time s, factor]; searches take it at time 0"},

    {"bolt", "a straight bar between two blocks"},
    {"bolt[].head", "in the block it holds, or on its face, x y z"},
    {"bolt[].end", "in another block, x y z"},
    {"bolt_pattern", "bolts in a grid over free faces"},
    {"bolt_pattern[].box", "heads lie on free faces inside it that look the way of `face` within 60 degrees"},
    {"bolt_pattern[].spacing", "along and up the face, from its middle outwards"},
    {"bolt_pattern[].length", "of each"},
    {"bolt_pattern[].plunge_deg", "below the horizontal"},
    {"bolt_pattern[].trend_deg", "the way they go, clockwise from north (+y)"},

    {"ground_motion", "an earthquake's record that moves all fixed blocks in `talus run`"},
    {"ground_motion.file", "CSV: time_s and any of ax_m_s2, ay_m_s2, az_m_s2, or of vx_m_s, vy_m_s, vz_m_s"},
    {"ground_motion.acceleration", "instead of file: rows [time s, x, y, z], times rising"},
    {"ground_motion.scale", "times the record; default 1"},
    {"ground_motion.baseline",
     "takes off the accelerations: \"none\" (default), \"mean\", \"line\" (least squares)"},

    {"*.name", "what results call it; a pattern's is the beginning of its bolts'"},
    {"*.kind", "\"anchored\": free between head and end; \"grouted\": bonded over its length"},
    {"*.area", "cross section of the bar"},
    {"*.modulus", "of the bar, Young's"},
    {"*.yield_force", "beyond it the force stays"},
    {"*.pretension", "comes with the weight; default 0"},
    {"*.rupture_strain", "at which it breaks; default none"},
    {"*.bond_stiffness", "grouted: of the grout, per length"},
    {"*.bond_strength", "grouted: of the grout, per length"},
    {"*.shear_stiffness", "grouted: across each joint it crosses; default 0"},
    {"*.plate", "grouted: has a plate at its head; default false"},
    {"*.face", "the face whose normal is nearest to this direction"},
    {"*.box", "upright, by its lower and its upper corner"},
    {"*.min", "lower corner, x y z"},
    {"*.max", "upper corner, x y z"},
    {"*.vertices", "corners [x, y, z]; the block is their convex hull"},
    {"*.material", "name of a [material.NAME]; may be left out when there is one"},
    {"*.joint", "name of a [joint.NAME]; default \"default\""},
    {"*.dip_deg", "steepest angle of the plane below the horizontal"},
    {"*.dip_direction_deg", "the way it dips, clockwise from north (+y)"},
    {"*.fisher", "Fisher constant of scattered orientations; default none: parallel"},
};

constexpr Description kSweep[] = {
    {"format", "version of the file format"},
    {"scenario", "the scenario file, from this file's folder"},
    {"analysis", "what each run computes"},
    {"range", "whether each run of a search also tries other loading histories; default false"},
    {"correlation", "random variables that go together"},
    {"correlation.fields", "of random variables drawn per run or per joint, by their first field"},
    {"correlation.matrix", "of their normal scores: symmetric, ones along its diagonal, positive definite"},
    {"samples", "of the random variables; default 1"},
    {"seed", "of what is drawn; default 1"},
    {"sampling", "\"random\" (default), or \"latin-hypercube\""},
    {"grid", "values, each with each of the other grids"},
    {"grid[].values", "numbers, texts, true or false"},
    {"grid[].from", "instead of values: the first"},
    {"grid[].to", "and the last"},
    {"grid[].count", "how many, evenly spaced"},
    {"grid[].step", "instead of count: between two"},
    {"table", "one case a row"},
    {"table.file", "CSV file whose header names the fields; a column `name` names the cases"},
    {"table.columns", "instead of file: names of the fields"},
    {"table.rows", "their values, a list for each case"},
    {"random", "a random variable"},
    {"random[].per", "one draw a run (\"run\", default), for each \"joint\" or for each \"interface\""},
    {"random[].distribution", "with its parameters, in the field's unit"},
    {"random[].min", "least"},
    {"random[].max", "greatest"},
    {"random[].mean", "of normal (before it is cut) and lognormal"},
    {"random[].sd", "standard deviation, likewise"},
    {"random[].mode", "triangular: the likeliest"},
    {"random[].alpha", "beta: first exponent"},
    {"random[].beta", "beta: second exponent"},
    {"report", "what summary and page say of the answers"},
    {"report.confidence", "of the intervals; default 0.95"},
    {"report.tilt_deg", "critical-angle: probability that it has failed at these tilts [deg]"},
    {"report.factor", "safety-factor: probability of less than these"},
    {"report.horizontal", "critical-acceleration: probability that it has failed at these k_h"},
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
