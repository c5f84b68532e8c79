#include "forces/bolts.h"

#include <algorithm>
#include <cmath>

#include "forces/bolt_law.h"
#include "geometry/face_frame.h"

namespace talus::bolts {
namespace {

constexpr double kInReach = 1e-3;  // of the block's size: a head that far outside is on it
constexpr double kGrazed = 1e-9;   // of the bolt's length: it only grazes a block

/// The part of a bolt inside a block: from one length along it to another [m].
struct Chord {
    std::int32_t block = 0;
    double from = 0, to = 0;
};

/// Where a point of the model lies in a block's own frame, at the start.
Vec3 inBlock(const State& state, std::size_t block, const Vec3& point) {
    const Geometry& geometry = *state.geometry;
    return geometry.initial_orientation.matrix(block).transpose() *
           (point - geometry.origin - geometry.initial_position.get(block));
}

/// Of one convex part of a block. Empty when from >= to.
Chord chordOf(const State& state, std::size_t block, const Polyhedron& shape, const Bolt& bolt) {
    const double length = (bolt.end - bolt.head).norm(), slack = kInReach * state.geometry->size[block];
    const Vec3 head = inBlock(state, block, bolt.head);
    const Vec3 along = (inBlock(state, block, bolt.end) - head) / length;
    Chord chord{static_cast<std::int32_t>(block), -slack, length + slack};
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const FaceFrame face = faceFrame(shape, f);
        const double height = face.height(head), slope = face.e3.dot(along);
        if (std::abs(slope) < 1e-12) {
            if (height > 0) return {};
            continue;
        }
        const double at = -height / slope;
        (slope > 0 ? chord.to : chord.from) = slope > 0 ? std::min(chord.to, at) : std::max(chord.from, at);
    }
    return chord;
}

/// Through a block, in pieces where it leaves the block and comes back. A seam between two parts is no gap.
void appendChords(const State& state, std::size_t block, const Bolt& bolt, double least,
                  std::vector<Chord>& chords) {
    std::vector<Chord> own;
    for (const Polyhedron& part : partsOf(state.geometry->shape[block])) {
        const Chord chord = chordOf(state, block, part, bolt);
        if (chord.to - chord.from > least) own.push_back(chord);
    }
    std::sort(own.begin(), own.end(), [](const Chord& a, const Chord& b) { return a.from < b.from; });
    const std::size_t first = chords.size();
    for (const Chord& chord : own) {
        const bool goes_on = chords.size() > first && chord.from - chords.back().to <= least;
        if (goes_on)
            chords.back().to = std::max(chords.back().to, chord.to);
        else
            chords.push_back(chord);
    }
}

/// The blocks that a bolt crosses, from its head on.
std::vector<Chord> chordsOf(const State& state, const Bolt& bolt) {
    const double least = kGrazed * (bolt.end - bolt.head).norm();
    const Vec3 middle = 0.5 * (bolt.head + bolt.end) - state.geometry->origin;
    const double half = 0.5 * (bolt.end - bolt.head).norm();
    std::vector<Chord> chords;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const double reach = state.geometry->radius[b] * (1 + kInReach) + half;
        if ((state.geometry->initial_position.get(b) - middle).norm() > reach) continue;
        appendChords(state, b, bolt, least, chords);
    }
    std::sort(chords.begin(), chords.end(),
              [](const Chord& a, const Chord& b) { return a.from + a.to < b.from + b.to; });
    return chords;
}

std::string placeText(const Vec3& place) {
    char text[96];
    std::snprintf(text, sizeof text, "(%g, %g, %g)", place.x(), place.y(), place.z());
    return text;
}

/// Finds the segments of all bolts.
class Build {
 public:
    explicit Build(State& state) : state_(state), model_(state.geometry->model) {}

    std::vector<Error> run() {
        for (std::size_t k = 0; k < model_.bolts.size(); ++k) add(static_cast<std::int32_t>(k));
        state_.bolts.memory.resize(state_.bolts.size());
        state_.bolts.force.assign(state_.bolts.size(), Vec3::Zero());
        state_.bolts.place.assign(state_.bolts.size(), Vec3::Zero());
        if (holding_nothing_ > 0)
            state_.warnings.push_back(std::to_string(holding_nothing_) +
                                      " bolts of patterns cross no joint of a free block and hold nothing");
        return std::move(errors_);
    }

