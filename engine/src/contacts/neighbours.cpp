// Pairs of overlapping boxes by grids, one per class of size.
//
// Cell sizes double from class to class. A box belongs to the first class whose cells are not smaller than
// it, and there to the cell of its lower corner. So the lower corners of all boxes of a class that overlap a
// given box lie in the cells from one below its lower corner to that of its upper corner. Each box searches
// its own class (half the cells around it, so that a pair is met once) and all coarser ones. A floor under a
// million blocks is then one lookup per block.
//
// Cells are numbered row by row. Boxes are sorted by cell, so a row of cells is one contiguous run of boxes.

#include "contacts/neighbours.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "state/range.h"

namespace talus {
namespace {

// A cell is slightly larger than its boxes, so that rounding of a cell index (1e-10 at most) cannot hide a
// box that just touches.
constexpr double kSlack = 1.0 + 1e-6;
// Keeps the cell numbers of a row-by-row count inside 64 bits.
constexpr double kMostCellsPerAxis = 1048576;  // 2^20
// Boxes up to this multiple of the median are in the finest class.
constexpr double kTypical = 1.5;
constexpr std::size_t kChunk = 4096;

struct Entry {
    std::uint64_t cell;
    std::int32_t box;
    std::int32_t level;
};

/// One class of size: its grid, and its run [begin, end) of the sorted entries.
struct Level {
    Vec3 cell_size;
    std::uint64_t row = 0, layer = 0;  ///< cells per row and per layer
    std::size_t begin = 0, end = 0;
};

using Cell = std::array<std::int64_t, 3>;

/// Everything the search reads.
struct Grids {
    Vec3 origin;
    std::vector<Level> levels;
    std::vector<Entry> entries;
    std::vector<Box> sorted_boxes;  ///< in the order of the entries

