// One line of the tables below per rule of the scenario format: a text with one fault, and where it must be
// found.

#include <algorithm>

#include "faults.h"
#include "talus/simulation.h"

namespace talus::formats {

namespace {

/// `snippet` stands behind a good stack: its first line is line 12.
Fault behindStack(const std::string& snippet, int line, const std::string& field,
                  const std::string& fragment) {
    return {properties() + stack() + snippet, 11 + line, field, fragment};
}

/// `more` are keys of the stack; their first line is line 12.
Fault inStack(const std::string& more, const std::string& field, const std::string& fragment) {
    return {properties() + stack(more + "\n"), 12, "stack[0]" + field, fragment};
}

/// `keys` are those of the first water; the first is on line 13.
Fault inWater(const std::string& keys, int line, const std::string& field, const std::string& fragment) {
    return {properties() + stack() + "[[water]]\n" + keys, 11 + line, "water[0]" + field, fragment};
}

/// `keys` of a block but its name, which is on line 8; they begin on line 9.
Fault inBlock(const std::string& keys, int line, const std::string& field, const std::string& fragment) {
    return {properties() + "[[block]]\nname = \"key\"\n" + keys, line, "block[0]" + field, fragment};
}

}  // namespace

TEST_CASE("scenario errors: the range of the search") {
    const auto fault = [](const std::string& snippet, const std::string& field, const std::string& fragment) {
        checkFault(behindStack(snippet, 2, field, fragment));
    };
    fault("[analysis]\nstart_deg = \"0\"\n", "analysis.start_deg", "found a string \"0\", allowed: a number");
    fault("[analysis]\nstart_deg = nan\n", "analysis.start_deg", "found nan, allowed: a finite number");
    fault("[analysis]\nstop_deg = -inf\n", "analysis.stop_deg", "found -inf, allowed: a finite number");
    fault("[analysis]\nstop_deg = 90\n", "analysis.stop_deg",
          "found 90, allowed: greater than -90 and less than 90");
    fault("[analysis]\nstop_deg = 0\n", "analysis.stop_deg", "found a search from 0 (gravity.tilt_deg) to 0");
    fault("[analysis]\nstart_deg = 45\n", "analysis.start_deg", "from 45 to 45 (the default)");
    fault("[analysis]\nstop_deg = 2.5\nstart_deg = 3\n", "analysis.stop_deg", "from 3 to 2.5");
}

TEST_CASE("scenario errors: [analysis], [run], [damping], [gravity], [contact], format") {
    const auto fault = [](const std::string& table, const std::string& key, const std::string& value,
                          const std::string& fragment) {
        checkFault(
            behindStack("[" + table + "]\n" + key + " = " + value + "\n", 2, table + "." + key, fragment));
    };
    fault("analysis", "tolerance_deg", "0", "found 0, allowed: at least 1e-09");
    fault("analysis", "tolerance_deg", "-0.01", "found -0.01");
    fault("analysis", "factor_tolerance", "0.0", "found 0, allowed");
    fault("analysis", "time_scaling", "1", "found an integer 1, allowed: true or false");
    fault("analysis", "time_scaling", "\"true\"", "found a string \"true\", allowed: true or false");
    fault("run", "duration_s", "0", "found 0, allowed: greater than 0");
    fault("run", "duration_s", "true", "found a boolean true, allowed: a number, greater than 0");
    fault("run", "time_step_s", "-1e-6", "found -1e-06, allowed: greater than 0");
    fault("run", "frame_interval_s", "0", "greater than 0");
    fault("run", "frame_interval_s", "1e-9",
          "found 1e-09 s in a run of 1 s, allowed: at most 10000000 frames");
    fault("run", "watch", "\"c1r1s1\"", "found a string \"c1r1s1\", allowed: an array of strings");
    fault("damping", "mass", "-1", "found -1, allowed: at least 0");
    fault("damping", "rotation", "-0.5", "found -0.5, allowed: at least 0");
    fault("damping", "contact", "inf", "found inf, allowed: a finite number");
    fault("damping", "local", "1", "found 1, allowed: at least 0 and less than 1");
    fault("gravity", "magnitude", "-9.81", "found -9.81, allowed: at least 0");
    fault("gravity", "tilt_deg", "-90", "found -90, allowed: greater than -90 and less than 90");
    fault("gravity", "tilt_deg", "1979-05-27", "found a date or time, allowed: a number");
    fault("contact", "points", "\"nine\"",
          "found \"nine\", allowed: \"vertex\", \"distributed\", \"quarter\", \"corner\", or \"grid N\"");
    for (const char* grid : {"\"grid\"", "\"grid 0\"", "\"grid 65\"", "\"grid -1\"", "\"grid 4.0\"",
                             "\"grid 4 \"", "\"grid 99999999999\""})
        fault("contact", "points", grid, "with N from 1 to 64");
    fault("contact", "points", "4", "found an integer 4, allowed: a string");

    checkFault({"format = 2\n" + properties() + stack(), 1, "format", "found 2, allowed: 1"});
    checkFault(
        {"format = 1.0\n" + properties() + stack(), 1, "format", "found a number 1.0, allowed: an integer"});
    checkFault(
        {"gravity = 9.81\n" + properties() + stack(), 1, "gravity", "found a number 9.81, allowed: a table"});
    checkFault(behindStack("[[run]]\nduration_s = 1\n", 1, "run", "found an array, allowed: a table"));
    checkFault(behindStack("[run]\nwatch = [\"c1r1s1\", 3]\n", 2, "run.watch[1]",
                           "found an integer 3, allowed: a string"));
    checkFault(behindStack("[run]\nwatch = [\"c4r1s1\"]\n", 2, "run.watch[0]",
                           "unknown block \"c4r1s1\", allowed: columns 1 to 3"));
    checkFault(behindStack("[run]\nwatch = [\"c1r3s1\"]\n", 2, "run.watch[0]", "rows 1 to 2 in this column"));
    checkFault(behindStack("[run]\nwatch = [\"flor\"]\n", 2, "run.watch[0]", "did you mean \"floor\"?"));
    checkFault(behindStack("[run]\nwatch = [\"C1R1S1\"]\n", 2, "run.watch[0]", "did you mean \"c1r1s1\"?"));
    checkFault(behindStack("[run]\nwatch = [\"floor\",\n\"floor\"]\n", 3, "run.watch[1]",
                           "again, allowed: each block once"));
    for (const char* name :
         {"\"c01r1s1\"", "\"c1r1s0\"", "\"c1r1s\"", "\"c1r1s99999999999\"", "\"\"", "\"c-1r1s1\""})
        checkFault(
            behindStack("[run]\nwatch = [" + std::string(name) + "]\n", 2, "run.watch[0]", "unknown block"));
}

TEST_CASE("scenario errors: unknown keys") {
    const auto fault = [](const std::string& snippet, int line, const std::string& field,
                          const std::string& fragment) {
        checkFault(behindStack(snippet, line, field, fragment));
    };
    fault("[damping]\nlocl = 0.5\n", 2, "damping.locl",
          "found an unknown key \"locl\", did you mean \"local\"?");
    fault("[gravity]\ntilt = 3\n", 2, "gravity.tilt", "did you mean \"tilt_deg\"?");
    fault("[run]\n\nduraton = 3\n", 3, "run.duraton", "did you mean \"duration_s\"?");
    fault("[gravity]\nfoo = 3\n", 2, "gravity.foo", "allowed: magnitude, tilt_deg");
    fault("[gravity]\n\"a b\" = 3\n", 2, "gravity.\"a b\"", "unknown key \"a b\"");
    fault("[materials.x]\n", 1, "materials", "allowed: format, analysis");
    fault("[[watr]]\n", 1, "watr", "did you mean \"water\"?");
    fault("[[water]]\nfissure = 1\ndepht = 0.1\n", 3, "water[0].depht", "did you mean \"depth\"?");
    checkFault({properties() + stack("", "colums = 3\nrows = 2\nslices = 1\n"), 8, "stack[0].colums",
                "did you mean \"columns\"?"});
    checkFault(inStack("friction_deg = 3", ".friction_deg", "did you mean \"bed_friction_deg\"?"));
    checkFault(inStack("Name = \"a\"", ".Name", "did you mean \"name\"?"));
    checkFault({material() + joint("default", "friction_deg = 30\nfriction = 3") + stack(), 7,
                "joint.default.friction", "allowed: normal_stiffness, shear_stiffness, friction_deg"});
    checkFault({"[material.granite]\ndensity = 2600\ncolour = 1\n" + joint() + stack(), 3,
                "material.granite.colour", "allowed: density"});
    checkFault({properties() + "[[block]]\nname = \"a\"\nbox = { min = [0,0,0], max = [1,1,1], mid = 1 }\n",
                9, "block[0].box.mid", "allowed: min, max"});
    checkFault(behindStack("[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoin = \"default\"\n", 3,
                           "interface[0].join", "did you mean \"joint\"?"));
}

TEST_CASE("scenario errors: materials and joints") {
    const auto inJoint = [](const std::string& line, const std::string& key, const std::string& fragment) {
        checkFault({material() + joint("default", "friction_deg = 30\n" + key + " = " + line) + stack(), 7,
                    "joint.default." + key, fragment});
    };
    inJoint("-1.0", "cohesion", "found -1, allowed: at least 0");
    inJoint("-1.0", "tensile_strength", "at least 0");
    inJoint("nan", "residual_cohesion", "a finite number");
    inJoint("90", "residual_friction_deg", "found 90, allowed: at least 0 and less than 90");
    inJoint("-0.5", "dilation_deg", "at least 0");
    inJoint("-1e-3", "softening_displacement", "at least 0");
    inJoint("[1]", "cohesion", "found an array, allowed: a number, at least 0");
    inJoint("{ a = 1 }", "cohesion", "found a table, allowed: a number");

    const auto jointOnly = [](const std::string& keys) {
        return material() + "[joint.default]\n" + keys + stack();
    };
    checkFault({jointOnly("normal_stiffness = 0\nshear_stiffness = 1e9\nfriction_deg = 3\n"), 4,
                "joint.default.normal_stiffness", "found 0, allowed: at least 1000"});
    checkFault({jointOnly("normal_stiffness = 1e9\nshear_stiffness = -1\nfriction_deg = 3\n"), 5,
                "joint.default.shear_stiffness", "found -1, allowed: at least 1000"});
    checkFault({jointOnly("normal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 90\n"), 6,
                "joint.default.friction_deg", "found 90, allowed: at least 0 and less than 90"});
    checkFault({jointOnly("normal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = -0.1\n"), 6,
                "joint.default.friction_deg", "found -0.1"});
    checkFault({jointOnly("normal_stiffness = 1e9\nshear_stiffness = 1e9\n"), 3, "joint.default.friction_deg",
                "missing"});
    checkFault({jointOnly("shear_stiffness = 1e9\nfriction_deg = 3\n"), 3, "joint.default.normal_stiffness",
                "missing"});
    checkFault({jointOnly("normal_stiffness = 1e9\nfriction_deg = 3\n"), 3, "joint.default.shear_stiffness",
                "missing"});

    checkFault({"[material.granite]\n" + joint() + stack(), 1, "material.granite.density", "missing"});
    checkFault({"[material.granite]\ndensity = 2.7\n" + joint() + stack(), 2, "material.granite.density",
                "found 2.7, allowed: at least 10 and at most 30000; is it in g/cm3"});
    checkFault({"[material]\ndensity = 2700\n" + joint() + stack("material = \"density\"\n"), 2,
                "material.density",
                "found an integer 2700, allowed: tables that begin with [material.NAME]"});
    checkFault({"joint = 3\n" + material() + stack(), 1, "joint", "found an integer 3, allowed: tables"});
    checkFault({joint() + stack(), 1, "material", "missing; required: [material.NAME]"});
    checkFault({material() + stack(), 1, "joint", "missing; required: [joint.default]"});
    checkFault({material() + joint("soft") + block("a"), 7, "block[0].joint",
                "no [joint.default] to stand in, allowed: soft"});
    checkFault({properties() + "[material.schist]\ndensity = 2600\n" + stack(), 9, "stack[0].material",
                "missing; required because there are several materials"});
    checkFault(inStack("material = \"granit\"", ".material",
                       "unknown material \"granit\", did you mean \"granite\"?"));
    checkFault(inStack("joint = \"weak\"", ".joint", "unknown joint \"weak\", allowed: default"));
    checkFault(inStack("bed_joint = \"defualt\"", ".bed_joint", "did you mean \"default\"?"));
    checkFault(inStack("side_joint = 1", ".side_joint", "found an integer 1, allowed: a string"));
}

TEST_CASE("scenario errors: stacks") {
    const auto counts = [](const std::string& text, int line, const std::string& field,
                           const std::string& fragment) {
        checkFault({properties() + stack("", text), line, field, fragment});
    };
    counts("columns = 0\nrows = 2\nslices = 2\n", 8, "stack[0].columns", "found 0, allowed: 1 to 1000000");
    counts("columns = -7\nrows = 2\nslices = 2\n", 8, "stack[0].columns", "found -7");
    counts("columns = 3.0\nrows = 2\nslices = 2\n", 8, "stack[0].columns",
           "found a number 3.0, allowed: an integer");
    counts("columns = 3\nrows = 9223372036854775807\nslices = 2\n", 9, "stack[0].rows",
           "allowed: 1 to 1000000");
    counts("columns = 1000000\nrows = 1000000\nslices = 1000000\n", 8, "stack[0].columns",
           "found 1000000000000000000 blocks (columns x rows x slices), allowed: at most 2000000");
    counts("columns = 3\nrows = 2\nslices = \"2\"\n", 10, "stack[0].slices",
           "found a string \"2\", allowed: an integer");
    counts("columns = 3\nslices = 2\n", 7, "stack[0].rows", "missing");
    counts("rows = 3\nslices = 2\n", 7, "stack[0].columns", "missing");
    counts("columns = 3\nrows = 2\n", 7, "stack[0].slices", "missing");

    const std::string shape = "[[stack]]\ncolumns = 3\nrows = 2\nslices = 2\n";
    checkFault({properties() + shape, 7, "stack[0].block", "missing"});
    checkFault({properties() + shape + "block = 0.2\n", 11, "stack[0].block",
                "found a number 0.2, allowed: an array of 3 numbers"});
    checkFault({properties() + shape + "block = [1, 2]\n", 11, "stack[0].block",
                "found an array of 2 values, allowed: an array of 3 numbers"});
    checkFault({properties() + shape + "block = [1,\n0.0, 3]\n", 12, "stack[0].block[1]",
                "found 0, allowed: greater than 0"});
    checkFault({properties() + shape + "block = [1, 2, nan]\n", 11, "stack[0].block[2]", "a finite number"});
    checkFault({properties() + shape + "block = [1, 2, 2e6]\n", 11, "stack[0].block[2]", "at most 1000000"});
    checkFault(
        {properties() + shape + "block = [1e6, 2, 2]\n", 11, "stack[0].block", "found a stack that reaches"});
    checkFault({properties() + shape + "block = [1e-300, 2, 2]\norigin = [1, 0, 0]\n", 7, "stack[0]",
                "cannot be represented at coordinates"});

    checkFault(inStack("origin = [0, 0]", ".origin", "an array of 3 numbers"));
    checkFault(inStack("origin = [0, 0, \"a\"]", ".origin[2]", "found a string \"a\", allowed: a number"));
    checkFault(inStack("name = 3", ".name", "a string"));
    checkFault(inStack("name = \"a\\nb\"", ".name",
                       "found \"a?b\", allowed: 0 to 100 bytes without control characters"));
    checkFault(inStack("name = \"" + std::string(101, 'n') + "\"", ".name", "0 to 100 bytes"));
    checkFault(inStack("bond = \"runing\"", ".bond", "found \"runing\", allowed: \"stack\", \"running\""));
    checkFault(inStack("heights = [1, 2]", ".heights", "found 2 values, allowed: one per column, 3"));
    checkFault(inStack("heights = [1, 2, 3]", ".heights[2]", "found 3, allowed: 1 to 2"));
    checkFault(inStack("heights = [0, 2, 2]", ".heights[0]", "found 0, allowed: 1 to 2"));
    checkFault(inStack("heights = [1, 2.0, 2]", ".heights[1]", "found a number 2.0, allowed: an integer"));
    checkFault(inStack("heights = 2", ".heights", "allowed: an array"));
    checkFault(
        inStack("heights = [1, 2, 2]\nbond = \"running\"", ".heights", "allowed: bond \"stack\" only"));
    checkFault(inStack("row_material = [\"granite\"]", ".row_material",
                       "found an array of 1 value, allowed: an array of 2 strings"));
    checkFault(
        inStack("row_material = [\"granite\", \"grante\"]", ".row_material[1]", "did you mean \"granite\"?"));
    checkFault(inStack("row_material = \"granite\"", ".row_material", "an array of 2 strings"));
    checkFault(
        inStack("bed_friction_deg = [1]", ".bed_friction_deg", "found 1 values, allowed: one per bed level"));
    checkFault(inStack("bed_friction_deg = 18", ".bed_friction_deg", "allowed: an array"));
    checkFault(inStack("bed_friction_deg = [18, 90]", ".bed_friction_deg[1]", "less than 90"));
    checkFault(inStack("bed_friction_deg = [18, [19]]", ".bed_friction_deg[1]",
                       "found an array, allowed: a number"));
    checkFault(inStack("bed_friction_deg = [[1, 2, 3], 19]", ".bed_friction_deg[1]",
                       "found an integer 19, allowed: an array of 3 numbers"));
    checkFault(inStack("bed_friction_deg = [[1, 2, 3], [1, 2]]", ".bed_friction_deg[1]",
                       "found an array of 2 values"));
    checkFault(
        inStack("bed_friction_deg = [[1, 2, 3], [1, 2, -3]]", ".bed_friction_deg[1][2]", "at least 0"));

    checkFault(
        {properties() + stack() + stack(), 12, "stack[1].name", "found the name \"\" of stack[0] again"});
    checkFault({properties() + stack("name = \"a\"\n") + stack("name = \"a\"\n"), 18, "stack[1].name",
                "found the name \"a\" of stack[0] again"});
    CHECK(readBad(properties() + stack("name = 1\n") + stack("name = 2\n")).size() ==
          2);  // no third: "" twice
    checkFault({properties() + "[stack]\ncolumns = 3\n", 7, "stack",
                "found a table, allowed: tables that begin with [[stack]]"});
    checkFault({"stack = [1]\n" + properties(), 1, "stack[0]", "found an integer 1, allowed: tables"});
    const std::string large = "columns = 1000000\nrows = 2\nslices = 1\n";
    checkFault(
        {properties() + stack("", large), 7, "stack[0]", "found 2000001 blocks so far, allowed: 2000000"});
}

TEST_CASE("scenario errors: blocks placed by hand") {
    checkFault({properties() + "[[block]]\nbox = { min = [0,0,0], max = [1,1,1] }\n", 7, "block[0].name",
                "missing"});
    checkFault({properties() + block(""), 8, "block[0].name", "found \"\", allowed: 1 to 100 bytes"});
    checkFault({properties() + block("a") + block("a"), 11, "block[1].name",
                "found the name \"a\" of another block"});
    checkFault({properties() + stack() + block("floor"), 13, "block[0].name", "of another block"});
    checkFault({properties() + stack() + block("c3r2s2"), 13, "block[0].name", "of another block"});
    checkFault({properties() + block("a", "joint = \"x\"\n"), 10, "block[0].joint",
                "unknown joint \"x\", allowed: default"});
    checkFault(
        {properties() + block("a", "material = \"x\"\n"), 10, "block[0].material", "unknown material \"x\""});
    checkFault({properties() + block("a", "fixed = 1\n"), 10, "block[0].fixed", "true or false"});
    checkFault({properties() + block("a", "driven = true\n"), 7, "block[0].velocity",
                "missing; required for a driven block"});
    checkFault({properties() + block("a", "fixed = true\nvelocity = [1, 0, 0]\n"), 11, "block[0].velocity",
                "of a fixed block"});
    checkFault({properties() + block("a", "fixed = true\nangular_velocity = [1, 0, 0]\n"), 11,
                "block[0].angular_velocity", "of a fixed block, allowed: only for free blocks"});
    checkFault(
        {properties() + block("a", "driven = true\nvelocity = [1, 0, 0]\nangular_velocity = [1, 0, 0]\n"), 12,
         "block[0].angular_velocity", "of a driven block"});
    checkFault({properties() + block("a", "angular_velocity = [1, 0, 2000]\n"), 10,
                "block[0].angular_velocity[2]", "at least -1000 and at most 1000"});
    checkFault({properties() + block("a", "fixed = true\ndriven = true\nvelocity = [1, 0, 0]\n"), 11,
                "block[0].driven", "both fixed and driven"});
    checkFault(
        {properties() + block("a", "velocity = [1, 0]\n"), 10, "block[0].velocity", "an array of 3 numbers"});
    checkFault({properties() + block("a", "velocity = [1, 0, inf]\n"), 10, "block[0].velocity[2]",
                "a finite number"});
    checkFault({properties() + block("a", "vertices = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]\n"), 10,
                "block[0].vertices", "both box and vertices"});

    checkFault(inBlock("", 7, ".box", "missing; a block needs box"));
    checkFault(inBlock("box = [0, 1]\n", 9, ".box", "found an array, allowed: a table"));
    checkFault(inBlock("box = { min = [0, 0, 0] }\n", 9, ".box.max", "missing"));
    checkFault(inBlock("box = { min = [0, 0, 0], max = [1, 1] }\n", 9, ".box.max", "an array of 3 numbers"));
    checkFault(inBlock("box = { min = [0, 2, 0], max = [1, 1, 1] }\n", 9, ".box.max",
                       "found 1 along y, allowed: greater than min, 2"));
    checkFault(inBlock("box = { min = [0, 0, 0], max = [1, 1, 0] }\n", 9, ".box.max", "found 0 along z"));
    checkFault(
        inBlock("box = { min = [0, 0, -2e6], max = [1, 1, 0] }\n", 9, ".box.min[2]", "at least -1000000"));
    checkFault(inBlock("vertices = 1\n", 9, ".vertices", "allowed: an array"));
    checkFault(inBlock("vertices = [[0,0,0],[1,0,0],[0,1,0]]\n", 9, ".vertices",
                       "found 3 points, allowed: 4 to 1000"));
    checkFault(
        inBlock("vertices = [[0,0,0],[1,0,0],[0,1,0],[1,1]]\n", 9, ".vertices[3]", "an array of 3 numbers"));
    checkFault(inBlock("vertices = [[0,0,0],[1,0,0],[0,1,0],\n[1,1,nan]]\n", 10, ".vertices[3][2]",
                       "a finite number"));
    checkFault(inBlock("vertices = [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]\n", 9, ".vertices", ""));
}

TEST_CASE("scenario errors: interfaces") {
    const auto fault = [](const std::string& keys, int line, const std::string& field,
                          const std::string& fragment) {
        checkFault(behindStack("[[interface]]\n" + keys, line, "interface[0]" + field, fragment));
    };
    fault("between = [\"c1r1s1\", \"c1r2s1\"]\n", 1, ".joint", "missing");
    fault("joint = \"default\"\n", 1, ".between", "missing");
    fault("between = [\"c1r1s1\", \"c1r2s1\"]\njoint = \"defalt\"\n", 3, ".joint",
          "did you mean \"default\"?");
    fault("between = \"c1r1s1\"\njoint = \"default\"\n", 2, ".between", "an array of 2 strings");
    fault("between = [\"c1r1s1\"]\njoint = \"default\"\n", 2, ".between",
          "found an array of 1 value, allowed: an array of 2 strings");
    fault("between = [\"c1r1s1\", 2]\njoint = \"default\"\n", 2, ".between[1]",
          "found an integer 2, allowed: a string");
    fault("between = [\"c1r1s1\",\n\"c1r2s3\"]\njoint = \"default\"\n", 3, ".between[1]", "slices 1 to 2");
    fault("between = [\"c1r1s1\", \"c1r1s1\"]\njoint = \"default\"\n", 2, ".between",
          "found \"c1r1s1\" twice");
    const std::string one = "[[interface]]\nbetween = [\"c1r1s1\", \"c1r2s1\"]\njoint = \"default\"\n";
    const std::string swapped = "[[interface]]\nbetween = [\"c1r2s1\", \"c1r1s1\"]\njoint = \"default\"\n";
    checkFault(
        behindStack(one + swapped, 5, "interface[1].between", "found the blocks of interface[0] again"));
}

TEST_CASE("scenario errors: water") {
    checkFault(inWater("depth = 1\n", 1, ".fissure", "one of these is required: fissure, between, block"));
    checkFault(inWater("fissure = 1\nblock = \"c1r1s1\"\nface = \"+x\"\ndepth = 1\n", 3, ".block",
                       "found fissure, block together, allowed: exactly one of fissure, between, block"));
    checkFault(inWater("fissure = 1\n", 1, ".depth", "one of these is required: depth, elevation, levels"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nelevation = 0.1\n", 4, ".elevation",
                       "exactly one of depth, elevation, levels"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nlevels = [[0, 1]]\n", 4, ".levels", "exactly one of"));
    checkFault(inWater("fissure = 4\ndepth = 0.1\n", 2, ".fissure", "found 4, allowed: 0 to 3"));
    checkFault(inWater("fissure = -1\ndepth = 0.1\n", 2, ".fissure", "found -1, allowed: 0 to 3"));
    checkFault(
        inWater("fissure = 1.0\ndepth = 0.1\n", 2, ".fissure", "found a number 1.0, allowed: an integer"));
    checkFault(inWater("fissure = 1\ndepth = -0.1\n", 3, ".depth", "found -0.1, allowed: at least 0"));
    checkFault(inWater("fissure = 1\ndepth = nan\n", 3, ".depth", "a finite number"));
    checkFault(inWater("fissure = 1\nelevation = inf\n", 3, ".elevation", "a finite number"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nbase = -0.1\n", 4, ".base", "at least 0"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\nbase = 0.1\n", 4, ".base",
                       "found 0.1, allowed: less than the height of the joint's walls, 0.1"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\ndensity = 0\n", 4, ".density", "at least 1 and"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\ndrains_at_aperture = 0\n", 4, ".drains_at_aperture",
                       "greater than 0"));
    checkFault(inWater("fissure = 1\ndepth = 0.1\ndrains_at_aperture = inf\n", 4, ".drains_at_aperture",
                       "a finite number"));
    checkFault(inWater("fissure = 1\nhead = [1, 1]\ndepth = 1\n", 3, ".head", "found head without between"));
    checkFault(inWater("fissure = 1\nface = \"+x\"\ndepth = 1\n", 3, ".face", "found face without block"));
    checkFault(inWater("fissure = 1\nstack = \"b\"\ndepth = 1\n", 3, ".stack", "unknown stack \"b\""));
    checkFault(inWater("fissure = 1\nlevels = []\n", 3, ".levels", "found an empty array"));
    checkFault(inWater("fissure = 1\nlevels = [[0, 0.1], [1]]\n", 3, ".levels[1]", "an array of 2 numbers"));
    checkFault(inWater("fissure = 1\nlevels = [[0, 0.1],\n[0, 0.2]]\n", 4, ".levels[1]",
                       "found the time 0, allowed: greater than the one before, 0"));
    checkFault(inWater("fissure = 1\nlevels = [[0, -0.1]]\n", 3, ".levels[0][1]", "at least 0"));
    checkFault(inWater("fissure = 1\nelevation = 0.1\nelevations = [[0, 1]]\n", 4, ".elevations",
                       "exactly one of depth, elevation, levels, elevations"));
    checkFault(inWater("fissure = 1\nelevations = [[0, 2e6]]\n", 3, ".elevations[0][1]", "found 2000000"));
    checkFault(inWater("fissure = 1\nlevels = [3]\n", 3, ".levels[0]",
                       "found an integer 3, allowed: an array of 2 numbers"));

    checkFault(inWater("between = [\"c1r1s1\", \"c1r2s1\"]\n", 1, ".depth",
                       "one of these is required: depth, elevation, levels, elevations, head"));
    checkFault(
        inWater("between = [\"c1r1s1\", \"c1r2s1\"]\nhead = [1]\n", 3, ".head", "an array of 2 numbers"));
    checkFault(inWater("between = [\"c1r1s1\", \"c1r2s1\"]\nhead = [1, -1]\n", 3, ".head[1]", "at least 0"));
    checkFault(inWater("between = [\"c1r1s1\", \"c1r2s1\"]\nhead = [1, 1]\nbase = 0.1\n", 4, ".base",
                       "found base without fissure"));
    checkFault(inWater("between = [\"c1r1s1\", \"c1r9s1\"]\nhead = [1, 1]\n", 2, ".between[1]",
                       "unknown block \"c1r9s1\""));
    checkFault(inWater("block = \"c1r1s1\"\ndepth = 1\n", 1, ".face", "missing"));
    checkFault(inWater("block = \"c1r1s1\"\nface = \"x\"\ndepth = 1\n", 3, ".face",
                       "found \"x\", allowed: \"+x\", \"-x\", \"+y\""));
    checkFault(inWater("block = \"key\"\nface = \"+x\"\ndepth = 1\n", 2, ".block", "unknown block \"key\""));

    const std::string water = "[[water]]\nfissure = 1\ndepth = 0.1\n";
    checkFault({properties() + block("a") + water, 11, "water[0].fissure",
                "a fissure in a scenario without a [[stack]]"});
    checkFault({properties() + stack("bond = \"running\"\n") + water, 14, "water[0].fissure",
                "with running bond, allowed: bond \"stack\" only"});
    checkFault({properties() + stack("name = \"a\"\n") + stack("name = \"b\"\norigin = [0, 9, 0]\n") + water,
                20, "water[0].stack", "missing; required because there are several stacks, allowed: a, b"});
    checkFault({"water = 3\n" + properties() + stack(), 1, "water",
                "found an integer 3, allowed: tables that begin with [[water]]"});
    checkFault({"[material]\n" + joint() + stack(), 1, "material", "missing; required: [material.NAME]"});
    checkFault({"joint = {}\n" + material() + stack(), 1, "joint", "missing; required: [joint.default]"});
}

TEST_CASE("scenario errors: closed volumes of water") {
    const std::string closed = "fissure = 1\ndepth = 0.05\nvolume = \"closed\"\n";
    checkFault(inWater(closed, 1, ".opening", "missing"));
    checkFault(inWater(closed + "opening = 0\n", 5, ".opening", "found 0, allowed: greater than 0"));
    checkFault(inWater("fissure = 1\ndepth = 0.05\nvolume = \"open\"\n", 4, ".volume",
                       "found \"open\", allowed: \"held\", \"closed\""));
    for (const std::string key :
         {"opening", "inflow", "overflow", "rain", "catchment", "leak_aperture", "leak_length"})
        for (const std::string held : {"", "volume = \"held\"\n"})
            checkFault(inWater("fissure = 1\ndepth = 0.05\n" + key + " = 0.008\n" + held, 4, "." + key,
                               "found " + key + " without volume = \"closed\", allowed: only with it"));
    const std::string good = closed + "opening = 0.002\n";
    checkFault(inWater(good + "inflow = -1\n", 6, ".inflow", "found -1, allowed: at least 0"));
    checkFault(inWater(good + "inflow = \"rain\"\n", 6, ".inflow", "found a string \"rain\""));
    checkFault(inWater(good + "inflow = []\n", 6, ".inflow",
                       "found an empty array, allowed: [[time s, m3/s per m], ...]"));
    checkFault(inWater(good + "inflow = [[0, 1], [0, 2]]\n", 6, ".inflow[1]", "found the time 0"));
    checkFault(inWater(good + "rain = 10\n", 6, ".rain",
                       "found rain without catchment, allowed: only together with catchment"));
    checkFault(inWater(good + "catchment = 10\n", 6, ".catchment", "found catchment without rain"));
    checkFault(inWater(good + "leak_aperture = 1e-4\n", 6, ".leak_aperture",
                       "found leak_aperture without leak_length, allowed: only together with leak_length"));
    checkFault(inWater(good + "leak_length = 5\n", 6, ".leak_length", "found leak_length without"));
    const std::string slope = good + "catchment = 10\n";
    checkFault(inWater(slope + "rain = -1\n", 7, ".rain", "found -1, allowed: at least 0"));
    checkFault(inWater(slope + "rain = [[0, 5], [60, 4000]]\n", 7, ".rain[1][1]", "found 4000, allowed"));
    checkFault(inWater(slope + "rain = [[0, 5], [0, 6]]\n", 7, ".rain[1]", "found the time 0"));
    checkFault(
        inWater(good + "leak_length = 5\nleak_aperture = 0.1\n", 7, ".leak_aperture", "found 0.1, allowed"));
    checkFault(
        inWater(good + "overflow = 0.04\n", 6, ".overflow", "found 0.04, allowed: at least the depth, 0.05"));
    checkFault(inWater(good + "drains_at_aperture = 0.001\n", 6, ".drains_at_aperture",
                       "found drains_at_aperture beside volume = \"closed\", allowed: fissure or joint"));
    const std::string end = "volume = \"closed\"\nopening = 0.002\n";
    checkFault(inWater("fissure = 1\nlevels = [[0, 0.05]]\n" + end, 3, ".levels", "found levels beside"));
    checkFault(inWater("fissure = 1\nelevations = [[0, 0.05]]\n" + end, 3, ".elevations",
                       "found elevations beside"));
    checkFault(inWater("between = [\"c1r1s1\", \"c2r1s1\"]\ndepth = 0.05\n" + end, 2, ".between",
                       "found between beside volume = \"closed\""));
    checkFault(inWater("block = \"c1r1s1\"\nface = \"+x\"\ndepth = 0.05\n" + end, 2, ".block",
                       "found block beside volume = \"closed\""));
}

TEST_CASE("scenario errors: a closed volume in a fissure that is not bounded is found by the engine") {
    const auto faultOf = [](const std::string& stack_keys, const std::string& keys) {
        const Scenario scenario = readGood(properties() + stack(stack_keys) + "[[water]]\n" + keys +
                                           "volume = \"closed\"\nopening = 0.002\n");
        const auto errors = placed(scenario, checkModel(scenario.model));
        CAPTURE(all(errors));
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == "water[0].volume");
        CHECK(errors[0].line > 0);
        return errors[0].message;
    };
    for (const char* free_face : {"fissure = 0\ndepth = 0.05\n", "fissure = 3\ndepth = 0.05\n"})
        CHECK(faultOf("", free_face).find("found a fissure that is not bounded") != std::string::npos);
    CHECK(faultOf("heights = [1, 2, 2]\n", "fissure = 1\ndepth = 0.08\n").find("below the level") !=
          std::string::npos);
}

TEST_CASE(
    "scenario errors: water that overlaps other water is found by the engine, and has its place in the "
    "file") {
    const auto faultsOf = [](const std::string& text) {
        const Scenario scenario = readGood(text);
        return placed(scenario, checkModel(scenario.model));
    };
    const auto two = [](const std::string& first, const std::string& second) {
        return properties() + stack() + "[[water]]\n" + first + "[[water]]\n" + second;
    };
    const auto overlaps = [&](const std::string& first, const std::string& second) {
        const auto errors = faultsOf(two(first, second));
        CAPTURE(all(errors));
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].field == "water[1]");
        CHECK(errors[0].line == 12 + 1 + std::count(first.begin(), first.end(), '\n'));
        CHECK(errors[0].message.find("overlaps that of water[0]") != std::string::npos);
    };
    const auto fits = [&](const std::string& first, const std::string& second) {
        const auto errors = faultsOf(two(first, second));
        CAPTURE(all(errors));
        CHECK(errors.empty());
    };
    overlaps("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.02\n");
    overlaps("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.02\nbase = 0.04\n");
    overlaps("fissure = 1\ndepth = 0.02\nbase = 0.04\n", "fissure = 1\ndepth = 0.05\n");
    overlaps("fissure = 1\ndepth = 0.05\n", "fissure = 1\nelevation = 0.02\n");
    overlaps("fissure = 1\nlevels = [[0, 0.0], [1, 0.06]]\n", "fissure = 1\ndepth = 0.02\nbase = 0.05\n");
    overlaps("fissure = 1\ndepth = 0.05\n", "block = \"c1r1s1\"\nface = \"+x\"\ndepth = 0.01\n");
    // The wet part that overlaps is found wherever it stands among many, and named by its place in the file.
    for (const int at : {1, 7, 24}) {
        std::string many = properties() + stack();
        for (int k = 0; k < 25; ++k)
            many += "[[water]]\nfissure = 1\nbase = " + std::to_string(0.001 * (k == 24 ? at - 1 : k + 1)) +
                    "\ndepth = 0.0009\n";
        const auto errors = faultsOf(many);
        REQUIRE(errors.size() == (at == 1 ? 0 : 1));
        if (at == 1) continue;
        CHECK(errors[0].field == "water[24]");
        CHECK(errors[0].message.find("overlaps that of water[" + std::to_string(at - 2) + "]") !=
              std::string::npos);
    }
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.02\nbase = 0.05\n");
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 2\ndepth = 0.05\n");
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 1\ndepth = 0.0\n");
    fits("fissure = 1\ndepth = 0.05\n", "fissure = 1\nelevation = -0.02\n");
    fits("fissure = 1\ndepth = 0.05\n", "block = \"c1r1s1\"\nface = \"-x\"\ndepth = 0.01\n");
    fits("fissure = 1\ndepth = 0.05\n", "block = \"c1r2s1\"\nface = \"+x\"\ndepth = 0.01\n");

    // At 30 deg the level at elevation 0.12 stands at (0.12 - 0.2 sin 30) / cos 30 = 0.0231 on the plane x =
    // 0.2.
    const std::string tilt = "[gravity]\ntilt_deg = 30\n";
    const std::string low = "fissure = 1\nelevation = 0.12\n";
    CHECK(faultsOf(tilt + two(low, "fissure = 1\ndepth = 0.02\nbase = 0.0232\n")).empty());
    CHECK(faultsOf(tilt + two(low, "fissure = 1\ndepth = 0.02\nbase = 0.0230\n")).at(0).field == "water[1]");
    // A search starts at analysis.start_deg.
    CHECK(faultsOf("[analysis]\nstart_deg = 0\n" + tilt +
                   two(low, "fissure = 1\ndepth = 0.02\nbase = 0.0232\n"))
              .size() == 1);
}

}  // namespace talus::formats
