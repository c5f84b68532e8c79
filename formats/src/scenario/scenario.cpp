// Scenario files: the order of reading. First every table is read and checked, then, if nothing is wrong, the
// model is built, then what needs the built blocks is checked.

#include "talus/formats/scenario.h"

#include "scenario/directory.h"
#include "scenario/fields.h"
#include "scenario/flow.h"
#include "scenario/force_sections.h"
#include "scenario/interface.h"
#include "scenario/placed_block.h"
#include "scenario/properties.h"
#include "scenario/read_document.h"
#include "scenario/rock_mass.h"
#include "scenario/settings.h"
#include "scenario/stack.h"
#include "scenario/unnamed.h"
#include "scenario/water.h"
#include "toml/document.h"
#include "toml/file_text.h"

namespace talus::formats {

namespace scenario {
namespace {

constexpr Place kFileStart{1, 1};

class ScenarioReader {
 public:
    /// \param folder  where mesh files are looked for: "" or with a slash at its end
    ScenarioReader(Report& report, Node root, std::string folder, std::int64_t most_blocks,
                   const std::atomic<bool>* stop, const std::function<void(const Progress&)>& progress)
        : report_(report),
          root_(report, root, "", scenarioSections()),
          folder_(std::move(folder)),
          most_blocks_(most_blocks),
          stop_(stop),
          progress_(progress) {}

    /// \post the scenario is complete, but for its text and places, when the report is clean
    Scenario read() {
        root_.integer("format", {1, 1});
        readSettings(root_, model_);
        materials_ = readMaterials(report_, root_);
        joints_ = readJoints(report_, root_);
        readBlocks();
        BlockDirectory directory(report_, stacks_, placed_);
        readRock(directory);
        checkWatch(directory);
        const auto interfaces = readInterfaces(report_, root_, directory, joints_);
        const auto waters =
            readWaters(report_, root_, {stacks_, rock_ ? &*rock_ : nullptr, folder_}, directory);
        for (const ForceSection& section : forceSections())
            section.read({report_, root_, directory, joints_, folder_}, model_);
        if (rock_) turnFaces(rock_->turn, model_);
        checkFlow();
        std::vector<RockWalls> walls;
        if (report_.clean()) walls = rockWalls(waters);
        if (report_.clean()) buildBlocks();
        if (report_.clean()) {
            addInterfaces(interfaces, model_);
            appendWaters(report_, waters, stacks_, walls, model_);
            placeForces();
            addDerivedJoints(joints_.origins(), model_);
        }
        Scenario scenario;
        scenario.model = std::move(model_);
        scenario.joint_origins = joints_.origins();
        scenario.materials = materials_.names.all();
        scenario.finite_cuts = finite_cuts_;
        scenario.idle_joints = std::move(idle_joints_);
        scenario.warnings = report_.takeWarnings();
        for (std::string& warning : warnings_) scenario.warnings.push_back(std::move(warning));
        return scenario;
    }

 private:
    void readBlocks() {
        std::int64_t count = 0;
        for (const FieldNode& entry : root_.tables("stack")) {
            stacks_.push_back(readStack(report_, entry, materials_, joints_, most_blocks_));
            Stack& stack = stacks_.back();
            stack.first_block = static_cast<std::int32_t>(count);
            if (stack.shape_known) count += stack.blockCount();
            if (!checkCount(stack.place, stack.field, count)) return;
        }
        for (const FieldNode& entry : root_.tables("block")) {
            for (PlacedBlock& placed : readPlacedBlocks(report_, entry, materials_, joints_, folder_))
                placed_.push_back(std::move(placed));
            const auto own = static_cast<std::int64_t>(placed_.size());
            if (!checkCount(placed_.back().place, entry.field, count + own)) return;
        }
        checkThereAreBlocks();
    }

