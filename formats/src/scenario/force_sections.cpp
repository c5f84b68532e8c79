#include "scenario/force_sections.h"

#include <initializer_list>
#include <string>
#include <utility>

#include "scenario/places.h"

namespace talus::formats::scenario {

namespace {

/// Keys that mean something in another kind of table only.
void refuse(TableReader& table, std::string_view with, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (table.has(key))
            table.error(key, "found " + std::string(key) + " beside " + std::string(with) +
                                 ", allowed: one or the other");
}

// --- [[load]] ------------------------------------------------------------------------------------------------------------

void readPressure(TableReader& table, AppliedLoad& load) {
    table.require({"face", "pressure"});
    load.direction = readDirection(table, "face").value_or(load.direction);
    load.pressure = table.number("pressure", kNotNegative).value_or(0);
}

void readBoxLoad(TableReader& table, AppliedLoad& load) {
    load.kind = AppliedLoad::Kind::box;
    refuse(table, "box", {"force", "point"});
    if (const auto box = readCorners(table, "box")) load.box_min = box->min, load.box_max = box->max;
    readPressure(table, load);
}

void readBlockLoad(Report& report, TableReader& table, const BlockDirectory& blocks, AppliedLoad& load) {
    if (const auto name = table.text("block"))
        load.block =
            blocks.resolve(report, table.placeOf("block"), table.fieldOf("block"), *name).value_or(0);
    if (!table.requireOneOf({"force", "pressure"})) return;
    if (table.has("pressure")) {
        load.kind = AppliedLoad::Kind::face;
        refuse(table, "pressure", {"point"});
        return readPressure(table, load);
    }
    refuse(table, "force", {"face"});
    load.force = table.vector("force", kAnyNumber).value_or(load.force);
    load.point = table.vector("point", kCoordinate);
}

void readLoads(Report& report, TableReader& root, const BlockDirectory& blocks, Model& model) {
    for (const FieldNode& node : root.tables("load")) {
        TableReader table(report, node.node, node.field,
                          {"block", "force", "point", "box", "face", "pressure", "factor"});
        AppliedLoad load;
        load.field = node.field;
        load.factor = readTable(report, table, "factor", kAnyNumber, "factor");
        if (table.requireOneOf({"block", "box"}))
            table.has("box") ? readBoxLoad(table, load) : readBlockLoad(report, table, blocks, load);
        model.loads.push_back(std::move(load));
    }
}

constexpr ForceSection kSections[] = {
    {"load", readLoads},
};

}  // namespace

std::span<const ForceSection> forceSections() { return kSections; }

}  // namespace talus::formats::scenario
