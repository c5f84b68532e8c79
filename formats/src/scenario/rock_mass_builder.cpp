#include <algorithm>
#include <cstdio>
#include <map>
#include <unordered_map>

#include "scenario/rock_mass.h"

namespace talus::formats::scenario {

namespace {

constexpr double kOnPlane = 1e-6;  // of the region's extent: how near to a plane counts as in it
constexpr double kTold = 0.01;     // of the cuts of finite joints: a larger share beyond the joints is
                                   // reported

double extentOf(const TriangleSurface& region) {
    Vec3 min = region.vertices[0], max = min;
    for (const Vec3& v : region.vertices) min = min.cwiseMin(v), max = max.cwiseMax(v);
    return (max - min).maxCoeff();
}

class BlockMaker {
 public:
    BlockMaker(Report& report, const RockMassInput& input) : report_(report), input_(input) {}

    std::optional<RockMassBlocks> make() {
        auto cut = cutRockMass(input_.description);
        if (!cut) {
            for (const Error& error : cut.errors())
                report_.add(report_.placeOf(error.field).value_or(input_.place), error.field, error.message);
            return std::nullopt;
        }
        blocks_.cut = std::move(*cut);
        blocks_.finite_cuts = finiteCuts(blocks_.cut, input_.description);
        nameBlocks();
        blocks_.fixed.assign(blocks_.cut.blocks.size(), false);
        for (const FixedEntry& entry : input_.fixed) fix(entry);
        return std::move(blocks_);
    }

 private:
    void nameBlocks() {
        for (std::size_t b = 0; b < blocks_.cut.blocks.size(); ++b)
            blocks_.names.push_back(input_.prefix + "b" + std::to_string(b + 1));
        std::unordered_map<std::int32_t, std::string> named;
        for (const PointName& name : input_.names) {
            const std::int32_t block = blockAt(blocks_.cut, name.point);
            if (block < 0) {
                report_.add(name.place, name.field,
                            "found a point outside every block, allowed: a point of the region");
                continue;
            }
            const auto [first, is_new] = named.emplace(block, name.name);
            if (is_new)
                blocks_.names[static_cast<std::size_t>(block)] = name.name;
            else
                report_.add(name.place, name.field,
                            "found a point in the block that is named " + quoted(first->second) +
                                " already, allowed: one name for a block");
        }
    }

    void fix(const FixedEntry& entry) {
        if (entry.by_place) {
            const auto taken =
                selectBlocks(blocks_.cut, *entry.by_place, kOnPlane * extentOf(input_.description.region));
            if (std::none_of(taken.begin(), taken.end(), [](bool is) { return is; }))
                report_.add(entry.place, entry.field,
                            "found no block there to fix; the joints may cut it differently, or it was cut "
                            "away, allowed: a selection of at least one block");
            for (std::size_t b = 0; b < taken.size(); ++b) blocks_.fixed[b] = blocks_.fixed[b] || taken[b];
        } else if (!entry.name.empty()) {
            fixByName(entry);
        }
    }

    void fixByName(const FixedEntry& entry) {
        const auto found = std::find(blocks_.names.begin(), blocks_.names.end(), entry.name);
        if (found == blocks_.names.end()) {
            report_.add(entry.name_place, entry.field + ".name",
                        "found the unknown block " + quoted(entry.name) +
                            ", allowed: " + quoted(input_.prefix + "b1") + " to " +
                            quoted(input_.prefix + "b" + std::to_string(blocks_.cut.blocks.size())) +
                            ", or a name of rock_mass.names");
            return;
        }
        blocks_.fixed[static_cast<std::size_t>(found - blocks_.names.begin())] = true;
    }

