#pragma once
// [correlation]: correlated random variables.
//
// By normal scores: each variable's share u becomes the score z = Phi^-1(u); independent scores are mixed by
// the rows of the matrix's Cholesky factor L, and Phi(L z) are the shares that the distributions take. So
// each variable keeps its distribution, and the scores have the matrix as their correlation (A. Der
// Kiureghian and P. L. Liu, J. Eng. Mech. 112, 1986, who call it Nataf's model). The first variable keeps the
// very samples it has alone.

#include <vector>

#include "sweep/variables.h"

namespace talus::formats::sweep {

/// Reads the table, if there is one, into the variables' `SweepColumn::scores`.
void readCorrelation(toml::Report& report, toml::TableReader& root, std::vector<Variable>& variables);

}  // namespace talus::formats::sweep
