// Cutting a rock mass: the region into cells, the cells by the joints' planes one after the other, the cells
// into blocks.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "rock_mass/cut_tree.h"
#include "rock_mass/expected_blocks.h"
#include "rock_mass/joints.h"
#include "rock_mass/place_text.h"
#include "rock_mass/region.h"
#include "rock_mass/solid.h"
#include "talus/rock_mass.h"

namespace talus {
namespace {

using namespace rock_mass;

constexpr double kWeld = 1e-11;            // of the region's extent
constexpr double kUlps = 64 * 2.22e-16;    // of the largest coordinate: what is nearer is rounding
constexpr double kThinSpacing = 1e-3;      // default least thickness: of the least mean spacing ...
constexpr double kThinExtent = 1e-4;       // ... or of the region's longest side
constexpr double kThinWelds = 1e5;         // weld distances, in any case
constexpr double kVolumeTolerance = 1e-9;  // of the region's volume
constexpr double kTimesExpected = 2.0;     // an estimate this many times what is allowed is refused
constexpr double kBytesPerBlock = 3e3;     // of a model and its state
constexpr double kSecondsPerBlock = 4e-5;  // to cut it: measured 1.2e-5 between planes, 5e-5 between discs
constexpr double kSameLevel = 1e-7;        // of the extent: centroids this near in a coordinate are level

std::string text(double value) { return numberText(value, 4); }
std::string text(const Vec3& p) { return placeText(p, 4); }

const std::string& fieldOf(const RockMass& description, std::size_t joint) {
    const std::size_t sets = description.sets.size();
    return joint < sets ? description.sets[joint].field : description.singles[joint - sets].field;
}

/// "joint_set[0] (J1)"
std::string titleOf(const RockMass& description, std::size_t joint) {
    const std::size_t sets = description.sets.size();
    const std::string& name =
        joint < sets ? description.sets[joint].name : description.singles[joint - sets].name;
    return fieldOf(description, joint) + (name.empty() ? "" : " (" + name + ")");
}

std::pair<Vec3, Vec3> boundsOf(const TriangleSurface& region) {
    Vec3 min = region.vertices[0], max = min;
    for (const Vec3& v : region.vertices) min = min.cwiseMin(v), max = max.cwiseMax(v);
    return {min, max};
}

double weldDistance(const TriangleSurface& region) {
    double farthest = 0;
    for (const Vec3& v : region.vertices) farthest = std::max(farthest, v.cwiseAbs().maxCoeff());
    return std::max(kWeld * surfaceExtent(region), kUlps * farthest);
}

/// Results of one joint or joint set.
struct Tally {
    std::size_t cuts = 0, left_out = 0;
    Vec3 first_place = Vec3::Zero();
    double first_thickness = 0;
};

/// A count to two significant figures: "18000".
std::string roundText(double count) {
    const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(std::max(count, 1.0))) - 1));
    char text[32];
    std::snprintf(text, sizeof text, "%.0f", std::round(count / unit) * unit);
    return text;
}

/// Whether a plane passes through the region, or touches it. The region is in one piece, so it does unless
/// all corners lie on one side. A finite joint has to come near it, too.
bool meets(const JointPlane& joint, const TriangleSurface& region) {
    const double weld = weldDistance(region);
    double low = kInfinity, high = -kInfinity;
    for (const Vec3& corner : region.vertices) {
        low = std::min(low, joint.plane.height(corner));
        high = std::max(high, joint.plane.height(corner));
    }
    if (low > weld || high < -weld) return false;
    if (!joint.reach) return true;
    const auto [min, max] = boundsOf(region);
    return (joint.reach->min.array() <= max.array() + weld).all() &&
           (joint.reach->max.array() >= min.array() - weld).all();
}

class Cutter {
 public:
    explicit Cutter(const RockMass& description) : description_(description) {}

