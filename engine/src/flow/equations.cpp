#include "flow/equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flow/cubic_law.h"

namespace talus::flow {
namespace {

constexpr double kNoFlow = 1e-12;     // of the largest flow at a node: rounding
constexpr double kNoPressure = 1e-9;  // of the median patch, as a head: rounding
constexpr double kBalanced = 1e-9;    // of the inflow: imbalance at a node
// Of the inflow: what may be left where rounding allows no better, between joints of very unequal apertures.
constexpr double kUnequalJoints = 1e-6;
constexpr double kStill = 1e-9;  // of the median patch: water with smaller differences of head is still

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

double lowestHead(const Conditions& conditions) {
    double lowest = kInfinity;
    for (std::size_t n = 0; n < conditions.of.size(); ++n)
        if (conditions.of[n] == Condition::head) lowest = std::min(lowest, conditions.head[n]);
    return std::isfinite(lowest) ? lowest : 0.0;
}

}  // namespace

Equations::Equations(const Network& network, const Conditions& conditions,
                     const std::vector<Corners>& transmissivity, const FreeSurface& surface)
    : network_(&network),
      conditions_(&conditions),
      dry_share_(surface.dry_share),
      ramp_(surface.ramp * network.height),
      around_(Vector::Zero(static_cast<Eigen::Index>(network.nodes.size()))),
      structure_(network, conditions),
      datum_(lowestHead(conditions)) {
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const Corners between = conductancesOf(gradientsOf(network, t), transmissivity[t]);
        for (std::size_t k = 0; k < 3; ++k)
            for (const std::size_t end : {k, (k + 1) % 3})
                around_[network.triangles[t][end]] += std::abs(between[k]);
        stiffness_.push_back(between);
    }
    openOutlets();
}

void Equations::openOutlets() {
    held_.clear();
    for (const Condition condition : conditions_->of) held_.push_back(condition != Condition::none ? 1 : 0);
}

void Equations::openOutlets(const Vector& heads) {
    openOutlets();
    const double no_pressure = kNoPressure * network_->size;
    for (std::size_t n = 0; n < held_.size(); ++n) {
        if (conditions_->of[n] == Condition::outlet &&
            heads[static_cast<Eigen::Index>(n)] < heldHead(n) - no_pressure) {
            held_[n] = 0;
        }
    }
}

double Equations::heldHead(std::size_t node) const {
    switch (conditions_->of[node]) {
        case Condition::head:
            return conditions_->head[node] - datum_;
        case Condition::outlet:
            return conditions_->elevation[node] - datum_;
        case Condition::none:
        case Condition::dry:
            break;
    }
    return 0;
}

void Equations::hold(Vector& heads) const {
    for (std::size_t n = 0; n < held_.size(); ++n)
        if (isHeld(n)) heads[static_cast<Eigen::Index>(n)] = heldHead(n);
}

bool Equations::switchOutlets(const Vector& heads, const Vector& inflow) {
    const double no_flow = kNoFlow * inflow.cwiseAbs().maxCoeff();
    const double no_pressure = kNoPressure * network_->size;
    bool any = false;
    for (std::size_t n = 0; n < held_.size(); ++n) {
        if (conditions_->of[n] != Condition::outlet) continue;
        const auto i = static_cast<Eigen::Index>(n);
        const bool wrong = isHeld(n) ? inflow[i] > no_flow : heads[i] > heldHead(n) + no_pressure;
        if (wrong) held_[n] = isHeld(n) ? 0 : 1, any = true;
    }
    return any;
}

double Equations::pressureHead(const Vector& heads, std::int32_t node) const {
    return heads[node] + datum_ - conditions_->elevation[at(node)];
}

Wetness Equations::full() const {
    return {std::vector<double>(held_.size(), 1.0), std::vector<double>(held_.size(), 0.0)};
}

Wetness Equations::wetnessOf(const Vector& heads, double ramp) const {
    Wetness wetness;
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(held_.size()); ++n) {
        const auto [conductivity, slope] = relativeConductivity(pressureHead(heads, n), ramp, dry_share_);
        wetness.conductivity.push_back(conductivity);
        wetness.slope.push_back(slope);
    }
    return wetness;
}

std::vector<double> Equations::sharesOf(const Wetness& wetness) const {
    std::vector<double> shares;
    for (const auto& [a, b, c] : network_->triangles) {
        const auto& k = wetness.conductivity;
        shares.push_back((k[at(a)] + k[at(b)] + k[at(c)]) / 3);
    }
    return shares;
}

TriangleFlow Equations::flowIn(std::size_t triangle, const Vector& heads, const Wetness& wetness) const {
    const auto [a, b, c] = network_->triangles[triangle];
    const auto& k = wetness.conductivity;
    return triangleFlow(stiffness_[triangle], {heads[a], heads[b], heads[c]}, {k[at(a)], k[at(b)], k[at(c)]});
}

Vector Equations::inflows(const Vector& heads, const Wetness& wetness) const {
    Vector sum = Vector::Zero(heads.size());
    for (std::size_t t = 0; t < stiffness_.size(); ++t) {
        const TriangleFlow flow = flowIn(t, heads, wetness);
        for (std::size_t k = 0; k < 3; ++k) sum[network_->triangles[t][k]] += flow.inflow[k];
    }
    return sum;
}

