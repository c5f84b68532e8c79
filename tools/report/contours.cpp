#include "report/contours.h"

#include <array>
#include <map>
#include <tuple>

namespace talus::tools {

namespace {

/// One side of a cell: along x or along y from grid point (i, j).
struct Side {
    std::size_t i, j;
    bool along_x;

    bool operator<(const Side& other) const {
        return std::tie(i, j, along_x) < std::tie(other.i, other.j, other.along_x);
    }
};

class Tracer {
 public:
    Tracer(const Field& field, double level) : field_(field), level_(level) {}

    std::vector<std::vector<Spot>> rings() {
        for (std::size_t j = 0; j + 1 < field_.side; ++j)
            for (std::size_t i = 0; i + 1 < field_.side; ++i) addCell(i, j);
        std::vector<std::vector<Spot>> all;
        while (!next_.empty()) all.push_back(ringFrom(next_.begin()->first));
        return all;
    }

 private:
    bool isAbove(std::size_t i, std::size_t j) const {
        const bool is_inner = i > 0 && j > 0 && i + 1 < field_.side && j + 1 < field_.side;
        return is_inner && field_.at(i, j) > level_;
    }

    /// Counter-clockwise around a cell, a ring begins where one passes from above to below, and ends where
    /// one comes back.
    void addCell(std::size_t i, std::size_t j) {
        const std::array<bool, 4> above{isAbove(i, j), isAbove(i + 1, j), isAbove(i + 1, j + 1),
                                        isAbove(i, j + 1)};
        const std::array<Side, 4> sides{{{i, j, true}, {i + 1, j, false}, {i, j + 1, true}, {i, j, false}}};
        const bool is_saddle = above[0] == above[2] && above[1] == above[3] && above[0] != above[1];
        // At a saddle the middle decides whether the two corners above are one area.
        const double middle =
            0.25 * (field_.at(i, j) + field_.at(i + 1, j) + field_.at(i + 1, j + 1) + field_.at(i, j + 1));
        for (std::size_t k = 0; k < 4; ++k) {
            if (!above[k] || above[(k + 1) % 4]) continue;
            std::size_t end = k;
            if (is_saddle) {
                end = middle > level_ ? (k + 1) % 4 : (k + 3) % 4;
            } else {
                do end = (end + 1) % 4;
                while (above[end] || !above[(end + 1) % 4]);
            }
            next_[sides[k]] = sides[end];
        }
    }

    std::vector<Spot> ringFrom(const Side& start) {
        std::vector<Spot> ring;
        for (auto at = next_.find(start); at != next_.end();) {
            const Side next = at->second;
            ring.push_back(crossing(at->first));
            next_.erase(at);
            at = next_.find(next);
        }
        return ring;
    }

    Spot crossing(const Side& side) const {
        const std::size_t i = side.i + (side.along_x ? 1 : 0), j = side.j + (side.along_x ? 0 : 1);
        const double from = field_.at(side.i, side.j), to = field_.at(i, j);
        const bool is_crossed = (from > level_) != (to > level_);  // not at the border, which counts as below
        const double share = is_crossed ? (level_ - from) / (to - from) : 0.5;
        const Spot a = field_.spot(side.i, side.j), b = field_.spot(i, j);
        return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
    }

    const Field& field_;
    double level_;
    std::map<Side, Side> next_;
};

}  // namespace

Spot Field::spot(std::size_t i, std::size_t j) const {
    const double step = 2 * reach / static_cast<double>(side - 1);
    return {-reach + step * static_cast<double>(i), -reach + step * static_cast<double>(j)};
}

Field sampled(std::size_t side, double reach, const std::function<double(Spot)>& value) {
    Field field{side, reach, {}};
    field.values.reserve(side * side);
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) field.values.push_back(value(field.spot(i, j)));
    return field;
}

std::vector<std::vector<Spot>> ringsAbove(const Field& field, double level) {
    return Tracer(field, level).rings();
}

}  // namespace talus::tools
