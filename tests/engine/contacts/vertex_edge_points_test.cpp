// Vertices and edges against brute force: all axes by the shadows of all vertices, without the Gauss map; and
// on the face that is met, every vertex of the other block and every place where one of its edges crosses the
// outline.

#include "contacts/vertex_edge_points.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

#include "engine/geometry/random_shapes.h"
#include "geometry/face_frame.h"
#include "geometry/separation.h"
#include "support/slower.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kNever = -1.0;  // no two faces are that near to parallel
const VertexEdgeLimits kNoFaces{.face_angle = kNever, .tie = 1e-4, .reach = 0.05};

using VertexPair = std::pair<std::int32_t, std::int32_t>;

std::set<VertexPair> edgesOf(const Polyhedron& shape) {
    std::set<VertexPair> edges;
    for (const auto& outline : shape.faces)
        for (std::size_t i = 0; i < outline.size(); ++i)
            edges.insert(std::minmax(outline[i], outline[(i + 1) % outline.size()]));
    return edges;
}

Vec3 along(const Polyhedron& shape, const VertexPair& edge) {
    return shape.vertices[static_cast<std::size_t>(edge.second)] -
           shape.vertices[static_cast<std::size_t>(edge.first)];
}

/// Gap between the shadows of two shapes along a unit vector from the first to the second.
double shadowGap(const Polyhedron& first, const Polyhedron& second, const Vec3& axis) {
    double high = -1e300, low = 1e300;
    for (const Vec3& v : first.vertices) high = std::max(high, axis.dot(v));
    for (const Vec3& v : second.vertices) low = std::min(low, axis.dot(v));
    return low - high;
}

/// The best of the axes of each kind.
struct BestAxes {
    double face = -1e300, edges = -1e300;
    bool second_is_reference = false;  ///< whose face
    std::size_t reference_face = 0;
};

BestAxes bruteForceAxes(const Polyhedron& first, const Polyhedron& second) {
    BestAxes best;
    for (const bool of_second : {false, true}) {
        const Polyhedron &reference = of_second ? second : first, &other = of_second ? first : second;
        for (std::size_t f = 0; f < reference.faces.size(); ++f) {
            const double gap = shadowGap(reference, other, reference.faceNormal(f));
            if (gap > best.face) best = {gap, best.edges, of_second, f};
        }
    }
    for (const VertexPair& e : edgesOf(first))
        for (const VertexPair& f : edgesOf(second)) {
            const Vec3 normal = along(first, e).normalized().cross(along(second, f).normalized());
            if (normal.norm() < 1e-6) continue;
            for (const double sign : {1.0, -1.0})
                best.edges = std::max(best.edges, shadowGap(first, second, sign * normal.normalized()));
        }
    return best;
}

/// The part of a segment within a convex outline, as shares of its length (Cyrus and Beck); begin > end:
/// none.
std::pair<double, double> partWithin(const std::vector<Vec2>& outline, const Vec2& from, const Vec2& to) {
    double begin = 0, end = 1;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 side = outline[(i + 1) % outline.size()] - outline[i], out(side.y(), -side.x());
        const double height = out.dot(from - outline[i]), slope = out.dot(to - from);
        if (slope > 0) end = std::min(end, -height / slope);
        if (slope < 0) begin = std::max(begin, -height / slope);
        if (slope == 0 && height > 0) return {1, 0};
    }
    return {begin, end};
}

