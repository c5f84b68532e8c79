#include "report/net.h"
#include "talus/angles.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace talus::tools {

namespace {

constexpr int kPieces = 180;  ///< straight pieces of a curve

}  // namespace

const char* nameOf(Projection projection) {
    return projection == Projection::equal_area ? "equal-area" : "equal-angle";
}

double Net::radiusOf(double angle) const {
    return projection_ == Projection::equal_area ? std::sqrt(2.0) * std::sin(0.5 * angle)
                                                 : std::tan(0.5 * angle);
}

Spot Net::onNet(const Vec3& line) const {
    const double across = line.head<2>().norm();
    if (across == 0) return {0, 0};
    const double r = radiusOf(std::atan2(across, -line.z()));
    return {r * line.x() / across, r * line.y() / across};
}

Spot Net::onPage(const Spot& on_net) const {
    return {middle_.x + radius_ * on_net.x, middle_.y - radius_ * on_net.y};
}

Vec3 Net::lineAt(const Spot& on_net) const {
    const double r = std::hypot(on_net.x, on_net.y);
    if (r == 0) return -Vec3::UnitZ();
    const double angle = projection_ == Projection::equal_area
                             ? 2 * std::asin(std::min(1.0, r / std::sqrt(2.0)))
                             : 2 * std::atan(r);
    return {std::sin(angle) * on_net.x / r, std::sin(angle) * on_net.y / r, -std::cos(angle)};
}

std::vector<Spot> Net::greatCircle(const Vec3& normal) const {
    // From one end of the strike down the dip to the other.
    const double across = normal.head<2>().norm();
    if (across < 1e-12) return cone(0.5 * std::numbers::pi);
    const Vec3 strike(-normal.y() / across, normal.x() / across, 0);
    const Vec3 down(normal.z() * normal.x() / across, normal.z() * normal.y() / across, -across);
    std::vector<Spot> spots;
    for (int k = 0; k <= kPieces; ++k) {
        const double turn = std::numbers::pi * k / kPieces;
        spots.push_back(onPage(Vec3(std::cos(turn) * strike + std::sin(turn) * down)));
    }
    return spots;
}

std::vector<Spot> Net::cone(double angle) const {
    std::vector<Spot> spots;
    const double r = radius_ * radiusOf(angle);
    for (int k = 0; k <= kPieces; ++k)
        spots.push_back(
            {middle_.x + r * std::cos(2 * k * kDegree), middle_.y + r * std::sin(2 * k * kDegree)});
    return spots;
}

void Net::draw(SvgWriter& svg, const std::string& words) const {
    for (const double angle : {30.0, 60.0}) svg.shape(cone(angle * kDegree), true, "grid");
    for (int k = 0; k < 4; ++k) {
        const double a = 45.0 * k * kDegree;
        svg.line({middle_.x - radius_ * std::cos(a), middle_.y - radius_ * std::sin(a)},
                 {middle_.x + radius_ * std::cos(a), middle_.y + radius_ * std::sin(a)}, "grid");
    }
    svg.shape(cone(90 * kDegree), true, "frame");
    svg.label({middle_.x, middle_.y - radius_ - 8}, "N", "middle", "caption");
    svg.label({middle_.x, middle_.y + radius_ + 20}, words, "middle", "small");
}

}  // namespace talus::tools
