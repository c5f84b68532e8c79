#pragma once
// Materials and joints: what other tables refer to by name.

#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scenario/reading.h"
#include "talus/formats/scenario.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// The joint of everything that names none.
inline constexpr const char* kDefaultJoint = "default";

/// Names in the order of the file, with their indices.
class NameList {
 public:
    explicit NameList(std::string what) : what_(std::move(what)) {}

    void add(const std::string& name);
    bool empty() const { return names_.empty(); }
    std::size_t size() const { return names_.size(); }
    const std::vector<std::string>& all() const { return names_; }

    std::optional<std::int32_t> find(const std::string& name) const;
    std::string list() const;  ///< for messages

    /// Index of a name a user wrote; an unknown one is reported.
    std::optional<std::int32_t> resolve(Report& report, Place place, const std::string& field,
                                        const std::string& name) const;

 private:
    std::string what_;  ///< "material", "joint"
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::int32_t> indices_;
};

struct Materials {
    NameList names{"material"};
    std::vector<double> densities;  ///< [kg/m^3]
};

/// The joints of the file, and those derived from them for bed levels and interfaces of their own.
class Joints {
 public:
    NameList names{"joint"};

    void add(Joint joint, JointProperties given);
    const std::vector<Joint>& all() const { return joints_; }
    const std::vector<JointOrigin>& origins() const { return origins_; }

    /// The joint like `base` with another friction angle, named like "default@18.5deg"; `base` itself when it
    /// is the same angle. The residual angle follows unless the file gave one.
    std::int32_t withFriction(std::int32_t base, double friction_deg);

    /// The joint between two faces of which a share, to a thousandth, is intact rock: friction (by its
    /// tangent), cohesion, tensile strength and stiffness in proportion to the areas (J. E. Jennings, 1970).
    /// \pre both follow Coulomb's law, and their strengths change alike over time
    std::int32_t withBridge(std::int32_t base, std::int32_t rock, double share);

    /// The joint like `base` but for the properties given in `table`, for one interface; `base` itself when
    /// there are none. `field` names the new joint.
    std::int32_t withOverrides(std::int32_t base, TableReader& table, const std::string& field);

 private:
    std::int32_t derive(std::int32_t base, JointOrigin::Kind kind, JointProperties given, Joint joint);

    std::vector<Joint> joints_;
    std::vector<JointOrigin> origins_;
    std::map<std::pair<std::int32_t, double>, std::int32_t> bed_levels_;
    std::map<std::pair<std::int32_t, long>, std::int32_t> bridges_;
};

/// Warnings that a joint of the file gets stronger as it slips, by the field of its residual strength.
std::vector<std::string> hardeningOf(const Joint& joint);

/// Keys of a joint's properties.
const std::vector<std::string>& jointKeys();

/// Fills in what is not given: the base's value, or that of the property it follows, unless the base was
/// given one.
void inherit(Joint& joint, JointProperties given, const Joint& base, JointProperties base_given);

Materials readMaterials(Report& report, TableReader& root);
Joints readJoints(Report& report, TableReader& root);

/// The material a table names under "material"; the only one there is when it names none.
std::optional<std::int32_t> readMaterial(Report& report, TableReader& table, const Materials& materials);

/// The joint a table names under `key`, "default" when it names none.
std::optional<std::int32_t> readJoint(Report& report, TableReader& table, std::string_view key,
                                      const Joints& joints);

}  // namespace talus::formats::scenario
