// The planes that cut a scenario's rock mass, and its region: its tables are read once more, nothing is cut.

#include "scenario/read_document.h"
#include "scenario/rock_mass.h"
#include "talus/formats/fractures.h"
#include "talus/formats/rock_region.h"

namespace talus::formats {

namespace {

using namespace scenario;

RockJoint jointOf(const RockMass& rock, const CutPlane& plane) {
    RockJoint joint;
    joint.normal = plane.normal;
    if (plane.joint < rock.sets.size()) {
        const JointSet& set = rock.sets[plane.joint];
        joint.set = set.name.empty() ? set.field : set.name;
        return joint;
    }
    const SingleJoint& single = rock.singles[plane.joint - rock.sets.size()];
    joint.set = !single.name.empty() ? single.name : single.of_network ? single.field : "single joints";
    if (single.of_network && single.radius) {
        joint.disc = {single.point,   single.dip,        single.dip_direction,
                      *single.radius, single.semi_minor, single.rake};
        joint.area_inside = areaInside(*joint.disc, rock.region);
    }
    return joint;
}

/// Nothing without a rock mass, or where a fault is reported.
std::optional<RockMassInput> readTables(Report& report, const Document& document, const std::string& path) {
    TableReader root(report, document.root(), "", scenarioSections());
    const Materials materials = readMaterials(report, root);
    const Joints joints = readJoints(report, root);
    const auto slash = path.rfind('/');
    return readRockMass(report, root, materials, joints,
                        slash == std::string::npos ? "" : path.substr(0, slash + 1));
}

}  // namespace

Result<std::vector<RockJoint>> rockJoints(const Scenario& scenario) {
    const auto document = toml::Document::parse(scenario.text, scenario.path);
    if (!document) return document.errors();
    Report report(scenario.path);
    auto rock = readTables(report, *document, scenario.path);
    if (rock && report.clean()) appendEndingSets(report, *rock);
    if (rock && report.clean()) appendFractures(report, *rock);
    if (!report.clean()) return report.errors();
    std::vector<RockJoint> all;
    if (!rock) return all;
    const auto planes = cuttingPlanes(rock->description);
    if (!planes) return planes.errors();
    for (const CutPlane& plane : *planes) all.push_back(jointOf(rock->description, plane));
    return all;
}

Result<std::optional<TriangleSurface>> rockRegion(const std::string& text, const std::string& path) {
    const auto document = toml::Document::parse(text, path);
    if (!document) return document.errors();
    Report report(path);
    auto rock = readTables(report, *document, path);
    if (!report.clean()) return report.errors();
    if (!rock) return std::optional<TriangleSurface>();
    return std::optional(std::move(rock->description.region));
}

}  // namespace talus::formats
