#include "mesh/point_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "toml/wording.h"

namespace talus::formats::mesh {

namespace {

using toml::numberText;

/// The cells from the first to the last one with a point, along x and y.
struct Bounds {
    Eigen::Vector2d first, last;  ///< whole numbers of cells from the origin
};

Bounds boundsOf(const std::vector<Vec3>& points, double cell) {
    Bounds bounds{Eigen::Vector2d::Constant(INFINITY), Eigen::Vector2d::Constant(-INFINITY)};
    for (const Vec3& p : points) {
        const Eigen::Vector2d at = (p.head<2>() / cell).array().floor();
        bounds.first = bounds.first.cwiseMin(at);
        bounds.last = bounds.last.cwiseMax(at);
    }
    return bounds;
}

/// Mean or median of some heights, which it may reorder.
double heightOf(std::vector<double>& heights, bool median) {
    if (!median) {
        double sum = 0;
        for (const double z : heights) sum += z;
        return sum / static_cast<double>(heights.size());
    }
    std::sort(heights.begin(), heights.end());
    const std::size_t middle = heights.size() / 2;
    return heights.size() % 2 == 1 ? heights[middle] : 0.5 * (heights[middle - 1] + heights[middle]);
}

class Thinner {
 public:
    Thinner(const std::vector<Vec3>& points, const Thinning& thinning)
        : points_(points), thinning_(thinning) {}

    PointGrid run() {
        layOut();
        fill();
        noteEmpty();
        keepLargest();
        while (partCorners()) keepLargest();
        dropUnused();
        if (left_out_ > 0) {
            grid_.notes.push_back("has " + std::to_string(left_out_) +
                                  " cells that touch the others at a corner, or not at all, and are left "
                                  "out, the first at " +
                                  placeText(first_left_out_));
        }
        return std::move(grid_);
    }

 private:
    void layOut() {
        const Bounds bounds = boundsOf(points_, thinning_.cell);
        grid_.columns = static_cast<std::size_t>(bounds.last.x() - bounds.first.x()) + 1;
        grid_.rows = static_cast<std::size_t>(bounds.last.y() - bounds.first.y()) + 1;
        first_ = bounds.first;
        grid_.south_west = (first_ + Eigen::Vector2d(0.5, 0.5)) * thinning_.cell;
        grid_.filled.assign(grid_.columns * grid_.rows, false);
        grid_.heights.assign(grid_.columns * grid_.rows, 0);
    }

    std::size_t cellOf(const Vec3& p) const {
        const Eigen::Vector2d at = (p.head<2>() / thinning_.cell).array().floor() - first_.array();
        return (grid_.rows - 1 - static_cast<std::size_t>(at.y())) * grid_.columns +
               static_cast<std::size_t>(at.x());
    }

