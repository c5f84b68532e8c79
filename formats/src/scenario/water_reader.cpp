#include <algorithm>
#include <array>
#include <unordered_map>

#include "scenario/fields.h"
#include "scenario/interface.h"
#include "scenario/places.h"
#include "scenario/water.h"
#include "talus/formats/mesh.h"
#include "talus/formats/scenario.h"

namespace talus::formats::scenario {

namespace {

// [m]: joints of rock masses that open wider run dry in time histories unless an entry says otherwise. Stiff
// joints open by some hundredths of a millimetre before failure; water kept behind a moving block would eject
// it.
constexpr double kOpenRock = 1e-3;

void readLevel(Report& report, TableReader& table, const std::vector<std::string>& kinds, Water& water) {
    if (!table.requireOneOf(kinds)) return;
    if (const auto depth = table.number("depth", kLength)) water.level = {{0, *depth}};
    if (table.has("levels")) water.level = readTable(report, table, "levels", kNotNegative, "depth m");
    if (const auto elevation = table.number("elevation", kCoordinate)) water.level = {{0, *elevation}};
    if (table.has("elevations"))
        water.level = readTable(report, table, "elevations", kCoordinate, "elevation m");
    if (table.has("elevation") || table.has("elevations")) water.kind = Water::Level::elevation;
    if (const auto head = table.numbers("head", kLength, 2)) {
        water.kind = Water::Level::head;
        water.head = {(*head)[0], (*head)[1]};
    }
}

class WaterReader {
 public:
    WaterReader(Report& report, const WaterPlaces& places, const BlockDirectory& blocks)
        : report_(report),
          stacks_(places.stacks),
          rock_(places.rock),
          folder_(places.folder),
          blocks_(blocks) {
        for (const Stack& stack : stacks_) stack_names_.add(stack.name);
    }

    std::optional<WaterEntry> read(const FieldNode& node) const {
        TableReader table(report_, node.node, node.field,
                          {"fissure",        "stack", "between",   "block",         "face",
                           "joint",          "plane", "depth",     "elevation",     "levels",
                           "elevations",     "head",  "base",      "density",       "drains_at_aperture",
                           "surface",        "obj",   "factor",    "daylights",     "crack",
                           "percent_filled", "peak",  "volume",    "opening",       "inflow",
                           "overflow",       "rain",  "catchment", "leak_aperture", "leak_length"});
        WaterEntry entry;
        entry.place = table.place();
        entry.water.field = node.field;
        readVolume(table, entry.water);
        if (rock_ != nullptr && !entry.water.closed && !table.has("fissure") && !table.has("block"))
            entry.water.drains_at_aperture = kOpenRock;
        readNumbers(table, kWaterFields, entry.water);
        if (!table.requireOneOf({"fissure", "between", "block", "joint", "surface", "obj"}))
            return std::nullopt;
        refuseForeignKeys(table);
        if (table.has("surface") || table.has("obj")) return readSurface(table, entry);
        readDaylight(table, entry.water);
        if (table.has("joint")) return readRockJoint(table, entry);
        if (table.has("fissure")) return readStackJoint(table, entry);
        if (table.has("between")) return readBetweenBlocks(table, entry);
        return readBlockFace(table, entry);
    }

 private:
    /// Keys that mean something in another kind of [[water]] only.
    static void refuseForeignKeys(TableReader& table) {
        const auto refuse = [&](const char* owner, const std::vector<std::string>& keys) {
            if (table.has(owner)) return;
            for (const std::string& key : table.present(keys))
                table.error(key,
                            "found " + key + " without " + owner + ", allowed: only together with " + owner);
        };
        refuse("fissure", {"stack"});
        if (!table.has("joint")) refuse("fissure", {"base"});
        refuse("joint", {"plane"});
        if (!table.has("joint")) refuse("between", {"head"});
        refuse("block", {"face"});
        if (!table.has("obj")) refuse("surface", {"factor"});
        if (!table.has("between")) refuse("joint", {"daylights"});
        refuse("joint", {"percent_filled"});
        refuse("percent_filled", {"crack", "peak"});
    }

    /// Whether the level follows from a volume, and what flows into it.
    void readVolume(TableReader& table, Water& water) const {
        const auto volume = table.choice("volume", {"held", "closed"});
        water.closed = volume && *volume == 1;
        readNumbers(table, kClosedWaterFields, water);
        water.inflow = readOverTime(table, "inflow", kInflow, "m3/s per m");
        water.rain = readOverTime(table, "rain", kRain, "mm/h");
        for (LevelPoint& point : water.rain) point.value *= kMetresPerSecond;
        const bool by_elevation = table.has("elevation");
        if (const auto over = table.number("overflow", by_elevation ? kCoordinate : kLength))
            water.overflow = *over;
        if (!table.has("volume") || volume) checkVolume(table, water);
    }

