#include "talus/formats/overrides.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <optional>

#include "scenario/fields.h"
#include "scenario/flow.h"
#include "scenario/properties.h"
#include "scenario/settings.h"

namespace talus::formats {

namespace scenario {
namespace {

/// The target of a field in a model. `put` takes the value in the file's unit and returns whether it is
/// allowed.
struct Target {
    Interval allowed;
    std::function<bool(Scenario&, double)> put;
    UnitMixUp mix_up{};
};

/// Warnings of another value give way to those of this one.
void renew(std::vector<std::string>& warnings, const std::vector<std::string>& before,
           std::vector<std::string> now) {
    const auto is_old = [&](const std::string& warning) {
        return std::find(before.begin(), before.end(), warning) != before.end();
    };
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(), is_old), warnings.end());
    warnings.insert(warnings.end(), std::move_iterator(now.begin()), std::move_iterator(now.end()));
}

/// Of a number that looks like another unit.
void renewMixUp(Scenario& scenario, const std::string& field, double value, const UnitMixUp& mix_up) {
    const std::string begin = field + ": found ";
    std::vector<std::string> before, now;
    for (const std::string& warning : scenario.warnings)
        if (warning.compare(0, begin.size(), begin) == 0) before.push_back(warning);
    if (auto doubt = mixUpWarning(field, numberText(value), value, mix_up); !doubt.empty())
        now.push_back(std::move(doubt));
    renew(scenario.warnings, before, std::move(now));
}

bool isGiven(const Scenario& scenario, const std::string& field) { return scenario.places.count(field) > 0; }

/// Joints made from `base` follow it in what they were not given.
void settle(Scenario& scenario, std::size_t base) {
    auto& joints = scenario.model.joints;
    const JointProperties given = scenario.joint_origins[base].given;
    inherit(joints[base], given, Joint{}, {});
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const JointOrigin& origin = scenario.joint_origins[j];
        if (j != base && static_cast<std::size_t>(origin.base) == base)
            inherit(joints[j], origin.given, joints[base], given);
    }
}

/// Not the friction that decides whether bed levels have their own joints; nor a joint from which others are
/// mixed.
std::optional<Target> jointTarget(const Scenario& scenario, const JointField& field) {
    const auto p = jointProperty(field.key);
    const auto& joints = scenario.model.joints;
    const auto& origins = scenario.joint_origins;
    const auto joint = std::find_if(joints.begin(), joints.end(),
                                    [&](const Joint& candidate) { return candidate.name == field.joint; });
    if (!p || joint == joints.end()) return std::nullopt;
    const auto j = static_cast<std::size_t>(joint - joints.begin());
    if (!kJointProperties[*p].laws.has(joint->law)) return std::nullopt;
    const bool is_friction = kJointProperties[*p].value == &Joint::friction;
    if (origins[j].kind != JointOrigin::Kind::file || (is_friction && origins[j].has_bed_levels) ||
        origins[j].is_mixed)
        return std::nullopt;
    const JointProperty& property = kJointProperties[*p];
    const auto put = [j, p = *p](Scenario& changed, double value) {
        Joint& own = changed.model.joints[j];
        const auto before = hardeningOf(own);
        own.*kJointProperties[p].value = value * kJointProperties[p].toSi();
        changed.joint_origins[j].given.set(p);
        settle(changed, j);
        renew(changed.warnings, before, hardeningOf(own));
        return true;
    };
    return Target{property.allowed, put, property.mix_up};
}

std::optional<Target> materialTarget(const Scenario& scenario, const std::string& name) {
    const auto found = std::find(scenario.materials.begin(), scenario.materials.end(), name);
    if (found == scenario.materials.end()) return std::nullopt;
    const auto material = static_cast<std::int32_t>(found - scenario.materials.begin());
    return Target{kDensity,
                  [material](Scenario& changed, double value) {
                      for (Block& block : changed.model.blocks)
                          if (block.material == material) block.density = value;
                      return true;
                  },
                  kDensityMixUp};
}

/// The number of one of the fields of a table; `owner` finds what holds it.
template <class Fields, class Owner>
std::optional<Target> numberTarget(const Fields& fields, const std::string& key, const Owner& owner) {
    for (const auto& field : fields)
        if (field.key == key)
            return Target{field.allowed,
                          [field, owner](Scenario& changed, double value) {
                              owner(changed.model).*field.value = value * field.toSi();
                              return true;
                          },
                          field.mix_up};
    return std::nullopt;
}

/// A level given as a share of its joint's height becomes two waters, at a level that the tilt decides: such
/// files are read again.
bool hasShares(const Model& model) {
    return std::any_of(model.waters.begin(), model.waters.end(), [](const Water& w) { return w.is_share; });
}

