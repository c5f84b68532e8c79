#include "scenario/force_sections.h"

#include <initializer_list>
#include <set>
#include <string>
#include <utility>

#include "scenario/flow.h"
#include "scenario/ground_motion.h"
#include "scenario/places.h"
#include "talus/angles.h"
#include "talus/bolts.h"

namespace talus::formats::scenario {

namespace {

/// Keys that mean something in another kind of table only.
void refuse(TableReader& table, std::string_view with, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
        if (table.has(key))
            table.error(key, "found " + std::string(key) + " beside " + std::string(with) +
                                 ", allowed: one or the other");
}

// --- [[load]]
// -----------------------------------------------------------------------------------------------------------

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

void readLoads(const ForceReader& from, Model& model) {
    Report& report = from.report;
    for (const FieldNode& node : from.root.tables("load")) {
        TableReader table(report, node.node, node.field,
                          {"block", "force", "point", "box", "face", "pressure", "factor"});
        AppliedLoad load;
        load.field = node.field;
        load.factor = readTable(report, table, "factor", kAnyNumber, "factor");
        if (table.requireOneOf({"block", "box"}))
            table.has("box") ? readBoxLoad(table, load) : readBlockLoad(report, table, from.blocks, load);
        model.loads.push_back(std::move(load));
    }
}

// --- [[bolt]], [[bolt_pattern]]
// --------------------------------------------------------------------------------------------

const std::vector<std::string> kBoltKeys{
    "name",           "kind",           "area",          "modulus",         "yield_force", "pretension",
    "rupture_strain", "bond_stiffness", "bond_strength", "shear_stiffness", "plate"};

std::vector<std::string> withBoltKeys(std::vector<std::string> keys) {
    keys.insert(keys.end(), kBoltKeys.begin(), kBoltKeys.end());
    return keys;
}

void readGrout(TableReader& table, Bolt& bolt) {
    table.require({"bond_stiffness", "bond_strength"});
    bolt.bond_stiffness = table.number("bond_stiffness", kPositive).value_or(1);
    bolt.bond_strength = table.number("bond_strength", kPositive).value_or(1);
    bolt.shear_stiffness = table.number("shear_stiffness", kNotNegative).value_or(0);
    bolt.plate = table.boolean("plate").value_or(false);
}

/// What a bolt is made of.
void readBar(TableReader& table, Bolt& bolt) {
    table.require({"kind", "area", "modulus", "yield_force"});
    bolt.area = table.number("area", kPositive).value_or(1);
    bolt.modulus = table.number("modulus", kPositive).value_or(1);
    bolt.yield_force = table.number("yield_force", kPositive).value_or(kInfinity);
    bolt.pretension = table.number("pretension", kNotNegative).value_or(0);
    bolt.rupture_strain = table.number("rupture_strain", kPositive).value_or(kInfinity);
    if (bolt.pretension > bolt.yield_force)
        table.error("pretension", "found more than yield_force, allowed: at most that");
    const auto kind = table.choice("kind", {"anchored", "grouted"});
    bolt.grouted = kind && *kind == 1;
    if (bolt.grouted) return readGrout(table, bolt);
    if (!kind) return;
    for (const char* key : {"bond_stiffness", "bond_strength", "shear_stiffness", "plate"})
        if (table.has(key))
            table.error(key, "found " + std::string(key) +
                                 " with kind \"anchored\", allowed: only with kind \"grouted\"");
}

/// The names of bolts so far, so that each is there once.
std::string readBoltName(TableReader& table, const std::string& otherwise, std::set<std::string>& names) {
    const std::string name = table.name("name", false).value_or(otherwise);
    if (!names.insert(name).second)
        table.error("name", "found \"" + name + "\" a second time, allowed: a name of its own for each");
    return name;
}

void readBolts(const ForceReader& from, Model& model) {
    std::set<std::string> names;
    for (const FieldNode& node : from.root.tables("bolt")) {
        TableReader table(from.report, node.node, node.field, withBoltKeys({"head", "end"}));
        Bolt bolt;
        bolt.field = node.field;
        bolt.name = readBoltName(table, "bolt" + std::to_string(model.bolts.size() + 1), names);
        table.require({"head", "end"});
        bolt.head = table.vector("head", kCoordinate).value_or(Vec3::Zero());
        bolt.end = table.vector("end", kCoordinate).value_or(Vec3::UnitX());
        if (table.has("end") && bolt.head == bolt.end)
            table.error("end", "found the same point as head, allowed: a different point");
        readBar(table, bolt);
        model.bolts.push_back(std::move(bolt));
    }
}

void readGrid(TableReader& table, BoltPattern& pattern) {
    table.require({"box", "face", "spacing", "length", "plunge_deg", "trend_deg"});
    if (const auto box = readCorners(table, "box")) pattern.box_min = box->min, pattern.box_max = box->max;
    pattern.direction = readDirection(table, "face").value_or(pattern.direction);
    if (const auto spacing = table.numbers("spacing", kPositive, 2))
        pattern.spacing_along = (*spacing)[0], pattern.spacing_up = (*spacing)[1];
    pattern.length = table.number("length", kPositive).value_or(1);
    pattern.plunge = kDegree * table.number("plunge_deg", {-90, 90, false, false}).value_or(0);
    pattern.trend = kDegree * table.number("trend_deg", {-360, 360, false, false}).value_or(0);
}

void readBoltPatterns(const ForceReader& from, Model& model) {
    std::set<std::string> names;
    for (const FieldNode& node : from.root.tables("bolt_pattern")) {
        TableReader table(from.report, node.node, node.field,
                          withBoltKeys({"box", "face", "spacing", "length", "plunge_deg", "trend_deg"}));
        BoltPattern pattern;
        pattern.like.field = node.field;
        pattern.like.name =
            readBoltName(table, "pattern" + std::to_string(model.bolt_patterns.size() + 1), names);
        readGrid(table, pattern);
        readBar(table, pattern.like);
        model.bolt_patterns.push_back(std::move(pattern));
    }
}

constexpr ForceSection kSections[] = {
    {"load", readLoads, nullptr},
    {"bolt", readBolts, nullptr},
    {"bolt_pattern", readBoltPatterns, placeBoltPatterns},
    {"ground_motion", readGroundMotion, nullptr},
    {"flow", readFlow, nullptr},
};

}  // namespace

std::span<const ForceSection> forceSections() { return kSections; }

}  // namespace talus::formats::scenario