 private:
    const std::string& nameOf(std::int32_t block) const {
        return model_.blocks[static_cast<std::size_t>(block)].name;
    }

    bool isFree(std::int32_t block) const {
        return state_.blocks.motion[static_cast<std::size_t>(block)] == Motion::free;
    }

    double slackAt(std::int32_t block) const {
        return 2 * kInReach * state_.geometry->size[static_cast<std::size_t>(block)];
    }

    void refuse(const Bolt& bolt, const char* key, std::string message) {
        if (bolt.must_hold && !model_.is_remainder)
            errors_.push_back({bolt.field + key, std::move(message)});
        else
            ++holding_nothing_;
    }

    void add(std::int32_t index) {
        const Bolt& bolt = model_.bolts[static_cast<std::size_t>(index)];
        const double length = (bolt.end - bolt.head).norm();
        const std::vector<Chord> chords = chordsOf(state_, bolt);
        if (chords.empty() || chords.front().from > slackAt(chords.front().block))
            return refuse(bolt, ".head",
                          "found " + placeText(bolt.head) +
                              ", outside of every block; allowed: a place in a block or on its face");
        if (chords.back().to < length - slackAt(chords.back().block))
            return refuse(bolt, ".end",
                          "found " + placeText(bolt.end) +
                              ", outside of every block; allowed: a place in a block or on its face");
        if (chords.size() == 1)
            return refuse(bolt, ".end",
                          "found head and end both in block \"" + nameOf(chords.front().block) +
                              "\"; allowed: a bolt that reaches another block");
        const std::size_t before = state_.bolts.size();
        bolt.grouted ? addGrouted(index, bolt, chords) : addAnchored(index, bolt, chords);
        if (state_.bolts.size() == before)
            refuse(bolt, ".end",
                   "found no free block that it ties to another; allowed: a head or an end in one");
    }

    /// \param from, to  lengths along the bolt of its two ends [m]
    void push(std::int32_t index, const Bolt& bolt, const Chord& a, const Chord& b, double from, double to,
              const BoltLaw& law) {
        if (a.block == b.block || (!isFree(a.block) && !isFree(b.block))) return;
        const Vec3 along = (bolt.end - bolt.head).normalized();
        const auto block_a = static_cast<std::size_t>(a.block);
        BoltSegment segment{.bolt = index, .block_a = a.block, .block_b = b.block, .law = law};
        segment.at_a = inBlock(state_, block_a, bolt.head + from * along);
        segment.at_b = inBlock(state_, static_cast<std::size_t>(b.block), bolt.head + to * along);
        if (bolt.grouted)
            segment.axis = state_.geometry->initial_orientation.matrix(block_a).transpose() * along;
        segment.length = to - from;
        state_.bolts.segments.push_back(std::move(segment));
    }

    static BoltLaw lawOf(const Bolt& bolt) {
        return {.stiffness = 0,
                .rigidity = bolt.modulus * bolt.area,
                .pretension = bolt.pretension,
                .yield = bolt.yield_force,
                .bond = kInfinity,
                .rupture_strain = bolt.rupture_strain,
                .dowel_stiffness = 0,
                .dowel_strength = 0};
    }

    void addAnchored(std::int32_t index, const Bolt& bolt, const std::vector<Chord>& chords) {
        const double length = (bolt.end - bolt.head).norm();
        BoltLaw law = lawOf(bolt);
        law.stiffness = law.rigidity / length;
        push(index, bolt, chords.front(), chords.back(), 0, length, law);
    }

    /// A segment at each joint it crosses, bonded over its length in the blocks on either side.
    void addGrouted(std::int32_t index, const Bolt& bolt, const std::vector<Chord>& chords) {
        const double length = (bolt.end - bolt.head).norm();
        const auto inRock = [&](const Chord& c) { return std::min(c.to, length) - std::max(c.from, 0.0); };
        double before = 0, after = 0;
        for (const Chord& chord : chords) after += inRock(chord);
        for (std::size_t k = 0; k + 1 < chords.size(); ++k) {
            before += inRock(chords[k]);
            after -= inRock(chords[k]);
            double from = std::min(chords[k].to, length), to = std::max(chords[k + 1].from, 0.0);
            if (from > to) from = to = 0.5 * (from + to);
            push(index, bolt, chords[k], chords[k + 1], from, to, groutedLaw(bolt, before, after));
        }
    }

