// The volume between a wall as built and the same wall moved, below a level table.

#include "forces/enclosed_volume.h"

#include <doctest/doctest.h>

#include "support/models.h"
#include "support/relative.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kWidth = 0.3, kHeight = 0.5;  // [m] of the wall, along y and z

/// A wall of a block behind x = 0 that looks along +x, its lower edge on z = 0.
FaceFrame wallFrame() { return {Vec3::Zero(), Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()}; }
Polygon wall() { return {{0, 0}, {kWidth, 0}, {kWidth, kHeight}, {0, kHeight}}; }

/// The wall's frame after it has receded by `gap` at its lower edge and leant back by `angle` about it.
FaceFrame moved(double gap, double angle) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(-angle, Vec3::UnitY()).toRotationMatrix();
    const FaceFrame start = wallFrame();
    return {Vec3(-gap, 0, 0), turn * start.e1, turn * start.e2, turn * start.e3};
}

WaterTable tiltedTable(double tilt, double depth) {
    const Vec3 up(std::sin(tilt), 0, std::cos(tilt));
    return {up, up.dot(Vec3(0, 0, depth))};  // through x = 0, z = depth
}

/// In the section, by brute force: strips of the room below the table and between the two planes.
double byStrips(double gap, double angle, double tilt, double depth) {
    constexpr int kStrips = 20000;
    double sum = 0;
    const double left = -gap - kHeight * std::tan(angle) - 1e-9;
    const double width = -left / kStrips;
    for (int k = 0; k < kStrips; ++k) {
        const double x = left + (k + 0.5) * width;
        const double table = depth - x * std::tan(tilt);
        const double wall_end = x >= -gap ? 0.0 : (-gap - x) / std::tan(angle);  // of the leaning wall
        sum += std::max(0.0, std::min(table, kHeight) - wall_end) * width;
    }
    return sum * kWidth;
}

}  // namespace

TEST_SUITE("engine") {
    TEST_CASE("enclosed volume: a wall that recedes, leans and stands under a tilted table") {
        for (const double gap : {0.001, 0.02})
            for (const double angle : {1e-9, 0.02})
                for (const double tilt : {-0.2, 0.0, 0.3}) {
                    CAPTURE(gap);
                    CAPTURE(angle);
                    CAPTURE(tilt);
                    const double volume =
                        sweptBelow(wall(), wallFrame(), moved(gap, angle), tiltedTable(tilt, 0.3));
                    CHECK(volume == near(byStrips(gap, angle, tilt, 0.3), 3e-4));
                }
    }

    TEST_CASE("enclosed volume: none as built, negative where the wall advances, all of it under water") {
        const WaterTable table = tiltedTable(0.25, 0.3);
        CHECK(sweptBelow(wall(), wallFrame(), wallFrame(), table) == 0);
        CHECK(areaBelow(wall(), wallFrame(), table) == near(0.3 * kWidth, 1e-12));
        const double d = 1e-3;
        const double exact = kWidth * (0.3 * d - 0.5 * d * d * std::tan(0.25));
        CHECK(sweptBelow(wall(), wallFrame(), moved(-d, 0), table) == near(-exact, 1e-12));
        CHECK(sweptBelow(wall(), wallFrame(), moved(d, 0), tiltedTable(0, 9)) ==
              near(d * kHeight * kWidth, 1e-12));
        CHECK(sweptBelow(wall(), wallFrame(), moved(d, 0), tiltedTable(0, -1)) == 0);
    }

    TEST_CASE("enclosed volume: at a fixed table it grows by the advance of what is wet") {
        const WaterTable table = tiltedTable(0.3, 0.3);
        const double gap = 0.01, step = 1e-6;
        const auto volume = [&](double at) { return sweptBelow(wall(), wallFrame(), moved(at, 0), table); };
        const double wet = kWidth * (0.3 + gap * std::tan(0.3));
        CHECK((volume(gap + step) - volume(gap - step)) / (2 * step) == near(wet, 1e-7));
    }
}
