#pragma once
// The linear programme of an assembly under given loads.
//
//   rows      three or six equations a body (over its weight, torques over its weight and radius too), so
//             that all numbers are of size one; the least weight counted is a thousandth of the mean
//             one limit a point with cohesion
//   columns   the lack of balance, a pair of signs for each equation
//             the growing load's multiplier
//             the pull of each bolt, up to its strength
//             forces along the edges of each point's pyramid, all pushing; with cohesion also its blunt end
//
// The dual values of the rows are the mechanism: the velocities at which the loads do most work against
// joints that open as they slide (Charnes, Lemke and Zienkiewicz 1959).

#include <cstdint>
#include <vector>

#include "law/law.h"
#include "limit_analysis/assembly.h"
#include "limit_analysis/linear_program.h"
#include "limit_analysis/pyramids.h"

namespace talus::limit {

/// Velocity and spin of a body, up to a common factor.
struct BodyMotion {
    Vec3 velocity = Vec3::Zero();
    Vec3 spin = Vec3::Zero();
};

class Programme {
 public:
    /// Loads that are there, and those that are multiplied by what is sought. The assembly must outlive it.
    Programme(const Assembly& assembly, const std::vector<contact::JointLaw>& laws, const Pyramids& pyramids,
              Side side, const Loads& fixed, const Loads& growing, const std::atomic<bool>* stop);

    /// The forces nearest to balance, without the growing load.
    Outcome balance();
    /// Their lack of balance, over the mean weight; below `kBalanced` they balance.
    double imbalance() const { return program_.objective(); }
    /// How that grows when strengths are divided by more, per logarithm of the divisor.
    double imbalanceGrowth() const;

    /// The greatest multiplier between two bounds for which forces balance. \pre balance() has been solved
    Outcome growMost(double least, double most);
    double multiplier() const;

    /// Inside: adds the directions in which the mechanism slides and the pyramids have no edge, and puts them
    /// into `pyramids`. False when there are none: then the pyramids are equivalent to cones.
    bool refineInside(Pyramids& pyramids);
    /// Outside: directions in which forces are beyond the cone; for the next programme.
    bool refineOutside(Pyramids& pyramids) const;
    Outcome solveAgain();

    std::vector<unsigned char> basis() const { return program_.basis(); }
    void startFrom(const std::vector<unsigned char>& basis) { program_.startFrom(basis); }

    std::vector<BodyMotion> mechanism() const;
    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    std::int64_t iterations() const { return program_.iterations(); }

 private:
    /// A column of forces: at which point, and which force a unit is.
    struct PointColumn {
        std::int32_t point;
        Vec3 force;  ///< along the point's axes [N]
        int column;
    };
    struct Strength {
        double tan_friction, shear, tension;  ///< shear strength without normal force, tensile strength [N]
    };

    Strength strengthOf(const ContactPoint& point) const;
    double scaleOf(std::int32_t body) const;
    double scaleOf(std::int32_t body_a, std::int32_t body_b) const;
    double scaleOf(const ContactPoint& point) const { return scaleOf(point.body_a, point.body_b); }
    void writeLoad(Columns& columns, std::size_t body, const Wrench& load) const;
    void writeForce(Columns& columns, std::int32_t body, const Vec3& place, const Vec3& force) const;
    void addForce(Columns& columns, std::size_t point, const Vec3& force, double most, int limit_row,
                  double share);
    void addCorner(Columns& columns, std::size_t point, const Corner& corner);
    void addPoint(Columns& columns, std::size_t point, const std::vector<Corner>& corners);
    void addImbalance(Columns& columns) const;
    void addMultiplier(Columns& columns, const Loads& growing) const;
    void addTendon(Columns& columns, const Tendon& tendon) const;
    LinearProgram makeRows(const Loads& fixed, const std::atomic<bool>* stop);
    Vec3 slip(std::size_t point, const std::vector<BodyMotion>& motion) const;
    bool worthAdding(std::size_t point, const Vec3& slip, double angle) const;

    const Assembly& assembly_;
    const std::vector<contact::JointLaw>& laws_;
    double mean_weight_ = 0;
    std::size_t rows_ = 0, columns_ = 0;
    std::vector<int> limit_row_;  ///< of each point; -1 without one
    std::vector<PointColumn> point_columns_;
    LinearProgram program_;
};

/// Share of the mean weight that counts as nothing.
inline constexpr double kBalanced = 1e-8;

}  // namespace talus::limit