    /// Counted from 1, so that the cell below the first one exists too, and is empty.
    Cell cellOf(const Level& level, const Vec3& point) const {
        Cell cell;
        for (int axis = 0; axis < 3; ++axis)
            cell[axis] = 1 + static_cast<std::int64_t>((point[axis] - origin[axis]) / level.cell_size[axis]);
        return cell;
    }
    static std::uint64_t number(const Level& level, std::int64_t x, std::int64_t y, std::int64_t z) {
        return static_cast<std::uint64_t>(x) + level.row * static_cast<std::uint64_t>(y) +
               level.layer * static_cast<std::uint64_t>(z);
    }
};

template <class Body>
void forEachIndex(std::size_t count, std::size_t grain, bool parallel, const Body& body) {
    forRange(count, grain, parallel, [&](const Range& range) {
        for (std::size_t i = range.begin; i < range.end; ++i) body(i);
    });
}

Box boundsOf(const std::vector<Box>& boxes) {
    Box all;
    for (const Box& box : boxes) all.add(box);
    return all;
}

/// Side of the finest cells along an axis: the largest of the typical boxes.
double finestCell(const std::vector<Box>& boxes, double domain, int axis) {
    std::vector<double> sides(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) sides[i] = boxes[i].max[axis] - boxes[i].min[axis];
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    const double limit = kTypical * *middle;
    double typical = 0;
    for (const double side : sides)
        if (side <= limit) typical = std::max(typical, side);
    const double least = domain / kMostCellsPerAxis;
    const double cell = std::max(typical, least);
    return cell > 0 ? cell : 1.0;  // all boxes are points with one coordinate here
}

int levelOf(const Box& box, const Vec3& finest) {
    int level = 0;
    for (double scale = 1; ((box.max - box.min).array() > scale * finest.array()).any(); scale *= 2) ++level;
    return level;
}

std::vector<Level> makeLevels(const Vec3& finest, const Vec3& domain, int count) {
    std::vector<Level> levels(static_cast<std::size_t>(count));
    double scale = kSlack;
    for (Level& level : levels) {
        level.cell_size = scale * finest;
        const auto cells = [&](int axis) {
            return static_cast<std::uint64_t>(domain[axis] / level.cell_size[axis]) +
                   3;  // one spare on either side
        };
        level.row = cells(0);
        level.layer = level.row * cells(1);
        scale *= 2;
    }
    return levels;
}

void sortEntries(std::vector<Entry>& entries, bool parallel) {
    const auto before = [](const Entry& a, const Entry& b) {
        if (a.level != b.level) return a.level < b.level;
        return a.cell != b.cell ? a.cell < b.cell : a.box < b.box;
    };
    sortRange(entries, parallel, before);
}

Grids buildGrids(const std::vector<Box>& boxes, bool parallel) {
    const Box all = boundsOf(boxes);
    const Vec3 domain = all.max - all.min;
    Vec3 finest;
    for (int axis = 0; axis < 3; ++axis) finest[axis] = finestCell(boxes, domain[axis], axis);

    Grids grids{all.min, {}, std::vector<Entry>(boxes.size()), std::vector<Box>(boxes.size())};
    const double largest = (domain.array() / finest.array()).maxCoeff();
    grids.levels = makeLevels(finest, domain, 2 + std::max(0, std::ilogb(std::max(1.0, largest))));
    forEachIndex(boxes.size(), kChunk, parallel, [&](std::size_t i) {
        const int index = levelOf(boxes[i], finest);
        const Level& level = grids.levels[static_cast<std::size_t>(index)];
        const auto [x, y, z] = grids.cellOf(level, boxes[i].min);
        grids.entries[i] = {Grids::number(level, x, y, z), static_cast<std::int32_t>(i), index};
    });
    sortEntries(grids.entries, parallel);
    forEachIndex(boxes.size(), kChunk, parallel, [&](std::size_t e) {
        grids.sorted_boxes[e] = boxes[static_cast<std::size_t>(grids.entries[e].box)];
    });
    std::size_t e = 0;
    for (std::size_t k = 0; k < grids.levels.size(); ++k) {
        grids.levels[k].begin = e;
        while (e < boxes.size() && static_cast<std::size_t>(grids.entries[e].level) == k) ++e;
        grids.levels[k].end = e;
    }
    return grids;
}

/// Some entries of one level: the unit of parallel work, cut alike for any number of threads.
struct Chunk {
    std::size_t level, begin, end;
};

std::vector<Chunk> cutChunks(const std::vector<Level>& levels) {
    std::vector<Chunk> chunks;
    for (std::size_t k = 0; k < levels.size(); ++k)
        for (std::size_t e = levels[k].begin; e < levels[k].end; e += kChunk)
            chunks.push_back({k, e, std::min(e + kChunk, levels[k].end)});
    return chunks;
}

/// Tests entry `e` against the entries from `from` on, up to the cell `last`.
void testRun(const Grids& grids, std::size_t e, std::size_t from, std::size_t end, std::uint64_t last,
             std::vector<BoxPair>& pairs) {
    for (std::size_t other = from; other < end && grids.entries[other].cell <= last; ++other)
        if (grids.sorted_boxes[e].meets(grids.sorted_boxes[other]))
            pairs.push_back(std::minmax(grids.entries[e].box, grids.entries[other].box));
}

/// First entry of [begin, end) in a cell not before `cell`.
std::size_t firstInCell(const Grids& grids, std::size_t begin, std::size_t end, std::uint64_t cell) {
    const auto first = grids.entries.begin();
    const auto less = [](const Entry& entry, std::uint64_t number) { return entry.cell < number; };
    return static_cast<std::size_t>(std::lower_bound(first + static_cast<std::ptrdiff_t>(begin),
                                                     first + static_cast<std::ptrdiff_t>(end), cell, less) -
                                    first);
}

/// Pairs within one class: the rest of the own cell, the cell after it, and the three cells of four rows
/// after it. Entries are visited in the order of their cells, so the start in each row only moves forward.
void searchOwnLevel(const Grids& grids, const Chunk& chunk, std::vector<BoxPair>& pairs) {
    const Level& level = grids.levels[chunk.level];
    const std::array<std::uint64_t, 4> rows{level.row, level.layer - level.row, level.layer,
                                            level.layer + level.row};
    std::array<std::size_t, 4> start;
    for (std::size_t r = 0; r < rows.size(); ++r)
        start[r] = firstInCell(grids, chunk.begin, level.end, grids.entries[chunk.begin].cell + rows[r] - 1);
    for (std::size_t e = chunk.begin; e < chunk.end; ++e) {
        const std::uint64_t cell = grids.entries[e].cell;
        testRun(grids, e, e + 1, level.end, cell + 1, pairs);
        for (std::size_t r = 0; r < rows.size(); ++r) {
            while (start[r] < level.end && grids.entries[start[r]].cell < cell + rows[r] - 1) ++start[r];
            testRun(grids, e, start[r], level.end, cell + rows[r] + 1, pairs);
        }
    }
}

/// Pairs of one box with the boxes of a coarser class.
void searchCoarserLevel(const Grids& grids, std::size_t e, const Level& level, std::vector<BoxPair>& pairs) {
    const Cell low = grids.cellOf(level, grids.sorted_boxes[e].min);
    const Cell high = grids.cellOf(level, grids.sorted_boxes[e].max);
    for (std::int64_t z = low[2] - 1; z <= high[2]; ++z)
        for (std::int64_t y = low[1] - 1; y <= high[1]; ++y) {
            const std::uint64_t first = Grids::number(level, low[0] - 1, y, z);
            const std::uint64_t last = Grids::number(level, high[0], y, z);
            testRun(grids, e, firstInCell(grids, level.begin, level.end, first), level.end, last, pairs);
        }
}

std::vector<BoxPair> searchChunk(const Grids& grids, const Chunk& chunk) {
    std::vector<BoxPair> pairs;
    searchOwnLevel(grids, chunk, pairs);
    for (std::size_t k = chunk.level + 1; k < grids.levels.size(); ++k) {
        const Level& level = grids.levels[k];
        if (level.begin == level.end) continue;
        for (std::size_t e = chunk.begin; e < chunk.end; ++e) searchCoarserLevel(grids, e, level, pairs);
    }
    return pairs;
}

/// Lexicographic order: counted into the rows of their first box, then each row sorted. Rows are short, and
/// this is several times faster than one big sort.
std::vector<BoxPair> sorted(const std::vector<std::vector<BoxPair>>& lists, std::size_t boxes,
                            bool parallel) {
    std::vector<std::size_t> row_end(boxes + 1, 0);
    for (const auto& list : lists)
        for (const BoxPair& pair : list) ++row_end[static_cast<std::size_t>(pair.first) + 1];
    for (std::size_t i = 1; i <= boxes; ++i) row_end[i] += row_end[i - 1];
    std::vector<BoxPair> pairs(row_end[boxes]);
    // row_end[i] starts as the beginning of row i and ends as its end.
    for (const auto& list : lists)
        for (const BoxPair& pair : list) pairs[row_end[static_cast<std::size_t>(pair.first)]++] = pair;
    forEachIndex(boxes, kChunk, parallel, [&](std::size_t i) {
        const std::size_t begin = i == 0 ? 0 : row_end[i - 1];
        std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(begin),
                  pairs.begin() + static_cast<std::ptrdiff_t>(row_end[i]));
    });
    return pairs;
}

/// One grid over the marked boxes, of which a cell meets one or does not.
class MarkedCells {
 public:
    /// \pre some box is marked
    MarkedCells(const std::vector<Box>& boxes, const std::vector<char>& marked) {
        std::vector<Box> of_marked;
        for (std::size_t i = 0; i < boxes.size(); ++i)
            if (marked[i]) of_marked.push_back(boxes[i]);
        bounds_ = boundsOf(of_marked);
        cells_.assign(static_cast<std::size_t>(kCells * kCells * kCells), 0);
        for (const Box& box : of_marked) {
            anyCell(box, [](char& cell) {
                cell = 1;
                return false;
            });
        }
    }