    Result<CutRockMass> run() {
        if (auto errors = checkAll(); !errors.empty()) return errors;
        VertexTable vertices(weldDistance(description_.region));
        auto cells = decompose(description_.region, planes_, vertices, description_.stop);
        if (stopped()) return interrupted();
        if (!cells) return inRegion(cells.errors());
        for (const Cell& cell : *cells) result_.region_volume += volume(cell, vertices);
        result_.min_thickness = minThickness();
        const Knife knife{planes_, vertices, result_.min_thickness};
        const auto joints = jointPlanes(description_, description_.region.vertices);
        if (!joints) return joints.errors();
        const double expected = expect(*joints);
        if (auto error = tooMany(expected, *joints)) return *error;
        CutTree tree(joined(std::move(*cells), knife));
        tallies_.resize(description_.sets.size() + description_.singles.size());
        for (std::size_t k = 0; k < joints->size(); ++k) {
            tell(k, joints->size(), tree.size(), expected);
            if (auto error = stopped() ? std::optional(interrupted()) : cutBy((*joints)[k], knife, tree))
                return *error;
        }
        warnOfCuts();
        return collect(tree, knife);
    }

 private:
    std::vector<Error> checkAll() const {
        auto errors = inRegion(checkSurface(description_.region));
        for (Error& error : checkJoints(description_)) errors.push_back(std::move(error));
        if (description_.min_thickness && !(*description_.min_thickness >= 0))
            errors.push_back(
                {description_.field + ".min_thickness", "found a negative thickness, allowed: at least 0"});
        return errors;
    }

    std::vector<Error> inRegion(std::vector<Error> errors) const {
        for (Error& error : errors)
            error.field = description_.field + ".region" + (error.field.empty() ? "" : "." + error.field);
        return errors;
    }

    /// The user's or the default, but so large that the weld distance is negligible against the gap of closed
    /// faces (1e-4 of a block).
    double minThickness() const {
        double spacing = kInfinity;
        for (const JointSet& set : description_.sets) spacing = std::min(spacing, set.spacing);
        const double fallback =
            std::min(kThinSpacing * spacing, kThinExtent * surfaceExtent(description_.region));
        return std::max(description_.min_thickness.value_or(fallback),
                        kThinWelds * weldDistance(description_.region));
    }

    std::optional<Error> cutBy(const JointPlane& joint, const Knife& knife, CutTree& tree) {
        const auto index = static_cast<std::int32_t>(planes_.size());
        planes_.push_back(joint.plane);
        Tally& tally = tallies_[joint.joint];
        const Reach* reach = joint.reach ? &*joint.reach : nullptr;
        std::optional<Error> error;
        tree.visit(joint.plane, reach, knife.vertices.weld(), [&](const Solid& solid) {
            if (error) return std::vector<Solid>{};
            CutOutcome outcome = cutSolid(solid, index, reach, knife);
            if (outcome.kind == CutOutcome::Kind::cut) ++tally.cuts;
            if (outcome.kind == CutOutcome::Kind::sliver) error = onSliver(joint, outcome, tally);
            if (tree.size() + outcome.parts.size() > description_.max_blocks) error = onTooMany(joint);
            if (stopped()) error = interrupted();
            return std::move(outcome.parts);
        });
        return error;
    }

    std::optional<Error> onSliver(const JointPlane& joint, const CutOutcome& outcome, Tally& tally) const {
        if (tally.left_out++ == 0) {
            tally.first_place = outcome.place;
            tally.first_thickness = outcome.thinnest;
        }
        if (!description_.refuse_slivers) return std::nullopt;
        return Error{fieldOf(description_, joint.joint),
                     "found a cut that leaves a sliver " + text(outcome.thinnest) + " m thick near " +
                         text(outcome.place) + ", allowed: at least min_thickness, " +
                         text(result_.min_thickness) + " m, or slivers = \"merge\""};
    }

    double mostExpected() const { return kTimesExpected * static_cast<double>(description_.max_blocks); }

    /// The number of blocks; counting stops where the number is refused.
    double expect(const std::vector<JointPlane>& joints) const {
        const auto [min, max] = boundsOf(description_.region);
        return expectedBlocks(joints, min, max, result_.region_volume, mostExpected());
    }

    /// Far too many are refused before they fill the memory.
    std::optional<Error> tooMany(double expected, const std::vector<JointPlane>& joints) const {
        if (!(expected > mostExpected())) return std::nullopt;
        return Error{fieldOfMost(joints), "found joints that cut the region into about " + text(expected) +
                                              " blocks or more (" + text(kBytesPerBlock * expected / 1e9) +
                                              " GB of memory, " + timeText(expected) +
                                              "), allowed: " + allowedBlocks()};
    }