    static BoltLaw groutedLaw(const Bolt& bolt, double before, double after) {
        BoltLaw law = lawOf(bolt);
        law.stiffness =
            bolt::inSeries(bolt::embeddedStiffness(law.rigidity, bolt.bond_stiffness, before, bolt.plate),
                           bolt::embeddedStiffness(law.rigidity, bolt.bond_stiffness, after, false));
        law.bond = bolt.bond_strength * (bolt.plate ? after : std::min(before, after));
        law.dowel_stiffness = bolt.shear_stiffness;
        law.dowel_strength = bolt::dowelStrength(bolt.yield_force);
        return law;
    }

    State& state_;
    const Model& model_;
    std::vector<Error> errors_{};
    int holding_nothing_ = 0;
};

/// Compressed rows: twice the segment, plus one where the block is its b.
void makeRows(const State& state, ForceParts& parts) {
    std::vector<std::pair<std::int32_t, std::int32_t>> entries;
    for (std::size_t k = 0; k < state.bolts.size(); ++k) {
        const BoltSegment& segment = state.bolts.segments[k];
        entries.emplace_back(segment.block_a, static_cast<std::int32_t>(2 * k));
        entries.emplace_back(segment.block_b, static_cast<std::int32_t>(2 * k + 1));
    }
    std::sort(entries.begin(), entries.end());
    for (const auto& [block, entry] : entries) {
        if (parts.block.empty() || parts.block.back() != block) {
            parts.block.push_back(block);
            parts.begin.push_back(parts.source.size());
        }
        parts.source.push_back(entry);
    }
    parts.begin.push_back(parts.source.size());
}

/// Calls each(segment, whether the block is its b).
template <class Each>
void eachSegmentOn(const ForceParts& parts, std::size_t block, const Each& each) {
    const auto at =
        std::lower_bound(parts.block.begin(), parts.block.end(), static_cast<std::int32_t>(block));
    if (at == parts.block.end() || static_cast<std::size_t>(*at) != block) return;
    const auto row = static_cast<std::size_t>(at - parts.block.begin());
    for (std::size_t p = parts.begin[row]; p < parts.begin[row + 1]; ++p)
        each(static_cast<std::size_t>(parts.source[p] / 2), parts.source[p] % 2 != 0);
}

/// A segment at two poses: the result of its law, and its point of action.
struct Pull {
    bolt::AxialForce axial;
    bolt::DowelForce dowel;
    BoltMemory memory;  ///< afterwards
    Vec3 along, place;  ///< from a to b, and b's end, model frame
    double apart = 0;   ///< the two ends [m]
};

Pull pullOf(const BoltSegment& segment, BoltMemory memory, double share, const TiedPose& a,
            const TiedPose& b) {
    Pull pull;
    pull.place = b.position + b.turn * segment.at_b;
    const Vec3 apart = pull.place - a.position - a.turn * segment.at_a;
    pull.apart = apart.norm();
    const bool grouted = segment.axis.squaredNorm() > 0;
    pull.along = grouted ? Vec3(a.turn * segment.axis) : Vec3(apart / pull.apart);
    const double elongation = pull.along.dot(apart) - segment.length;
    pull.axial = bolt::axialForce(segment.law, elongation, share, memory);
    if (grouted) {
        const Vec3 own = a.turn.transpose() * apart;
        pull.dowel =
            bolt::dowelForce(segment.law, segment.axis, own - segment.axis.dot(own) * segment.axis, memory);
    }
    pull.memory = memory;
    return pull;
}

TiedPose poseOf(const State& state, std::int32_t block) {
    const auto b = static_cast<std::size_t>(block);
    return {state.blocks.position.get(b), state.blocks.orientation.matrix(b)};
}

Pull pullOf(const State& state, std::size_t k) {
    const BoltSegment& segment = state.bolts.segments[k];
    return pullOf(segment, state.bolts.memory[k], state.load.gravity_share, poseOf(state, segment.block_a),
                  poseOf(state, segment.block_b));
}

}  // namespace

