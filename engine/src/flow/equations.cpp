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
constexpr double kStill = 1e-9;      // of the median patch: water with smaller differences of head is still
constexpr double kShareStep = 1e-6;  // of the ramp: step of the difference that gives a share's slope

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

double lowestHead(const Conditions& conditions) {
    double lowest = kInfinity;
    for (std::size_t n = 0; n < conditions.of.size(); ++n)
        if (conditions.of[n] == Condition::head) lowest = std::min(lowest, conditions.head[n]);
    return std::isfinite(lowest) ? lowest : 0.0;
}

}  // namespace

Equations::Equations(const Network& network, const Conditions& conditions,
                     const std::vector<double>& transmissivity, const FreeSurface& surface)
    : network_(&network),
      conditions_(&conditions),
      dry_share_(surface.dry_share),
      structure_(network, conditions),
      datum_(lowestHead(conditions)) {
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const Gradients g = gradientsOf(network, t);
        std::array<double, 3> between{};
        for (std::size_t k = 0; k < 3; ++k)
            between[k] = -transmissivity[t] * g.area * g.of[k].dot(g.of[(k + 1) % 3]);
        stiffness_.push_back(between);
    }
    for (const Condition condition : conditions.of) held_.push_back(condition != Condition::none ? 1 : 0);
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

std::array<double, 3> Equations::pressureHeads(const Vector& heads, std::size_t triangle) const {
    std::array<double, 3> above{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t n = network_->triangles[triangle][k];
        above[k] = heads[n] + datum_ - conditions_->elevation[at(n)];
    }
    return above;
}

std::vector<double> Equations::sharesOf(const Vector& heads, double ramp) const {
    std::vector<double> shares(triangles());
    for (std::size_t t = 0; t < shares.size(); ++t)
        shares[t] = dry_share_ + (1 - dry_share_) * wetShare(pressureHeads(heads, t), ramp);
    return shares;
}

Vector Equations::inflows(const Vector& heads, const std::vector<double>& shares) const {
    Vector sum = Vector::Zero(heads.size());
    for (std::size_t t = 0; t < triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t i = network_->triangles[t][k], j = network_->triangles[t][(k + 1) % 3];
            const double flow = shares[t] * stiffness_[t][k] * (heads[i] - heads[j]);
            sum[i] += flow;
            sum[j] -= flow;
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

void Equations::addConductance(const std::vector<double>& shares, SparseMatrix& matrix) const {
    for (std::size_t t = 0; t < triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const double c = shares[t] * stiffness_[t][k];
            add(t, k, k, c, matrix);
            add(t, next, next, c, matrix);
            add(t, k, next, -c, matrix);
            add(t, next, k, -c, matrix);
        }
}

void Equations::addShareSlopes(const Vector& heads, double ramp, SparseMatrix& matrix) const {
    for (std::size_t t = 0; t < triangles(); ++t) {
        const std::array<double, 3> above = pressureHeads(heads, t);
        const double share = wetShare(above, ramp);
        if (share <= 0 || share >= 1) continue;
        std::array<double, 3> inflow{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const double flow =
                stiffness_[t][k] * (heads[network_->triangles[t][k]] - heads[network_->triangles[t][next]]);
            inflow[k] += flow;
            inflow[next] -= flow;
        }
        const double step = kShareStep * ramp;
        for (std::size_t by = 0; by < 3; ++by) {
            std::array<double, 3> more = above, less = above;
            more[by] += step;
            less[by] -= step;
            const double slope =
                (1 - dry_share_) * (wetShare(more, ramp) - wetShare(less, ramp)) / (2 * step);
            for (std::size_t of = 0; of < 3; ++of) add(t, of, by, slope * inflow[of], matrix);
        }
    }
}

SparseMatrix Equations::identityOfHeld() const {
    SparseMatrix matrix = structure_.empty();
    for (std::size_t n = 0; n < held_.size(); ++n)
        if (isHeld(n)) matrix.valuePtr()[structure_.diagonal(n)] = 1;
    return matrix;
}

SparseMatrix Equations::conductance(const std::vector<double>& shares) const {
    SparseMatrix matrix = identityOfHeld();
    addConductance(shares, matrix);
    return matrix;
}

SparseMatrix Equations::derivative(const Vector& heads, double ramp) const {
    SparseMatrix matrix = identityOfHeld();
    addConductance(sharesOf(heads, ramp), matrix);
    addShareSlopes(heads, ramp, matrix);
    return matrix;
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

bool Equations::isBalanced(const Vector& heads, const std::vector<double>& shares,
                           const Vector& inflow) const {
    const double left = imbalance(inflow);
    if (left <= kBalanced) return true;
    if (!heads.allFinite() || !inflow.allFinite()) return false;
    return isStill(heads) || (left <= kUnequalJoints && isRounding(heads, shares, inflow));
}

/// Still water has no inflow to compare an imbalance with.
bool Equations::isStill(const Vector& heads) const {
    for (const auto& [a, b, c] : network_->triangles)
        if (std::max({heads[a], heads[b], heads[c]}) - std::min({heads[a], heads[b], heads[c]}) >
            kStill * size())
            return false;
    return true;
}

/// A node's inflow is a sum of c (h_i - h_j), each known to the rounding of the heads only.
bool Equations::isRounding(const Vector& heads, const std::vector<double>& shares,
                           const Vector& inflow) const {
    Vector conductance = Vector::Zero(heads.size());
    for (std::size_t t = 0; t < triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            for (const std::size_t end : {k, (k + 1) % 3})
                conductance[network_->triangles[t][end]] += shares[t] * std::abs(stiffness_[t][k]);
    const double rounding = std::numeric_limits<double>::epsilon() * heads.cwiseAbs().maxCoeff();
    for (Eigen::Index n = 0; n < heads.size(); ++n)
        if (!isHeld(static_cast<std::size_t>(n)) && std::abs(inflow[n]) > rounding * conductance[n])
            return false;
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

}  // namespace talus::flow