    static std::string timeText(double blocks) {
        const double seconds = kSecondsPerBlock * blocks;
        return seconds < 60 ? "less than a minute to cut"
                            : "some " + roundText(std::ceil(seconds / 60)) + " min to cut";
    }

    void tell(std::size_t joint, std::size_t joints, std::size_t blocks, double expected) const {
        if (!description_.progress) return;
        description_.progress(
            {"cutting", static_cast<double>(joint) / static_cast<double>(joints),
             std::to_string(blocks) + " of some " + roundText(expected) + " blocks, " + timeText(expected)});
    }

    /// Of the joint set that has the most planes; the rock mass' own when single joints are more.
    std::string fieldOfMost(const std::vector<JointPlane>& joints) const {
        std::vector<std::size_t> planes(description_.sets.size() + 1);
        for (const JointPlane& joint : joints) ++planes[std::min(joint.joint, description_.sets.size())];
        const auto most =
            static_cast<std::size_t>(std::max_element(planes.begin(), planes.end()) - planes.begin());
        return most < description_.sets.size() ? description_.sets[most].field + ".spacing"
                                               : description_.field;
    }

    std::string allowedBlocks() const {
        return "at most max_blocks, " + std::to_string(description_.max_blocks) +
               "; use a wider spacing, a smaller region, or a larger max_blocks";
    }

    bool stopped() const {
        return description_.stop != nullptr && description_.stop->load(std::memory_order_relaxed);
    }
    Error interrupted() const { return {description_.field, "interrupted while it was cut"}; }

    Error onTooMany(const JointPlane& joint) const {
        return {fieldOf(description_, joint.joint), "found more than " +
                                                        std::to_string(description_.max_blocks) +
                                                        " blocks so far, allowed: " + allowedBlocks()};
    }

    void warnOfCuts() {
        for (std::size_t joint = 0; joint < tallies_.size();) {
            // Discs of a network are reported together.
            std::size_t next = joint + 1, idle = 0;
            Tally tally = tallies_[joint];
            for (; next < tallies_.size() && isOfNetwork(next) &&
                   fieldOf(description_, next) == fieldOf(description_, joint);
                 ++next)
                add(tallies_[next], tally);
            for (std::size_t k = joint; k < next; ++k) idle += tallies_[k].cuts + tallies_[k].left_out == 0;
            // Sets that end at another set cover the region's box, beyond the region, too.
            if (isOfNetwork(joint) && !isDisc(joint) && idle < next - joint) idle = 0;
            warnOf(titleOf(description_, joint), tally, idle, next - joint, isDisc(joint));
            joint = next;
        }
    }

    bool isOfNetwork(std::size_t joint) const {
        const std::size_t sets = description_.sets.size();
        return joint >= sets && description_.singles[joint - sets].of_network;
    }

    bool isDisc(std::size_t joint) const {
        return isOfNetwork(joint) && description_.singles[joint - description_.sets.size()].radius;
    }

    static void add(const Tally& other, Tally& sum) {
        if (sum.left_out == 0)
            sum.first_place = other.first_place, sum.first_thickness = other.first_thickness;
        sum.cuts += other.cuts;
        sum.left_out += other.left_out;
    }

    void warnOf(const std::string& title, const Tally& tally, std::size_t idle, std::size_t count,
                bool discs) {
        if (tally.cuts == 0) result_.idle_joints.push_back(title);
        if (tally.left_out > 0)
            result_.warnings.push_back(title + ": " + std::to_string(tally.left_out) +
                                       (tally.left_out == 1 ? " cut was" : " cuts were") +
                                       " left out, because a part would be thinner than " +
                                       text(result_.min_thickness) + " m; the first near " +
                                       text(tally.first_place) + ", " + text(tally.first_thickness) +
                                       " m thick");
        if (discs && idle > 0)
            result_.warnings.push_back(title + ": " + std::to_string(idle) + " of " + std::to_string(count) +
                                       " discs cut no block");
        else if (idle > 0)
            result_.warnings.push_back(title + ": cuts no block");
    }

