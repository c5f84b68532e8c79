// Weights of planes, and how densely their poles lie.

#include <algorithm>
#include <cmath>

#include "talus/pole_statistics.h"

namespace talus::kinematics {

double terzaghiWeight(const Vec3& normal, const Vec3& scanline, double least_angle) {
    // sin of the angle between line and plane is cos of the angle between line and normal.
    return 1 / std::max(std::abs(normal.dot(scanline)), std::sin(least_angle));
}

double poleDensity(const Vec3& direction, const std::vector<Vec3>& normals,
                   const std::vector<double>& weights, const Counting& counting) {
    // A circle about an axis with half angle t covers 1 - cos t of the hemisphere. With k = 1 / area, exp(k
    // (cos - 1)) has the same integral up to exp(-k): both are 2 pi area.
    const double concentration = 1 / counting.area, edge = 1 - counting.area;
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double weight = weights.empty() ? 1 : weights[i];
        const double cosine = std::abs(normals[i].dot(direction));
        all += weight;
        if (counting.fisher) {
            sum += weight * std::exp(concentration * (cosine - 1));
        } else if (cosine >= edge) {
            sum += weight;
        }
    }
    return all > 0 ? sum / all : 0;
}

}  // namespace talus::kinematics
