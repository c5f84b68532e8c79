#include "block_theory/body_maker.h"

#include <algorithm>

#include "block_theory/tolerances.h"

namespace talus::keyblocks {
namespace {

/// A well mixed number of a block (splitmix64: G. Steele, D. Lea and C. Flood, OOPSLA 2014).
std::uint64_t mixed(std::uint64_t block) {
    std::uint64_t z = (block + 1) * 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

constexpr double kFactorRounding = 1e-9;  ///< of factors
/// Rounds in which a group takes along only the carried blocks that need it most; then all at once, to save
/// time.
constexpr int kOneByOne = 30;

}  // namespace

std::uint64_t BodyMaker::identityOf(const std::vector<std::size_t>& members) {
    std::uint64_t sum = 0;
    for (const std::size_t block : members) sum += mixed(block);
    return sum;
}

Body BodyMaker::bodyOf(const std::vector<std::size_t>& members) {
    inside_.clear();
    for (const std::size_t block : members) inside_.mark(block);
    outer_.clear();
    Body body;
    for (const std::size_t block : members) {
        body.force += slope_.force[block];
        for (const Contact& contact : slope_.contactsOf(block))
            if (!inside_.has(static_cast<std::size_t>(contact.other))) outer_.push_back(contact);
    }
    body.contacts = outer_;
    return body;
}

Group BodyMaker::groupOf(const std::vector<std::size_t>& members) {
    Group group;
    group.sliding = judgeBriefly(bodyOf(members), joints_);
    group.identity = identityOf(members);
    for (const std::size_t block : members) {
        group.mass += slope_.mass[block];
        group.volume += slope_.volume[block];
    }
    if (group.sliding.mode != SlidingMode::none) group.members = members;
    return group;
}

Sliding BodyMaker::detailsOf(const std::vector<std::size_t>& members) {
    return judge(bodyOf(members), joints_);
}

std::vector<std::size_t> BodyMaker::neighboursOf(const std::vector<std::size_t>& members) {
    std::vector<std::size_t> found;
    for (const std::size_t block : members)
        for (const Contact& contact : slope_.contactsOf(block)) {
            const auto other = static_cast<std::size_t>(contact.other);
            if (slope_.free[other] && inside_.mark(other)) found.push_back(other);
        }
    return found;
}

bool BodyMaker::leansOnInside(std::size_t block) const {
    const Vec3& force = slope_.force[block];
    const auto contacts = slope_.contactsOf(block);
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
        return inside_.has(static_cast<std::size_t>(contact.other)) &&
               force.dot(contact.normal) < -kNoForce * force.norm();
    });
}

double BodyMaker::factorWithoutInside(std::size_t block) {
    outer_.clear();
    for (const Contact& contact : slope_.contactsOf(block))
        if (!inside_.has(static_cast<std::size_t>(contact.other))) outer_.push_back(contact);
    return judgeBriefly({slope_.force[block], outer_}, joints_).factor;
}

BodyMaker::Carried BodyMaker::carriedBy(const Group& group) {
    constexpr std::size_t kMembersPerNeighbour = 8;  // marked while a neighbour is judged
    work_left_ -= std::min(work_left_, group.members.size() / kMembersPerNeighbour);
    bodyOf(group.members);
    seen_.clear();
    Carried carried;
    for (const std::size_t member : group.members)
        for (const Contact& contact : slope_.contactsOf(member)) {
            const auto other = static_cast<std::size_t>(contact.other);
            if (!slope_.free[other] || inside_.has(other) || !seen_.mark(other)) continue;
            if (!leansOnInside(other)) continue;
            work_left_ -= std::min<std::size_t>(work_left_, 1);
            const double factor = factorWithoutInside(other);
            if (factor < group.sliding.factor * (1 - kFactorRounding)) carried.emplace_back(other, factor);
        }
    return carried;
}

Group BodyMaker::settled(Group group, std::unordered_set<std::uint64_t>* known) {
    for (int turn = 0; group.sliding.mode != SlidingMode::none; ++turn) {
        if (known != nullptr && !known->insert(group.identity).second) return Group{};
        const Carried carried = carriedBy(group);
        if (isUsedUp()) return Group{};
        if (carried.empty()) return group;
        double least = kInfinity;
        for (const auto& [block, factor] : carried) least = std::min(least, factor);
        // With the blocks that need it most the group may be too weak to carry others.
        const double most = turn < kOneByOne ? least * (1 + kFactorRounding) : kInfinity;
        std::vector<std::size_t> members = group.members;
        seen_.clear();
        for (const std::size_t block : members) seen_.mark(block);
        for (const auto& [block, factor] : carried)
            if (factor <= most && seen_.mark(block)) members.push_back(block);
        const bool moves =
            closeOver(slope_, group.sliding.direction, group.members.size(), slope_.size(), seen_, members);
        Group larger = moves ? groupOf(members) : Group{};
        if (larger.sliding.mode == SlidingMode::none) {
            for (const auto& [block, factor] : carried) group.carried.push_back(block);
            return group;
        }
        group = std::move(larger);
    }
    return group;
}

}  // namespace talus::keyblocks
