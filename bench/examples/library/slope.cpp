// A slope from a program of your own: four columns of rock on a floor, water between the first two. At which
// tilt does it fail, which columns go, and how hard do they press on the floor before?
//
// Everything in the library is in SI units and radians, x is uphill, z is normal to the floor. Gravity turns
// about y: with positive tilt downhill is -x. No call prints, exits or throws on bad input; what is wrong
// comes back as a list of errors.

#include <talus/analysis.h>    // critical angle, factor of safety
#include <talus/simulation.h>  // time history
#include <talus/theory.h>      // closed formulas

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

constexpr double kDegree = M_PI / 180;  // [rad]
constexpr int kColumns = 4;
constexpr double kLength = 0.2, kHeight = 0.3;  // of a column [m]
constexpr double kFriction = 30 * kDegree;
constexpr double kWaterDepth = 0.2;  // [m]

/// A result's value; a program with users would show them all the errors and go on.
template <class T>
T valueOf(talus::Result<T> result) {
    if (result.ok()) return *std::move(result);
    for (const talus::Error& error : result.errors())
        std::fprintf(stderr, "%s: %s\n", error.field.c_str(), error.message.c_str());
    std::exit(1);
}

talus::Block box(const std::string& name, const talus::Vec3& min, const talus::Vec3& max) {
    talus::Block block;
    block.name = name;
    block.shape = valueOf(talus::makeBox(min, max));  // or convexHull(points)
    block.density = 2700;
    block.face_joint.assign(block.shape.faces.size(), 0);  // every face has the model's joint number 0
    return block;
}

talus::Model buildSlope() {
    talus::Joint joint;  // without cohesion
    joint.name = "sand";
    joint.normal_stiffness = joint.shear_stiffness = 1e11;
    joint.friction = joint.residual_friction = kFriction;

    talus::Model model;
    model.joints = {joint};
    model.blocks = {box("floor", {-0.5, 0, -0.2}, {1.5, 0.1, 0})};
    model.blocks[0].motion = talus::Motion::fixed;
    for (int i = 0; i < kColumns; ++i)
        model.blocks.push_back(
            box("column " + std::to_string(i + 1), {kLength * i, 0, 0}, {kLength * (i + 1), 0.1, kHeight}));

    talus::Water water;
    water.pair = {1, 2};               // both walls of the joint between these blocks
    water.level = {{0, kWaterDepth}};  // at time 0, and ever after
    model.waters = {water};
    return model;
}

/// The last state of a short time history, which starts at rest under weight and water.
talus::FullFrame stateAt(talus::Model model, double tilt) {
    model.gravity.tilt = tilt;
    model.run.duration = 0.001;
    talus::FullFrame last;
    talus::RunOutput output;
    output.full = [&](talus::FullFrame&& frame) { last = std::move(frame); };
    valueOf(talus::run(model, {}, output));
    return last;
}

int main() {
    const talus::Model slope = buildSlope();

    talus::Control control;  // takes a callback for progress and a flag to stop early, too
    control.threads = 0;     // all cores; the answer has the same bits for any number
    const talus::SearchResult result = valueOf(talus::criticalAngle(slope, control));
    std::printf("%s: critical angle %.2f deg, %s of", toString(result.status), result.answer / kDegree,
                toString(result.mode));
    for (const std::string& name : result.moving_blocks) std::printf(" %s", name.c_str());

    const double exact = talus::theory::criticalTiltSliding({.length = kLength,
                                                             .height = kHeight,
                                                             .density = 2700,
                                                             .water_depth = kWaterDepth,
                                                             .friction = kFriction});
    std::printf("\nlimit equilibrium of column 1: %.2f deg\n", exact / kDegree);

    const talus::FullFrame state = stateAt(slope, result.low - kDegree);
    const talus::FrameInterfaces& joints = state.interfaces;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (joints.block_a[i] != 0 && joints.block_b[i] != 0) continue;  // block 0 is the floor
        double force = 0;
        for (std::int64_t p = joints.point_begin[i]; p < joints.point_begin[i + 1]; ++p)
            force += state.points.normal[p];
        const int block = std::max(joints.block_a[i], joints.block_b[i]);
        std::printf("%s presses on the floor with %.1f N\n", slope.blocks[block].name.c_str(), force);
    }
    return result.status == talus::SearchStatus::found ? 0 : 1;
}