    void fill() {
        std::vector<std::pair<std::size_t, double>> heights;  // by cell, those of one in the file's order
        heights.reserve(points_.size());
        for (const Vec3& p : points_) heights.emplace_back(cellOf(p), p.z());
        std::stable_sort(heights.begin(), heights.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<double> own;
        for (std::size_t i = 0; i < heights.size();) {
            const std::size_t cell = heights[i].first;
            own.clear();
            for (; i < heights.size() && heights[i].first == cell; ++i) own.push_back(heights[i].second);
            grid_.filled[cell] = true;
            grid_.heights[cell] = heightOf(own, thinning_.median);
        }
    }

    std::string placeText(std::size_t cell) const {
        const auto column = static_cast<double>(cell % grid_.columns);
        const std::size_t from_north = cell / grid_.columns;
        const auto row = static_cast<double>(grid_.rows - 1 - from_north);
        return "(" + numberText(grid_.south_west.x() + column * thinning_.cell) + ", " +
               numberText(grid_.south_west.y() + row * thinning_.cell) + ")";
    }

    void noteEmpty() {
        std::string note = "was thinned from " + std::to_string(points_.size()) + " points to a grid of " +
                           std::to_string(grid_.columns) + " x " + std::to_string(grid_.rows) +
                           " cells, each with the " + (thinning_.median ? "median" : "mean") +
                           " height of its points";
        const auto empty =
            static_cast<std::size_t>(std::count(grid_.filled.begin(), grid_.filled.end(), false));
        if (empty > 0) {
            const auto first = std::find(grid_.filled.begin(), grid_.filled.end(), false);
            note += "; " + std::to_string(empty) + (empty == 1 ? " cell has" : " cells have") +
                    " no point, the first at " +
                    placeText(static_cast<std::size_t>(first - grid_.filled.begin()));
        }
        grid_.notes.push_back(std::move(note));
    }

    // --- squares between four cells: their north-western cell stands for them
    std::size_t squares() const { return (grid_.columns - 1) * (grid_.rows - 1); }
    std::size_t cornerOf(std::size_t square) const {
        return square / (grid_.columns - 1) * grid_.columns + square % (grid_.columns - 1);
    }
    bool isWhole(std::size_t row, std::size_t column) const {
        const std::size_t nw = row * grid_.columns + column;
        return grid_.filled[nw] && grid_.filled[nw + 1] && grid_.filled[nw + grid_.columns] &&
               grid_.filled[nw + grid_.columns + 1];
    }

    /// Squares that hang together by their sides; of the others, whose cells have no other square, the cells
    /// are emptied.
    void keepLargest() {
        if (grid_.columns < 2 || grid_.rows < 2) return;
        const std::size_t across = grid_.columns - 1, up = grid_.rows - 1;
        std::vector<std::int32_t> piece(squares(), -1);
        std::vector<std::size_t> sizes, open;
        for (std::size_t start = 0; start < piece.size(); ++start) {
            if (piece[start] >= 0 || !isWhole(start / across, start % across)) continue;
            const auto own = static_cast<std::int32_t>(sizes.size());
            sizes.push_back(0);
            piece[start] = own;
            for (open.assign(1, start); !open.empty();) {
                const std::size_t square = open.back(), row = square / across, column = square % across;
                open.pop_back();
                ++sizes.back();
                const auto visit = [&](std::size_t r, std::size_t c) {
                    if (piece[r * across + c] >= 0 || !isWhole(r, c)) return;
                    piece[r * across + c] = own;
                    open.push_back(r * across + c);
                };
                if (row > 0) visit(row - 1, column);
                if (row + 1 < up) visit(row + 1, column);
                if (column > 0) visit(row, column - 1);
                if (column + 1 < across) visit(row, column + 1);
            }
        }
        if (sizes.empty()) return;
        const auto largest =
            static_cast<std::int32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
        for (std::size_t square = 0; square < piece.size(); ++square)
            if (piece[square] >= 0 && piece[square] != largest) emptyOneCell(square, piece, largest);
    }

    /// One cell that no square of the largest piece has is enough to take the square out.
    void emptyOneCell(std::size_t square, const std::vector<std::int32_t>& piece, std::int32_t largest) {
        const std::size_t across = grid_.columns - 1, up = grid_.rows - 1;
        const auto isOfLargest = [&](std::size_t row, std::size_t column) {  // the cell
            for (const std::size_t r : {row, row - 1}) {
                for (const std::size_t c : {column, column - 1})
                    if (r < up && c < across && piece[r * across + c] == largest) return true;
            }
            return false;
        };
        for (const std::size_t r : {square / across, square / across + 1}) {
            for (const std::size_t c : {square % across, square % across + 1})
                if (!isOfLargest(r, c)) return empty(r * grid_.columns + c);
        }
    }

    /// Where four squares meet and only two opposite ones are whole, the surface would be joined in a point
    /// only. \return whether there was such a place
    bool partCorners() {
        bool any = false;
        for (std::size_t row = 1; row + 1 < grid_.rows; ++row) {
            for (std::size_t column = 1; column + 1 < grid_.columns; ++column) {
                const bool nw = isWhole(row - 1, column - 1), ne = isWhole(row - 1, column);
                const bool sw = isWhole(row, column - 1), se = isWhole(row, column);
                if (nw != se || ne != sw || nw == ne) continue;
                empty(row * grid_.columns + column);
                any = true;
            }
        }
        return any;
    }

    void empty(std::size_t cell) {
        if (!grid_.filled[cell]) return;
        if (left_out_++ == 0) first_left_out_ = cell;
        grid_.filled[cell] = false;
    }

    /// Cells without a square.
    void dropUnused() {
        const std::vector<bool> filled = grid_.filled;
        for (std::size_t cell = 0; cell < filled.size(); ++cell) {
            if (!filled[cell]) continue;
            const std::size_t row = cell / grid_.columns, column = cell % grid_.columns;
            bool used = false;
            for (const std::size_t r : {row, row - 1}) {
                for (const std::size_t c : {column, column - 1})
                    used = used || (r < grid_.rows - 1 && c < grid_.columns - 1 && isWholeIn(filled, r, c));
            }
            if (!used) empty(cell);
        }
    }

    bool isWholeIn(const std::vector<bool>& filled, std::size_t row, std::size_t column) const {
        const std::size_t nw = row * grid_.columns + column;
        return filled[nw] && filled[nw + 1] && filled[nw + grid_.columns] && filled[nw + grid_.columns + 1];
    }

    const std::vector<Vec3>& points_;
    const Thinning& thinning_;
    PointGrid grid_;
    Eigen::Vector2d first_;  ///< cell in the south-west, in cells from the origin
    std::size_t left_out_ = 0, first_left_out_ = 0;
};

}  // namespace

double cellsOver(const std::vector<Vec3>& points, double cell) {
    const Bounds bounds = boundsOf(points, cell);
    return (bounds.last.x() - bounds.first.x() + 1) * (bounds.last.y() - bounds.first.y() + 1);
}

PointGrid thinned(const std::vector<Vec3>& points, const Thinning& thinning) {
    return Thinner(points, thinning).run();
}

}  // namespace talus::formats::mesh