/// Ends of the parts of a block's edges that lie over a face, no higher than `reach`, from the lowest up.
std::vector<Vec3> endsOverFace(const Polyhedron& reference, std::size_t face, const Polyhedron& other,
                               double reach) {
    const FaceFrame frame = faceFrame(reference, face);
    std::vector<Vec2> outline;
    for (const std::int32_t v : reference.faces[face])
        outline.push_back(frame.toPlane(reference.vertices[static_cast<std::size_t>(v)]));
    std::vector<Vec3> ends;
    const auto add = [&](const Vec3& x) {
        const bool known =
            std::any_of(ends.begin(), ends.end(), [&](const Vec3& y) { return (x - y).norm() < 1e-9; });
        if (!known && frame.height(x) <= reach) ends.push_back(x);
    };
    for (const VertexPair& edge : edgesOf(other)) {
        const Vec3 from = other.vertices[static_cast<std::size_t>(edge.first)], way = along(other, edge);
        const auto [begin, end] = partWithin(outline, frame.toPlane(from), frame.toPlane(from + way));
        if (begin > end) continue;
        add(from + begin * way);
        add(from + end * way);
    }
    std::sort(ends.begin(), ends.end(),
              [&](const Vec3& x, const Vec3& y) { return frame.height(x) < frame.height(y); });
    return ends;
}

/// Height over the highest face plane: zero on the surface.
double outside(const Polyhedron& shape, const Vec3& x) {
    double highest = -1e300;
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
        highest = std::max(highest, faceFrame(shape, f).height(x));
    return highest;
}

/// A hull about the origin.
Polyhedron centredHull(Random& random) {
    const Polyhedron hull = randomPolyhedron(random, random.integer(5, 9));
    const Mat3 turn = random.rotation();
    return moved(hull, turn, -(turn * massProperties(hull).centroid));
}

/// Two hulls somewhere in space, the second shifted so that they overlap by `depth`.
std::pair<Polyhedron, Polyhedron> pressedPair(Random& random, double depth) {
    for (;;) {
        const Polyhedron first = centredHull(random), second = centredHull(random);
        if (separation(first, second) > -2.0 * depth) continue;
        const Vec3 way = random.direction();
        double in = 0, out = 6;
        for (int k = 0; k < 45; ++k) {
            const double middle = 0.5 * (in + out);
            (separation(first, moved(second, Mat3::Identity(), middle * way)) > -depth ? out : in) = middle;
        }
        const Mat3 turn = random.rotation();
        const Vec3 shift = random.inBox(3);
        return {moved(first, turn, shift), moved(second, turn, turn * (out * way) + shift)};
    }
}

VertexEdgePoints find(const Polyhedron& first, const Polyhedron& second,
                      const VertexEdgeLimits& limits = kNoFaces) {
    const Placed placed_1(first), placed_2(second);
    return findVertexEdgePoints(placed_1.world(), placed_2.world(), limits);
}

void checkPoint(const VertexEdgePoint& point, const Polyhedron& first, const Polyhedron& second,
                double reach) {
    const Polyhedron &reference = point.second_is_reference ? second : first,
                     &other = point.second_is_reference ? first : second;
    CHECK(point.e1.norm() == within(1e-12, 1));
    CHECK(point.e2.norm() == within(1e-12, 1));
    CHECK(std::abs(point.e1.dot(point.e2)) < 1e-12);
    const Vec3 normal = point.e1.cross(point.e2);
    CHECK((point.on_other - point.on_reference - point.gap * normal).norm() < 1e-9);
    CHECK(point.gap <= reach);
    CHECK(std::abs(outside(other, point.on_other)) < 1e-9);
    CHECK(std::abs(outside(reference, point.on_reference)) < 1e-8);
    CHECK(point.reference_face >= 0);
    CHECK(point.reference_face < static_cast<std::int32_t>(reference.faces.size()));
    CHECK(point.other_face >= 0);
    CHECK(point.other_face < static_cast<std::int32_t>(other.faces.size()));
}

/// The four lowest of the ends over the face, no more and no fewer.
void checkPointsOnFace(const VertexEdgePoints& found, const Polyhedron& reference, std::size_t face,
                       const Polyhedron& other, double reach) {
    const std::vector<Vec3> ends = endsOverFace(reference, face, other, reach);
    CHECK(found.count == std::min(ends.size(), VertexEdgePoints::kMost));
    for (std::size_t k = 0; k < std::min(ends.size(), found.count); ++k) {
        CAPTURE(k);
        CHECK(std::any_of(found.begin(), found.end(), [&](const VertexEdgePoint& point) {
            return (point.on_other - ends[k]).norm() < 1e-8;
        }));
    }
    for (const VertexEdgePoint& point : found) CHECK(point.reference_face == static_cast<std::int32_t>(face));
}

