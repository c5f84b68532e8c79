#include <algorithm>

#include "scenario/rock_mass.h"

namespace talus::formats::scenario {

namespace {

constexpr Interval kDipDeg{0, 90, false, false};
constexpr Interval kDipDirectionDeg{-360, 360, false, false};
constexpr Interval kFisher{0, 1e12, true, false};
constexpr Interval kSpread{0, 1, false, true};
constexpr std::size_t kMaxProfile = 1000;
constexpr std::int64_t kMostBlocksOfRock = 100'000'000;  // parts of blocks are counted in 32 bits
constexpr std::int64_t kMaxSeed = INT64_MAX;
const std::vector<std::string> kSides = {"below", "above", "touching"};
const std::vector<std::string> kBoundaries = {"-x", "+x", "-y", "+y", "-z", "+z"};

class RockMassReader {
 public:
    RockMassReader(Report& report, const Materials& materials, const Joints& joints,
                   const std::string& folder)
        : report_(report), materials_(materials), joints_(joints), folder_(folder) {}

    RockMassInput read(TableReader& root) {
        TableReader table =
            *root.table("rock_mass", {"name", "region", "material", "joint", "min_thickness", "slivers",
                                      "seed", "fixed", "names", "max_blocks", "bridge"});
        table.require({"region"});
        input_.place = table.place();
        input_.description.field = table.field();
        readBounds(table);
        readProperties(table);
        for (const FieldNode& entry : root.tables("joint_set")) readSet(entry);
        for (const FieldNode& entry : root.tables("single_joint")) readSingle(entry);
        resolveEndingSets(report_, input_);
        readFractureSets(report_, root, joints_, folder_, input_);
        readBridge(table);
        for (const FieldNode& entry : table.tables("fixed")) readFixed(entry);
        readNames(table);
        return std::move(input_);
    }

 private:
    void readProperties(TableReader& table) {
        RockMass& rock = input_.description;
        input_.prefix = table.name("name", true).value_or("");
        if (const auto material = readMaterial(report_, table, materials_)) {
            input_.material = *material;
            input_.density = materials_.densities[static_cast<std::size_t>(*material)];
        }
        input_.joint = readJoint(report_, table, "joint", joints_).value_or(0);
        rock.min_thickness = table.number("min_thickness", kLength);
        rock.refuse_slivers = table.choice("slivers", {"merge", "refuse"}).value_or(0) == 1;
        if (const auto most = table.integer("max_blocks", {1, kMostBlocksOfRock}))
            input_.max_blocks = static_cast<std::size_t>(*most);
        rock.seed = static_cast<std::uint64_t>(table.integer("seed", {0, kMaxSeed}).value_or(1));
    }

