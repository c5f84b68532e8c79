#pragma once
// Friction cones as pyramids: which polygon stands for the circle of shear forces at each contact point.

#include <vector>

#include "limit_analysis/assembly.h"

namespace talus::limit {

/// Inside: the polygon's corners lie on the circle, so that its forces are real ones. Outside: its sides
/// touch the circle.
enum class Side { inside, outside };

/// A corner of a polygon: its direction in the plane of the joint from the first tangent [rad], and how far
/// out it lies (1 on the circle).
struct Corner {
    double angle = 0;
    double reach = 1;
};

/// Directions for every contact point, refined where a solution asks for more. The first is the first
/// tangent, so that in the vertical plane of x both polygons are exact.
class Pyramids {
 public:
    explicit Pyramids(const Assembly& assembly);

    std::vector<Corner> corners(std::size_t point, Side side) const;
    /// False when there is such a direction already.
    bool add(std::size_t point, double angle);

 private:
    bool plane_section_;
    std::vector<std::vector<double>> angles_;  ///< of each point, ascending from 0 to 2 pi
};

}  // namespace talus::limit
