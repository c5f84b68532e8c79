#pragma once
// Masonry for tests.

#include "support/models.h"

namespace talus::test {

/// A semicircular arch of equal voussoirs on two fixed springers, 1 m wide; `radius` of its middle line [m].
inline Model archModel(int voussoirs, double radius, double thickness, double friction_deg,
                       double stiffness) {
    Model model;
    model.joints = {joint(friction_deg, stiffness)};
    const double inner = radius - thickness / 2, outer = radius + thickness / 2;
    model.blocks = {box("left", {-outer - 1, -1, -1}, {-inner + 1, 2, 0}, 2700, Motion::fixed),
                    box("right", {inner - 1, -1, -1}, {outer + 1, 2, 0}, 2700, Motion::fixed)};
    for (int k = 0; k < voussoirs; ++k) {
        Block block = box("v" + std::to_string(k + 1), {0, 0, 0}, {1, 1, 1}, 2400);
        for (Vec3& v : block.shape.vertices) {
            const double angle = M_PI * (k + v.x()) / voussoirs, r = v.z() > 0.5 ? outer : inner;
            v = {-r * std::cos(angle), v.y(), r * std::sin(angle)};
        }
        model.blocks.push_back(block);
    }
    return model;
}

}  // namespace talus::test
