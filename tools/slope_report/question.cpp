#include "slope_report/question.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "cli/failures.h"
#include "cli/input_hash.h"
#include "cli/text.h"
#include "slope_report/face.h"
#include "talus/formats/inputs.h"

namespace talus::tools {

namespace {

constexpr const char *kAngle = "critical-angle", *kFactor = "safety-factor",
                     *kAcceleration = "critical-acceleration";

/// Which search a key under [analysis] belongs to.
constexpr std::pair<const char*, const char*> kKeys[]{{"analysis.start_deg", kAngle},
                                                      {"analysis.stop_deg", kAngle},
                                                      {"analysis.tolerance_deg", kAngle},
                                                      {"analysis.factor_tolerance", kFactor},
                                                      {"analysis.acceleration_tolerance", kAcceleration}};

const LoadSearch* searchNamed(const std::string& name) {
    if (const LoadSearch* search = loadSearch(name)) return search;
    std::string names;
    for (const LoadSearch& search : loadSearches())
        names += (names.empty() ? "" : ", ") + std::string(search.name);
    throw BadInput(Error{"--analysis", "found \"" + name + "\", allowed: " + names});
}

/// The texts in quotes of a scenario, each once.
std::set<std::string> quoted(const std::string& text) {
    std::set<std::string> found;
    for (std::size_t begin = text.find_first_of("\"'\n"); begin != std::string::npos;
         begin = text.find_first_of("\"'\n", begin + 1)) {
        if (text[begin] == '\n') continue;
        const std::size_t end = text.find_first_of(std::string{text[begin], '\n'}, begin + 1);
        if (end == std::string::npos) break;
        if (text[end] != '\n') found.insert(text.substr(begin + 1, end - begin - 1));
        begin = end;
    }
    return found;
}

std::string contentOf(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

Chosen<const LoadSearch*> analysisOf(const formats::Scenario& scenario, const std::string& wish) {
    if (!wish.empty()) return {searchNamed(wish), "as asked for"};
    for (const auto& [key, search] : kKeys) {
        if (scenario.places.contains(key))
            return {loadSearch(search), "the scenario gives " + std::string(key)};
    }
    if (scenario.places.contains("gravity.tilt_deg"))
        return {loadSearch(kAngle), "the scenario gives gravity.tilt_deg"};
    return {loadSearch(kFactor), "the scenario names no other analysis"};
}

std::optional<Chosen<kinematics::Face>> netFace(const formats::Scenario& scenario, const std::string& wish) {
    if (wish.empty()) {
        const auto face = faceOf(scenario.model);
        if (!face) return std::nullopt;
        return Chosen<kinematics::Face>{*face, "mean of the model's outer faces that dip by " +
                                                   text(degrees(kLeastFaceDip), 0) +
                                                   " degrees or more, by area; --slope gives another"};
    }
    const auto [dip, direction] = anglesOf("--slope", wish, "DIP/DIPDIRECTION in degrees, such as 70/135");
    if (!(dip > 0 && dip <= 90) || !(std::abs(direction) <= 360)) {
        throw BadInput(Error{"--slope", "found " + wish +
                                            ", allowed: a dip greater than 0 and at most 90 degrees, and a "
                                            "dip direction of -360 to 360 degrees"});
    }
    return Chosen<kinematics::Face>{{radians(dip), radians(direction < 0 ? direction + 360 : direction)},
                                    "as given"};
}

Chosen<double> netFriction(const Model& model) {
    std::optional<Joint> least;
    for (const Joint& given : model.joints) {
        const Joint joint = strengthAt(given, 0);
        if (frictionAngle(joint) > 0 && (!least || frictionAngle(joint) < frictionAngle(*least)))
            least = joint;
    }
    if (!least) return {0, "no joint has friction"};
    return {frictionAngle(*least), "the least of the joints that have friction, that of " + least->name};
}

std::vector<std::pair<std::string, std::string>> inputDigests(const formats::Scenario& scenario) {
    namespace fs = std::filesystem;
    std::vector<std::pair<std::string, std::string>> digests{
        {fs::path(scenario.path).filename().string(), xxh128(scenario.text)}};
    const fs::path folder = fs::path(scenario.path).parent_path();
    for (const std::string& name : quoted(scenario.text)) {
        const fs::path path = folder / name;
        if (!name.empty() && formats::isInput(path.string()) &&
            path.lexically_normal() != fs::path(scenario.path).lexically_normal())
            digests.emplace_back(name, xxh128(contentOf(path)));
    }
    return digests;
}

}  // namespace talus::tools