    /// Cut as soon as its tables are read, because only then its blocks have names. Not after earlier faults,
    /// which may concern it.
    void readRock(BlockDirectory& directory) {
        rock_ = readRockMass(report_, root_, materials_, joints_, folder_);
        if (!rock_) return;
        rock_->description.max_blocks = rock_->max_blocks.value_or(static_cast<std::size_t>(most_blocks_));
        rock_->description.stop = stop_;
        if (rock_->turn.isGiven() && !isGiven("seismic", "direction_deg"))
            model_.seismic.azimuth = rock_->turn.azimuth();
        rock_->description.progress = progress_;
        if (report_.clean()) appendEndingSets(report_, *rock_);
        if (report_.clean()) appendFractures(report_, *rock_);
        if (report_.clean()) rock_blocks_ = cutBlocks(report_, *rock_);
        if (!rock_blocks_) return directory.setIncomplete();
        warnings_ = rock_blocks_->cut.warnings;
        idle_joints_ = rock_blocks_->cut.idle_joints;
        finite_cuts_ = summaryOf(*rock_, rock_blocks_->finite_cuts);
        if (auto note = bridgeNote(finite_cuts_)) warnings_.push_back(std::move(*note));
        if (rock_->has_mesh)
            if (auto dust = dustWarning(*rock_blocks_)) warnings_.push_back(std::move(*dust));
        directory.add(report_, rock_blocks_->names, firstRockBlock(), rock_->place, "rock_mass.name");
    }

    std::int32_t firstRockBlock() const {
        std::int64_t count = static_cast<std::int64_t>(placed_.size());
        for (const Stack& stack : stacks_) count += stack.blockCount();
        return static_cast<std::int32_t>(count);
    }

    /// Of the waters in joints of the rock mass; empty for the others.
    std::vector<RockWalls> rockWalls(const std::vector<WaterEntry>& waters) const {
        std::vector<RockWalls> walls(waters.size());
        for (std::size_t i = 0; i < waters.size(); ++i) {
            if (waters[i].where != WaterEntry::Where::rock_joint) continue;
            const auto walls_of = [&](std::size_t joint, std::optional<std::int64_t> plane) -> JointWalls {
                const auto& sets = rock_->description.sets;
                const auto& singles = rock_->description.singles;
                return {jointWalls(*rock_, *rock_blocks_, joint, plane, firstRockBlock()),
                        wetOutline(*rock_, joint),
                        joint < sets.size() ? sets[joint].name : singles[joint - sets.size()].name};
            };
            walls[i].joint = walls_of(waters[i].rock_joint, waters[i].plane);
            if (waters[i].crack) walls[i].crack = walls_of(*waters[i].crack, std::nullopt);
        }
        return walls;
    }

    bool isGiven(std::string_view section, std::string_view key) const {
        const auto node = root_.find(section);
        return node && node->kind() == Kind::table && node->find(key);
    }

    void placeForces() {
        for (const ForceSection& section : forceSections()) {
            if (section.place == nullptr) continue;
            for (Error& error : section.place(model_))
                report_.add(report_.placeOf(error.field).value_or(kFileStart), error.field,
                            std::move(error.message));
        }
    }

    bool checkCount(Place place, const std::string& field, std::int64_t count) {
        if (count <= most_blocks_) return true;
        report_.add(
            place, field,
            "found " + std::to_string(count) + " blocks so far, allowed: " + std::to_string(most_blocks_));
        return false;
    }

    void checkThereAreBlocks() {
        if (isEmpty("stack") && isEmpty("block") && !root_.has("rock_mass")) {
            if (!root_.isMeant("stack") && !root_.isMeant("block") && !root_.isMeant("rock_mass"))
                report_.add(
                    kFileStart, "stack",
                    "found no blocks, allowed: at least one [[stack]] or [[block]], or a [rock_mass]");
            return;
        }
        if (materials_.names.empty()) reportNone("material", "[material.NAME] with a density");
        if (joints_.names.empty()) reportNone("joint", "[joint.default] with stiffness and friction");
    }

    /// Unless a misspelt key, or a value of the wrong type, is reported already.
    void reportNone(std::string_view key, const std::string& required) {
        const auto node = root_.find(key);
        const bool has_faulty_entries = node && (node->kind() != Kind::table || node->size() > 0);
        if (!root_.isMeant(key) && !has_faulty_entries) root_.error(key, "missing; required: " + required);
    }

