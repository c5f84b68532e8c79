#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "scenario/rock_mass.h"

namespace talus::formats::scenario {

namespace {

// What holds the convex parts of one block together: more than any rock, and less than what makes sums lose digits.
constexpr double kBondStrength = 1e15;  // [Pa]
constexpr double kOnPlane = 1e-6;       // of the region's extent: how near to a plane counts as in it

double extentOf(const TriangleSurface& region) {
    Vec3 min = region.vertices[0], max = min;
    for (const Vec3& v : region.vertices) min = min.cwiseMin(v), max = max.cwiseMax(v);
    return (max - min).maxCoeff();
}

/// The largest part of each block comes first: it has the block's own name.
void sortParts(CutRockMass& cut) {
    std::vector<std::size_t> order(cut.parts.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const BlockPart &p = cut.parts[a], &q = cut.parts[b];
        return p.block != q.block ? p.block < q.block : p.volume > q.volume;
    });
    std::vector<BlockPart> parts;
    std::vector<std::int32_t> moved(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        parts.push_back(std::move(cut.parts[order[k]]));
        moved[order[k]] = static_cast<std::int32_t>(k);
    }
    cut.parts = std::move(parts);
    for (auto& [a, b] : cut.bonds)
        std::tie(a, b) =
            std::pair(std::minmax({moved[static_cast<std::size_t>(a)], moved[static_cast<std::size_t>(b)]}));
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
        if (!blocks_.cut.bonds.empty()) sortParts(blocks_.cut);
        nameBlocks();
        blocks_.fixed.assign(blocks_.cut.parts.size(), false);
        for (const FixedEntry& entry : input_.fixed) fix(entry);
        return std::move(blocks_);
    }

 private:
    void nameBlocks() {
        std::vector<std::string> name_of(static_cast<std::size_t>(blocks_.cut.blocks));
        for (std::size_t b = 0; b < name_of.size(); ++b)
            name_of[b] = input_.prefix + "b" + std::to_string(b + 1);
        std::unordered_map<std::int32_t, std::string> named;
        for (const PointName& name : input_.names) {
            const std::int32_t block = blockAt(blocks_.cut, name.point);
            if (block < 0) {
                report_.add(name.place, name.field,
                            "found a point in no block, allowed: a point of the region");
                continue;
            }
            const auto [first, is_new] = named.emplace(block, name.name);
            if (is_new)
                name_of[static_cast<std::size_t>(block)] = name.name;
            else
                report_.add(name.place, name.field,
                            "found a point in the block that is named " + quoted(first->second) +
                                " already, allowed: one name for a block");
        }
        int part = 0;
        for (std::size_t p = 0; p < blocks_.cut.parts.size(); ++p) {
            const std::int32_t block = blocks_.cut.parts[p].block;
            part = p > 0 && blocks_.cut.parts[p - 1].block == block ? part + 1 : 1;
            const std::string& name = name_of[static_cast<std::size_t>(block)];
            blocks_.names.push_back(part == 1 ? name : name + "." + std::to_string(part));
        }
    }

    void fix(const FixedEntry& entry) {
        if (entry.by_place) {
            const auto taken =
                selectBlocks(blocks_.cut, *entry.by_place, kOnPlane * extentOf(input_.description.region));
            if (std::none_of(taken.begin(), taken.end(), [](bool is) { return is; }))
                report_.add(entry.place, entry.field,
                            "found no block there to fix: it is cut otherwise, or cut away, allowed: a "
                            "selection of at "
                            "least one block");
            for (std::size_t p = 0; p < taken.size(); ++p) blocks_.fixed[p] = blocks_.fixed[p] || taken[p];
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
                            quoted(input_.prefix + "b" + std::to_string(blocks_.cut.blocks)) +
                            ", or a name of rock_mass.names");
            return;
        }
        const std::int32_t block =
            blocks_.cut.parts[static_cast<std::size_t>(found - blocks_.names.begin())].block;
        for (std::size_t p = 0; p < blocks_.cut.parts.size(); ++p)
            if (blocks_.cut.parts[p].block == block) blocks_.fixed[p] = true;
    }

    Report& report_;
    const RockMassInput& input_;
    RockMassBlocks blocks_;
};

/// Strength of a face by the joint that made it.
std::int32_t strengthOf(const RockMassInput& input, const FaceOrigin& origin) {
    if (origin.joint < 0) return input.joint;
    const auto joint = static_cast<std::size_t>(origin.joint);
    const auto& sets = input.description.sets;
    return joint < sets.size() ? sets[joint].joint : input.description.singles[joint - sets.size()].joint;
}

/// As stiff as the stiffest joint of the file, so that it does not shorten the time step.
Joint bond(const RockMassInput& input, const std::vector<Joint>& joints) {
    Joint intact = joints[static_cast<std::size_t>(input.joint)];
    intact.name = "intact rock";
    for (const Joint& joint : joints) {
        intact.normal_stiffness = std::max(intact.normal_stiffness, joint.normal_stiffness);
        intact.shear_stiffness = std::max(intact.shear_stiffness, joint.shear_stiffness);
    }
    intact = holding(std::move(intact), kBondStrength);
    intact.dilation = 0;
    return intact;
}

}  // namespace

std::optional<RockMassBlocks> cutBlocks(Report& report, const RockMassInput& input) {
    return BlockMaker(report, input).make();
}

void appendRockMass(const RockMassInput& input, RockMassBlocks blocks, Model& model) {
    const auto first = static_cast<std::int32_t>(model.blocks.size());
    for (std::size_t p = 0; p < blocks.cut.parts.size(); ++p) {
        BlockPart& part = blocks.cut.parts[p];
        Block block;
        block.name = std::move(blocks.names[p]);
        block.shape = std::move(part.shape);
        block.material = input.material;
        block.density = input.density;
        block.motion = blocks.fixed[p] ? Motion::fixed : Motion::free;
        block.field = input.description.field;
        for (const FaceOrigin& origin : part.origin) block.face_joint.push_back(strengthOf(input, origin));
        model.blocks.push_back(std::move(block));
    }
    if (blocks.cut.bonds.empty()) return;
    const auto intact = static_cast<std::int32_t>(model.joints.size());
    model.joints.push_back(bond(input, model.joints));
    for (const auto& [a, b] : blocks.cut.bonds)
        model.pair_joints.push_back({first + a, first + b, intact, false, input.description.field});
}

std::vector<WetFace> jointWalls(const CutRockMass& cut, std::size_t joint, std::optional<std::int64_t> plane,
                                std::int32_t first) {
    std::vector<WetFace> walls;
    for (std::size_t p = 0; p < cut.parts.size(); ++p)
        for (std::size_t f = 0; f < cut.parts[p].origin.size(); ++f) {
            const FaceOrigin& origin = cut.parts[p].origin[f];
            if (origin.joint != static_cast<std::int32_t>(joint) || (plane && origin.plane != *plane))
                continue;
            walls.push_back({first + static_cast<std::int32_t>(p), static_cast<std::int32_t>(f)});
        }
    return walls;
}

}  // namespace talus::formats::scenario
