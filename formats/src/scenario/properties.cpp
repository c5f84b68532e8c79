#include "scenario/properties.h"

#include <algorithm>

namespace talus::formats::scenario {

namespace {

constexpr const char* kDefaultJoint = "default";

Joint readJointTable(TableReader& table, const std::string& name, double friction_deg) {
    Joint joint;
    joint.name = name;
    joint.normal_stiffness = table.number("normal_stiffness", kPositive).value_or(0);
    joint.shear_stiffness = table.number("shear_stiffness", kPositive).value_or(0);
    joint.friction = friction_deg * kRadPerDeg;
    joint.cohesion = table.number("cohesion", kNotNegative).value_or(0);
    joint.tensile_strength = table.number("tensile_strength", kNotNegative).value_or(0);
    joint.residual_cohesion = table.number("residual_cohesion", kNotNegative).value_or(0);
    joint.residual_friction =
        table.number("residual_friction_deg", kFrictionDeg).value_or(friction_deg) * kRadPerDeg;
    joint.dilation = table.number("dilation_deg", kFrictionDeg).value_or(0) * kRadPerDeg;
    return joint;
}

}  // namespace

void NameList::add(const std::string& name) {
    indices_.emplace(name, static_cast<std::int32_t>(names_.size()));
    names_.push_back(name);
}

std::optional<std::int32_t> NameList::find(const std::string& name) const {
    const auto found = indices_.find(name);
    return found == indices_.end() ? std::nullopt : std::optional<std::int32_t>(found->second);
}

std::string NameList::list() const { return listed(names_); }

std::optional<std::int32_t> NameList::resolve(Report& report, Place place, const std::string& field,
                                              const std::string& name) const {
    if (const auto index = find(name)) return index;
    if (names_.empty()) return std::nullopt;  // the one fault then is reported once for the whole file
    const std::string hint = report.full() ? "" : suggestion(name, names_);
    report.add(place, field, "found the unknown " + what_ + " " + quoted(name) + hint);
    return std::nullopt;
}

void Joints::add(Joint joint, double friction_deg, bool has_residual_friction) {
    names.add(joint.name);
    joints_.push_back(std::move(joint));
    friction_deg_.push_back(friction_deg);
    has_residual_friction_.push_back(has_residual_friction);
}

std::int32_t Joints::withFriction(std::int32_t base, double friction_deg) {
    const auto index = static_cast<std::size_t>(base);
    if (friction_deg == friction_deg_[index]) return base;
    const auto [place, is_new] =
        derived_.try_emplace({base, friction_deg}, static_cast<std::int32_t>(joints_.size()));
    if (!is_new) return place->second;
    Joint joint = joints_[index];
    joint.name += "@" + numberText(friction_deg) + "deg";
    joint.friction = friction_deg * kRadPerDeg;
    if (!has_residual_friction_[index]) joint.residual_friction = joint.friction;
    joints_.push_back(std::move(joint));
    return place->second;
}

std::int32_t Joints::withOverrides(std::int32_t base, TableReader& table, const std::string& field) {
    const auto index = static_cast<std::size_t>(base);
    if (std::none_of(jointKeys().begin(), jointKeys().end(),
                     [&](const std::string& key) { return table.has(key); }))
        return base;
    Joint joint = joints_[index];
    joint.name += "@" + field;
    const auto replace = [&](const char* key, const Range& range, double& value, double unit) {
        const auto given = table.number(key, range);
        if (given) value = *given * unit;
        return given.has_value();
    };
    replace("normal_stiffness", kPositive, joint.normal_stiffness, 1);
    replace("shear_stiffness", kPositive, joint.shear_stiffness, 1);
    replace("cohesion", kNotNegative, joint.cohesion, 1);
    replace("tensile_strength", kNotNegative, joint.tensile_strength, 1);
    replace("residual_cohesion", kNotNegative, joint.residual_cohesion, 1);
    replace("dilation_deg", kFrictionDeg, joint.dilation, kRadPerDeg);
    const bool has_friction = replace("friction_deg", kFrictionDeg, joint.friction, kRadPerDeg);
    const bool has_residual =
        replace("residual_friction_deg", kFrictionDeg, joint.residual_friction, kRadPerDeg);
    // As in a joint's own table, the residual angle is the peak's unless somebody gave one.
    if (has_friction && !has_residual && !has_residual_friction_[index])
        joint.residual_friction = joint.friction;
    joints_.push_back(std::move(joint));
    return static_cast<std::int32_t>(joints_.size()) - 1;
}

const std::vector<std::string>& jointKeys() {
    static const std::vector<std::string> keys = {
        "normal_stiffness", "shear_stiffness",   "friction_deg",          "cohesion",
        "tensile_strength", "residual_cohesion", "residual_friction_deg", "dilation_deg"};
    return keys;
}

Materials readMaterials(Report& report, TableReader& root) {
    Materials materials;
    for (const FieldNode& entry : root.namedTables("material")) {
        TableReader table(report, entry.node, entry.field, {"density"});
        table.require({"density"});
        materials.names.add(entry.name);
        materials.densities.push_back(table.number("density", kPositive).value_or(1));
    }
    return materials;
}

Joints readJoints(Report& report, TableReader& root) {
    Joints joints;
    for (const FieldNode& entry : root.namedTables("joint")) {
        TableReader table(report, entry.node, entry.field, jointKeys());
        table.require({"normal_stiffness", "shear_stiffness", "friction_deg"});
        const double friction_deg = table.number("friction_deg", kFrictionDeg).value_or(0);
        joints.add(readJointTable(table, entry.name, friction_deg), friction_deg,
                   table.has("residual_friction_deg"));
    }
    return joints;
}

std::optional<std::int32_t> readMaterial(Report& report, TableReader& table, const Materials& materials) {
    if (table.has("material")) {
        const auto name = table.text("material");
        if (!name) return std::nullopt;
        return materials.names.resolve(report, table.placeOf("material"), table.fieldOf("material"), *name);
    }
    if (materials.names.size() == 1) return 0;
    // With none at all the one fault is reported for the whole file.
    if (!materials.names.empty())
        table.error("material", "missing; required because there are several materials");
    return std::nullopt;
}

std::optional<std::int32_t> readJoint(Report& report, TableReader& table, std::string_view key,
                                      const Joints& joints) {
    if (table.has(key)) {
        const auto name = table.text(key);
        if (!name) return std::nullopt;
        return joints.names.resolve(report, table.placeOf(key), table.fieldOf(key), *name);
    }
    if (joints.names.empty()) return std::nullopt;  // likewise
    if (const auto index = joints.names.find(kDefaultJoint)) return index;
    table.error(key, "missing, and there is no [joint.default] to stand in, allowed: " + joints.names.list());
    return std::nullopt;
}

}  // namespace talus::formats::scenario
