// [[fracture_set]]: discs drawn at random, from a table, or from the traces of a drawing.

#include "mesh/traces.h"
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

bool isDrawing(const std::string& file) { return file.ends_with(".dxf") || file.ends_with(".DXF"); }

/// Of traces that define no plane: both angles, or none.
std::optional<Orientation> readOrientation(TableReader& table) {
    if (!table.has("dip_deg") && !table.has("dip_direction_deg")) return std::nullopt;
    table.require({"dip_deg", "dip_direction_deg"});
    const auto dip = table.number("dip_deg", kDipDeg),
               direction = table.number("dip_direction_deg", kDipDirectionDeg);
    if (!dip || !direction) return std::nullopt;
    return Orientation{*dip * kRadPerDeg, *direction * kRadPerDeg};
}

void readDrawing(Report& report, TableReader& table, const std::string& path, const TraceOptions& options,
                 FractureSetInput& input) {
    auto traces = readTraces(path, options);
    if (traces) {
        input.from_file = std::move(traces->discs);
        for (const std::string& note : traces->notes) report.warn(table.fieldOf("file") + ": " + note);
        return;
    }
    for (const Error& error : traces.errors()) table.error("file", format(error));
}

void readFile(Report& report, TableReader& table, const std::string& folder, FractureSetInput& input) {
    const auto file = table.text("file");
    if (!file) return;
    const bool drawing = isDrawing(*file);
    for (const std::string& key : table.present(kDrawn))
        if (!drawing || (key != "dip_deg" && key != "dip_direction_deg"))
            table.error(key,
                        "found " + key + " together with file, which already has it, allowed: one of them");
    if (table.has("layer") && !drawing)
        table.error("layer", "found layer with a file that is no drawing, allowed: only with a .dxf file");
    const std::string path = file->starts_with('/') ? *file : folder + *file;
    const TraceOptions options{table.text("layer"), drawing ? readOrientation(table) : std::nullopt};
    if (drawing) return readDrawing(report, table, path, options, input);
    auto discs = readFractures(path);
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
        std::vector<std::string> keys{"name", "joint", "file", "layer"};
        keys.insert(keys.end(), kDrawn.begin(), kDrawn.end());
        TableReader table(report, entry.node, entry.field, keys);
        FractureSetInput set;
        const std::string name = table.name("name", false).value_or("");
        if (table.has("file"))
            readFile(report, table, folder, set);
        else if (!table.isMeant("file"))
            set.drawn = readDrawn(table);
        if (table.has("layer") && !table.has("file"))
            table.error("layer", "found layer without file, allowed: only with a .dxf file");
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
            joint.semi_minor = disc.semi_minor;
            joint.rake = disc.rake;
            if (disc.isEllipse()) joint.polygon = outlineOf(disc);
            joint.joint = set.drawn.joint;
            joint.field = set.drawn.field;
            joint.of_network = true;
            rock.singles.push_back(std::move(joint));
        }
    }
}

}  // namespace talus::formats::scenario
