#include "scenario/placed_block.h"

#include "scenario/block_shape.h"
#include "scenario/fields.h"

namespace talus::formats::scenario {

namespace {

void readMotion(TableReader& table, Block& block) {
    const bool fixed = table.boolean("fixed").value_or(false);
    const bool driven = table.boolean("driven").value_or(false);
    block.velocity = table.vector("velocity", kSpeed).value_or(Vec3::Zero());
    if (fixed && driven) table.error("driven", "found a block both fixed and driven, allowed: one of them");
    if (fixed && !driven && table.has("velocity"))
        table.error("velocity", "found a velocity of a fixed block, allowed: only for free or driven blocks");
    if (driven && !table.has("velocity")) table.error("velocity", "missing; required for a driven block");
    block.motion = fixed ? Motion::fixed : driven ? Motion::driven : Motion::free;
}

}  // namespace

PlacedBlock readPlacedBlock(Report& report, const FieldNode& entry, const Materials& materials,
                            const Joints& joints, const std::string& folder) {
    TableReader table(report, entry.node, entry.field,
                      {"name", "box", "vertices", "parts", "mesh", "scale", "material", "joint", "fixed",
                       "driven", "velocity"});
    table.require({"name"});
    PlacedBlock placed;
    Block& block = placed.block;
    placed.place = table.place();
    placed.name_place = table.placeOf("name");
    const auto name = table.name("name", false);
    placed.name_known = name.has_value();
    block.name = name.value_or("");
    block.field = entry.field;
    if (auto shape = readShape(report, table, folder)) block.shape = std::move(*shape);
    readMotion(table, block);
    if (const auto material = readMaterial(report, table, materials)) {
        block.material = *material;
        block.density = materials.densities[static_cast<std::size_t>(*material)];
    }
    if (const auto joint = readJoint(report, table, "joint", joints))
        block.face_joint.assign(block.shape.faces.size(), *joint);
    return placed;
}

}  // namespace talus::formats::scenario
