#include "snapshot/header_parts.h"

#include <algorithm>

#include "snapshot/joint_numbers.h"

namespace talus::formats {
namespace {

std::vector<double> valuesOf(const std::vector<Joint>& joints, double Joint::*property) {
    std::vector<double> values;
    for (const Joint& joint : joints) values.push_back(joint.*property);
    return values;
}

void addLaws(const std::vector<Joint>& joints, fb::JointsT& m) {
    m.envelope_begin = {0};
    for (const Joint& joint : joints) {
        m.law.emplace_back(toString(joint.law));
        for (const EnvelopePoint& point : joint.shear_strength) {
            m.envelope_normal.push_back(point.normal_stress);
            m.envelope_shear.push_back(point.shear_strength);
        }
        m.envelope_begin.push_back(static_cast<std::int32_t>(m.envelope_normal.size()));
    }
}

bool readLaw(const std::string& name, Joint& joint) {
    const auto found = std::find(kStrengthLawNames.begin(), kStrengthLawNames.end(), name);
    if (found == kStrengthLawNames.end()) return false;
    joint.law = static_cast<StrengthLaw>(found - kStrengthLawNames.begin());
    return true;
}

/// \pre the law names are as many as joints
bool readLaws(const fb::JointsT& m, std::vector<Joint>& joints) {
    const auto& begin = m.envelope_begin;
    const std::size_t points = m.envelope_normal.size();
    if (begin.size() != joints.size() + 1 || m.envelope_shear.size() != points) return false;
    for (std::size_t k = 0; k < joints.size(); ++k) {
        if (!readLaw(m.law[k], joints[k]) || begin[k] < 0 || begin[k] > begin[k + 1] ||
            static_cast<std::size_t>(begin[k + 1]) > points)
            return false;
        for (auto p = static_cast<std::size_t>(begin[k]); p < static_cast<std::size_t>(begin[k + 1]); ++p)
            joints[k].shear_strength.push_back({m.envelope_normal[p], m.envelope_shear[p]});
    }
    return true;
}

/// False when there are not as many values as joints.
bool putValues(const std::vector<double>& values, std::string_view key, std::vector<Joint>& joints) {
    if (values.size() != joints.size()) return false;
    if (const auto property = jointProperty(key))
        for (std::size_t k = 0; k < joints.size(); ++k)
            joints[k].*kJointProperties[*property].value = values[k];
    return true;
}

}  // namespace

std::unique_ptr<fb::WaterT> toMessage(const Water& water) {
    auto m = std::make_unique<fb::WaterT>();
    m->level = static_cast<fb::Level>(water.kind);
    for (const LevelPoint& point : water.level) {
        m->level_time.push_back(point.time);
        m->level_value.push_back(point.value);
    }
    m->head.assign(water.head.begin(), water.head.end());
    m->density = water.density;
    m->drains_at_aperture = water.drains_at_aperture;
    m->base = water.base;
    for (const WetFace& wall : water.walls) {
        m->wall_block.push_back(wall.block);
        m->wall_face.push_back(wall.face);
    }
    if (water.pair) m->pair = {water.pair->first, water.pair->second};
    m->field = water.field;
    for (const Vec3& corner : water.outline)
        m->outline.insert(m->outline.end(), corner.begin(), corner.end());
    return m;
}

bool fromMessage(const fb::WaterT& m, Water& water) {
    if (m.level > fb::Level::MAX || m.level_time.size() != m.level_value.size() || m.head.size() != 2 ||
        m.wall_block.size() != m.wall_face.size() || (!m.pair.empty() && m.pair.size() != 2) ||
        m.outline.size() % 3 != 0)
        return false;
    water.kind = static_cast<Water::Level>(m.level);
    for (std::size_t k = 0; k < m.level_time.size(); ++k)
        water.level.push_back({m.level_time[k], m.level_value[k]});
    std::copy(m.head.begin(), m.head.end(), water.head.begin());
    water.density = m.density;
    water.drains_at_aperture = m.drains_at_aperture;
    water.base = m.base;
    for (std::size_t k = 0; k < m.wall_block.size(); ++k)
        water.walls.push_back({m.wall_block[k], m.wall_face[k]});
    if (!m.pair.empty()) water.pair = {m.pair[0], m.pair[1]};
    water.field = m.field;
    for (std::size_t k = 0; k < m.outline.size(); k += 3)
        water.outline.emplace_back(m.outline[k], m.outline[k + 1], m.outline[k + 2]);
    return true;
}

bool allCoulomb(const std::vector<Joint>& joints) {
    return std::all_of(joints.begin(), joints.end(),
                       [](const Joint& joint) { return joint.law == StrengthLaw::coulomb; });
}

fb::JointsT toMessage(const std::vector<Joint>& joints) {
    fb::JointsT m;
    for (const Joint& joint : joints) m.name.push_back(joint.name);
    for (const JointProperty& property : kJointProperties) {
        std::vector<double> values = valuesOf(joints, property.value);
        if (auto* column = columnOf(kJointColumns, property.key, m))
            *column = std::move(values);
        else
            m.property.push_back(jointNumbers(property.key, std::move(values)));
    }
    if (!allCoulomb(joints)) addLaws(joints, m);
    return m;
}

/// Values missing in an older file keep the defaults of Joint{}; unknown ones of a later file are ignored.
bool fromMessage(const fb::JointsT& m, std::vector<Joint>& joints) {
    for (const std::string& name : m.name) joints.emplace_back().name = name;
    for (const JointColumn& column : kJointColumns)
        if (!putValues(m.*column.values, column.key, joints)) return false;
    for (const auto& numbers : m.property)
        if (!putValues(numbers->values, numbers->name, joints)) return false;
    return m.law.empty() || (m.law.size() == joints.size() && readLaws(m, joints));
}

fb::FailureT toMessage(const SnapshotFailure& failure) {
    fb::FailureT m;
    m.analysis = failure.analysis;
    m.load = failure.load;
    m.mode = static_cast<std::uint8_t>(failure.mode);
    for (const FailureMode role : failure.roles) m.role.push_back(static_cast<std::uint8_t>(role));
    m.factor = failure.factors;
    m.answer = failure.answer;
    m.stands = failure.stands;
    m.fails = failure.fails;
    for (const PathPoint& point : failure.path) {
        m.path_load.push_back(point.load);
        m.path_displacement.push_back(point.displacement);
    }
    return m;
}

bool fromMessage(const fb::FailureT& m, SnapshotFailure& failure) {
    const auto isMode = [](std::uint8_t value) {
        return value <= static_cast<std::uint8_t>(FailureMode::mixed);
    };
    if (!isMode(m.mode) || !std::all_of(m.role.begin(), m.role.end(), isMode)) return false;
    failure.analysis = m.analysis;
    failure.load = m.load;
    failure.mode = static_cast<FailureMode>(m.mode);
    for (const std::uint8_t role : m.role) failure.roles.push_back(static_cast<FailureMode>(role));
    failure.factors = m.factor;
    failure.answer = m.answer;
    failure.stands = m.stands;
    failure.fails = m.fails;
    if (m.path_load.size() != m.path_displacement.size()) return false;
    for (std::size_t k = 0; k < m.path_load.size(); ++k)
        failure.path.push_back({m.path_load[k], m.path_displacement[k]});
    return true;
}

}  // namespace talus::formats
