#pragma once
// Vectors out of the lists of frames.

#include <Eigen/Geometry>

#include "talus/formats/export.h"

namespace talus::formats {

template <class Number>
Vec3 at(const VectorList<Number>& list, std::size_t k) {
    return {static_cast<double>(list.x[k]), static_cast<double>(list.y[k]), static_cast<double>(list.z[k])};
}

inline Mat3 turnOf(const QuaternionList& q, std::size_t k) {
    return Eigen::Quaterniond(q.w[k], q.x[k], q.y[k], q.z[k]).toRotationMatrix();
}

}  // namespace talus::formats
