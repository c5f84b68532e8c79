// One line of the tables below per rule of the scenario format: a text with one fault, and where it must be
// found.

#include "faults.h"

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

}  // namespace talus::formats
