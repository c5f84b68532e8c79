#include "talus/formats/failing.h"

#include <cmath>
#include <sstream>

#include "scenario/reading.h"
#include "talus/searches.h"
#include "toml/document.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace scenario {
namespace {

using Path = std::vector<PathPart>;

Path below(Path path, PathPart part) {
    path.push_back(std::move(part));
    return path;
}

/// Calls visit(path, node) for the element or for each element of an array, or of arrays in arrays.
template <class Visit>
void eachNumber(const Node& node, const Path& path, const Visit& visit) {
    if (node.isNumber()) return visit(path, node.number());
    if (node.kind() != Kind::array) return;
    for (std::size_t i = 0; i < node.size(); ++i) eachNumber(node.at(i), below(path, i), visit);
}

/// Writes into the text what a search changes in the model.
class Editor {
 public:
    Editor(Document& document, const Scenario& scenario) : document_(document), scenario_(scenario) {}

    void apply(const FailingLoad& load) {
        setVaried(load);
        set({"run", "duration_s"}, load.duration);
        set({"run", "frame_interval_s"}, load.frame_interval);
        document_.erase({"run", "time_step_s"});
        for (const char* key : {"mass", "rotation", "local"}) document_.erase({"damping", key});
        set({"damping", "contact"}, load.contact_damping);
        eraseRestitution();
        for (const char* key : {"levels", "elevations"})
            stop(
                "water", key, [](const Water& water) { return water.level.front().value; },
                scenario_.model.waters);
        stop(
            "load", "factor", [](const AppliedLoad& load) { return load.factor.front().value; },
            scenario_.model.loads);
        stopStrengths();
    }

    std::optional<Error> takeFault() { return std::move(fault_); }

 private:
    void set(const Path& path, double value) {
        if (const auto wrong = document_.set(path, value); wrong && !fault_) fault_ = Error{"", *wrong};
    }

    /// A search has none.
    void eraseRestitution() {
        const std::string key(propertyOf(&Joint::restitution_normal).key);
        const Node root = document_.root();
        std::vector<Path> places;
        if (const auto joints = root.find("joint"))
            for (const Entry& joint : joints->entries()) places.push_back({"joint", joint.key, key});
        eachTable(root, "interface",
                  [&](const Node&, const Path& path) { places.push_back(below(path, key)); });
        for (const Path& place : places) document_.erase(place);
    }

    void setVaried(const FailingLoad& load) {
        const VariedQuantity& quantity = quantityOf(load.varied);
        if (quantity.divides_strengths && load.value != 1) divideStrengths(load.value);
        Model model = scenario_.model;
        putUnderLoad(model, load.varied, load.value);
        for (const ScenarioNumber& number : quantity.written) {
            const auto value = number.value(model);
            const Path path{number.section, number.key};
            if (value)
                set(number.element < 0 ? path : below(path, static_cast<std::size_t>(number.element)),
                    *value);
        }
    }

    void divideStrengths(double factor) {
        const Node root = document_.root();
        if (const auto joints = root.find("joint"))
            for (const Entry& joint : joints->entries())
                divideStrengths(joint.value, {"joint", joint.key}, lawOf(joint.value), factor);
        eachTable(root, "interface", [&](const Node& table, const Path& path) {
            divideStrengths(table, path, lawOfEntry(root, table), factor);
        });
        eachTable(root, "stack", [&](const Node& table, const Path& path) {
            divide(table, path, propertyOf(&Joint::friction), StrengthLaw::coulomb, "bed_friction_deg",
                   factor);
        });
    }

    /// What is not given and not zero either is written out.
    void divideStrengths(const Node& table, const Path& path, StrengthLaw law, double factor) {
        for (const JointProperty& property : kJointProperties) {
            if (!isReduced(jointOf(law), property)) continue;
            const bool of_joint = path.front() == PathPart(std::string("joint"));
            if (of_joint && !table.find(property.key) && property.same_as == nullptr &&
                Joint{}.*property.value != 0)
                set(below(path, std::string(property.key)),
                    Joint{}.*property.value / property.toSi() / factor);
            else
                divide(table, path, property, law, std::string(property.key), factor);
        }
    }

