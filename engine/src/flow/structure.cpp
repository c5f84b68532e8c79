#include "flow/structure.h"

namespace talus::flow {
namespace {

bool isUnknown(const Conditions& conditions, std::int32_t node) {
    const Condition of = conditions.of[static_cast<std::size_t>(node)];
    return of == Condition::none || of == Condition::outlet;
}

SparseMatrix emptyMatrix(const Network& network, const Conditions& conditions) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(network.nodes.size() + 6 * network.triangles.size());
    for (std::size_t n = 0; n < network.nodes.size(); ++n)
        entries.emplace_back(static_cast<int>(n), static_cast<int>(n), 0.0);
    for (const auto& triangle : network.triangles)
        for (const std::int32_t row : triangle)
            for (const std::int32_t column : triangle)
                if (row != column && isUnknown(conditions, row) && isUnknown(conditions, column))
                    entries.emplace_back(row, column, 0.0);
    const auto size = static_cast<Eigen::Index>(network.nodes.size());
    SparseMatrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

}  // namespace

Structure::Structure(const Network& network, const Conditions& conditions)
    : empty_(emptyMatrix(network, conditions)),
      entry_(network.triangles.size()),
      diagonal_(network.nodes.size()) {
    for (std::size_t t = 0; t < entry_.size(); ++t)
        for (std::size_t k = 0; k < 9; ++k)
            entry_[t][k] = entryOf(empty_, network.triangles[t][k / 3], network.triangles[t][k % 3]);
    for (std::size_t n = 0; n < diagonal_.size(); ++n)
        diagonal_[n] = entryOf(empty_, static_cast<std::int32_t>(n), static_cast<std::int32_t>(n));
}

}  // namespace talus::flow