    void readBounds(TableReader& table) {
        if (auto region = readRegion(report_, table, folder_)) {
            input_.description.region = std::move(region->surface);
            input_.has_mesh = region->is_mesh;
            input_.turn = region->turn;
        }
        auto& vertices = input_.description.region.vertices;
        if (vertices.empty()) return;
        Vec3 low = vertices[0], high = low;
        for (const Vec3& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
        input_.low = low;
        input_.high = high;
        if (!input_.turn.isTurned()) return;
        for (Vec3& v : vertices) v = input_.turn(v);
        report_.warn(table.fieldOf("region") +
                     ".slope_azimuth_deg: the profile is turned about the vertical through the origin; "
                     "gravity.tilt_deg and critical-angle still tilt towards -x (270 degrees)");
    }

    // --- joints
    // -------------------------------------------------------------------------------------------------

    /// The joint's name, for water and selections.
    std::string readName(TableReader& table, std::size_t joint) {
        const std::string name = table.name("name", false).value_or("");
        if (name.empty()) return name;
        if (input_.joint_names.find(name))
            table.error("name",
                        "found the name " + quoted(name) + " of another joint, allowed: a name of its own");
        input_.joint_names.add(name);
        input_.joint_of_name.push_back(joint);
        return name;
    }

    void readSet(const FieldNode& entry) {
        TableReader table(report_, entry.node, entry.field,
                          {"name", "dip_deg", "dip_direction_deg", "spacing", "origin", "offset",
                           "spacing_law", "spacing_spread", "fisher", "joint", "ends_at"});
        table.require({"dip_deg", "dip_direction_deg", "spacing"});
        JointSet set;
        set.field = entry.field;
        const auto other = table.text("ends_at");
        set.name =
            other ? table.name("name", false).value_or("") : readName(table, input_.description.sets.size());
        set.dip = table.number("dip_deg", kDipDeg).value_or(0) * kRadPerDeg;
        set.dip_direction = table.number("dip_direction_deg", kDipDirectionDeg).value_or(0) * kRadPerDeg;
        set.spacing = table.number("spacing", kSize).value_or(1);
        set.origin = table.vector("origin", kCoordinate).value_or(input_.turn(input_.low));
        set.offset = table.number("offset", kCoordinate).value_or(0);
        set.law = static_cast<SpacingLaw>(
            table.choice("spacing_law", {"constant", "uniform", "exponential"}).value_or(0));
        set.spread =
            table.number("spacing_spread", kSpread).value_or(set.law == SpacingLaw::uniform ? 0.5 : 0);
        if (table.has("spacing_spread") && set.law != SpacingLaw::uniform)
            table.error("spacing_spread",
                        "found a spread without a uniform law, allowed: only with spacing_law = \"uniform\"");
        set.fisher = table.number("fisher", kFisher);
        set.joint = readStrength(report_, table, set.name, joints_);
        if (!other) return input_.description.sets.push_back(std::move(set));
        for (const std::string& key : table.present({"origin", "offset"})) {
            table.error(key, "found " + key +
                                 " beside ends_at, by which the set begins anew between each two planes, "
                                 "allowed: one of them");
        }
        input_.ending_sets.push_back({{std::move(set)}, *other, table.placeOf("ends_at")});
    }

    void readSingle(const FieldNode& entry) {
        TableReader table(report_, entry.node, entry.field,
                          {"name", "point", "dip_deg", "dip_direction_deg", "radius", "polygon", "joint"});
        SingleJoint joint;
        joint.field = entry.field;
        joint.name = readName(table, input_.description.sets.size() + input_.description.singles.size());
        if (table.has("polygon")) {
            for (const char* key : {"point", "dip_deg", "dip_direction_deg", "radius"})
                if (table.has(key))
                    table.error(key,
                                "found " + std::string(key) +
                                    " together with polygon, which already gives it, allowed: one of them");
            joint.polygon = readPolygon(table);
        } else if (!table.isMeant("polygon")) {
            table.require({"point", "dip_deg", "dip_direction_deg"});
            joint.point = table.vector("point", kCoordinate).value_or(Vec3::Zero());
            joint.dip = table.number("dip_deg", kDipDeg).value_or(0) * kRadPerDeg;
            joint.dip_direction =
                table.number("dip_direction_deg", kDipDirectionDeg).value_or(0) * kRadPerDeg;
            joint.radius = table.number("radius", kSize);
        }
        joint.joint = readStrength(report_, table, joint.name, joints_);
        input_.description.singles.push_back(std::move(joint));
    }

    std::vector<Vec3> readPolygon(TableReader& table) {
        std::vector<Vec3> corners;
        const auto array = table.array("polygon");
        if (!array) return corners;
        if (array->size() < 3 || array->size() > kMaxProfile)
            table.error("polygon", "found " + std::to_string(array->size()) + " corners, allowed: 3 to " +
                                       std::to_string(kMaxProfile));
        for (std::size_t i = 0; i < std::min(array->size(), kMaxProfile); ++i) {
            const std::string field = elementField(table.fieldOf("polygon"), i);
            report_.mark(field, array->at(i).place());
            if (const auto corner = readVector(report_, array->at(i), field, kCoordinate))
                corners.push_back(*corner);
        }
        return corners;
    }

    std::optional<std::string> whyNotMixed(std::int32_t joint, std::int32_t rock) const {
        const auto index = static_cast<std::size_t>(joint), other = static_cast<std::size_t>(rock);
        if (std::max(index, other) >= joints_.all().size()) return std::nullopt;
        const Joint &one = joints_.all()[index], &of_rock = joints_.all()[other];
        if (one.law != StrengthLaw::coulomb)
            return quoted(one.name) + " of law " + quoted(toString(one.law)) +
                   ", allowed with bridges: finite joints and rock of law \"coulomb\"";
        if (one.wet_strength_factor != 1)
            return quoted(one.name) + " with a wet_strength_factor of " +
                   numberText(one.wet_strength_factor) +
                   ", allowed with bridges: 1 for finite joints and rock";
        if (one.strength_over_time != of_rock.strength_over_time)
            return quoted(one.name) + " with another strength_over_time than " + quoted(of_rock.name) +
                   ", allowed with bridges: the same for finite joints and rock, or none";
        return std::nullopt;
    }

    /// Where a joint ends within a face, rock and joint are mixed by their areas: only Coulomb's law is in
    /// proportion to them, and the mixture has one factor over time.
    void readBridge(TableReader& table) {
        if (!table.has("bridge")) return;
        input_.bridge = readJoint(report_, table, "bridge", joints_);
        if (!input_.bridge) return;
        std::vector<std::int32_t> mixed{*input_.bridge};
        for (const SingleJoint& joint : input_.description.singles)
            if (joint.radius || !joint.polygon.empty()) mixed.push_back(joint.joint);
        for (const FractureSetInput& set : input_.fracture_sets) mixed.push_back(set.drawn.joint);
        for (const std::int32_t joint : mixed) {
            if (const auto why = whyNotMixed(joint, *input_.bridge))
                return table.error("bridge", "found the joint " + *why);
        }
    }

    // --- which blocks
    // -------------------------------------------------------------------------------------------

    void readFixed(const FieldNode& entry) {
        TableReader table(report_, entry.node, entry.field,
                          {"box", "plane", "joint", "boundary", "name", "side"});
        FixedEntry fixed{entry.field, table.place(), std::nullopt, "", table.placeOf("name")};
        if (!table.requireOneOf({"box", "plane", "joint", "boundary", "name"})) return;
        const bool has_side = table.has("plane") || table.has("joint");
        if (table.has("side") && !has_side)
            table.error("side", "found side without plane or joint, allowed: only together with one of them");
        const auto side = table.choice("side", kSides).value_or(0);
        BlockSelection selection;
        selection.kind = static_cast<BlockSelection::Kind>(side + 1);
        bool known = true;
        if (table.has("box")) known = readSelectionBox(table, selection);
        if (table.has("plane")) known = readSelectionPlane(table, selection);
        if (table.has("joint")) known = readSelectionJoint(table, selection);
        if (table.has("boundary")) known = readSelectionBoundary(table, selection);
        if (table.has("name"))
            fixed.name = table.name("name", false).value_or("");
        else if (known)
            fixed.by_place = selection;
        input_.fixed.push_back(std::move(fixed));
    }

    static bool readSelectionBox(TableReader& table, BlockSelection& selection) {
        selection.kind = BlockSelection::Kind::box;
        auto box = table.table("box", {"min", "max"});
        if (!box) return false;
        box->require({"min", "max"});
        const auto min = box->vector("min", kCoordinate), max = box->vector("max", kCoordinate);
        if (!min || !max) return false;
        selection.min = *min;
        selection.max = *max;
        return true;
    }

    static bool readSelectionPlane(TableReader& table, BlockSelection& selection) {
        auto plane = table.table("plane", {"point", "dip_deg", "dip_direction_deg"});
        if (!plane) return false;
        plane->require({"point", "dip_deg", "dip_direction_deg"});
        const auto point = plane->vector("point", kCoordinate);
        const auto dip = plane->number("dip_deg", kDipDeg),
                   direction = plane->number("dip_direction_deg", kDipDirectionDeg);
        if (!point || !dip || !direction) return false;
        selection.point = *point;
        selection.upward_normal = upwardNormal(*dip * kRadPerDeg, *direction * kRadPerDeg);
        return true;
    }

    bool readSelectionJoint(TableReader& table, BlockSelection& selection) {
        const auto name = table.text("joint");
        if (!name) return false;
        const RockMass& rock = input_.description;
        if (input_.joint_names.empty()) {
            table.error("joint", "found " + quoted(*name) +
                                     ", but no joint has a name, allowed: the name of a single joint");
            return false;
        }
        const auto index =
            input_.joint_names.resolve(report_, table.placeOf("joint"), table.fieldOf("joint"), *name);
        if (!index) return false;
        const std::size_t joint = input_.joint_of_name[static_cast<std::size_t>(*index)];
        if (joint < rock.sets.size()) {
            table.error("joint",
                        "found the joint set " + quoted(*name) + ", allowed: a single joint, or a plane");
            return false;
        }
        const SingleJoint& single = rock.singles[joint - rock.sets.size()];
        selection.point = single.point;
        selection.upward_normal = upwardNormal(single.dip, single.dip_direction);
        if (single.polygon.size() >= 3) {
            selection.point = single.polygon[0];
            const Vec3 normal =
                (single.polygon[1] - single.polygon[0]).cross(single.polygon[2] - single.polygon[0]);
            selection.upward_normal = (normal.z() < 0 ? -1 : 1) * normal.normalized();
        }
        return true;
    }

    bool readSelectionBoundary(TableReader& table, BlockSelection& selection) {
        const auto boundary = table.choice("boundary", kBoundaries);
        if (!boundary) return false;
        selection.kind = BlockSelection::Kind::touching;
        selection.point = input_.turn(*boundary % 2 == 0 ? input_.low : input_.high);
        selection.upward_normal = input_.turn(Vec3::Unit(static_cast<Eigen::Index>(*boundary / 2)));
        return true;
    }

    void readNames(TableReader& table) {
        ask(report_, table.fieldOf("names"), [] { return Asked{.kind = Asked::Kind::named_values}; });
        const auto node = table.find("names");
        if (!node) return;
        if (node->kind() != Kind::table)
            return reportFound(report_, *node, table.fieldOf("names"),
                               "a table: names = { key = [x, y, z] }");
        for (const Entry& entry : node->entries()) {
            PointName name{entry.key, joinField(table.fieldOf("names"), entry.key), entry.place};
            if (const auto point = readVector(report_, entry.value, name.field, kCoordinate))
                name.point = *point;
            input_.names.push_back(std::move(name));
        }
    }

    Report& report_;
    const Materials& materials_;
    const Joints& joints_;
    std::string folder_;
    RockMassInput input_;
};

}  // namespace

std::int32_t readStrength(Report& report, TableReader& table, const std::string& name, const Joints& joints) {
    if (!table.has("joint"))
        if (const auto own = joints.names.find(name)) return *own;
    return readJoint(report, table, "joint", joints).value_or(0);
}

std::optional<RockMassInput> readRockMass(Report& report, TableReader& root, const Materials& materials,
                                          const Joints& joints, const std::string& folder) {
    const auto node = root.find("rock_mass");
    if (!node) {
        for (const char* key : {"joint_set", "single_joint", "fracture_set"})
            if (root.has(key) && !root.isMeant("rock_mass"))
                root.error(key, "found " + std::string(key) +
                                    " without [rock_mass], allowed: together with a region to cut");
        return std::nullopt;
    }
    if (node->kind() != Kind::table) {
        reportFound(report, *node, "rock_mass", "a table that begins with [rock_mass]");
        return std::nullopt;
    }
    return RockMassReader(report, materials, joints, folder).read(root);
}

}  // namespace talus::formats::scenario
