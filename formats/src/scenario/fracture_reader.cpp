// [[fracture_set]]: discs drawn at random, or from a file.

#include "scenario/rock_mass.h"
#include "talus/formats/fractures.h"

namespace talus::formats::scenario {

namespace {

constexpr Interval kDipDeg{0, 90, false, false};
constexpr Interval kDipDirectionDeg{-360, 360, false, false};
constexpr Interval kFisher{0, 1e12, true, false};
constexpr std::int64_t kMostFractures = 1'000'000;
const std::vector<std::string> kDrawn{
    "dip_deg",         "dip_direction_deg", "fisher",     "radius_law", "radius", "radius_deviation",
    "radius_exponent", "radius_min",        "radius_max", "p32",        "count"};

/// Which keys go with which law.
void checkLaw(TableReader& table, RadiusLaw law) {
    const auto only = [&](const char* key, bool allowed, const char* with) {
        if (table.has(key) && !allowed)
            table.error(key, "found " + std::string(key) +
                                 " with another law, allowed: only with radius_law = \"" + with + "\"");
    };
    const bool power = law == RadiusLaw::power, lognormal = law == RadiusLaw::lognormal;
    only("radius_deviation", lognormal, "lognormal");
    only("radius_exponent", power, "power");
    only("radius_min", power || lognormal, "power");
    only("radius_max", power || lognormal, "power");
    only("radius", !power, "constant");
    if (power)
        table.require({"radius_exponent", "radius_min", "radius_max"});
    else
        table.require({"radius"});
    if (lognormal) table.require({"radius_deviation"});
}

FractureSet readDrawn(TableReader& table) {
    FractureSet set;
    table.require({"dip_deg", "dip_direction_deg"});
    table.requireOneOf({"p32", "count"});
    set.dip = table.number("dip_deg", kDipDeg).value_or(0) * kRadPerDeg;
    set.dip_direction = table.number("dip_direction_deg", kDipDirectionDeg).value_or(0) * kRadPerDeg;
    set.fisher = table.number("fisher", kFisher);
    set.law =
        static_cast<RadiusLaw>(table.choice("radius_law", {"constant", "lognormal", "power"}).value_or(0));
    checkLaw(table, set.law);
    set.radius = table.number("radius", kSize).value_or(1);
    set.deviation = table.number("radius_deviation", kSize).value_or(1);
    set.exponent = table.number("radius_exponent", {0, 100}).value_or(1);
    set.least = table.number("radius_min", kSize).value_or(0);
    set.most = table.number("radius_max", kSize).value_or(kMaxLength);
    set.p32 = table.number("p32", kPositive);
    if (const auto count = table.integer("count", {1, kMostFractures}))
        set.count = static_cast<std::size_t>(*count);
    return set;
}

void readFile(TableReader& table, const std::string& folder, FractureSetInput& input) {
    for (const std::string& key : table.present(kDrawn))
        table.error(key, "found " + key + " together with file, which already has it, allowed: one of them");
    const auto file = table.text("file");
    if (!file) return;
    auto discs = readFractures(file->starts_with('/') ? *file : folder + *file);
    if (discs) {
        input.from_file = std::move(*discs);
        return;
    }
    for (const Error& error : discs.errors()) table.error("file", format(error));
}

}  // namespace

void readFractureSets(Report& report, TableReader& root, const Joints& joints, const std::string& folder,
                      RockMassInput& input) {
    for (const FieldNode& entry : root.tables("fracture_set")) {
        std::vector<std::string> keys{"name", "joint", "file"};
        keys.insert(keys.end(), kDrawn.begin(), kDrawn.end());
        TableReader table(report, entry.node, entry.field, keys);
        FractureSetInput set;
        const std::string name = table.name("name", false).value_or("");
        if (table.has("file"))
            readFile(table, folder, set);
        else if (!table.isMeant("file"))
            set.drawn = readDrawn(table);
        set.drawn.name = name;
        set.drawn.field = entry.field;
        set.drawn.joint = readStrength(report, table, name, joints);
        set.is_file = table.has("file");
        input.fracture_sets.push_back(std::move(set));
    }
}

void appendFractures(Report& report, RockMassInput& input) {
    RockMass& rock = input.description;
    for (std::size_t i = 0; i < input.fracture_sets.size(); ++i) {
        FractureSetInput& set = input.fracture_sets[i];
        auto discs = set.is_file ? Result<std::vector<Fracture>>(std::move(set.from_file))
                                 : drawFractures(set.drawn, rock.region, rock.seed, i, rock.stop);
        if (!discs) {
            for (const Error& error : discs.errors())
                report.add(report.placeOf(error.field).value_or(input.place), error.field, error.message);
            continue;
        }
        for (const Fracture& disc : *discs) {
            SingleJoint joint;
            joint.name = set.drawn.name;
            joint.point = disc.centre;
            joint.dip = disc.dip;
            joint.dip_direction = disc.dip_direction;
            joint.radius = disc.radius;
            joint.joint = set.drawn.joint;
            joint.field = set.drawn.field;
            joint.of_network = true;
            rock.singles.push_back(std::move(joint));
        }
    }
}

}  // namespace talus::formats::scenario