    Joint jointOf(StrengthLaw law) const {
        Joint joint;
        joint.law = law;
        joint.tension_reduced = scenario_.model.analysis.reduce_tensile_strength;
        return joint;
    }

    /// Of a joint's table. The scenario has been read, so that there is no other law.
    static StrengthLaw lawOf(const Node& joint) {
        const auto name = joint.find("law");
        for (std::size_t k = 0; name && k < kStrengthLawNames.size(); ++k)
            if (name->text() == kStrengthLawNames[k]) return static_cast<StrengthLaw>(k);
        return StrengthLaw::coulomb;
    }

    /// Of the joint that an entry for two blocks names.
    static StrengthLaw lawOfEntry(const Node& root, const Node& entry) {
        const auto joints = root.find("joint"), name = entry.find("joint");
        const auto joint = joints && name ? joints->find(name->text()) : std::nullopt;
        return joint ? lawOf(*joint) : StrengthLaw::coulomb;
    }

    void divide(const Node& table, const Path& path, const JointProperty& property, StrengthLaw law,
                const std::string& key, double factor) {
        change(table, path, key, [&](double value) {
            Joint joint = jointOf(law);
            joint.*property.value = value * property.toSi();
            return reduced(joint, factor).*property.value / property.toSi();
        });
    }

    /// One number, or all of an array's.
    template <class Changed>
    void change(const Node& table, const Path& path, const std::string& key, const Changed& changed) {
        const auto node = table.find(key);
        if (!node) return;
        std::vector<std::pair<Path, double>> values;  // writing replaces the nodes that are read here
        eachNumber(*node, below(path, key),
                   [&](const Path& place, double value) { values.emplace_back(place, changed(value)); });
        for (const auto& [place, value] : values) set(place, value);
    }

    void stopStrengths() {
        constexpr const char* kKey = "strength_over_time";
        const auto joints = document_.root().find("joint");
        if (!joints) return;
        std::vector<std::pair<Path, double>> values;  // writing replaces the nodes that are read here
        for (const Entry& joint : joints->entries()) {
            const auto table = joint.value.find(kKey);
            for (std::size_t k = 0; table && k < table->size(); ++k)
                values.emplace_back(Path{"joint", joint.key, kKey, k, std::size_t{1}},
                                    table->at(0).at(1).number());
        }
        for (const auto& [place, value] : values) set(place, value);
    }

    /// In a search waters stand, loads push and joints hold as at time 0.
    template <class First, class Owners>
    void stop(const char* section, const char* key, const First& first, const Owners& owners) {
        eachTable(document_.root(), section, [&](const Node& table, const Path& path) {
            const auto index = std::get<std::size_t>(path.back());
            if (!table.find(key) || index >= owners.size()) return;
            for (std::size_t k = 0; k < table.find(key)->size(); ++k)
                set(below(below(below(path, key), k), std::size_t{1}), first(owners[index]));
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

Model failingModel(Model model, const FailingLoad& load) {
    putUnderLoad(model, load.varied, load.value);
    model.run.duration = load.duration;
    model.run.frame_interval = load.frame_interval;
    model.run.time_step.reset();
    model.damping = {};
    model.damping.contact = load.contact_damping;
    for (Joint& joint : model.joints) joint.restitution_normal = 1;
    for (Water& water : model.waters)
        for (LevelPoint& point : water.level) point.value = water.level.front().value;
    for (AppliedLoad& load : model.loads)
        for (LevelPoint& point : load.factor) point.value = load.factor.front().value;
    for (Joint& joint : model.joints)
        for (LevelPoint& point : joint.strength_over_time)
            point.value = joint.strength_over_time.front().value;
    return model;
}

Result<Scenario> failingScenario(const Scenario& scenario, const FailingLoad& load,
                                 const std::string& remark) {
    auto document = toml::Document::parse(scenario.text, scenario.path);
    if (!document) return document.errors();
    scenario::Editor editor(*document, scenario);
    editor.apply(load);
    if (auto fault = editor.takeFault()) return *fault;
    auto failing =
        parseScenario(scenario::asComments(remark) + toml::writeDocument(*document), scenario.path);
    if (failing) failing->model = failingModel(scenario.model, load);
    return failing;
}

}  // namespace talus::formats
