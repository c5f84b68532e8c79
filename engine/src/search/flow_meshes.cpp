// The flow on another mesh: how far discharges depend on its size.

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "talus/flow.h"

namespace talus {
namespace {

// Triangles of a finer mesh, at most. With a free surface 50,000 take a few seconds, and 117,000 of a network
// in space took 52 s where its own 29,000 take 0.8 s. Full joints take 1 s with 117,000.
constexpr std::size_t kMostTriangles = 50'000, kMostOfFullJoints = 500'000;

std::optional<Error> tooLarge(const Flow& flow, std::size_t triangles) {
    const std::size_t most = flow.free_surface || flow.coupled ? kMostTriangles : kMostOfFullJoints;
    if (triangles <= most) return std::nullopt;
    return Error{flow.field + ".refinements", "the mesh with refinements = 1 has " +
                                                  std::to_string(triangles) +
                                                  " triangles; compared are at most " + std::to_string(most)};
}

double relativeChange(double flow, double other) {
    return flow == 0 ? std::numeric_limits<double>::quiet_NaN() : (other - flow) / flow;
}

double net(const BoundaryFlow& boundary) { return boundary.inflow - boundary.outflow; }

}  // namespace

Result<MeshChange> meshChange(Model model, const SteadyFlow& flow, const Control& control) {
    int& refinements = model.flow->refinements;
    if (flow.coupling) refinements = flow.coupling->refinements;
    model.flow->refines = false;
    if (refinements == 0)
        if (auto error = tooLarge(*model.flow, 4 * flow.triangles.size())) return *error;
    refinements = refinements > 0 ? refinements - 1 : 1;  // a coarser mesh costs less
    MeshChange result;
    result.refinements = refinements;
    const Result<SteadyFlow> other =
        model.flow->coupled ? coupledFlow(model, control) : steadyFlow(model, control);
    if (!other) return other.errors();
    result.triangles = other->triangles.size();
    for (std::size_t k = 0; k < flow.boundaries.size(); ++k)
        result.boundaries.push_back(relativeChange(net(flow.boundaries[k]), net(other->boundaries[k])));
    result.total = relativeChange(flow.inflow_sum, other->inflow_sum);
    return result;
}

}  // namespace talus
