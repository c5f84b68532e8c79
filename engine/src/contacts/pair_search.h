#pragma once
// First half of a search: the near pairs of blocks, part by part, and the faces, vertices and edges that may
// touch. The second half (interfaces.cpp) makes interfaces of them.

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

/// Pairs of parts that the previous interfaces give to a search; each list sorted.
struct KnownPairs {
    PartPairs with_places{};        ///< keep their places as long as they are near
    PartPairs bearing{};            ///< keep their patch, however narrow (kLeastShare)
    std::vector<DeepFaces> deep{};  ///< keep their patch, however deep
};

/// Whether even the narrowest patches count (kLeastShare): in histories, and in a model as built.
inline bool narrowPatchesCount(const State& state, bool initial) {
    return initial || state.springs == Springs::keep_energy;
}

/// By block: 1 for the marked ones, for all that may be within `margin` [m] of one, and for some others.
std::vector<char> blocksNear(const State& state, const std::vector<char>& around, double margin);

/// Pairs of the range with places for vertices and edges.
PartPairs pairsWithPlaces(const Geometry& geometry, const Interfaces& interfaces, const SearchRange& range);

/// Pairs of the range in contact by a sliver that is bonded, or that carries a share kBears of the forces on
/// one of their blocks. \pre forces of the interfaces are those of the last step or solve
PartPairs pairsThatBear(const State& state, const SearchRange& range);

/// \pre range.margin > 0 Examines all pairs of parts of different blocks nearer than `range.margin` and
/// passes the findings to `take`, pair by pair in order. It works in pieces: a million blocks have thirteen
/// million pairs, and all findings at once would take more memory than the state.
/// \param initial whether the blocks are as built: then overlaps are looked for
/// \param control    told the share that is done; \return false when it asked to stop: then pairs are missing
/// \param work the work done is added to it; may be null
bool examinePairs(const State& state, const SearchRange& range, const KnownPairs& known, bool initial,
                  bool parallel, const std::function<void(const PairFinding&)>& take,
                  const Control& control = {}, SearchWork* work = nullptr);

}  // namespace talus
