#include "scenario/flow.h"

#include <algorithm>
#include <utility>

#include "scenario/fields.h"
#include "scenario/places.h"

namespace talus::formats::scenario {

namespace {

constexpr Bounds kPasses{1, 1000};
/// Keys that need `coupled = true`.
const std::vector<std::string> kCouplingKeys{"residual_aperture_share", "coupling_tolerance",
                                             "coupling_passes"};
constexpr Bounds kRefinements{0, 5};  // each makes four times the triangles: 5 are a thousand for each

void readJointApertures(const ForceReader& from, TableReader& flow_table, Flow& flow) {
    for (const FieldNode& node : flow_table.namedTables("joint")) {
        TableReader table(from.report, node.node, node.field, {"aperture"});
        table.require({"aperture"});
        const auto joint = from.joints.names.resolve(from.report, table.place(), node.field, node.name);
        const auto aperture = table.number("aperture", kHydraulicAperture, kApertureMixUp);
        if (joint && aperture) flow.joint_apertures.emplace_back(*joint, *aperture);
    }
}

void readKind(TableReader& table, FlowBoundary& boundary) {
    if (!table.requireOneOf({"head", "outlet"})) return;
    if (const auto head = table.number("head", kCoordinate)) boundary.head = *head;
    const auto outlet = table.boolean("outlet");
    if (outlet && !*outlet) table.error("outlet", "found false, allowed: true, or head instead");
    if (outlet) boundary.kind = FlowBoundary::Kind::outlet;
}

void readPlace(const ForceReader& from, TableReader& table, FlowBoundary& boundary) {
    if (table.present({"face", "joint", "box"}).empty())
        table.error("face", "missing; required: face, joint or box, to say where the boundary is");
    boundary.face = readDirection(table, "face");
    if (const auto box = readCorners(table, "box")) boundary.box_min = box->min, boundary.box_max = box->max;
    const auto name = table.text("joint");
    if (!name) return;
    if (const auto joint =
            from.joints.names.resolve(from.report, table.placeOf("joint"), table.fieldOf("joint"), *name))
        boundary.joints = {*joint};
}

void readBoundaries(const ForceReader& from, TableReader& flow_table, Flow& flow) {
    bool any_head = false;
    for (const FieldNode& node : flow_table.tables("boundary")) {
        TableReader table(from.report, node.node, node.field,
                          {"name", "head", "outlet", "face", "joint", "box"});
        FlowBoundary boundary;
        boundary.field = node.field;
        boundary.name =
            table.name("name", false).value_or("boundary" + std::to_string(flow.boundaries.size() + 1));
        readKind(table, boundary);
        readPlace(from, table, boundary);
        any_head = any_head || table.has("head");
        flow.boundaries.push_back(std::move(boundary));
    }
    if (!any_head)
        flow_table.error("boundary", "found no [[flow.boundary]] with a head, allowed: at least one");
}

void readCoupling(TableReader& table, Flow& flow) {
    flow.coupled = table.boolean("coupled").value_or(false);
    if (const auto passes = table.integer("coupling_passes", kPasses))
        flow.coupling_passes = static_cast<int>(*passes);
    if (flow.coupled || table.isMeant("coupled")) return;
    for (const std::string& key : table.present(kCouplingKeys))
        table.error(key, "found without coupled = true, allowed: only with it");
}

}  // namespace

void readFlow(const ForceReader& from, Model& model) {
    std::vector<std::string> keys = keysOf(kFlowFields);
    keys.insert(keys.end(),
                {"free_surface", "refinements", "coupled", "coupling_passes", "joint", "boundary"});
    auto table = from.root.table("flow", keys);
    if (!table) return;
    Flow flow;
    flow.field = table->field();
    table->require({"aperture"});
    readNumbers(*table, kFlowFields, flow);
    flow.free_surface = table->boolean("free_surface").value_or(true);
    const auto refinements = table->integer("refinements", kRefinements);
    flow.refinements = static_cast<int>(refinements.value_or(0));
    readCoupling(*table, flow);
    flow.refines = flow.coupled && !refinements;
    readJointApertures(from, *table, flow);
    readBoundaries(from, *table, flow);
    model.flow = std::move(flow);
}

void turnFaces(const SlopeTurn& turn, Model& model) {
    if (!model.flow) return;
    for (FlowBoundary& boundary : model.flow->boundaries)
        if (boundary.face) boundary.face = turn(*boundary.face);
}

void addDerivedJoints(const std::vector<JointOrigin>& origins, Model& model) {
    if (!model.flow) return;
    const auto isOfFile = [&](std::int32_t joint) {
        return origins[static_cast<std::size_t>(joint)].kind == JointOrigin::Kind::file;
    };
    // Joints of the file stand first, so their numbers never change.
    std::erase_if(model.flow->joint_apertures, [&](const auto& entry) { return !isOfFile(entry.first); });
    for (FlowBoundary& boundary : model.flow->boundaries)
        std::erase_if(boundary.joints, [&](std::int32_t joint) { return !isOfFile(joint); });
    for (std::size_t j = 0; j < origins.size(); ++j) {
        const auto joint = static_cast<std::int32_t>(j);
        if (isOfFile(joint)) continue;
        auto& apertures = model.flow->joint_apertures;
        const auto base = std::find_if(apertures.begin(), apertures.end(),
                                       [&](const auto& entry) { return entry.first == origins[j].base; });
        if (base != apertures.end()) {
            const double aperture = base->second;
            apertures.emplace_back(joint, aperture);
        }
        for (FlowBoundary& boundary : model.flow->boundaries)
            if (std::find(boundary.joints.begin(), boundary.joints.end(), origins[j].base) !=
                boundary.joints.end())
                boundary.joints.push_back(joint);
    }
}

}  // namespace talus::formats::scenario
