#include <algorithm>

#include "scenario/stack.h"

namespace talus::formats::scenario {

namespace {

constexpr std::int64_t kMaxCount = 1'000'000;  // columns, rows or slices; the product of three fits 64 bits

void readHeights(Report& report, TableReader& table, Stack& stack) {
    const auto array = table.array("heights");
    if (!array) return;
    const std::string field = table.fieldOf("heights");
    if (stack.running) table.error("heights", "found heights in running bond, allowed: bond \"stack\" only");
    if (array->size() != static_cast<std::size_t>(stack.columns)) {
        table.error("heights", "found " + std::to_string(array->size()) +
                                   " values, allowed: one per column, " + std::to_string(stack.columns));
        stack.shape_known = false;
        return;
    }
    for (std::size_t i = 0; i < array->size(); ++i) {
        const auto height = readInteger(report, array->at(i), elementField(field, i), {1, stack.rows});
        if (!height) stack.shape_known = false;
        stack.heights[i] = static_cast<int>(height.value_or(1));
    }
}

/// Before anything of that size is allocated.
bool checkBlockCount(TableReader& table, std::int64_t count, std::int64_t most) {
    if (count <= most) return true;
    table.error("columns", "found " + std::to_string(count) +
                               " blocks (columns x rows x slices), allowed: at most " + std::to_string(most));
    return false;
}

void readCounts(Report& report, TableReader& table, Stack& stack, std::int64_t most_blocks) {
    const auto columns = table.integer("columns", {1, kMaxCount});
    const auto rows = table.integer("rows", {1, kMaxCount});
    const auto slices = table.integer("slices", {1, kMaxCount});
    stack.running = table.choice("bond", {"stack", "running"}).value_or(0) == 1;
    stack.shape_known =
        columns && rows && slices && checkBlockCount(table, *columns * *rows * *slices, most_blocks);
    if (!stack.shape_known) return;
    stack.columns = static_cast<int>(*columns);
    stack.rows = static_cast<int>(*rows);
    stack.slices = static_cast<int>(*slices);
    stack.heights.assign(static_cast<std::size_t>(stack.columns), stack.rows);
    readHeights(report, table, stack);
    stack.column_start.assign(1, 0);
    for (const int height : stack.heights)
        stack.column_start.push_back(stack.column_start.back() + std::int64_t{height} * stack.slices);
}

/// The far corner too has to lie within the range of coordinates.
void checkExtent(TableReader& table, const Stack& stack) {
    const Vec3 extent = stack.block.cwiseProduct(Vec3(3.0 * stack.columns, stack.slices + 2.0, stack.rows));
    const double farthest = (stack.origin.cwiseAbs() + extent).maxCoeff();
    if (farthest > 3 * kMaxLength)
        table.error("block", "found a stack that reaches " + numberText(farthest) + " m, allowed: at most " +
                                 numberText(3 * kMaxLength) + " m");
}

void readRowMaterials(Report& report, TableReader& table, const Materials& materials, Stack& stack) {
    const auto rows = stack.shape_known ? std::optional<std::size_t>(stack.rows) : std::nullopt;
    const auto names = table.texts("row_material", rows);
    if (!names) return;
    const Node array = *table.find("row_material");
    for (std::size_t row = 0; row < names->size(); ++row) {
        const std::string field = elementField(table.fieldOf("row_material"), row);
        const auto material = materials.names.resolve(report, array.at(row).place(), field, (*names)[row]);
        stack.materials.push_back(material.value_or(0));
    }
}

void readMaterials(Report& report, TableReader& table, const Materials& materials, Stack& stack) {
    const auto rows = table.find("row_material");
    const bool by_row = rows && !(rows->kind() == Kind::array && rows->size() == 0);
    if (by_row) readRowMaterials(report, table, materials, stack);
    if (by_row && !table.has("material")) return;
    const auto material = readMaterial(report, table, materials);
    if (!by_row) stack.materials.assign(static_cast<std::size_t>(stack.rows), material.value_or(0));
}

void readBedFriction(Report& report, TableReader& table, Stack& stack) {
    const auto array = table.array("bed_friction_deg");
    if (!array || array->size() == 0) return;
    const std::string field = table.fieldOf("bed_friction_deg");
    const bool per_column = array->at(0).kind() == Kind::array;
    if (stack.shape_known && array->size() != static_cast<std::size_t>(stack.rows)) {
        table.error("bed_friction_deg",
                    "found " + std::to_string(array->size()) +
                        " values, allowed: one per bed level (the floor's is the first), " +
                        std::to_string(stack.rows));
        return;
    }
    const auto columns = stack.shape_known ? std::optional<std::size_t>(stack.columns) : std::nullopt;
    const Interval& allowed = propertyOf(&Joint::friction).allowed;
    for (std::size_t level = 0; level < array->size(); ++level) {
        const std::string level_field = elementField(field, level);
        if (per_column) {
            auto values = readNumbers(report, array->at(level), level_field, allowed, columns);
            stack.bed_friction_deg.push_back(values ? std::move(*values) : std::vector<double>{});
        } else {
            stack.bed_friction_deg.push_back(
                {readNumber(report, array->at(level), level_field, allowed).value_or(0)});
        }
    }
}

/// A bed level's friction angle is one of Coulomb's law.
void checkBedFriction(TableReader& table, const Joints& joints, const Stack& stack) {
    const auto bed = static_cast<std::size_t>(stack.bed_joint);
    if (stack.bed_friction_deg.empty() || bed >= joints.all().size()) return;
    const Joint& joint = joints.all()[bed];
    if (joint.law != StrengthLaw::coulomb)
        table.error("bed_friction_deg", "found with the bed joint " + quoted(joint.name) + " of law " +
                                            quoted(toString(joint.law)) + ", allowed: with law \"coulomb\"");
}

}  // namespace

Stack readStack(Report& report, const FieldNode& entry, const Materials& materials, const Joints& joints,
                std::int64_t most_blocks) {
    TableReader table(report, entry.node, entry.field,
                      {"name", "origin", "columns", "rows", "slices", "block", "material", "bond", "heights",
                       "joint", "bed_joint", "side_joint", "bed_friction_deg", "row_material"});
    table.require({"columns", "rows", "slices", "block"});
    Stack stack;
    stack.field = entry.field;
    stack.place = table.place();
    stack.name_place = table.placeOf("name");
    readCounts(report, table, stack, most_blocks);
    const auto name = table.name("name", true);
    stack.name = name.value_or("");
    stack.name_known = name || !table.has("name");
    stack.shape_known = stack.shape_known && stack.name_known;
    stack.origin = table.vector("origin", kCoordinate).value_or(stack.origin);
    if (const auto block = table.vector("block", kSize)) {
        stack.block = *block;
        checkExtent(table, stack);
    }
    readMaterials(report, table, materials, stack);
    stack.joint = readJoint(report, table, "joint", joints).value_or(0);
    stack.bed_joint = readJoint(report, table, "bed_joint", joints).value_or(0);
    stack.side_joint = readJoint(report, table, "side_joint", joints).value_or(0);
    readBedFriction(report, table, stack);
    checkBedFriction(table, joints, stack);
    return stack;
}

}  // namespace talus::formats::scenario