    static void checkVolume(TableReader& table, const Water& water) {
        if (!water.closed) {
            for (const std::string& key : table.present(
                     {"opening", "inflow", "overflow", "rain", "catchment", "leak_aperture", "leak_length"}))
                table.error(key, "found " + key + " without volume = \"closed\", allowed: only with it");
            return;
        }
        table.require({"opening"});
        requireBoth(table, "rain", "catchment");
        requireBoth(table, "leak_aperture", "leak_length");
        for (const std::string& key :
             table.present({"between", "block", "surface", "obj", "levels", "elevations", "head", "daylights",
                            "percent_filled", "drains_at_aperture"})) {
            table.error(key, "found " + key +
                                 " beside volume = \"closed\", allowed: fissure or joint, with depth or "
                                 "elevation");
        }
    }

    static void requireBoth(TableReader& table, const char* one, const char* other) {
        if (table.has(one) == table.has(other)) return;
        const bool is_one = table.has(one);
        const std::string found = is_one ? one : other, missing = is_one ? other : one;
        table.error(found,
                    "found " + found + " without " + missing + ", allowed: only together with " + missing);
    }

    /// `KEY = NUMBER`, or over time.
    std::vector<LevelPoint> readOverTime(TableReader& table, const char* key, const Interval& values,
                                         std::string_view what) const {
        const auto node = table.find(key);
        const bool is_number = node && node->kind() != Kind::array;
        if (!is_number) {
            if (auto over_time = readTable(report_, table, key, values, what); node) return over_time;
        }
        const auto constant = table.number(key, values);
        if (!constant) return {};
        return {{0, *constant}};
    }

    /// \pre its level was read
    static void checkOverflow(TableReader& table, const Water& water) {
        if (!water.closed || water.level.empty() || !(water.overflow < water.level[0].value)) return;
        table.error("overflow", "found " + numberText(water.overflow) + ", allowed: at least the " +
                                    (water.kind == Water::Level::elevation ? "elevation, " : "depth, ") +
                                    numberText(water.level[0].value));
    }

    /// How the pressure falls towards a lower end that lies open.
    static void readDaylight(TableReader& table, Water& water) {
        const auto how = table.choice("daylights", {"straight", "half-height"});
        if (!how) return;
        water.daylight = *how == 0 ? Water::Daylight::straight : Water::Daylight::half_height;
        if (table.has("head"))
            table.error("daylights", "found daylights together with head, allowed: one or the other");
    }

    /// The water table of the whole slope.
    std::optional<WaterEntry> readSurface(TableReader& table, WaterEntry& entry) const {
        entry.where = WaterEntry::Where::below_surface;
        for (const std::string& key :
             table.present({"depth", "elevation", "levels", "elevations", "daylights"}))
            table.error(key, "found " + key + " together with a surface, allowed: one or the other");
        if (table.has("obj"))
            entry.surface.mesh = readSurfaceMesh(table);
        else
            takeLine(readLine(table), entry.surface);
        entry.surface.factor = table.number("factor", {0, 10, true, false}).value_or(1);
        entry.surface.density = entry.water.density;
        entry.surface.drains_at_aperture = entry.water.drains_at_aperture;
        entry.surface.field = entry.water.field;
        return entry;
    }

    /// Of a turned profile it lies along the slope, too, as a surface that reaches over all of it.
    void takeLine(std::vector<PhreaticSurface::Point> line, PhreaticSurface& surface) const {
        if (line.empty() || rock_ == nullptr || !rock_->turn.isTurned()) {
            surface.line = std::move(line);
            return;
        }
        const double margin = (rock_->high - rock_->low).maxCoeff();
        line.insert(line.begin(), {std::min(line.front().x, rock_->low.x()) - margin, line.front().z});
        line.push_back({std::max(line.back().x, rock_->high.x()) + margin, line.back().z});
        for (const PhreaticSurface::Point& point : line) {
            for (const double y : {rock_->low.y() - margin, rock_->high.y() + margin})
                surface.mesh.vertices.push_back(rock_->turn({point.x, y, point.z}));
        }
        for (std::int32_t k = 0; k + 1 < static_cast<std::int32_t>(line.size()); ++k) {
            surface.mesh.triangles.push_back({2 * k, 2 * k + 2, 2 * k + 3});
            surface.mesh.triangles.push_back({2 * k, 2 * k + 3, 2 * k + 1});
        }
    }