/// Where a search starts and ends may follow from the tilt.
bool putTilt(Scenario& scenario, double tilt_deg) {
    Model& model = scenario.model;
    if (model.gravity.direction || hasShares(model)) return false;
    const double tilt = tilt_deg * kRadPerDeg;
    const bool has_start = isGiven(scenario, "analysis.start_deg");
    const bool has_stop = isGiven(scenario, "analysis.stop_deg");
    if (!has_start && has_stop && !(tilt < model.analysis.stop)) return false;
    if (!has_start && !has_stop) model.analysis.stop = defaultStopDeg(tilt_deg) * kRadPerDeg;
    model.gravity.tilt = tilt;
    return true;
}

std::optional<Target> waterTarget(const Scenario& scenario, const FieldPath& path) {
    const auto* index = path.size() > 2 ? std::get_if<std::size_t>(&path[1]) : nullptr;
    const auto* key = path.size() > 2 ? std::get_if<std::string>(&path[2]) : nullptr;
    if (!index || !key || *index >= scenario.model.waters.size()) return std::nullopt;
    if (hasShares(scenario.model)) return std::nullopt;
    const std::size_t water = *index;
    if (path.size() == 3)
        if (auto target = numberTarget(kWaterFields, *key,
                                       [water](Model& model) -> Water& { return model.waters[water]; }))
            return target;
    if (!isGiven(scenario, joinField(elementField("water", water), *key))) return std::nullopt;
    if (path.size() == 3)
        if (auto target = numberTarget(kClosedWaterFields, *key,
                                       [water](Model& model) -> Water& { return model.waters[water]; }))
            return target;
    if (path.size() == 3 && *key == "inflow" && scenario.model.waters[water].inflow.size() == 1)
        return Target{kInflow, [water](Scenario& changed, double value) {
                          changed.model.waters[water].inflow = {{0, value}};
                          return true;
                      }};
    if (path.size() == 3 && *key == "rain" && scenario.model.waters[water].rain.size() == 1)
        return Target{kRain, [water](Scenario& changed, double value) {
                          changed.model.waters[water].rain = {{0, value * kMetresPerSecond}};
                          return true;
                      }};
    if (path.size() == 3 && *key == "overflow")
        return Target{kCoordinate, [water](Scenario& changed, double value) {
                          Water& changing = changed.model.waters[water];
                          if (!(value >= changing.level[0].value)) return false;
                          changing.overflow = value;
                          return true;
                      }};
    if (const auto* end = path.size() == 4 && *key == "head" ? std::get_if<std::size_t>(&path[3]) : nullptr;
        end && *end < 2)
        return Target{kLength, [water, end = *end](Scenario& changed, double value) {
                          changed.model.waters[water].head[end] = value;
                          return true;
                      }};
    if (path.size() == 3 && (*key == "depth" || *key == "elevation"))
        return Target{*key == "depth" ? kLength : kCoordinate, [water](Scenario& changed, double value) {
                          changed.model.waters[water].level = {{0, value}};
                          return true;
                      }};
    return std::nullopt;
}

std::optional<Target> targetOf(const Scenario& scenario, std::string_view field) {
    const auto path = parseField(field);
    if (!path || path->size() < 2 || !std::holds_alternative<std::string>(path->front())) return std::nullopt;
    const std::string& table = std::get<std::string>(path->front());
    if (table == "water") return waterTarget(scenario, *path);
    if (const auto joint = jointField(*path)) return jointTarget(scenario, *joint);
    const auto* second = std::get_if<std::string>(&(*path)[1]);
    if (!second) return std::nullopt;
    if (table == "material" && path->size() == 3 && path->back() == PathPart(std::string("density")))
        return materialTarget(scenario, *second);
    if (path->size() != 2) return std::nullopt;
    if (table == "gravity" && *second == "tilt_deg") return Target{kTiltDeg, putTilt};
    if (table == "gravity")
        return numberTarget(kGravityFields, *second, [](Model& model) -> Gravity& { return model.gravity; });
    if (table == "flow" && scenario.model.flow)
        return numberTarget(kFlowFields, *second, [](Model& model) -> Flow& { return *model.flow; });
    std::optional<Target> target;
    eachNumberSection([&](std::string_view section, const auto& fields, auto owner) {
        if (table == section)
            target = numberTarget(
                fields, *second, [owner](Model & model) -> auto& { return model.*owner; });
    });
    return target;
}

using BlockPair = std::pair<std::int32_t, std::int32_t>;

BlockPair blocksOf(const PairJoint& pair) { return std::minmax(pair.block_a, pair.block_b); }

/// The [[interface]] entries of a scenario as a list that can be extended, and the model made from it again.
/// Joints stand in the order of the reader: those of the file, those of entries with properties of their own,
/// all others.
class InterfaceEntries {
 public:
    explicit InterfaceEntries(Scenario& scenario) : scenario_(scenario), model_(scenario.model) {
        for (const PairJoint& pair : model_.pair_joints)
            if (pair.must_touch) append(pair);
    }