bool hasTwin(const VertexEdgePoint& point, const VertexEdgePoints& others) {
    return std::any_of(others.begin(), others.end(), [&](const VertexEdgePoint& other) {
        const bool same_way =
            point.second_is_reference != other.second_is_reference;  // the same block's face
        const Vec3 &on_reference = same_way ? other.on_reference : other.on_other,
                   &on_other = same_way ? other.on_other : other.on_reference;
        return (point.on_reference - on_reference).norm() < 1e-9 && (point.on_other - on_other).norm() < 1e-9;
    });
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE(
        "findVertexEdgePoints: axis, depth and points of pressed random hulls are those of brute force") {
        constexpr int kTrials = kTriesFew ? 50 : 200;
        Random random(71);
        int on_faces = 0, between_edges = 0, crossings = 0;
        for (int trial = 0; trial < kTrials; ++trial) {
            CAPTURE(trial);
            const auto [first, second] = pressedPair(random, std::pow(10, random.uniform(-4, -1)));
            const BestAxes best = bruteForceAxes(first, second);
            const VertexEdgePoints found = find(first, second);
            REQUIRE(found.near);
            const bool edges = best.edges > best.face + kNoFaces.tie;
            CHECK(found.distance == doctest::Approx(edges ? best.edges : best.face).epsilon(1e-9));
            CHECK(std::abs(found.distance - separation(first, second)) <= kNoFaces.tie * (1 + 1e-9));
            for (const VertexEdgePoint& point : found) checkPoint(point, first, second, kNoFaces.reach);
            if (edges) {
                ++between_edges;
                REQUIRE(found.count == 1);
                const VertexEdgePoint& point = found.points[0];
                CHECK_FALSE(point.second_is_reference);
                CHECK(point.gap == doctest::Approx(best.edges).epsilon(1e-9));
                CHECK(shadowGap(first, second, point.e1.cross(point.e2)) ==
                      doctest::Approx(best.edges).epsilon(1e-9));
                continue;
            }
            ++on_faces;
            REQUIRE(found.count > 0);
            CHECK(found.points[0].second_is_reference == best.second_is_reference);
            const Polyhedron &reference = best.second_is_reference ? second : first,
                             &other = best.second_is_reference ? first : second;
            checkPointsOnFace(found, reference, best.reference_face, other, kNoFaces.reach);
            for (const VertexEdgePoint& point : found)
                crossings += std::none_of(other.vertices.begin(), other.vertices.end(),
                                          [&](const Vec3& v) { return (v - point.on_other).norm() < 1e-9; });
        }
        CHECK(on_faces > kTrials * 3 / 10);
        CHECK(between_edges > kTrials * 3 / 20);
        CHECK(crossings > kTrials / 10);
    }

    TEST_CASE("findVertexEdgePoints: the same whichever block comes first, and wherever in space") {
        Random random(72);
        for (int trial = 0; trial < 80; ++trial) {
            CAPTURE(trial);
            const auto [first, second] = pressedPair(random, std::pow(10, random.uniform(-4, -1)));
            const VertexEdgePoints there = find(first, second), back = find(second, first);
            CHECK(back.distance == within(1e-9, there.distance));
            CHECK(back.first_face == there.second_face);
            CHECK(back.second_face == there.first_face);
            REQUIRE(back.count == there.count);
            for (const VertexEdgePoint& point : there) CHECK(hasTwin(point, back));
            const Mat3 turn = random.rotation();
            const Vec3 shift = random.inBox(10);
            const VertexEdgePoints elsewhere = find(moved(first, turn, shift), moved(second, turn, shift));
            CHECK(elsewhere.distance == doctest::Approx(there.distance).epsilon(1e-9));
            REQUIRE(elsewhere.count == there.count);
            for (std::size_t k = 0; k < there.count; ++k)
                CHECK((elsewhere.points[k].on_other - (turn * there.points[k].on_other + shift)).norm() <
                      1e-9);
        }
    }

    TEST_CASE(
        "findVertexEdgePoints: what is farther apart than the reach is not near, and told no farther than it "
        "is") {
        Random random(73);
        for (int trial = 0; trial < 80; ++trial) {
            CAPTURE(trial);
            const auto [first, second] = pressedPair(random, -std::pow(10, random.uniform(-3, 0)));
            const double apart = separation(first, second);
            const VertexEdgePoints found = find(first, second);
            CHECK(found.near == (apart <= kNoFaces.reach));
            CHECK(found.distance <= apart + 1e-12);
            if (found.near) continue;
            CHECK(found.count == 0);
            CHECK(found.distance > kNoFaces.reach);
            const Placed placed_1(first), placed_2(second);
            if (areApart(placed_1.world(), placed_2.world(), 0.1)) CHECK(apart > 0.1);
        }
    }

    TEST_CASE(
        "findVertexEdgePoints: a cube over a floor comes down on a vertex, an edge, an edge over the brink") {
        const Polyhedron floor = box({-2, -2, -1}, {2, 2, 0}),
                         cube = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
        const Mat3 roof = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()).toRotationMatrix();
        const VertexEdgePoints edge = find(floor, moved(cube, roof, {0, 0, std::sqrt(0.5) - 0.01}));
        REQUIRE(edge.count == 2);
        for (const VertexEdgePoint& point : edge) {
            CHECK_FALSE(point.second_is_reference);
            CHECK(point.gap == within(1e-12, -0.01));
            CHECK(std::abs(point.on_other.y()) == within(1e-12, 0.5));
            CHECK((point.e1.cross(point.e2) - Vec3::UnitZ()).norm() < 1e-15);
        }
        const VertexEdgePoints over = find(floor, moved(cube, roof, {0.3, 1.8, std::sqrt(0.5) + 0.001}));
        REQUIRE(over.count == 2);
        for (const VertexEdgePoint& point : over) {
            CHECK(point.gap == within(1e-9, 0.001));
            CHECK((point.on_other.y() == doctest::Approx(1.3) || point.on_other.y() == doctest::Approx(2)));
        }
        const Mat3 tip = Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitZ()).toRotationMatrix();
        const VertexEdgePoints vertex = find(moved(cube, tip, {0.2, 0.1, std::sqrt(0.75) - 0.003}), floor);
        REQUIRE(vertex.count == 1);
        CHECK(vertex.points[0].second_is_reference);
        CHECK((vertex.points[0].on_other - Vec3(0.2, 0.1, -0.003)).norm() < 1e-12);
        CHECK((vertex.points[0].on_reference - Vec3(0.2, 0.1, 0)).norm() < 1e-12);
    }

    TEST_CASE(
        "findVertexEdgePoints: faces that lie on each other are left alone, up to their angle and more when "
        "pressed") {
        const VertexEdgeLimits limits{.face_angle = 0.05, .angle_per_depth = 10, .tie = 1e-4, .reach = 1e-3};
        const Polyhedron below = box({-0.5, -0.5, -1}, {0.5, 0.5, 0}),
                         above = box({-0.5, -0.5, 0}, {0.5, 0.5, 1});
        const auto tilted = [&](double angle, double depth) {  // about its lowest edge
            const Mat3 turn = Eigen::AngleAxisd(-angle, Vec3::UnitY()).toRotationMatrix();
            return moved(above, turn, Vec3(0.2, 0, -depth - (turn * Vec3(-0.5, 0, 0)).z()));
        };
        for (const double angle : {0.0, 0.01, 0.049}) {
            const VertexEdgePoints found = find(below, tilted(angle, 1e-5), limits);
            CHECK(found.near);
            CHECK(found.count == 0);
            CHECK(found.first_face == 5);  // top on bottom
            CHECK(found.second_face == 4);
        }
        CHECK(find(below, tilted(0.06, 1e-5), limits).count == 2);
        CHECK(find(below, tilted(0.06, 2e-3), limits).count == 0);  // 0.05 + 10 * 0.002
        CHECK(find(below, tilted(0.08, 2e-3), limits).count == 2);
    }

    TEST_CASE(
        "findVertexEdgePoints: edges win over a face, and vertices over faces that meet, by more than the "
        "tie "
        "only") {
        // Two roofs across each other: ridges along x and y, each of half the angle `steep` to the
        // horizontal.
        const auto roofs = [](double depth) {
            const auto ridge = [](double z) {
                return *convexHull({{-1, -0.5, z - 0.5},
                                    {1, -0.5, z - 0.5},
                                    {-1, 0.5, z - 0.5},
                                    {1, 0.5, z - 0.5},
                                    {-1, 0, z},
                                    {1, 0, z}});
            };
            const Mat3 over =
                (Mat3() << 0, 1, 0, 1, 0, 0, 0, 0, -1).finished();  // upside down, ridge along y
            return std::pair{ridge(0), moved(ridge(0), over, {0, 0, -depth})};
        };
        Random random(74);
        for (int trial = 0; trial < 30; ++trial) {
            const auto [first, second] = roofs(random.uniform(0.01, 0.4));
            const BestAxes best = bruteForceAxes(first, second);
            REQUIRE(best.edges > best.face);
            const double lead = best.edges - best.face;
            VertexEdgeLimits limits = kNoFaces;
            limits.tie = lead * 0.999;
            const VertexEdgePoints edges = find(first, second, limits);
            REQUIRE(edges.count == 1);
            CHECK((edges.points[0].e1.cross(edges.points[0].e2) - Vec3::UnitZ()).norm() < 1e-12);
            CHECK(edges.distance == within(1e-9, best.edges));
            limits.tie = lead * 1.001;
            CHECK(find(first, second, limits).distance == within(1e-9, best.face));
        }
    }

    TEST_CASE(
        "approachOf: within the moves it was asked for no vertex or edge meets that it did not foresee") {
        constexpr double kTravel = 0.02, kTurn = 0.01;
        const VertexEdgeLimits limits{.face_angle = 0.05, .angle_per_depth = 10, .tie = 1e-4, .reach = 1e-3};
        Random random(75);
        int sharp = 0, seen = 0;
        for (int trial = 0; trial < 60; ++trial) {
            CAPTURE(trial);
            const bool boxes = trial % 2 == 0;
            const Polyhedron first =
                boxes ? box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}) : randomPolyhedron(random, 8);
            const Polyhedron second =
                boxes
                    ? moved(first,
                            Eigen::AngleAxisd(random.uniform(0, 0.08), random.direction()).toRotationMatrix(),
                            Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                                 random.uniform(0.99, 1.06)))
                    : moved(randomPolyhedron(random, 8), random.rotation(), 1.2 * random.direction());
            const Placed placed_1(first), placed_2(second);
            const Approach approach = approachOf(placed_1.world(), placed_2.world(), limits, kTravel, kTurn);
            sharp += approach == Approach::vertex_edge;
            if (approach == Approach::vertex_edge) continue;
            Vec3 middle = Vec3::Zero();
            for (const Vec3& v : second.vertices) middle += v / static_cast<double>(second.vertices.size());
            for (int k = 0; k < 30; ++k) {
                // Half of what is allowed goes to the turn's own travel.
                const double turn_by = random.uniform(0, kTurn) * 0.5;
                const Mat3 turn = Eigen::AngleAxisd(turn_by, random.direction()).toRotationMatrix();
                const Vec3 shift =
                    middle - turn * middle + random.uniform(0, 0.25 * kTravel) * random.direction();
                const VertexEdgePoints found = find(first, moved(second, turn, shift), limits);
                CHECK(found.count == 0);
                ++seen;
            }
        }
        CHECK(sharp > 10);
        CHECK(seen > 300);
    }
}
