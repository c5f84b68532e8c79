#pragma once
// Poses of blocks. Interfaces read them in no order of blocks. So the numbers of one block lie side by side,
// and a pose takes two cache lines instead of seven.

#include <cstddef>
#include <vector>

#include "talus/polyhedron.h"

namespace talus {

struct alignas(32) Position {
    double x = 0, y = 0, z = 0;
    double unused = 0;  ///< makes a record one register
    friend bool operator==(const Position&, const Position&) = default;
};

/// Unit quaternion, a block's own frame to the model frame.
struct alignas(32) Quaternion {
    double w = 1, x = 0, y = 0, z = 0;
    friend bool operator==(const Quaternion&, const Quaternion&) = default;
};

struct PositionArray : std::vector<Position> {
    Vec3 get(std::size_t i) const { return {(*this)[i].x, (*this)[i].y, (*this)[i].z}; }
    void set(std::size_t i, const Vec3& v) { (*this)[i] = {v.x(), v.y(), v.z()}; }
    void add(const Vec3& v) { push_back({v.x(), v.y(), v.z()}); }
};

struct QuaternionArray : std::vector<Quaternion> {
    Mat3 matrix(std::size_t i) const {
        const auto& [a, b, c, d] = (*this)[i];
        Mat3 r;
        r << 1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c),  //
            2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b),   //
            2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c);
        return r;
    }
};

/// Where kernels find them: four doubles a block.
inline const double* numbers(const PositionArray& a) { return a.empty() ? nullptr : &a.front().x; }
inline double* numbers(PositionArray& a) { return a.empty() ? nullptr : &a.front().x; }
inline const double* numbers(const QuaternionArray& a) { return a.empty() ? nullptr : &a.front().w; }
inline double* numbers(QuaternionArray& a) { return a.empty() ? nullptr : &a.front().w; }

}  // namespace talus
