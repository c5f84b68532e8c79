#pragma once
// Contact points of a full frame for reports and other programs: in the model frame, one entry each.

#include <cstdint>
#include <vector>

#include "talus/frame.h"

namespace talus {

/// Places that are kept for vertices and edges but touch nothing are left out.
struct ContactTable {
    std::vector<std::int32_t> interface;         ///< of the frame
    std::vector<std::int32_t> block_a, block_b;  ///< between them
    std::vector<std::int32_t> joint;
    VectorList<double> position;       ///< on the reference face, which is a's [m]
    VectorList<double> normal;         ///< unit, from a to b
    std::vector<double> gap;           ///< 0 where it closed, negative when pressed [m]
    std::vector<double> area;          ///< A_s [m^2]
    VectorList<double> force;          ///< of the springs on b [N]
    VectorList<double> shear;          ///< its part in the face [N]
    std::vector<double> normal_force;  ///< F_n, effective, compression positive [N]
    std::vector<float> water_force;    ///< P [N]
    std::vector<float> mobilised;      ///< shear force over shear strength, 0..1
    std::vector<PointState> state;

    std::size_t size() const { return interface.size(); }
};

ContactTable contactTable(const FullFrame& frame);

}  // namespace talus
