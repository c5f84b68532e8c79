#include "scenario/placed_block.h"

#include "scenario/block_shape.h"
#include "scenario/fields.h"

namespace talus::formats::scenario {

namespace {

void readMotion(TableReader& table, Block& block) {
    const bool fixed = table.boolean("fixed").value_or(false);
    const bool driven = table.boolean("driven").value_or(false);
    block.velocity = table.vector("velocity", kSpeed).value_or(Vec3::Zero());
    block.angular_velocity = table.vector("angular_velocity", kSpin).value_or(Vec3::Zero());
    if (fixed && driven) table.error("driven", "found a block both fixed and driven, allowed: one of them");
    if (fixed && !driven && table.has("velocity"))
        table.error("velocity", "found a velocity of a fixed block, allowed: only for free or driven blocks");
    if ((fixed || driven) && table.has("angular_velocity"))
        table.error("angular_velocity", "found an angular velocity of a " +
                                            std::string(fixed ? "fixed" : "driven") +
                                            " block, allowed: only for free blocks");
    if (driven && !table.has("velocity")) table.error("velocity", "missing; required for a driven block");
    block.motion = fixed ? Motion::fixed : driven ? Motion::driven : Motion::free;
}

}  // namespace

std::vector<PlacedBlock> readPlacedBlocks(Report& report, const FieldNode& entry, const Materials& materials,
                                          const Joints& joints, const std::string& folder) {
    std::vector<std::string> keys{"name"};
    keys.insert(keys.end(), shapeKeys().begin(), shapeKeys().end());
    keys.insert(keys.end(), {"material", "joint", "fixed", "driven", "velocity", "angular_velocity"});
    TableReader table(report, entry.node, entry.field, keys);
    const bool is_many = table.boolean("each_solid").value_or(false);
    table.require({"name"});
    PlacedBlock placed;
    Block& block = placed.block;
    placed.place = table.place();
    placed.name_place = table.placeOf("name");
    const auto name = table.name("name", is_many);
    placed.name_known = name.has_value();
    block.name = name.value_or("");
    block.field = entry.field;
    std::vector<NamedShape> shapes;
    if (is_many) {
        shapes = readSolidShapes(report, table, folder);
        placed.name_known = !shapes.empty();
    } else if (auto shape = readShape(report, table, folder)) {
        shapes.push_back({"", std::move(*shape)});
    }
    readMotion(table, block);
    if (const auto material = readMaterial(report, table, materials)) {
        block.material = *material;
        block.density = materials.densities[static_cast<std::size_t>(*material)];
    }
    const auto joint = readJoint(report, table, "joint", joints);
    if (shapes.empty()) return {placed};
    std::vector<PlacedBlock> all(shapes.size(), placed);
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].block.name += shapes[k].name;
        all[k].block.shape = std::move(shapes[k].shape);
        if (joint) all[k].block.face_joint.assign(all[k].block.shape.faces.size(), *joint);
    }
    return all;
}

}  // namespace talus::formats::scenario
