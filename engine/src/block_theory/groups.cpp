#include "block_theory/groups.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "block_theory/best_groups.h"
#include "block_theory/body_maker.h"
#include "block_theory/closures.h"
#include "block_theory/directions.h"
#include "block_theory/growth.h"
#include "block_theory/volume_front.h"
#include "state/caller.h"
#include "state/range.h"

namespace talus::keyblocks {
namespace {

/// Most blocks that closures visit, over all directions: some seconds. Closures beyond that are left out and
/// reported.
constexpr std::size_t kMostVisits = 40'000'000;
constexpr std::size_t kLeastVisits = 4;  ///< of a direction, for every block
/// Most blocks in a closure along one block's own direction.
constexpr std::size_t kMostOwn = 1000, kLeastOwn = 20;
/// The weakest groups of each direction that are tested for carried blocks, and the neighbours judged for
/// them in all: one second.
constexpr std::size_t kSettled = 64, kSettlingWork = 1'000'000, kLeastSettlingWork = 2000;
/// Groups that are grown, and blocks visited for that: half a second.
constexpr std::size_t kMostGrown = 32, kGrowthVisits = 2'000'000;
/// Directions between two checks for interruption, and own directions likewise. It is not the number of
/// threads, so the answer does not depend on that.
constexpr std::size_t kDirectionsAtOnce = 8, kOwnAtOnce = 4096;

/// Connected pieces of the blocks that can move.
std::vector<std::vector<std::size_t>> piecesOf(const Slope& slope, const std::vector<char>& can_move) {
    std::vector<std::vector<std::size_t>> pieces;
    Marks marks(slope.size());
    for (std::size_t b = 0; b < slope.size(); ++b) {
        if (!can_move[b] || !marks.mark(b)) continue;
        std::vector<std::size_t> piece{b};
        for (std::size_t k = 0; k < piece.size(); ++k)
            for (const Contact& contact : slope.contactsOf(piece[k])) {
                const auto other = static_cast<std::size_t>(contact.other);
                if (can_move[other] && marks.mark(other)) piece.push_back(other);
            }
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

/// The groups of one direction, or of one share of the own directions.
struct Part {
    explicit Part(std::size_t most) : raw(kSettled), best(most) {}
    BestGroups raw;                ///< as judged
    BestGroups best;               ///< with all that they carry
    VolumeFront raw_curve, curve;  ///< the same two, by volume
    std::size_t judged = 0, left_out = 0, curve_left_out = 0;
};

class Search {
 public:
    Search(const Slope& slope, const std::vector<Joint>& joints, std::size_t most, bool curve, bool parallel,
           const Control& control)
        : slope_(slope),
          joints_(joints),
          most_(std::max(most, kMostGrown)),
          wants_curve_(curve),
          parallel_(parallel),
          control_(control),
          best_(most_),
          directions_(directionsOf(slope)) {}

    GroupSearch run(std::size_t most) {
        stage_ = {0, 0.05};
        lookAt(1, 1, [&](std::size_t, Part& part) { alone(part); });
        stage_ = {0.05, 0.6};
        const std::size_t share = kMostVisits / std::max<std::size_t>(directions_.everywhere.size(), 1);
        const std::size_t visits = std::max(share, kLeastVisits * slope_.size());
        lookAt(directions_.everywhere.size(), kDirectionsAtOnce,
               [&](std::size_t k, Part& part) { along(directions_.everywhere[k], visits, part); });
        stage_ = {0.6, 0.9};
        const std::size_t shares = (directions_.own.size() + kOwnAtOnce - 1) / kOwnAtOnce;
        lookAt(shares, kDirectionsAtOnce, [&](std::size_t k, Part& part) { ofBlocks(k, part); });
        stage_ = {0.9, 1};
        grown();
        found_.directions = directions_.everywhere.size();
        found_.groups = best_.take();
        if (found_.groups.size() > most) found_.groups.resize(most);
        found_.curve = curve_.take();
        return std::move(found_);
    }

 private:
    /// Parts side by side, some at a time, put together in order.
    template <class Body>
    void lookAt(std::size_t count, std::size_t at_once, const Body& body) {
        for (std::size_t first = 0; first < count && !found_.interrupted; first += at_once) {
            const std::size_t n = std::min(at_once, count - first);
            std::vector<Part> parts(n, Part(most_));
            forRange(n, 1, parallel_, [&](Range range) {
                for (std::size_t k = range.begin; k < range.end; ++k) {
                    body(first + k, parts[k]);
                    const std::size_t work = std::max(kSettlingWork / count, kLeastSettlingWork);
                    settle(parts[k], work);
                    if (wants_curve_) settleCurve(parts[k], work);
                }
            });
            for (Part& part : parts) {
                if (wants_curve_) addToCurve(part);
                best_.add(std::move(part.best));
                found_.judged += part.judged;
                found_.left_out += part.left_out;
                found_.curve_left_out += part.curve_left_out;
            }
            found_.interrupted = isStopped(control_);
            report(static_cast<double>(first + n) / static_cast<double>(count));
        }
    }

    void report(double done) const {
        if (control_.progress)
            control_.progress({"groups of blocks", stage_.from + done * (stage_.to - stage_.from),
                               std::to_string(found_.judged) + " groups"});
    }

    void alone(Part& part) {
        BodyMaker maker(slope_, joints_);
        for (std::size_t b = 0; b < slope_.size(); ++b)
            if (slope_.free[b]) judge({b}, maker, part);
    }

    void judge(const std::vector<std::size_t>& members, BodyMaker& maker, Part& part) const {
        Group group = maker.groupOf(members);
        if (wants_curve_ && part.raw_curve.wants(group)) part.raw_curve.add(group);
        part.raw.add(std::move(group));
        ++part.judged;
    }

    /// The weakest first, so that groups left out by the work limit are stronger.
    void settle(Part& part, std::size_t work) const {
        BodyMaker maker(slope_, joints_);
        maker.allow(work);
        std::unordered_set<std::uint64_t> known;
        for (Group& group : part.raw.take()) {
            if (maker.isUsedUp())
                ++part.left_out;
            else
                part.best.add(maker.settled(std::move(group), &known));
        }
    }

    /// The weakest groups of at least their volume. Leaving one out does not affect the list.
    void settleCurve(Part& part, std::size_t work) const {
        BodyMaker maker(slope_, joints_);
        maker.allow(work);
        std::unordered_set<std::uint64_t> known;
        for (Group& group : part.raw_curve.take()) {
            if (maker.isUsedUp())
                ++part.curve_left_out;
            else
                add(maker.settled(std::move(group), &known), part.curve);
        }
    }

    /// The load of carried blocks is not counted, so the factor of a group that carries others is not that of
    /// a failure.
    static void add(Group group, VolumeFront& curve) {
        if (group.carried.empty()) curve.add(std::move(group));
    }

    void addToCurve(Part& part) {
        curve_.add(std::move(part.curve));
        for (const Group& group : part.best.sorted())
            if (curve_.wants(group)) add(group, curve_);
    }

    void along(const Vec3& direction, std::size_t visits, Part& part) const {
        const Movable movable = movableAlong(slope_, direction);
        BodyMaker maker(slope_, joints_);
        Marks marks(slope_.size());
        std::unordered_set<std::uint64_t> known;
        std::vector<std::size_t> members;
        std::size_t k = 0;
        for (; k < movable.seeds.size() && visits > 0; ++k) {
            members = {movable.seeds[k]};
            marks.clear();
            marks.mark(members.front());
            const bool complete = closeOver(slope_, direction, 0, visits, marks, members);
            visits -= std::min(visits, members.size());
            if (!complete)
                ++part.left_out;
            else if (members.size() > 1 && known.insert(BodyMaker::identityOf(members)).second)
                judge(members, maker, part);
        }
        part.left_out += movable.seeds.size() - k;
        for (const auto& piece : piecesOf(slope_, movable.can_move))
            if (piece.size() > 1) judge(piece, maker, part);
    }

    void ofBlocks(std::size_t share, Part& part) const {
        const std::size_t most = std::clamp(kMostVisits / directions_.own.size(), kLeastOwn, kMostOwn);
        const std::size_t end = std::min(directions_.own.size(), (share + 1) * kOwnAtOnce);
        BodyMaker maker(slope_, joints_);
        Marks marks(slope_.size());
        std::vector<std::size_t> members;
        for (std::size_t k = share * kOwnAtOnce; k < end; ++k) {
            const OwnDirection& own = directions_.own[k];
            members = {own.block};
            marks.clear();
            marks.mark(own.block);
            if (closeOver(slope_, own.direction, 0, most, marks, members) && members.size() > 1)
                judge(members, maker, part);
            else if (members.size() > most)
                ++part.left_out;
        }
    }

    void grown() {
        std::vector<Group> from = best_.sorted();
        std::erase_if(
            from, [](const Group& group) { return !(group.sliding.factor > 0) || !group.carried.empty(); });
        if (from.size() > kMostGrown) from.resize(kMostGrown);
        lookAt(from.size(), kMostGrown, [&](std::size_t k, Part& part) {
            BodyMaker maker(slope_, joints_);
            maker.allow(kGrowthVisits / from.size() / 4);
            grow(slope_, from[k], kGrowthVisits / from.size(), maker, part.best);
        });
    }

    const Slope& slope_;
    const std::vector<Joint>& joints_;
    std::size_t most_;
    bool wants_curve_, parallel_;
    const Control& control_;
    BestGroups best_;
    VolumeFront curve_{};
    Directions directions_;
    GroupSearch found_{};
    /// Shares of the time, 0..1, measured on a slope of 100,000 blocks.
    struct {
        double from = 0, to = 1;
    } stage_;
};

}  // namespace

GroupSearch leastGroups(const Slope& slope, const std::vector<Joint>& joints, std::size_t most, bool curve,
                        bool parallel, const Control& control) {
    return Search(slope, joints, most, curve, parallel, control).run(most);
}

}  // namespace talus::keyblocks
