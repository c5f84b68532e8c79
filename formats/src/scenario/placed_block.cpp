#include "scenario/placed_block.h"

#include "scenario/fields.h"
#include "scenario/places.h"

namespace talus::formats::scenario {

namespace {

// Keeps the hull of a hostile list of points from taking minutes; real blocks have tens of vertices.
constexpr std::size_t kMaxVertices = 1000;

void takeShape(TableReader& table, std::string_view key, Result<Polyhedron> shape, Block& block) {
    if (shape)
        block.shape = std::move(*shape);
    else
        for (const Error& error : shape.errors()) table.error(key, error.message);
}

void readBox(TableReader& table, Block& block) {
    if (const auto box = readCorners(table, "box"))
        takeShape(table, "box", makeBox(box->min, box->max), block);
}

void readVertices(Report& report, TableReader& table, Block& block) {
    const auto array = table.array("vertices");
    if (!array) return;
    if (array->size() < 4 || array->size() > kMaxVertices) {
        table.error("vertices", "found " + std::to_string(array->size()) + " points, allowed: 4 to " +
                                    std::to_string(kMaxVertices));
        return;
    }
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < array->size(); ++i)
        if (const auto point =
                readVector(report, array->at(i), elementField(table.fieldOf("vertices"), i), kCoordinate))
            points.push_back(*point);
    if (points.size() == array->size()) takeShape(table, "vertices", convexHull(points), block);
}

void readShape(Report& report, TableReader& table, Block& block) {
    if (table.has("box") && table.has("vertices"))
        table.error("vertices", "found both box and vertices, allowed: one of them");
    else if (!table.has("box") && !table.has("vertices") && !table.isMeant("box") &&
             !table.isMeant("vertices"))
        table.error("box", "missing; a block needs box = { min, max } or vertices");
    readBox(table, block);
    readVertices(report, table, block);
}

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
                            const Joints& joints) {
    TableReader table(report, entry.node, entry.field,
                      {"name", "box", "vertices", "material", "joint", "fixed", "driven", "velocity"});
    table.require({"name"});
    PlacedBlock placed;
    Block& block = placed.block;
    placed.place = table.place();
    placed.name_place = table.placeOf("name");
    const auto name = table.name("name", false);
    placed.name_known = name.has_value();
    block.name = name.value_or("");
    block.field = entry.field;
    readShape(report, table, block);
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
