#pragma once
// A linear programme, solved by CLP (COIN-OR): least cost . x with rows and columns within their bounds.

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

namespace talus::limit {

/// Columns one after the other, each with its entries that are not zero.
struct Columns {
    std::vector<double> lower, upper, cost;
    std::vector<int> begin{0};  ///< first entry of each; one more at the end
    std::vector<int> row;
    std::vector<double> value;

    std::size_t size() const { return cost.size(); }
    void entry(int in_row, double of_value) {
        if (of_value == 0) return;
        row.push_back(in_row);
        value.push_back(of_value);
    }
    /// Ends the column whose entries were given.
    void close(double from, double to, double at_cost = 0) {
        lower.push_back(from);
        upper.push_back(to);
        cost.push_back(at_cost);
        begin.push_back(static_cast<int>(row.size()));
    }
};

enum class Outcome { optimal, infeasible, unbounded, stopped, failed };

class LinearProgram {
 public:
    /// Rows' bounds; `stop` ends a solution early.
    LinearProgram(const std::vector<double>& row_lower, const std::vector<double>& row_upper,
                  const std::atomic<bool>* stop);
    ~LinearProgram();
    LinearProgram(LinearProgram&&) noexcept;
    LinearProgram& operator=(LinearProgram&&) noexcept;

    void append(const Columns& columns);
    void setColumn(int column, double lower, double upper, double cost);

    /// Which columns and rows are basic, and at which of their bounds the others are; to start another
    /// programme of the same size from.
    std::vector<unsigned char> basis() const;
    void startFrom(const std::vector<unsigned char>& basis);

    Outcome solveDual();    ///< the dual simplex method: from a start whose costs are in order
    Outcome solvePrimal();  ///< the primal one: from where an earlier solution stands

    double objective() const;
    double value(int column) const;
    /// Cost of one more unit in a row (its dual value).
    double price(int row) const;
    std::int64_t iterations() const;  ///< in all

 private:
    struct Solver;
    std::unique_ptr<Solver> solver_;
};

}  // namespace talus::limit