std::vector<Error> build(State& state, ForceParts& parts) {
    std::vector<Error> errors = Build(state).run();
    makeRows(state, parts);
    return errors;
}

void update(State& state) {
    Bolts& bolts = state.bolts;
    for (std::size_t k = 0; k < bolts.size(); ++k) {
        const Pull pull = pullOf(state, k);
        bolts.memory[k] = pull.memory;
        bolts.place[k] = pull.place;
        const Mat3 turn = poseOf(state, bolts.segments[k].block_a).turn;
        bolts.force[k] = pull.memory.broken ? Vec3(Vec3::Zero())
                                            : Vec3(turn * pull.dowel.force - pull.axial.force * pull.along);
    }
}

Wrench on(const State& state, const ForceParts& parts, std::size_t block) {
    Wrench sum;
    const Vec3 centroid = state.blocks.position.get(block);
    eachSegmentOn(parts, block, [&](std::size_t k, bool is_b) {
        const TieForce tie{.force = state.bolts.force[k], .place = state.bolts.place[k]};
        sum += is_b ? tie.onB(centroid) : tie.onA(centroid);
    });
    return sum;
}

std::vector<Tie> ties(const State& state) {
    std::vector<Tie> all;
    for (const BoltSegment& segment : state.bolts.segments) all.push_back({segment.block_a, segment.block_b});
    return all;
}

TieForce between(const State& state, std::size_t k, const TiedPose& a, const TiedPose& b) {
    const Pull pull = pullOf(state.bolts.segments[k], state.bolts.memory[k], state.load.gravity_share, a, b);
    const Mat3 own = a.turn * pull.dowel.slope * a.turn.transpose();
    Mat3 stiffness = own + pull.axial.slope * pull.along * pull.along.transpose();
    if (state.bolts.segments[k].axis.squaredNorm() == 0)  // it turns after its ends
        stiffness += pull.axial.force / pull.apart * (Mat3::Identity() - pull.along * pull.along.transpose());
    return {a.turn * pull.dowel.force - pull.axial.force * pull.along, pull.place, stiffness};
}

std::vector<std::pair<std::int32_t, TieForce>> springsOn(const State& state, const ForceParts& parts,
                                                         std::size_t block) {
    std::vector<std::pair<std::int32_t, TieForce>> springs;
    eachSegmentOn(parts, block, [&](std::size_t k, bool is_b) {
        const BoltSegment& segment = state.bolts.segments[k];
        const Pull pull = pullOf(state, k);
        const Mat3 along = pull.along * pull.along.transpose();
        double across = segment.law.dowel_stiffness;
        if (segment.axis.squaredNorm() == 0) across = segment.law.yield / pull.apart;
        TieForce spring{.place = pull.place};
        spring.stiffness = segment.law.stiffness * along + across * (Mat3::Identity() - along);
        springs.emplace_back(is_b ? segment.block_a : segment.block_b, spring);
    });
    return springs;
}

double storedEnergy(const State& state) {
    double sum = 0;
    for (std::size_t k = 0; k < state.bolts.size(); ++k) {
        const Pull pull = pullOf(state, k);
        if (!pull.memory.broken)
            sum += bolt::storedEnergy(state.bolts.segments[k].law, pull.axial.force, pull.dowel.force);
    }
    return sum;
}

double reach(const State& state) {
    double farthest = 0;
    for (std::size_t k = 0; k < state.bolts.size(); ++k) {
        const BoltLaw& law = state.bolts.segments[k].law;
        const Pull pull = pullOf(state, k);
        if (pull.memory.broken) continue;
        farthest = std::max(farthest, (bolt::axialStrength(law, 1.0) - pull.axial.force) / law.stiffness);
        if (law.dowel_stiffness > 0)
            farthest =
                std::max(farthest, (law.dowel_strength - pull.dowel.force.norm()) / law.dowel_stiffness);
    }
    return farthest;
}

