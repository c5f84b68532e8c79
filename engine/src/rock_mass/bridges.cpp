// Rock bridges: where the cuts of finite joints continue beyond the joints, through intact rock.

#include <algorithm>
#include <map>

#include "geometry/box_tree.h"
#include "rock_mass/joints.h"
#include "talus/rock_mass.h"

namespace talus {
namespace {

using namespace rock_mass;

constexpr double kAreaRounding = 1e-9;  // of the area two faces share

struct CutFace {
    std::int32_t block = 0, face = 0;
    Polygon outline;  ///< in the plane of the joint
    Box box;
};

/// The faces one joint made.
struct Sides {
    std::vector<CutFace> above, below;  ///< those that face down onto the joint's plane, and up
};

std::map<std::size_t, Reach> finiteJoints(const RockMass& description) {
    std::map<std::size_t, Reach> reaches;
    const auto joints = jointPlanes(description, description.region.vertices);
    if (!joints) return reaches;
    for (const JointPlane& joint : *joints)
        if (joint.reach) reaches.emplace(joint.joint, *joint.reach);
    return reaches;
}

std::map<std::size_t, Sides> sidesOf(const CutRockMass& mass, const std::map<std::size_t, Reach>& reaches) {
    std::map<std::size_t, Sides> all;
    for (std::size_t b = 0; b < mass.blocks.size(); ++b) {
        const CutBlock& block = mass.blocks[b];
        for (std::size_t f = 0; f < block.origin.size(); ++f) {
            if (block.origin[f].joint < 0 || block.shape.isInner(f)) continue;
            const auto joint = static_cast<std::size_t>(block.origin[f].joint);
            const auto reach = reaches.find(joint);
            if (reach == reaches.end()) continue;
            CutFace face{static_cast<std::int32_t>(b), static_cast<std::int32_t>(f), {}, {}};
            std::vector<Vec3> outline;
            for (const std::int32_t v : block.shape.faces[f])
                outline.push_back(block.shape.vertices[static_cast<std::size_t>(v)]);
            for (const Vec3& corner : outline) face.box.add(corner);
            face.outline = reach->second.flat(outline);
            Sides& sides = all[joint];
            const bool looks_up = block.shape.faceNormal(f).dot(reach->second.frame.e3) > 0;
            (looks_up ? sides.below : sides.above).push_back(std::move(face));
        }
    }
    return all;
}

void appendCuts(std::size_t joint, const Reach& reach, const Sides& sides, std::vector<JointCut>& cuts) {
    std::vector<Box> boxes;
    for (const CutFace& face : sides.above) boxes.push_back(face.box);
    const BoxTree tree(boxes);
    for (const CutFace& below : sides.below) {
        std::vector<std::size_t> near;
        tree.visit(below.box, [&](std::size_t k) { near.push_back(k); });
        std::sort(near.begin(), near.end());
        for (const std::size_t k : near) {
            const CutFace& above = sides.above[k];
            const Polygon common = intersect(below.outline, above.outline);
            if (common.empty()) continue;
            const double shared = area(common);
            const double beyond = 1 - reach.coveredArea(common) / shared;
            cuts.push_back({below.block, below.face, above.block, above.face, joint, shared,
                            beyond < kAreaRounding ? 0 : std::min(beyond, 1.0)});
        }
    }
}

}  // namespace

std::vector<JointCut> finiteCuts(const CutRockMass& mass, const RockMass& description) {
    const auto reaches = finiteJoints(description);
    std::vector<JointCut> cuts;
    if (reaches.empty()) return cuts;
    for (const auto& [joint, sides] : sidesOf(mass, reaches))
        appendCuts(joint, reaches.at(joint), sides, cuts);
    return cuts;
}

}  // namespace talus
