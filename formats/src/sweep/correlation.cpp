#include "sweep/correlation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "toml/wording.h"

namespace talus::formats::sweep {

namespace {

using namespace toml;

using Matrix = std::vector<std::vector<double>>;
constexpr Interval kCoefficient{-1, 1, false, false};
// Least remaining variance of a variable once those before it are known: less is rounding, or a
// contradiction.
constexpr double kLeastVariance = 1e-9;

/// Places of the variables that are named, in the order of the list.
std::optional<std::vector<std::size_t>> readFields(TableReader& table,
                                                   const std::vector<Variable>& variables) {
    const auto names = table.texts("fields", std::nullopt);
    if (!names) return std::nullopt;
    std::vector<std::size_t> places;
    for (const std::string& name : *names) {
        const auto found = std::find_if(variables.begin(), variables.end(), [&](const Variable& variable) {
            return variable.column.source == SweepSource::random && variable.column.name == name;
        });
        if (found == variables.end()) {
            table.error("fields", "found " + quoted(name) + ", allowed: the field of a [[random]]");
            return std::nullopt;
        }
        if (found->column.per == SampledPer::interface) {
            table.error("fields", "found " + quoted(name) +
                                      ", which is drawn per interface; allowed: draws per run or per joint");
            return std::nullopt;
        }
        places.push_back(static_cast<std::size_t>(found - variables.begin()));
    }
    if (std::set<std::size_t>(places.begin(), places.end()).size() == places.size() && places.size() >= 2)
        return places;
    table.error("fields", "found fewer than two fields, or one twice; allowed: two or more different ones");
    return std::nullopt;
}

/// Symmetric, with ones along its diagonal; nothing when that is reported.
std::optional<Matrix> readMatrix(Report& report, TableReader& table, std::size_t size) {
    const auto rows = table.array("matrix");
    if (!rows) return std::nullopt;
    Matrix matrix;
    for (std::size_t k = 0; k < rows->size(); ++k) {
        const std::string field = elementField(table.fieldOf("matrix"), k);
        auto row = readNumbers(report, rows->at(k), field, kCoefficient, std::nullopt);
        if (!row) return std::nullopt;
        const auto fault = [&](const std::string& text) { report.add(rows->at(k).place(), field, text); };
        if (row->size() != size || k >= size)
            return fault("found a matrix that is not " + std::to_string(size) + " x " + std::to_string(size) +
                         ", allowed: a row and a column for each field"),
                   std::nullopt;
        if ((*row)[k] != 1)
            return fault("found " + numberText((*row)[k]) + " on the diagonal, allowed: 1"), std::nullopt;
        for (std::size_t j = 0; j < k; ++j)
            if ((*row)[j] != matrix[j][k])
                return fault("found " + numberText((*row)[j]) + " in column " + std::to_string(j + 1) +
                             ", but " + numberText(matrix[j][k]) + " in row " + std::to_string(j + 1) +
                             "; allowed: a symmetric matrix"),
                       std::nullopt;
        matrix.push_back(std::move(*row));
    }
    if (matrix.size() == size) return matrix;
    table.error("matrix", "found " + std::to_string(matrix.size()) + " rows, allowed: one for each field, " +
                              std::to_string(size));
    return std::nullopt;
}

/// The Cholesky factor, row by row. The first row that the ones before it leave no variance is reported.
std::optional<Matrix> factorOf(Report& report, TableReader& table, const Matrix& matrix) {
    Matrix factor;
    for (std::size_t k = 0; k < matrix.size(); ++k) {
        std::vector<double> row(k + 1, 0);
        double left = 1;
        for (std::size_t j = 0; j < k; ++j) {
            double sum = matrix[k][j];
            for (std::size_t i = 0; i < j; ++i) sum -= row[i] * factor[j][i];
            row[j] = sum / factor[j][j];
            left -= row[j] * row[j];
        }
        if (!(left > kLeastVariance)) {
            report.add(table.find("matrix")->at(k).place(), elementField(table.fieldOf("matrix"), k),
                       "found a matrix that is not positive definite: no variables have the correlations of "
                       "rows 1 to " +
                           std::to_string(k + 1) + "; allowed: smaller ones in row " + std::to_string(k + 1));
            return std::nullopt;
        }
        row[k] = std::sqrt(left);
        factor.push_back(std::move(row));
    }
    return factor;
}

}  // namespace

void readCorrelation(Report& report, TableReader& root, std::vector<Variable>& variables) {
    auto table = root.table("correlation", {"fields", "matrix"});
    if (!table) return;
    table->require({"fields", "matrix"});
    const auto places = readFields(*table, variables);
    const auto matrix = readMatrix(report, *table, places ? places->size() : 2);
    if (!places || !matrix) return;
    const auto factor = factorOf(report, *table, *matrix);
    if (!factor) return;
    for (std::size_t k = 1; k < places->size(); ++k) {
        std::vector<ScoreShare>& scores = variables[(*places)[k]].column.scores;
        for (std::size_t j = 0; j <= k; ++j)
            if ((*factor)[k][j] != 0) scores.push_back({(*places)[j], (*factor)[k][j]});
        if (scores.size() == 1) scores.clear();  // its own alone: the very sample it has without a matrix
    }
}

}  // namespace talus::formats::sweep