    /// `obj = "FILE"`, beside the scenario: an open surface.
    TriangleSurface readSurfaceMesh(TableReader& table) const {
        const auto file = table.text("obj");
        if (!file) return {};
        MeshOptions options;
        options.format = MeshFormat::obj;
        options.farthest = kMaxLength;
        options.open = true;
        auto mesh = readMesh(file->starts_with('/') ? *file : folder_ + *file, options);
        for (Error error : mesh.errors()) {
            error.field.clear();
            table.error("obj", error.file.empty() ? error.message : format(error));
        }
        if (!mesh) return {};
        for (std::string& note : mesh->notes) report_.warn(table.fieldOf("obj") + ": " + std::move(note));
        return std::move(mesh->surface);
    }

    /// `surface = [[x, z], ...]` from small to great x.
    std::vector<PhreaticSurface::Point> readLine(TableReader& table) const {
        const auto list = table.array("surface");
        if (!list) return {};
        std::vector<PhreaticSurface::Point> line;
        for (std::size_t k = 0; k < list->size(); ++k) {
            const std::string field = table.fieldOf("surface") + "[" + std::to_string(k) + "]";
            const auto point = readNumbers(report_, list->at(k), field, kCoordinate, 2);
            if (!point) return {};
            if (!line.empty() && (*point)[0] <= line.back().x)
                report_.add(list->at(k).place(), field,
                            "found x = " + numberText((*point)[0]) + " after " + numberText(line.back().x) +
                                ", a line that folds back; allowed: increasing x");
            line.push_back({(*point)[0], (*point)[1]});
        }
        if (line.size() < 2) table.error("surface", "found fewer than two points, allowed: at least two");
        return line;
    }

    /// Index of the stack meant; nothing when that is reported.
    std::optional<std::size_t> readStackName(TableReader& table) const {
        if (stacks_.empty()) {
            table.error("fissure",
                        "found a fissure in a scenario without a [[stack]], allowed: between, or block");
            return std::nullopt;
        }
        if (table.has("stack")) {
            const auto name = table.text("stack");
            if (!name) return std::nullopt;
            return stack_names_.resolve(report_, table.placeOf("stack"), table.fieldOf("stack"), *name);
        }
        if (stacks_.size() == 1) return 0;
        table.error("stack",
                    "missing; required because there are several stacks, allowed: " + stack_names_.list());
        return std::nullopt;
    }

    std::optional<WaterEntry> readStackJoint(TableReader& table, WaterEntry& entry) const {
        readLevel(report_, table, {"depth", "elevation", "levels", "elevations"}, entry.water);
        checkOverflow(table, entry.water);
        const double base = table.number("base", kLength).value_or(0);
        const auto index = readStackName(table);
        const auto fissure = table.integer("fissure", {0, fissureLimit(index)});
        if (!index || !fissure || !stacks_[*index].shape_known) return std::nullopt;
        const Stack& stack = stacks_[*index];
        if (stack.running) {
            table.error("fissure",
                        "found water in " + stack.field + " with running bond, allowed: bond \"stack\" only");
            return std::nullopt;
        }
        entry.stack = *index;
        entry.fissure = static_cast<int>(*fissure);
        entry.water.base = stack.origin.z() + base;
        checkBase(table, stack, entry.fissure, base);
        return entry;
    }

    std::int64_t fissureLimit(std::optional<std::size_t> stack) const {
        return stack && stacks_[*stack].shape_known ? stacks_[*stack].columns : INT32_MAX;
    }

    static void checkBase(TableReader& table, const Stack& stack, int fissure, double base) {
        int rows = 0;
        for (const int column : {fissure - 1, fissure})
            if (column >= 0 && column < stack.columns)
                rows = std::max(rows, stack.heights[static_cast<std::size_t>(column)]);
        const double top = rows * stack.block.z();
        if (base >= top)
            table.error("base", "found " + numberText(base) +
                                    ", allowed: less than the height of the joint's walls, " +
                                    numberText(top));
    }