    /// A value of the wrong type counts as something: it is reported where it is read.
    bool isEmpty(std::string_view key) const {
        const auto node = root_.find(key);
        return !node || (node->kind() == Kind::array && node->size() == 0);
    }

    void checkFlow() {
        if (!model_.flow) return;
        if (auto fault = flowBeyondJoints(finite_cuts_))
            report_.add(report_.placeOf(model_.flow->field).value_or(kFileStart), model_.flow->field,
                        std::move(*fault));
    }

    void checkWatch(const BlockDirectory& directory) {
        const auto run = root_.find("run");
        const auto watch = run && run->kind() == Kind::table ? run->find("watch") : std::nullopt;
        if (watch && watch->kind() == Kind::array) directory.checkNames(report_, *watch, "run.watch");
    }

    void buildBlocks() {
        std::int64_t count = static_cast<std::int64_t>(placed_.size());
        for (const Stack& stack : stacks_) count += stack.blockCount();
        model_.blocks.reserve(static_cast<std::size_t>(count));
        for (const Stack& stack : stacks_) appendStack(report_, stack, materials_, joints_, model_);
        for (PlacedBlock& placed : placed_) model_.blocks.push_back(std::move(placed.block));
        if (rock_) appendRockMass(*rock_, std::move(*rock_blocks_), joints_, model_);
        model_.joints = joints_.all();
        for (Joint& joint : model_.joints) joint.tension_reduced = model_.analysis.reduce_tensile_strength;
        if (stacks_.size() == 1 && placed_.empty() && !rock_) model_.stack = shapeOf(stacks_[0]);
    }

    static StackShape shapeOf(const Stack& stack) {
        return {stack.columns, stack.rows,    stack.slices, stack.block,
                stack.origin,  stack.running, stack.heights};
    }

    Report& report_;
    TableReader root_;
    Model model_;
    Materials materials_;
    Joints joints_;
    std::vector<Stack> stacks_;
    std::vector<PlacedBlock> placed_;
    std::string folder_;
    std::int64_t most_blocks_;
    const std::atomic<bool>* stop_;
    const std::function<void(const Progress&)>& progress_;
    std::optional<RockMassInput> rock_;
    std::optional<RockMassBlocks> rock_blocks_;
    FiniteCuts finite_cuts_;
    std::vector<std::string> warnings_, idle_joints_;
};

}  // namespace
}  // namespace scenario

std::vector<std::string> scenario::scenarioSections() {
    std::vector<std::string> all{"format",    "analysis",     "run",          "gravity", "contact",
                                 "material",  "joint",        "stack",        "block",   "rock_mass",
                                 "joint_set", "single_joint", "fracture_set", "water",   "interface"};
    eachNumberSection([&](const char* section, const auto&, auto) { all.emplace_back(section); });
    for (const ForceSection& section : forceSections()) all.emplace_back(section.name);
    return all;
}

Result<Scenario> scenario::readDocument(const Document& document, std::string text, const std::string& path,
                                        std::int64_t most_blocks, const std::atomic<bool>* stop,
                                        Questions* questions,
                                        const std::function<void(const Progress&)>& progress) {
    Report report(path);
    report.listen(questions);
    const auto slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
    ScenarioReader reader(report, document.root(), folder, most_blocks, stop, progress);
    Scenario scenario = reader.read();
    if (!report.clean()) return report.errors();
    scenario::warnOfUnnamed(report, document.root());
    for (std::string& warning : report.takeWarnings()) scenario.warnings.push_back(std::move(warning));
    scenario.path = path;
    scenario.text = std::move(text);
    scenario.places = report.takePlaces();
    return scenario;
}

Result<Scenario> parseScenario(const std::string& text, const std::string& path, std::int64_t most_blocks,
                               const std::atomic<bool>* stop) {
    const auto document = toml::Document::parse(text, path);
    if (!document) return document.errors();
    return scenario::readDocument(*document, text, path, most_blocks, stop);
}

Result<Scenario> readScenario(const std::string& path, const std::atomic<bool>* stop) {
    const auto text = toml::readFileText(path);
    if (!text) return text.errors();
    return parseScenario(*text, path, kMostBlocks, stop);
}

}  // namespace talus::formats