    void set(const PairOverride& change) {
        const auto found = places_.find(std::minmax(change.block_a, change.block_b));
        if (found == places_.end())
            append({change.block_a, change.block_b, change.joint, true,
                    elementField("interface", entries_.size())});
        Entry& entry = found == places_.end() ? entries_.back() : entries_[found->second];
        if (!entry.own) {
            entry.own = model_.joints[static_cast<std::size_t>(entry.pair.joint)];
            entry.own->name += "@" + entry.pair.field;
            entry.origin = {JointOrigin::Kind::interface, entry.pair.joint};
        }
        const JointProperty& property = kJointProperties[change.property];
        (*entry.own).*property.value = change.value * property.toSi();
        entry.origin.given.set(change.property);
    }

    void store() {
        std::vector<Joint> joints;
        std::vector<JointOrigin> origins;
        const auto keep = [&](const Joint& joint, const JointOrigin& origin) {
            joints.push_back(joint);
            origins.push_back(origin);
            return static_cast<std::int32_t>(joints.size()) - 1;
        };
        std::vector<std::int32_t> moved(model_.joints.size(), 0);
        const auto keepAll = [&](bool of_file) {
            for (std::size_t j = 0; j < moved.size(); ++j) {
                const auto kind = scenario_.joint_origins[j].kind;
                if (kind != JointOrigin::Kind::interface && (kind == JointOrigin::Kind::file) == of_file)
                    moved[j] = keep(model_.joints[j], scenario_.joint_origins[j]);
            }
        };
        keepAll(true);
        for (Entry& entry : entries_) {
            if (!entry.own) continue;
            const auto base = static_cast<std::size_t>(entry.origin.base);
            inherit(*entry.own, entry.origin.given, model_.joints[base], scenario_.joint_origins[base].given);
            entry.pair.joint = keep(*entry.own, entry.origin);
        }
        keepAll(false);
        renumber(moved);
        model_.joints = std::move(joints);
        scenario_.joint_origins = std::move(origins);
        addDerivedJoints(scenario_.joint_origins, model_);
    }

 private:
    struct Entry {
        PairJoint pair;
        std::optional<Joint> own;  ///< differs from a joint of the file
        JointOrigin origin;
    };

    void append(const PairJoint& pair) {
        const auto joint = static_cast<std::size_t>(pair.joint);
        const JointOrigin& origin = scenario_.joint_origins[joint];
        const bool has_own = origin.kind == JointOrigin::Kind::interface;
        places_.emplace(blocksOf(pair), entries_.size());
        entries_.push_back({pair, has_own ? std::optional(model_.joints[joint]) : std::nullopt, origin});
    }

    /// Faces, and pairs: those of entries come last and stand for all others of the same blocks.
    void renumber(const std::vector<std::int32_t>& moved) {
        for (Block& block : model_.blocks)
            for (std::int32_t& joint : block.face_joint) joint = moved[static_cast<std::size_t>(joint)];
        std::vector<PairJoint> pairs;
        for (PairJoint& pair : model_.pair_joints) {
            if (places_.count(blocksOf(pair)) > 0) continue;
            pair.joint = moved[static_cast<std::size_t>(pair.joint)];
            pairs.push_back(std::move(pair));
        }
        for (Entry& entry : entries_) pairs.push_back(std::move(entry.pair));
        model_.pair_joints = std::move(pairs);
    }

    Scenario& scenario_;
    Model& model_;
    std::vector<Entry> entries_;
    std::map<BlockPair, std::size_t> places_;
};

}  // namespace
}  // namespace scenario

bool canOverride(const Scenario& scenario, std::string_view field) {
    return scenario::targetOf(scenario, field).has_value();
}

bool applyOverride(Scenario& scenario, std::string_view field, double value) {
    const auto target = scenario::targetOf(scenario, field);
    if (!target || !target->allowed.contains(value) || !target->put(scenario, value)) return false;
    scenario::renewMixUp(scenario, std::string(field), value, target->mix_up);
    return true;
}

bool overridePairs(Scenario& scenario, const std::vector<PairOverride>& overrides) {
    for (const PairOverride& change : overrides) {
        const JointProperty& property = kJointProperties[change.property];
        const StrengthLaw law = scenario.model.joints[static_cast<std::size_t>(change.joint)].law;
        if (!property.laws.has(law) || !property.allowed.contains(change.value)) return false;
    }
    scenario::InterfaceEntries entries(scenario);
    for (const PairOverride& change : overrides) entries.set(change);
    entries.store();
    return true;
}

}  // namespace talus::formats