    bool meet(const Box& box) {
        return box.meets(bounds_) && anyCell(box, [](const char& cell) { return cell != 0; });
    }

 private:
    static constexpr std::int64_t kCells = 32;  // along each axis

    /// Along an axis; the same coordinate is in the same cell, whichever box asks.
    std::int64_t cellAt(double coordinate, int axis) const {
        const double extent = bounds_.max[axis] - bounds_.min[axis];
        const double share = extent > 0 ? (coordinate - bounds_.min[axis]) / extent : 0.0;
        return static_cast<std::int64_t>(std::clamp(share, 0.0, 1.0) * (kCells - 1));
    }

    /// Whether `is` says so of a cell that the box lies in; none after that is asked.
    template <class Is>
    bool anyCell(const Box& box, const Is& is) {
        Cell low, high;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = cellAt(box.min[axis], axis);
            high[axis] = cellAt(box.max[axis], axis);
        }
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t x = low[0]; x <= high[0]; ++x)
                    if (is(cells_[static_cast<std::size_t>((z * kCells + y) * kCells + x)])) return true;
            }
        }
        return false;
    }

    Box bounds_;
    std::vector<char> cells_;
};

}  // namespace

std::vector<char> findNearMarked(const std::vector<Box>& boxes, const std::vector<char>& marked) {
    assert(marked.size() == boxes.size());
    std::vector<char> near(boxes.size(), 0);
    if (std::find(marked.begin(), marked.end(), 1) == marked.end()) return near;
    MarkedCells cells(boxes, marked);
    for (std::size_t i = 0; i < boxes.size(); ++i) near[i] = cells.meet(boxes[i]);
    return near;
}

std::vector<BoxPair> findNeighbours(const std::vector<Box>& boxes, bool parallel) {
    if (boxes.size() < 2) return {};
    const Grids grids = buildGrids(boxes, parallel);
    const std::vector<Chunk> chunks = cutChunks(grids.levels);
    std::vector<std::vector<BoxPair>> lists(chunks.size());
    forEachIndex(chunks.size(), 1, parallel,
                 [&](std::size_t c) { lists[c] = searchChunk(grids, chunks[c]); });
    return sorted(lists, boxes.size(), parallel);
}

}  // namespace talus
