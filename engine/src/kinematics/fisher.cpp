// Mean orientation, Fisher's constant and their confidence.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "talus/pole_statistics.h"

namespace talus::kinematics {

namespace {

constexpr double kConfidence = 0.95;
/// Share of N by which R has to be less: planes that are parallel but for rounding have no K.
constexpr double kLeastScatter = 1e-9;

/// A mean this little below horizontal is that of vertical planes, and keeps its side.
constexpr double kUpright = 1e-12;

/// P(chi-squared of 2 m degrees of freedom <= x) = 1 - exp(-x/2) sum over j < m of (x/2)^j / j!, exact for an
/// even number.
double chiSquared(double x, std::size_t m) {
    double above = 0;
    for (std::size_t j = 0; j < m; ++j) {
        const auto k = static_cast<double>(j);
        above += std::exp(k * std::log(x / 2) - x / 2 - std::lgamma(k + 1));
    }
    return 1 - above;
}

/// The x that is not exceeded with probability p. Its mean is 2 m and its deviation 2 sqrt(m), so it lies in
/// the first bracket.
double chiSquaredQuantile(double p, std::size_t m) {
    const auto mean = 2 * static_cast<double>(m);
    double low = 0, high = mean + 10 * std::sqrt(2 * mean) + 20;
    for (int k = 0; k < 60; ++k) {  // to rounding
        const double middle = 0.5 * (low + high);
        (chiSquared(middle, m) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Axis of the largest eigenvalue of sum w n n^T.
Vec3 principalAxis(const std::vector<Vec3>& normals, const std::vector<double>& weights) {
    Mat3 tensor = Mat3::Zero();
    for (std::size_t i = 0; i < normals.size(); ++i)
        tensor += weights[i] * normals[i] * normals[i].transpose();
    return Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvectors().col(2);
}

/// Sum of w n, each normal on the side of the axis.
Vec3 sumAlong(const Vec3& axis, const std::vector<Vec3>& normals, const std::vector<double>& weights) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < normals.size(); ++i)
        sum += (normals[i].dot(axis) < 0 ? -weights[i] : weights[i]) * normals[i];
    return sum;
}

void addConfidence(FisherStatistics& result) {
    const auto n = static_cast<double>(result.count);
    const double scatter = n - result.resultant;
    if (result.count < 2 || scatter <= kLeastScatter * n) return;
    const std::size_t half_freedom = result.count - 1;  // of 2 (N - 1) degrees
    result.k = (n - 1) / scatter;
    result.k_low = chiSquaredQuantile(0.5 * (1 - kConfidence), half_freedom) / (2 * scatter);
    result.k_high = chiSquaredQuantile(0.5 * (1 + kConfidence), half_freedom) / (2 * scatter);
    // Fisher (1953): cos = 1 - (N - R) / R ((1 / 0.05)^(1 / (N - 1)) - 1)
    const double cosine = 1 - scatter / result.resultant * (std::pow(1 / (1 - kConfidence), 1 / (n - 1)) - 1);
    if (cosine > -1) result.cone_95 = std::acos(cosine);
}

}  // namespace

FisherStatistics fisherStatistics(const std::vector<Vec3>& normals, const std::vector<double>& weights) {
    FisherStatistics result;
    result.count = normals.size();
    std::vector<double> scaled = weights;
    scaled.resize(normals.size(), 1);
    double sum_of_weights = 0;
    for (const double weight : scaled) sum_of_weights += weight;
    for (double& weight : scaled) weight *= static_cast<double>(normals.size()) / sum_of_weights;

    Vec3 axis = principalAxis(normals, scaled);
    if (axis.dot(normals.front()) < 0) axis = -axis;  // for vertical planes the first one decides which end
    Vec3 sum = sumAlong(axis, normals, scaled);
    for (int k = 0; k < 100;
         ++k) {  // |sum| grows with each normal that turns, so it ends; as a rule after one
        const Vec3 next = sumAlong(sum, normals, scaled);
        if (next == sum) break;
        sum = next;
    }
    result.resultant = sum.norm();
    result.mean = sum / result.resultant;
    if (result.mean.z() < -kUpright) result.mean = -result.mean;
    addConfidence(result);
    return result;
}

}  // namespace talus::kinematics