Result<std::vector<TieLimit>> limits(const State& state) {
    std::vector<TieLimit> all;
    for (const BoltSegment& segment : state.bolts.segments) {
        const Bolt& bolt = state.geometry->model.bolts[static_cast<std::size_t>(segment.bolt)];
        if (segment.law.dowel_stiffness > 0)
            return Error{"", "bolt \"" + bolt.name +
                                 "\" has a shear_stiffness; limit analysis needs bolts without it"};
        const TiedPose b = poseOf(state, segment.block_b);
        all.push_back({{segment.block_a, segment.block_b},
                       b.position + b.turn * segment.at_b,
                       (bolt.end - bolt.head).normalized(),
                       bolt::axialStrength(segment.law, 1.0)});
    }
    return all;
}

std::vector<ForceArray> memory(const State& state) {
    if (state.bolts.size() == 0) return {};
    std::vector<ForceArray> arrays{{"yielded", {}}, {"slipped", {}}, {"dowel_x", {}},
                                   {"dowel_y", {}}, {"dowel_z", {}}, {"broken", {}}};
    for (const BoltMemory& memory : state.bolts.memory) {
        const double numbers[] = {memory.yielded,   memory.slipped,   memory.dowel.x(),
                                  memory.dowel.y(), memory.dowel.z(), memory.broken ? 1.0 : 0.0};
        for (std::size_t k = 0; k < arrays.size(); ++k) arrays[k].values.push_back(numbers[k]);
    }
    return arrays;
}

void remember(State& state, std::span<const ForceArray> arrays) {
    if (arrays.empty()) return;
    for (std::size_t k = 0; k < state.bolts.size(); ++k) {
        const auto number = [&](std::size_t array) { return arrays[array].values[k]; };
        state.bolts.memory[k] = {number(0), number(1), Vec3(number(2), number(3), number(4)), number(5) != 0};
    }
}

std::vector<SupportReport> reports(const State& state) {
    enum { kYielded, kSlipped };
    std::vector<SupportReport> all;
    for (const Bolt& bolt : state.geometry->model.bolts)
        all.push_back(
            {.name = bolt.name, .signs = {{"yielded", "yielded"}, {"slipped", "slipped in its grout"}}});
    for (std::size_t k = 0; k < state.bolts.size(); ++k) {
        const BoltSegment& segment = state.bolts.segments[k];
        SupportReport& bolt = all[static_cast<std::size_t>(segment.bolt)];
        const BoltMemory& memory = state.bolts.memory[k];
        const double force = memory.broken ? 0.0 : pullOf(state, k).axial.force;
        bolt.force = std::max(bolt.force, force);
        bolt.utilisation =
            std::max(bolt.utilisation,
                     std::min(1.0, force / bolt::axialStrength(segment.law, state.load.gravity_share)));
        bolt.signs[kYielded].is = bolt.signs[kYielded].is || memory.yielded > 0;
        bolt.signs[kSlipped].is = bolt.signs[kSlipped].is || memory.slipped > 0;
        bolt.broken = bolt.broken || memory.broken;
    }
    return all;
}

SupportLines lines(const State& state) {
    const std::vector<Bolt>& all = state.geometry->model.bolts;
    const std::vector<BoltSegment>& segments = state.bolts.segments;
    const auto inModel = [&](std::int32_t block, const Vec3& own) -> Vec3 {
        const auto b = static_cast<std::size_t>(block);
        const Geometry& geometry = *state.geometry;
        return geometry.origin + geometry.initial_position.get(b) +
               geometry.initial_orientation.matrix(b) * own;
    };
    SupportLines lines;
    lines.point_begin = {0};
    std::size_t k = 0;
    for (std::size_t bolt = 0; bolt < all.size(); ++bolt) {
        lines.name.push_back(all[bolt].name);
        const std::size_t first = k;
        for (; k < segments.size() && static_cast<std::size_t>(segments[k].bolt) == bolt; ++k) {
            const BoltSegment& segment = segments[k];
            if (k == first) lines.add(segment.block_a, all[bolt].head);
            lines.add(segment.block_a, inModel(segment.block_a, segment.at_a));
            lines.add(segment.block_b, inModel(segment.block_b, segment.at_b));
        }
        if (k > first) lines.add(segments[k - 1].block_b, all[bolt].end);
        lines.point_begin.push_back(static_cast<std::int32_t>(lines.block.size()));
    }
    return lines;
}

}  // namespace talus::bolts
