#pragma once
// The half of a search that looks: which pairs of blocks, part by part, are near, and what they may touch
// each other with. The other half (interfaces.cpp) makes interfaces of it.

#include <cstdint>
#include <functional>
#include <vector>

#include "contacts/deep_contacts.h"
#include "contacts/face_pairs.h"
#include "contacts/near_pairs.h"
#include "state/arrays.h"
#include "talus/control.h"

namespace talus {

/// What the search finds for one pair of convex parts of two blocks.
struct PairFinding {
    std::vector<FacePair> faces;  ///< face_a on the reference block
    std::int32_t block_a = 0, block_b = 0;
    std::int32_t part_a = 0, part_b = 0;  ///< as Geometry numbers them
    bool may_meet_by_vertices = false;
    bool overlaps = false;
    double depth = 0;  ///< [m], when they overlap
};

/// What a search knows of pairs of parts by the interfaces before it; each sorted.
struct KnownPairs {
    PartPairs with_places{};        ///< keep their places as long as they are near
    PartPairs bearing{};            ///< keep their patch, however narrow (kLeastShare)
    std::vector<DeepFaces> deep{};  ///< keep their patch, however deep
};

/// Whether patches count however narrow they are (kLeastShare): in histories, and of a model as it was built.
inline bool narrowPatchesCount(const State& state, bool initial) {
    return initial || state.springs == Springs::keep_energy;
}

/// By block: 1 of the marked ones, of all that may be nearer than `margin` [m] to one, and of some beside.
std::vector<char> blocksNear(const State& state, const std::vector<char>& around, double margin);

/// Pairs of the range with places for vertices and edges.
PartPairs pairsWithPlaces(const Geometry& geometry, const Interfaces& interfaces, const SearchRange& range);

/// Pairs of the range that lie on each other by a sliver and are bonded there, or carry there some of what
/// one of their blocks does (kBears). \pre forces of the interfaces are those of the last step or solve
PartPairs pairsThatBear(const State& state, const SearchRange& range);

/// \pre range.margin > 0
/// Examines all pairs of parts of different blocks nearer than `range.margin` and hands what it finds to
/// `take`, pair by pair in order. In pieces: of a million blocks' thirteen million pairs all findings at once
/// would take more memory than the state.
/// \param initial    whether the blocks stand as the model has them: then overlaps are looked for
/// \param control    told the share that is done; \return false when it asked to stop: then pairs are missing
/// \param work       what was looked at is added to it; null: nobody wants to know
bool examinePairs(const State& state, const SearchRange& range, const KnownPairs& known, bool initial,
                  bool parallel, const std::function<void(const PairFinding&)>& take,
                  const Control& control = {}, SearchWork* work = nullptr);

}  // namespace talus