    Report& report_;
    const RockMassInput& input_;
    RockMassBlocks blocks_;
};

std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::int32_t strengthOf(const RockMassInput& input, std::size_t joint) {
    const auto& sets = input.description.sets;
    return joint < sets.size() ? sets[joint].joint : input.description.singles[joint - sets.size()].joint;
}

/// Strength of a face by the joint that made it.
std::int32_t strengthOf(const RockMassInput& input, const FaceOrigin& origin) {
    return origin.joint < 0 ? input.joint : strengthOf(input, static_cast<std::size_t>(origin.joint));
}

/// Faces with nothing but intact rock on the other side, sorted.
std::vector<std::pair<std::int32_t, std::int32_t>> facesInBridges(const std::vector<JointCut>& cuts) {
    std::map<std::pair<std::int32_t, std::int32_t>, bool> whole;
    for (const JointCut& cut : cuts)
        for (const auto& face : {std::pair(cut.block_a, cut.face_a), std::pair(cut.block_b, cut.face_b)}) {
            const auto [place, is_new] = whole.emplace(face, cut.beyond == 1);
            place->second = place->second && cut.beyond == 1;
        }
    std::vector<std::pair<std::int32_t, std::int32_t>> faces;
    for (const auto& [face, is_whole] : whole)
        if (is_whole) faces.push_back(face);
    return faces;
}

std::string beyondText(const FiniteCuts& cuts) {
    return shortText(cuts.beyond) + " of " + shortText(cuts.area) + " m2 of these cuts lie beyond the joints";
}

}  // namespace

FiniteCuts summaryOf(const RockMassInput& input, const std::vector<JointCut>& cuts) {
    FiniteCuts all;
    all.are_bridges = input.bridge.has_value();
    for (const JointCut& cut : cuts) {
        ++all.interfaces;
        all.bridged += cut.beyond > 0 ? 1 : 0;
        all.area += cut.area;
        all.beyond += cut.beyond * cut.area;
    }
    return all;
}

std::optional<std::string> bridgeNote(const FiniteCuts& cuts) {
    if (cuts.are_bridges || !(cuts.beyond > kTold * cuts.area)) return std::nullopt;
    return "finite joints cut through whole blocks: " + beyondText(cuts) +
           " and have the strength of the joints; with "
           "rock_mass.bridge = \"NAME\" that part has the strength of joint NAME, for intact rock";
}

std::optional<std::string> flowBeyondJoints(const FiniteCuts& cuts) {
    if (!(cuts.beyond > kTold * cuts.area)) return std::nullopt;
    return "found finite joints whose cuts go on through intact rock, where no water flows: " +
           beyondText(cuts) +
           "; allowed beside flow: joints that end at other joints or at the region's boundary, and joints "
           "without an extent";
}

std::optional<RockMassBlocks> cutBlocks(Report& report, const RockMassInput& input) {
    return BlockMaker(report, input).make();
}

void appendRockMass(const RockMassInput& input, RockMassBlocks blocks, Joints& joints, Model& model) {
    const auto first = static_cast<std::int32_t>(model.blocks.size());
    for (std::size_t b = 0; b < blocks.cut.blocks.size(); ++b) {
        CutBlock& cut = blocks.cut.blocks[b];
        Block block;
        block.name = std::move(blocks.names[b]);
        block.shape = std::move(cut.shape);
        block.material = input.material;
        block.density = input.density;
        block.motion = blocks.fixed[b] ? Motion::fixed : Motion::free;
        block.field = input.description.field;
        for (const FaceOrigin& origin : cut.origin) block.face_joint.push_back(strengthOf(input, origin));
        model.blocks.push_back(std::move(block));
    }
    if (!input.bridge) return;
    for (const JointCut& cut : blocks.finite_cuts) {
        const std::int32_t own = strengthOf(input, cut.joint);
        const std::int32_t joint = joints.withBridge(own, *input.bridge, cut.beyond);
        if (joint != own)
            model.pair_joints.push_back({first + cut.block_a, first + cut.block_b, joint, false,
                                         input.description.field + ".bridge", cut.face_a, cut.face_b});
    }
}

std::vector<WetFace> jointWalls(const RockMassInput& input, const RockMassBlocks& blocks, std::size_t joint,
                                std::optional<std::int64_t> plane, std::int32_t first) {
    std::vector<WetFace> walls;
    const auto dry = input.bridge ? facesInBridges(blocks.finite_cuts)
                                  : std::vector<std::pair<std::int32_t, std::int32_t>>{};
    const CutRockMass& cut = blocks.cut;
    for (std::size_t b = 0; b < cut.blocks.size(); ++b)
        for (std::size_t f = 0; f < cut.blocks[b].origin.size(); ++f) {
            const FaceOrigin& origin = cut.blocks[b].origin[f];
            const std::pair face(static_cast<std::int32_t>(b), static_cast<std::int32_t>(f));
            if (origin.joint != static_cast<std::int32_t>(joint) || (plane && origin.plane != *plane) ||
                cut.blocks[b].shape.isInner(f) || std::binary_search(dry.begin(), dry.end(), face))
                continue;
            walls.push_back({first + face.first, face.second});
        }
    return walls;
}

std::vector<Vec3> wetOutline(const RockMassInput& input, std::size_t joint) {
    const std::size_t sets = input.description.sets.size();
    if (!input.bridge || joint < sets) return {};
    return outlineOf(input.description.singles[joint - sets]);
}

}  // namespace talus::formats::scenario