    /// In a single joint, in one plane of a joint set, or (by elevation) in all of a set.
    std::optional<WaterEntry> readRockJoint(TableReader& table, WaterEntry& entry) const {
        entry.where = WaterEntry::Where::rock_joint;
        readLevel(report_, table, {"elevation", "depth", "levels", "elevations", "head", "percent_filled"},
                  entry.water);
        checkOverflow(table, entry.water);
        readFilled(table, entry);
        const auto crack = table.text("crack");
        if (const auto base = table.number("base", kCoordinate)) entry.water.base = *base;
        if (table.has("base") && table.has("head"))
            table.error("base", "found base together with head, allowed: with a level");
        const auto name = table.text("joint");
        const auto plane = table.integer("plane", {INT32_MIN, INT32_MAX});
        if (!name) return std::nullopt;
        if (!rock_ || rock_->joint_names.empty()) {
            table.error(
                "joint",
                rock_ ? "found " + quoted(*name) + ", but no joint set or single joint has a name"
                      : "found a joint in a scenario without [rock_mass], allowed: fissure, between, block");
            return std::nullopt;
        }
        const auto index = rockJoint(table, "joint", *name);
        if (!index) return std::nullopt;
        entry.rock_joint = *index;
        if (crack) {
            entry.crack = rockJoint(table, "crack", *crack);
            if (!entry.crack) return std::nullopt;
            if (*entry.crack < rock_->description.sets.size())
                table.error("crack", "found the joint set " + quoted(*crack) + ", allowed: a single joint");
        }
        entry.plane = plane;
        const bool is_set = entry.rock_joint < rock_->description.sets.size();
        if (is_set && !plane && entry.water.closed) {
            table.error("joint", "found a closed volume in all planes of the joint set " + quoted(*name) +
                                     ", allowed: plane = NUMBER for one of them");
        }
        if (plane && !is_set)
            table.error("plane",
                        "found plane with the single joint " + quoted(*name) + ", allowed: with a joint set");
        if (is_set && !table.has("plane") && !entry.filled && entry.water.kind != Water::Level::elevation)
            table.error("joint", "found a " +
                                     std::string(entry.water.kind == Water::Level::head ? "head" : "depth") +
                                     " in all planes of the joint set " + quoted(*name) +
                                     ", allowed: elevation, or plane = NUMBER for one of them");
        return entry;
    }

    std::optional<std::size_t> rockJoint(TableReader& table, const char* key, const std::string& name) const {
        const auto index = rock_->joint_names.resolve(report_, table.placeOf(key), table.fieldOf(key), name);
        if (!index) return std::nullopt;
        return rock_->joint_of_name[static_cast<std::size_t>(*index)];
    }

    /// The distributions of E. Hoek and J. W. Bray, Rock Slope Engineering (1981), by where pressure is
    /// greatest.
    static void readFilled(TableReader& table, WaterEntry& entry) {
        const auto percent = table.number("percent_filled", {0, 100, false, false});
        const auto peak = table.choice("peak", {"crack-base", "half-height", "toe"});
        if (!table.has("percent_filled")) return;
        if (percent) entry.filled = *percent / 100;
        if (table.has("daylights"))
            table.error("daylights", "found daylights together with percent_filled, allowed: peak");
        table.require({"peak"});
        if (!peak) return;
        constexpr std::array kFalls{Water::Daylight::straight, Water::Daylight::half_height,
                                    Water::Daylight::closed};
        entry.water.daylight = kFalls[static_cast<std::size_t>(*peak)];
        entry.fills_crack_alone = *peak == 0;
        if (entry.fills_crack_alone && !table.has("crack"))
            table.error("peak", "found \"crack-base\" without crack, allowed: \"half-height\", \"toe\"");
    }

    std::optional<WaterEntry> readBetweenBlocks(TableReader& table, WaterEntry& entry) const {
        entry.where = WaterEntry::Where::between_blocks;
        readLevel(report_, table, {"depth", "elevation", "levels", "elevations", "head"}, entry.water);
        entry.water.pair = readBetween(report_, table, blocks_);
        return entry;
    }

    std::optional<WaterEntry> readBlockFace(TableReader& table, WaterEntry& entry) const {
        entry.where = WaterEntry::Where::block_face;
        table.require({"face"});
        readLevel(report_, table, {"depth", "elevation", "levels", "elevations"}, entry.water);
        entry.direction = readDirection(table, "face").value_or(entry.direction);
        const auto name = table.text("block");
        if (!name) return std::nullopt;
        const auto block = blocks_.resolve(report_, table.placeOf("block"), table.fieldOf("block"), *name);
        entry.block = block.value_or(0);
        return entry;
    }

    Report& report_;
    const std::vector<Stack>& stacks_;
    const RockMassInput* rock_;
    const std::string& folder_;
    const BlockDirectory& blocks_;
    NameList stack_names_{"stack"};
};

}  // namespace

std::vector<WaterEntry> readWaters(Report& report, TableReader& root, const WaterPlaces& places,
                                   const BlockDirectory& blocks) {
    const WaterReader reader(report, places, blocks);
    std::vector<WaterEntry> entries;
    for (const FieldNode& node : root.tables("water"))
        if (auto entry = reader.read(node)) entries.push_back(std::move(*entry));
    return entries;
}

}  // namespace talus::formats::scenario
