#pragma once
// Statistics of measured planes: mean orientation and Fisher's constant, sets, weights, density on the net.
//
// Planes are axes: a normal and its opposite are the same plane. Normals are given pointing upwards.

#include <optional>
#include <vector>

#include "talus/polyhedron.h"
#include "talus/result.h"

namespace talus::kinematics {

/// Mean and scatter of planes by Fisher's distribution on the sphere, density exp(K cos theta) (R. A. Fisher
/// 1953; K. V. Mardia and P. E. Jupp, Directional Statistics, 2000, section 10.3).
struct FisherStatistics {
    std::size_t count = 0;         ///< N
    Vec3 mean = Vec3::UnitZ();     ///< unit normal, upwards
    double resultant = 0;          ///< R, 0..N; by weights they are scaled to add up to N
    std::optional<double> k;       ///< (N - 1) / (N - R); none of one plane, or of parallel ones
    std::optional<double> k_low;   ///< K is between these with 95 % confidence:
    std::optional<double> k_high;  ///< 2 K (N - R) is chi-squared with 2 (N - 1) degrees of freedom
    std::optional<double>
        cone_95;  ///< the true mean lies within this angle of the mean, with 95 % confidence [rad]
};

/// Of planes about their common axis. Each normal is turned to the side of the mean; the first mean is the
/// axis of the largest eigenvalue of the orientation tensor. \param weights one each, or none. \pre at least
/// one plane
FisherStatistics fisherStatistics(const std::vector<Vec3>& normals, const std::vector<double>& weights = {});

/// The set, 0 .. count - 1, of each plane: spherical k-means of axes, the sets in order of their number of
/// planes, most first.
///
/// Each plane goes to the centre with the largest |cos|, each centre becomes the mean axis of its planes,
/// until none changes. The start is deterministic (k-means++ of D. Arthur and S. Vassilvitskii 2007 draws
/// it). The first centre is where planes lie most densely. Each further one is where the density times sin^2
/// of the angle from the centres so far is largest, so that no isolated plane begins a set. \param weights
/// one each, or none. Errors: fewer different planes than sets; no set wanted.
Result<std::vector<std::size_t>> findSets(const std::vector<Vec3>& normals, std::size_t count,
                                          const std::vector<double>& weights = {});

/// Weight of a plane met by a scanline: 1 / sin(angle between scanline and plane), the angle taken as at
/// least `least_angle` [rad] (R. D. Terzaghi 1965).
double terzaghiWeight(const Vec3& normal, const Vec3& scanline, double least_angle);

/// How poles are counted for contours.
struct Counting {
    /// Whether each pole counts exp(k (|cos| - 1)) with k = 1 / area, else 1 inside the circle and 0 outside.
    /// Both are 1 at the pole and integrate to `area` of the hemisphere.
    bool fisher = true;
    double area = 0.01;  ///< of the counting circle, as a share of the hemisphere
};

/// Share of all poles (by weight) per counting circle about a direction; poles at random give `area`.
double poleDensity(const Vec3& direction, const std::vector<Vec3>& normals,
                   const std::vector<double>& weights, const Counting& counting);

}  // namespace talus::kinematics
