#include "build/build.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contacts/update.h"
#include "forces/sum.h"
#include "law/joint_laws.h"
#include "state/caller.h"
#include "state/placed_shape.h"

namespace talus {
namespace {

/// Principal axes; the model's own axes where the inertia is diagonal already, so that boxes keep theirs.
Mat3 principalAxes(const Mat3& inertia, Vec3& moments) {
    const double off_diagonal = std::abs(inertia(0, 1)) + std::abs(inertia(0, 2)) + std::abs(inertia(1, 2));
    moments = inertia.diagonal();
    if (off_diagonal <= 1e-12 * inertia.trace()) return Mat3::Identity();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia);
    moments = solver.eigenvalues();
    Mat3 axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
    return axes;
}

/// Slopes are often given in survey coordinates. Millions of metres from the origin a double resolves no more
/// than the overlap of a stiff joint. Far from the origin the state's own origin is the middle of the model.
Vec3 originFor(const Model& model) {
    constexpr double kFar = 10.0;  // of the model's extent
    Vec3 low = Vec3::Constant(kInfinity), high = Vec3::Constant(-kInfinity);
    for (const Block& block : model.blocks)
        for (const Vec3& v : block.shape.vertices) {
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
    const Vec3 middle = 0.5 * (low + high);
    return middle.norm() > kFar * (high - low).norm() ? Vec3(middle.array().round()) : Vec3(Vec3::Zero());
}

/// Of the surface [m^2].
double meanFaceArea(const Polyhedron& shape) {
    double area = 0, faces = 0;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        if (shape.isInner(face)) continue;
        area += shape.faceArea(face);
        ++faces;
    }
    return area / faces;
}

void addParts(const Polyhedron& shape, Geometry& geometry) {
    const auto block = static_cast<std::int32_t>(geometry.first_part.size()) - 1;
    geometry.part_block.insert(geometry.part_block.end(), shape.partCount(), block);
    geometry.first_part.push_back(static_cast<std::int32_t>(geometry.part_block.size()));
    const auto add_edges = [&](std::span<const std::vector<std::int32_t>> faces) {
        const std::vector<PartEdge> edges = partEdges(faces);
        geometry.part_edges.insert(geometry.part_edges.end(), edges.begin(), edges.end());
        geometry.first_edge.push_back(geometry.part_edges.size());
    };
    if (shape.partCount() == 1) add_edges(shape.faces);
    for (const ConvexPart& part : shape.faces.parts()) add_edges(part.faces);
    const std::vector<FacePlane> planes = facePlanes(shape);
    geometry.face_planes.insert(geometry.face_planes.end(), planes.begin(), planes.end());
    geometry.first_plane.push_back(geometry.face_planes.size());
}

void addBlock(const Block& block, State& state, Geometry& geometry, std::vector<Error>& errors) {
    Polyhedron own = block.shape;
    for (Vec3& v : own.vertices) v -= geometry.origin;
    const MassProperties mass = massProperties(own);
    if (!(mass.volume > 0) || !std::isfinite(mass.volume)) {
        errors.push_back({block.field, "block \"" + block.name + "\" has no volume"});
        return;
    }
    Blocks& blocks = state.blocks;
    Vec3 moments;
    const Mat3 axes = principalAxes(mass.inertia, moments);
    const Eigen::Quaterniond turn(axes);
    double radius = 0;
    for (Vec3& v : own.vertices) {
        v = axes.transpose() * (v - mass.centroid);
        radius = std::max(radius, v.norm());
    }
    geometry.size.push_back(smallestExtent(own));
    geometry.radius.push_back(radius);
    geometry.face_area.push_back(meanFaceArea(own));
    addParts(own, geometry);
    geometry.shape.push_back(std::move(own));

    const bool free = block.motion == Motion::free;
    blocks.position.add(mass.centroid);
    blocks.orientation.push_back({turn.w(), turn.x(), turn.y(), turn.z()});
    blocks.velocity.add(block.motion == Motion::fixed ? Vec3(Vec3::Zero()) : block.velocity);
    blocks.mass.push_back(block.density * mass.volume);
    const Vec3 inertia = block.density * moments;
    blocks.inertia.add(inertia);
    blocks.inverse_mass.push_back(free ? 1.0 / blocks.mass.back() : 0.0);
    blocks.inverse_inertia.add(free ? Vec3(inertia.cwiseInverse()) : Vec3(Vec3::Zero()));
    blocks.motion.push_back(block.motion);
    blocks.free.push_back(free ? 1 : 0);
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::shared_ptr<const Model> keptByCaller(const Model& model) {
    return {std::shared_ptr<const Model>(), &model};
}

Result<State> buildState(Model model, bool parallel, const Control& control) {
    return buildState(std::make_shared<const Model>(std::move(model)), parallel, control);
}

Result<State> buildState(std::shared_ptr<const Model> description, bool parallel, const Control& control) {
    State state;
    auto geometry = std::make_shared<Geometry>(std::move(description));
    const Model& model = geometry->model;
    std::vector<Error> errors;
    if (model.blocks.empty()) return Error{"", "there are no blocks"};
    geometry->origin = originFor(model);
    for (const Block& block : model.blocks) {
        if (isStopped(control)) return Error{"", "interrupted while it was built"};
        addBlock(block, state, *geometry, errors);
    }
    if (!errors.empty()) return errors;

    const std::size_t n = state.blocks.size();
    state.blocks.angular_momentum.resize(n);
    state.blocks.angular_velocity.resize(n);
    state.blocks.force.resize(n);
    state.blocks.torque.resize(n);
    geometry->length_scale = medianOf(geometry->size);
    geometry->initial_position = state.blocks.position;
    geometry->initial_orientation = state.blocks.orientation;
    geometry->fixed = placeFixed(state.blocks, *geometry);
    state.geometry = geometry;
    state.laws = jointLaws(model.joints);
    state.load.tilt = model.gravity.tilt;
    state.load.horizontal = model.seismic.horizontal;
    state.damping = model.damping;
    state.damping.restitution = std::any_of(model.joints.begin(), model.joints.end(),
                                            [](const Joint& joint) { return joint.restitution_normal < 1; });
    state.drained.assign(model.waters.size(), 0);

    errors = findInterfaces(state, true, parallel, control);
    if (!errors.empty()) return errors;
    errors = buildBlockForces(state);
    if (!errors.empty()) return errors;
    return state;
}

}  // namespace talus