/// Entries of held nodes stay zero, so that the structure stays as it is.
void Equations::add(std::size_t triangle, std::size_t row, std::size_t column, double value,
                    SparseMatrix& matrix) const {
    const auto& corners = network_->triangles[triangle];
    if (!isHeld(at(corners[row])) && !isHeld(at(corners[column])))
        matrix.valuePtr()[structure_.entry(triangle, row, column)] += value;
}

SparseMatrix Equations::identityOfHeld() const {
    SparseMatrix matrix = structure_.empty();
    for (std::size_t n = 0; n < held_.size(); ++n)
        if (isHeld(n)) matrix.valuePtr()[structure_.diagonal(n)] = 1;
    return matrix;
}

SparseMatrix Equations::derivative(const Vector& heads, const Wetness& wetness) const {
    SparseMatrix matrix = identityOfHeld();
    for (std::size_t t = 0; t < stiffness_.size(); ++t) {
        const TriangleFlow flow = flowIn(t, heads, wetness);
        for (std::size_t column = 0; column < 3; ++column) {
            const double slope = wetness.slope[at(network_->triangles[t][column])];
            for (std::size_t row = 0; row < 3; ++row) {
                add(t, row, column, flow.by_head[row][column] + slope * flow.by_conductivity[row][column],
                    matrix);
            }
        }
    }
    return matrix;
}

void Equations::addStorage(double multiple, SparseMatrix& matrix) const {
    for (std::size_t n = 0; n < held_.size(); ++n) {
        if (isHeld(n)) continue;
        matrix.valuePtr()[structure_.diagonal(n)] += multiple * around_[static_cast<Eigen::Index>(n)];
    }
}

void Equations::stopInRamp(const Vector& from, double ramp, Vector& to) const {
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(held_.size()); ++n) {
        const double before = pressureHead(from, n), after = pressureHead(to, n);
        if (!isHeld(at(n)) && std::min(before, after) < -ramp && std::max(before, after) >= 0)
            to[n] = conditions_->elevation[at(n)] - datum_ - 0.5 * ramp;
    }
}

double Equations::imbalance(const Vector& inflow) const {
    if (!inflow.allFinite()) return kInfinity;
    double most = 0, entering = 0;
    for (std::size_t n = 0; n < held_.size(); ++n) {
        const double flow = inflow[static_cast<Eigen::Index>(n)];
        isHeld(n) ? entering += std::max(0.0, flow) : most = std::max(most, std::abs(flow));
    }
    return most > 0 ? most / std::max(entering, most * 1e-300) : 0;
}

bool Equations::isBalanced(const Vector& heads, const Vector& inflow) const {
    const double left = imbalance(inflow);
    if (left <= kBalanced) return true;
    if (!heads.allFinite() || !inflow.allFinite()) return false;
    return isStill(heads) || (left <= kUnequalJoints && isRounding(heads, inflow));
}

/// Still water has no inflow to compare an imbalance with.
bool Equations::isStill(const Vector& heads) const {
    for (const auto& [a, b, c] : network_->triangles)
        if (std::max({heads[a], heads[b], heads[c]}) - std::min({heads[a], heads[b], heads[c]}) >
            kStill * network_->size)
            return false;
    return true;
}

/// A node's inflow is a sum of c (h_i - h_j) k, each known to the rounding of the heads only.
bool Equations::isRounding(const Vector& heads, const Vector& inflow) const {
    const double rounding = std::numeric_limits<double>::epsilon() * heads.cwiseAbs().maxCoeff();
    for (Eigen::Index n = 0; n < heads.size(); ++n)
        if (!isHeld(static_cast<std::size_t>(n)) && std::abs(inflow[n]) > rounding * around_[n]) return false;
    return true;
}

Gradients gradientsOf(const Network& network, std::size_t triangle) {
    const Vec3 normal = (network.corner(triangle, 1) - network.corner(triangle, 0))
                            .cross(network.corner(triangle, 2) - network.corner(triangle, 0));
    const double twice = normal.norm();
    Gradients gradients{{}, 0.5 * twice};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 opposite = network.corner(triangle, (k + 2) % 3) - network.corner(triangle, (k + 1) % 3);
        gradients.of[k] = normal.cross(opposite) / (twice * twice);
    }
    return gradients;
}

Corners conductancesOf(const Gradients& gradients, const Corners& transmissivity) {
    Corners conductance{};
    for (std::size_t k = 0; k < 3; ++k)
        conductance[k] = -transmissivity[k] * gradients.area * gradients.of[k].dot(gradients.of[(k + 1) % 3]);
    const auto k = static_cast<std::size_t>(std::ranges::min_element(conductance) - conductance.begin());
    const double here = transmissivity[k], a = transmissivity[(k + 1) % 3], b = transmissivity[(k + 2) % 3];
    if (conductance[k] >= 0 || (here == a && here == b)) return conductance;
    const double of_a = conductance[(k + 1) % 3], of_b = conductance[(k + 2) % 3];  // c T
    const double through_hub = (of_a * b + of_b * a) / (of_a + of_b);
    if (through_hub < here) conductance[k] *= through_hub / here;
    return conductance;
}

}  // namespace talus::flow