    /// A solid with its place in the order of blocks.
    struct Ranked {
        /// z, x, y of the centroid in steps of the least difference that counts
        std::array<std::int64_t, 3> level;
        const Solid* solid;
    };

    std::vector<Ranked> ranked(const CutTree& tree, const Knife& knife) const {
        const double step = kSameLevel * surfaceExtent(description_.region);
        std::vector<Ranked> order;
        for (const Solid& solid : tree.solids()) {
            Vec3 centroid = Vec3::Zero();
            double total = 0;
            for (const Cell& piece : solid.pieces) {
                const double share = volume(piece, knife.vertices);
                centroid += share * centre(piece, knife.vertices);
                total += share;
            }
            centroid /= total;
            order.push_back({{std::llround(centroid.z() / step), std::llround(centroid.x() / step),
                              std::llround(centroid.y() / step)},
                             &solid});
        }
        std::stable_sort(order.begin(), order.end(),
                         [](const Ranked& a, const Ranked& b) { return a.level < b.level; });
        return order;
    }

    FaceOrigin originOf(const CellFace& face) const {
        const Plane& plane = planes_[static_cast<std::size_t>(face.plane)];
        return {plane.source, plane.number};
    }

    Result<CutBlock> blockOf(const Solid& solid, const VertexTable& vertices) const {
        auto shape = shapeOf(solid, vertices);
        if (!shape)
            return Error{description_.field, "a block near " + text(0.5 * (solid.min + solid.max)) + ": " +
                                                 shape.errors()[0].message};
        CutBlock block{std::move(*shape), {}, 0};
        for (const Cell& piece : solid.pieces)
            for (const CellFace& face : piece.faces) block.origin.push_back(originOf(face));
        block.volume = massProperties(block.shape).volume;
        return block;
    }

    Result<CutRockMass> collect(const CutTree& tree, const Knife& knife) {
        constexpr std::size_t kTold = 1024;  // blocks from report to report
        result_.blocks.reserve(tree.size());
        for (const Ranked& ranked : ranked(tree, knife)) {
            if (stopped()) return interrupted();
            if (description_.progress && result_.blocks.size() % kTold == 0) {
                description_.progress(
                    {"shaping", static_cast<double>(result_.blocks.size()) / static_cast<double>(tree.size()),
                     std::to_string(tree.size()) + " blocks"});
            }
            auto block = blockOf(*ranked.solid, knife.vertices);
            if (!block) return block.errors();
            result_.volume += block->volume;
            result_.blocks.push_back(std::move(*block));
        }
        if (!(std::abs(result_.volume - result_.region_volume) <= kVolumeTolerance * result_.region_volume))
            return Error{description_.field,
                         "the blocks' volumes add up to " + text(result_.volume) +
                             " m3, the "
                             "region's is " +
                             text(result_.region_volume) +
                             " m3: joints are too nearly parallel for such large coordinates"};
        return std::move(result_);
    }

    const RockMass& description_;
    std::vector<Plane> planes_;
    std::vector<Tally> tallies_;
    CutRockMass result_;
};

}  // namespace

Result<CutRockMass> cutRockMass(const RockMass& description) { return Cutter(description).run(); }

Result<std::vector<CutPlane>> cuttingPlanes(const RockMass& description) {
    if (auto errors = checkJoints(description); !errors.empty()) return errors;
    const auto joints = jointPlanes(description, description.region.vertices);
    if (!joints) return joints.errors();
    std::vector<CutPlane> planes;
    for (const JointPlane& joint : *joints)
        if (meets(joint, description.region)) planes.push_back({joint.plane.normal, joint.joint});
    return planes;
}

Result<Polyhedron> solidOf(const TriangleSurface& surface) {
    if (auto errors = checkSurface(surface); !errors.empty()) return errors;
    std::vector<Plane> planes;
    VertexTable vertices(weldDistance(surface));
    auto cells = decompose(surface, planes, vertices);
    if (!cells) return cells.errors();
    const std::vector<Solid> solids = joined(std::move(*cells), Knife{planes, vertices});
    if (solids.size() > 1)
        return Error{"", "found a surface around " + std::to_string(solids.size()) +
                             " separate bodies, allowed: one body"};
    return shapeOf(solids[0], vertices);
}

}  // namespace talus
