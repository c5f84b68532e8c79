// What a placed part carries along is what its faces give: random polyhedra, and bodies of several parts.

#include "geometry/world_shape.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "build/build.h"
#include "engine/geometry/random_shapes.h"
#include "state/placed_shape.h"
#include "support/bodies.h"

using namespace talus;
using namespace talus::test;

namespace {

bool isEdgeOf(const std::vector<std::int32_t>& outline, const PartEdge& edge) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto ends = std::minmax(outline[i], outline[(i + 1) % outline.size()]);
        if (ends.first == edge.from && ends.second == edge.to) return true;
    }
    return false;
}

/// Each edge once, in order, with the two faces that have it: Euler's number of them.
void checkEdges(const WorldShape& shape) {
    const std::span<const PartEdge> edges = shape.edges;
    CHECK(edges.size() == shape.vertices.size() + shape.faces.size() - 2);
    for (std::size_t k = 0; k < edges.size(); ++k) {
        CHECK(edges[k].from < edges[k].to);
        CHECK(edges[k].left != edges[k].right);
        CHECK(isEdgeOf(shape.faces[static_cast<std::size_t>(edges[k].left)], edges[k]));
        CHECK(isEdgeOf(shape.faces[static_cast<std::size_t>(edges[k].right)], edges[k]));
        if (k > 0)
            CHECK(std::pair(edges[k - 1].from, edges[k - 1].to) < std::pair(edges[k].from, edges[k].to));
    }
}

/// As the vertices in the world say.
void checkNormals(const WorldShape& shape) {
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const Polyhedron placed{
            {shape.vertices.begin(), shape.vertices.end()},
            FaceList(std::vector<std::vector<std::int32_t>>(shape.faces.begin(), shape.faces.end()))};
        CHECK((shape.normals[face] - placed.faceNormal(face)).norm() < 1e-12);
    }
}

}  // namespace

TEST_SUITE("geometry") {
    TEST_CASE("a placed part has the edges and normals of its own faces") {
        Random random(7);
        Model model = floorModel(30);
        for (int k = 0; k < 20; ++k)
            addBody(model, "rock" + std::to_string(k),
                    moved(randomPolyhedron(random, random.integer(4, 20)), Eigen::Quaterniond::Identity(),
                          Vec3(10.0 * k, 0, 20)));
        for (const auto& boxes : {angle(), channel(), cross()})
            addBody(model, "body" + std::to_string(model.blocks.size()),
                    moved(bodyOf(boxes), Eigen::Quaterniond::Identity(),
                          Vec3(10.0 * static_cast<double>(model.blocks.size()), 0, 20)));
        State state = *buildState(model, false);
        for (std::size_t b = 1; b < state.blocks.size(); ++b) {
            const Eigen::Quaterniond turn(random.rotation());
            state.blocks.orientation[b] = {turn.w(), turn.x(), turn.y(), turn.z()};
        }
        const std::size_t parts = state.geometry->part_block.size();
        REQUIRE(parts == 1 + 20 + 2 + 3 + 5);
        for (std::size_t part = 0; part < parts; ++part) {
            CAPTURE(part);
            const PlacedPart placed(state, static_cast<std::int32_t>(part));
            checkEdges(placed.world());
            checkNormals(placed.world());
        }
    }
}
