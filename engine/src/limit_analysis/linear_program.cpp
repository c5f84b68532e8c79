#include "limit_analysis/linear_program.h"

#include <ClpEventHandler.hpp>
#include <ClpSimplex.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace talus::limit {
namespace {

constexpr double kTolerance = 1e-9;  // of rows, and of reduced costs; both are of size one (programme.h)
// CLP takes larger numbers for infinite, and ends the program where it cannot.
constexpr double kLargestBound = 1e20;

bool isWithinReach(double x) { return std::abs(x) < kLargestBound; }

/// A row may have no lower or no upper bound.
bool areBounds(const std::vector<double>& lower, const std::vector<double>& upper) {
    constexpr double kUnbounded = std::numeric_limits<double>::infinity();
    return std::all_of(lower.begin(), lower.end(),
                       [](double x) { return isWithinReach(x) || x == -kUnbounded; }) &&
           std::all_of(upper.begin(), upper.end(),
                       [](double x) { return isWithinReach(x) || x == kUnbounded; });
}

/// Ends the simplex method when the caller asks for it.
class StopHandler : public ClpEventHandler {
 public:
    explicit StopHandler(const std::atomic<bool>* stop) : stop_(stop) {}
    int event(Event which) override {
        constexpr int kGoOn = -1, kEnd = 0;
        if (which != endOfIteration && which != endOfFactorization) return kGoOn;
        return stop_ != nullptr && stop_->load(std::memory_order_relaxed) ? kEnd : kGoOn;
    }
    ClpEventHandler* clone() const override { return new StopHandler(*this); }

 private:
    const std::atomic<bool>* stop_;
};

Outcome outcomeOf(const ClpSimplex& model) {
    switch (model.status()) {
        case 0:
            return Outcome::optimal;
        case 1:
            return Outcome::infeasible;
        case 2:
            return Outcome::unbounded;
        case 5:
            return Outcome::stopped;
        default:
            return Outcome::failed;
    }
}

}  // namespace

struct LinearProgram::Solver {
    ClpSimplex model;
    std::int64_t iterations = 0;
    bool is_sound = true;  ///< all its numbers are within CLP's reach
};

LinearProgram::LinearProgram(const std::vector<double>& row_lower, const std::vector<double>& row_upper,
                             const std::atomic<bool>* stop)
    : solver_(std::make_unique<Solver>()) {
    ClpSimplex& model = solver_->model;
    solver_->is_sound = areBounds(row_lower, row_upper);
    model.setLogLevel(0);
    const StopHandler handler(stop);
    model.passInEventHandler(&handler);
    model.resize(static_cast<int>(row_lower.size()), 0);
    for (std::size_t row = 0; row < row_lower.size(); ++row)
        model.setRowBounds(static_cast<int>(row), row_lower[row], row_upper[row]);
    model.setPrimalTolerance(kTolerance);
    model.setDualTolerance(kTolerance);
    model.scaling(0);  // rows and columns are scaled already; with CLP's own it ended far from the optimum
}

LinearProgram::~LinearProgram() = default;
LinearProgram::LinearProgram(LinearProgram&&) noexcept = default;
LinearProgram& LinearProgram::operator=(LinearProgram&&) noexcept = default;

void LinearProgram::append(const Columns& columns) {
    if (columns.size() == 0) return;
    solver_->is_sound =
        solver_->is_sound && std::all_of(columns.value.begin(), columns.value.end(), isWithinReach);
    solver_->model.addColumns(static_cast<int>(columns.size()), columns.lower.data(), columns.upper.data(),
                              columns.cost.data(), columns.begin.data(), columns.row.data(),
                              columns.value.data());
}

void LinearProgram::setColumn(int column, double lower, double upper, double cost) {
    solver_->model.setColumnBounds(column, lower, upper);
    solver_->model.setObjectiveCoefficient(column, cost);
}

std::vector<unsigned char> LinearProgram::basis() const {
    const ClpSimplex& model = solver_->model;
    const unsigned char* status = model.statusArray();
    if (status == nullptr) return {};
    return {status, status + model.numberColumns() + model.numberRows()};
}

void LinearProgram::startFrom(const std::vector<unsigned char>& basis) {
    const ClpSimplex& model = solver_->model;
    if (basis.size() == static_cast<std::size_t>(model.numberColumns() + model.numberRows()))
        solver_->model.copyinStatus(basis.data());
}

Outcome LinearProgram::solveDual() {
    if (!solver_->is_sound) return Outcome::failed;
    solver_->model.dual();
    solver_->iterations += solver_->model.numberIterations();
    return outcomeOf(solver_->model) == Outcome::optimal ? solvePrimal() : outcomeOf(solver_->model);
}

/// Repeated until it makes no more steps: where many bases give the same forces, CLP sometimes stops before
/// the optimum.
Outcome LinearProgram::solvePrimal() {
    constexpr int kMostTimes = 5;
    if (!solver_->is_sound) return Outcome::failed;
    for (int k = 0; k < kMostTimes; ++k) {
        solver_->model.primal();
        solver_->iterations += solver_->model.numberIterations();
        if (solver_->model.numberIterations() == 0) break;
    }
    return outcomeOf(solver_->model);
}

double LinearProgram::objective() const { return solver_->model.objectiveValue(); }
double LinearProgram::value(int column) const { return solver_->model.primalColumnSolution()[column]; }
double LinearProgram::price(int row) const { return solver_->model.dualRowSolution()[row]; }
std::int64_t LinearProgram::iterations() const { return solver_->iterations; }

}  // namespace talus::limit
