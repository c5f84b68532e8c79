#include "talus/formats/failing.h"

#include <cmath>
#include <sstream>

#include "scenario/reading.h"
#include "toml/document.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace scenario {
namespace {

using Path = std::vector<PathPart>;

double inDegrees(double radians) { return radians / kRadPerDeg; }

double numberOf(const Node& node) {
    return node.kind() == Kind::integer ? static_cast<double>(node.integer()) : node.real();
}

Path below(Path path, PathPart part) {
    path.push_back(std::move(part));
    return path;
}

/// Calls visit(path, node) for the element or for each element of an array, or of arrays in arrays.
template <class Visit>
void eachNumber(const Node& node, const Path& path, const Visit& visit) {
    if (node.kind() == Kind::integer || node.kind() == Kind::real) return visit(path, numberOf(node));
    if (node.kind() != Kind::array) return;
    for (std::size_t i = 0; i < node.size(); ++i) eachNumber(node.at(i), below(path, i), visit);
}

class Editor {
 public:
    Editor(Document& document, const Scenario& scenario) : document_(document), scenario_(scenario) {}

    void apply(const FailingLoad& load) {
        if (load.tilt) setTilt(*load.tilt);
        if (load.factor != 1) divideStrengths(load.factor);
        set({"run", "duration_s"}, load.duration);
        set({"run", "frame_interval_s"}, load.frame_interval);
        document_.erase({"run", "time_step_s"});
        for (const char* key : {"mass", "rotation", "local"}) document_.erase({"damping", key});
        set({"damping", "contact"}, load.contact_damping);
        stopWaters();
    }

    std::optional<Error> takeFault() { return std::move(fault_); }

 private:
    void set(const Path& path, double value) {
        if (const auto wrong = document_.set(path, value); wrong && !fault_) fault_ = Error{"", *wrong};
    }

    /// A search of this scenario starts and ends where it did.
    void setTilt(double tilt) {
        const Model& model = scenario_.model;
        set({"analysis", "start_deg"}, inDegrees(model.analysis.start.value_or(model.gravity.tilt)));
        set({"analysis", "stop_deg"}, inDegrees(model.analysis.stop));
        set({"gravity", "tilt_deg"}, inDegrees(tilt));
    }

    void divideStrengths(double factor) {
        const Node root = document_.root();
        if (const auto joints = root.find("joint"))
            for (const Entry& joint : joints->entries())
                divideStrengths(joint.value, {"joint", joint.key}, factor);
        eachTable(root, "interface",
                  [&](const Node& table, const Path& path) { divideStrengths(table, path, factor); });
        eachTable(root, "stack", [&](const Node& table, const Path& path) {
            divideAngles(table, path, "bed_friction_deg", factor);
        });
    }

    void divideStrengths(const Node& table, const Path& path, double factor) {
        for (const char* key : {"friction_deg", "residual_friction_deg"})
            divideAngles(table, path, key, factor);
        for (const char* key : {"cohesion", "residual_cohesion"})
            if (const auto node = table.find(key)) set(below(path, key), numberOf(*node) / factor);
    }

    void divideAngles(const Node& table, const Path& path, const std::string& key, double factor) {
        const auto node = table.find(key);
        if (!node) return;
        std::vector<std::pair<Path, double>> angles;  // writing replaces the nodes that are read here
        eachNumber(*node, below(path, key), [&](const Path& place, double angle_deg) {
            angles.emplace_back(place, inDegrees(std::atan(std::tan(angle_deg * kRadPerDeg) / factor)));
        });
        for (const auto& [place, angle_deg] : angles) set(place, angle_deg);
    }

    /// In a search water stands as at time 0.
    void stopWaters() {
        const std::size_t waters = scenario_.model.waters.size();
        eachTable(document_.root(), "water", [&](const Node& table, const Path& path) {
            const auto index = std::get<std::size_t>(path.back());
            if (!table.find("levels") || index >= waters) return;
            const double level = scenario_.model.waters[index].level.front().value;
            for (std::size_t k = 0; k < table.find("levels")->size(); ++k)
                set(below(below(below(path, "levels"), k), std::size_t{1}), level);
        });
    }

    template <class Visit>
    static void eachTable(const Node& root, const std::string& key, const Visit& visit) {
        const auto array = root.find(key);
        if (!array || array->kind() != Kind::array) return;
        for (std::size_t i = 0; i < array->size(); ++i) visit(array->at(i), Path{key, i});
    }

    Document& document_;
    const Scenario& scenario_;
    std::optional<Error> fault_;
};

std::string asComments(const std::string& text) {
    std::istringstream lines(text);
    std::string comments;
    for (std::string line; std::getline(lines, line);) comments += "# " + line + "\n";
    return comments;
}

}  // namespace
}  // namespace scenario

Result<Scenario> failingScenario(const Scenario& scenario, const FailingLoad& load,
                                 const std::string& remark) {
    auto document = toml::Document::parse(scenario.text, scenario.path);
    if (!document) return document.errors();
    scenario::Editor editor(*document, scenario);
    editor.apply(load);
    if (auto fault = editor.takeFault()) return *fault;
    return parseScenario(scenario::asComments(remark) + toml::writeDocument(*document), scenario.path);
}

}  // namespace talus::formats
