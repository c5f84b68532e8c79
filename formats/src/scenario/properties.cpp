#include "scenario/properties.h"

#include <cmath>

#include "scenario/fields.h"
#include "scenario/places.h"

namespace talus::formats::scenario {

namespace {

// Distinct shares of intact rock: a network of 10,000 discs then makes a thousand joints, not 50,000.
constexpr long kBridgeSteps = 1000;
constexpr const char *kLaw = "law", *kShearStrength = "shear_strength", *kOverTime = "strength_over_time";

std::vector<std::string> keysOfLaw(StrengthLaw law) {
    std::vector<std::string> keys;
    for (const JointProperty& property : kJointProperties)
        if (property.laws.has(law)) keys.emplace_back(property.key);
    if (law == StrengthLaw::envelope) keys.emplace_back(kShearStrength);
    return keys;
}

void reportOfAnotherLaw(TableReader& table, std::string_view key, StrengthLaw law) {
    table.error(key,
                "found in a joint of law " + quoted(toString(law)) + ", allowed: " + listed(keysOfLaw(law)));
}

/// Takes over what the table gives to a joint of a law; says what that is.
JointProperties readGiven(TableReader& table, Joint& joint) {
    JointProperties given;
    for (std::size_t p = 0; p < kJointPropertyCount; ++p) {
        const JointProperty& property = kJointProperties[p];
        if (!property.laws.has(joint.law)) {
            if (table.has(property.key)) reportOfAnotherLaw(table, property.key, joint.law);
            continue;
        }
        const auto value = table.number(property.key, property.allowed, property.mix_up);
        if (value) joint.*property.value = *value * property.toSi();
        given[p] = value.has_value();
    }
    return given;
}

/// What is wrong with a point that follows others.
std::optional<std::string> faultOf(const EnvelopePoint& point, const std::vector<EnvelopePoint>& before) {
    if (before.empty() && point.normal_stress != 0)
        return "found a first normal stress of " + numberText(point.normal_stress) + ", allowed: 0";
    if (before.empty()) return std::nullopt;
    if (!(point.normal_stress > before.back().normal_stress))
        return "found a normal stress of " + numberText(point.normal_stress) +
               ", allowed: greater than the one before, " + numberText(before.back().normal_stress);
    if (point.shear_strength < before.back().shear_strength)
        return "found a shear strength of " + numberText(point.shear_strength) +
               ", allowed: at least the one before, " + numberText(before.back().shear_strength);
    return std::nullopt;
}

std::vector<EnvelopePoint> readEnvelope(Report& report, TableReader& table) {
    std::vector<EnvelopePoint> envelope;
    const auto array = table.array(kShearStrength);
    if (!array) return envelope;
    if (array->size() < 2)
        table.error(kShearStrength, "found " + std::to_string(array->size()) +
                                        " points, allowed: two or more of [normal stress Pa, strength Pa]");
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string field = elementField(table.fieldOf(kShearStrength), i);
        const auto numbers =
            readNumbers(report, array->at(i), field, propertyOf(&Joint::cohesion).allowed, 2);
        if (!numbers) continue;
        const EnvelopePoint point{(*numbers)[0], (*numbers)[1]};
        if (const auto fault = faultOf(point, envelope)) report.add(array->at(i).place(), field, *fault);
        envelope.push_back(point);
    }
    return envelope;
}

/// Nothing when there is no such one.
std::optional<StrengthLaw> readLaw(TableReader& table) {
    static const std::vector<std::string> names(kStrengthLawNames.begin(), kStrengthLawNames.end());
    if (!table.has(kLaw)) return StrengthLaw::coulomb;
    const auto law = table.choice(kLaw, names);
    return law ? std::optional(static_cast<StrengthLaw>(*law)) : std::nullopt;
}

/// \pre the law is known
JointProperties readStrength(Report& report, TableReader& table, Joint& joint) {
    for (const JointProperty& property : kJointProperties)
        if (property.required_by.has(joint.law)) table.require({property.key});
    if (joint.law == StrengthLaw::envelope) {
        table.require({kShearStrength});
        joint.shear_strength = readEnvelope(report, table);
    } else if (table.has(kShearStrength)) {
        reportOfAnotherLaw(table, kShearStrength, joint.law);
    }
    if (table.has(kOverTime))
        joint.strength_over_time = readTable(report, table, kOverTime, kStrengthOverTime, "factor");
    return readGiven(table, joint);
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

void inherit(Joint& joint, JointProperties given, const Joint& base, JointProperties base_given) {
    for (std::size_t p = 0; p < kJointPropertyCount; ++p)
        if (!given[p]) joint.*kJointProperties[p].value = base.*kJointProperties[p].value;
    for (std::size_t p = 0; p < kJointPropertyCount; ++p) {
        const JointProperty& property = kJointProperties[p];
        if (property.same_as == nullptr || given[p] || base_given[p]) continue;
        if (given[jointProperty(property.same_as)]) joint.*property.value = joint.*property.same_as;
    }
}

void Joints::add(Joint joint, JointProperties given) {
    names.add(joint.name);
    inherit(joint, given, Joint{}, {});
    origins_.push_back({JointOrigin::Kind::file, static_cast<std::int32_t>(joints_.size()), given});
    joints_.push_back(std::move(joint));
}

std::int32_t Joints::derive(std::int32_t base, JointOrigin::Kind kind, JointProperties given, Joint joint) {
    const auto index = static_cast<std::size_t>(base);
    joint.law = joints_[index].law;
    joint.shear_strength = joints_[index].shear_strength;
    joint.strength_over_time = joints_[index].strength_over_time;
    inherit(joint, given, joints_[index], origins_[index].given);
    joints_.push_back(std::move(joint));
    origins_.push_back({kind, base, given});
    return static_cast<std::int32_t>(joints_.size()) - 1;
}

std::int32_t Joints::withFriction(std::int32_t base, double friction_deg) {
    const auto index = static_cast<std::size_t>(base);
    const double friction = friction_deg * propertyOf(&Joint::friction).toSi();
    origins_[index].has_bed_levels = true;
    if (friction == joints_[index].friction) return base;
    const auto [place, is_new] =
        bed_levels_.try_emplace({base, friction_deg}, static_cast<std::int32_t>(joints_.size()));
    if (!is_new) return place->second;
    Joint joint;
    joint.name = joints_[index].name + "@" + numberText(friction_deg) + "deg";
    joint.friction = friction;
    JointProperties given;
    given.set(jointProperty(&Joint::friction));
    return derive(base, JointOrigin::Kind::bed_level, given, std::move(joint));
}

std::int32_t Joints::withBridge(std::int32_t base, std::int32_t rock, double share) {
    const long steps = std::lround(share * kBridgeSteps);
    const auto index = static_cast<std::size_t>(base), other = static_cast<std::size_t>(rock);
    if (steps == 0 || base == rock) return base;
    if (steps == kBridgeSteps) return rock;
    const auto [place, is_new] =
        bridges_.try_emplace({base, steps}, static_cast<std::int32_t>(joints_.size()));
    if (!is_new) return place->second;
    origins_[index].is_mixed = origins_[other].is_mixed = true;
    const double part = static_cast<double>(steps) / kBridgeSteps;
    Joint joint;
    joint.name = joints_[index].name + "@" + numberText(part) + joints_[other].name;
    for (const JointProperty& property : kJointProperties) {
        const double own = joints_[index].*property.value, of_rock = joints_[other].*property.value;
        joint.*property.value = property.isAngle()
                                    ? std::atan((1 - part) * std::tan(own) + part * std::tan(of_rock))
                                    : (1 - part) * own + part * of_rock;
    }
    // The part without peak strength has none to lose: the mixture softens as the part that has one.
    joint.softening_displacement =
        std::max(joints_[index].softening_displacement, joints_[other].softening_displacement);
    return derive(base, JointOrigin::Kind::bridge, JointProperties{}.set(), std::move(joint));
}

std::int32_t Joints::withOverrides(std::int32_t base, TableReader& table, const std::string& field) {
    if (table.present(jointKeys()).empty()) return base;
    Joint joint;
    joint.name = joints_[static_cast<std::size_t>(base)].name + "@" + field;
    joint.law = joints_[static_cast<std::size_t>(base)].law;
    const JointProperties given = readGiven(table, joint);
    return derive(base, JointOrigin::Kind::interface, given, std::move(joint));
}

std::vector<std::string> hardeningOf(const Joint& joint) {
    std::vector<std::string> warnings;
    const std::string table = toml::joinField("joint", joint.name);
    for (const auto& [peak, residual] : {std::pair{&Joint::cohesion, &Joint::residual_cohesion},
                                         std::pair{&Joint::friction, &Joint::residual_friction}}) {
        const JointProperty &of_peak = propertyOf(peak), &of_residual = propertyOf(residual);
        if (!of_residual.laws.has(joint.law) || !of_peak.laws.has(joint.law)) continue;
        if (!(joint.*residual > joint.*peak)) continue;
        warnings.push_back(toml::joinField(table, of_residual.key) + ": " +
                           numberText(joint.*residual / of_residual.toSi()) + " is more than " +
                           std::string(of_peak.key) + ", " + numberText(joint.*peak / of_peak.toSi()) +
                           ": the joint gets stronger as it slips");
    }
    return warnings;
}

const std::vector<std::string>& jointKeys() {
    static const std::vector<std::string> keys = keysOf(kJointProperties);
    return keys;
}

Materials readMaterials(Report& report, TableReader& root) {
    Materials materials;
    for (const FieldNode& entry : root.namedTables("material")) {
        TableReader table(report, entry.node, entry.field, {"density"});
        table.require({"density"});
        materials.names.add(entry.name);
        materials.densities.push_back(table.number("density", kDensity, kDensityMixUp).value_or(1));
    }
    return materials;
}

Joints readJoints(Report& report, TableReader& root) {
    Joints joints;
    std::vector<std::string> keys = jointKeys();
    keys.insert(keys.end(), {kLaw, kShearStrength, kOverTime});
    for (const FieldNode& entry : root.namedTables("joint")) {
        TableReader table(report, entry.node, entry.field, keys);
        Joint joint;
        joint.name = entry.name;
        JointProperties given;
        if (const auto law = readLaw(table)) {
            joint.law = *law;
            given = readStrength(report, table, joint);
        }
        joints.add(std::move(joint), given);
        if (!report.clean()) continue;
        for (std::string& warning : hardeningOf(joints.all().back())) report.warn(std::move(warning));
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
