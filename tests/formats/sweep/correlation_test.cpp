// Correlated random variables: correlation reached, distributions kept, and what is no correlation refused.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "formats/scenario/scenario_texts.h"
#include "formats/sweep/sweep_file.h"
#include "talus/formats/sweep.h"

namespace talus::formats {

namespace {

constexpr std::uint64_t kSamples = 4000;

std::string variable(const std::string& field, const std::string& more) {
    return "[[random]]\nfield = \"" + field + "\"\n" + more + "\n";
}

const std::string kVariables =
    variable("joint.default.friction_deg", "distribution = \"uniform\"\nmin = 18\nmax = 40") +
    variable("joint.default.cohesion", "distribution = \"lognormal\"\nmean = 500\nsd = 400") +
    variable("material.granite.density",
             "distribution = \"beta\"\nalpha = 2\nbeta = 5\nmin = 2600\nmax = 2800") +
    variable("gravity.tilt_deg", "distribution = \"triangular\"\nmin = 1\nmode = 2\nmax = 3");

std::string correlation(const std::string& matrix) {
    return "[correlation]\nfields = [\"joint.default.friction_deg\", \"joint.default.cohesion\", "
           "\"material.granite.density\"]\nmatrix = " +
           matrix + "\n";
}

SweepFile correlated(const std::string& more, const std::string& head = "") {
    return SweepFile("scenario = \"slope.toml\"\nanalysis = \"critical-angle\"\nsamples = " +
                         std::to_string(kSamples) + "\n" + head + kVariables + more,
                     properties() + stack());
}

/// Of each column, its samples.
std::vector<std::vector<double>> samplesOf(const Sweep& sweep) {
    std::vector<std::vector<double>> all(sweep.columns.size());
    for (std::uint64_t sample = 0; sample < kSamples; ++sample) {
        const SweepRun run = runOf(sweep, sample);
        for (std::size_t c = 0; c < all.size(); ++c) all[c].push_back(std::get<double>(run.values[c]));
    }
    return all;
}

/// Ranks as normal scores: what the correlation is of, whatever the distribution.
std::vector<double> scoresOf(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> scores(values.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        scores[order[rank]] =
            normalQuantile((static_cast<double>(rank) + 0.5) / static_cast<double>(order.size()));
    return scores;
}

double correlationOf(const std::vector<double>& a, const std::vector<double>& b) {
    double both = 0, of_a = 0, of_b = 0;
    for (std::size_t k = 0; k < a.size(); ++k) both += a[k] * b[k], of_a += a[k] * a[k], of_b += b[k] * b[k];
    return both / std::sqrt(of_a * of_b);
}

/// Kolmogorov and Smirnov's largest difference of the distribution functions, at 199 places.
double distanceFrom(const Distribution& distribution, const std::vector<double>& values) {
    double most = 0;
    for (int k = 1; k < 200; ++k) {
        const double limit = quantile(distribution, k / 200.0);
        const auto below = std::count_if(values.begin(), values.end(), [&](double v) { return v < limit; });
        most = std::max(
            most, std::abs(static_cast<double>(below) / static_cast<double>(values.size()) - k / 200.0));
    }
    return most;
}

}  // namespace

TEST_CASE(
    "correlated variables have the matrix as the correlation of their normal scores, and keep their "
    "distributions") {
    for (const char* sampling : {"random", "latin-hypercube"}) {
        CAPTURE(sampling);
        const std::string head = std::string("sampling = \"") + sampling + "\"\n";
        const Sweep sweep =
            correlated(correlation("[[1, -0.6, 0.3], [-0.6, 1, 0.2], [0.3, 0.2, 1]]"), head).read();
        const auto samples = samplesOf(sweep);
        std::vector<std::vector<double>> scores;
        for (const auto& values : samples) scores.push_back(scoresOf(values));
        const double wanted[4][4] = {{1, -0.6, 0.3, 0}, {-0.6, 1, 0.2, 0}, {0.3, 0.2, 1, 0}, {0, 0, 0, 1}};
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < 4; ++b) {
                CAPTURE(a);
                CAPTURE(b);
                const double found = correlationOf(scores[a], scores[b]);
                if (a < b) MESSAGE("correlation ", found, ", wanted ", wanted[a][b]);
                CHECK(std::abs(found - wanted[a][b]) < 3.5 / std::sqrt(double(kSamples)));
            }
        // 1.95 / sqrt(n): a distribution that is the right one is farther in one case of a thousand.
        for (std::size_t c = 0; c < samples.size(); ++c)
            CHECK(distanceFrom(sweep.columns[c].distribution, samples[c]) <
                  1.95 / std::sqrt(double(kSamples)));
        // What is not correlated, and the first that is, draw what they draw alone.
        const auto alone = samplesOf(correlated("", head).read());
        CHECK(samples[0] == alone[0]);
        CHECK(samples[3] == alone[3]);
        CHECK(samples[1] != alone[1]);
    }
}

TEST_CASE(
    "the identity of a sweep changes with its correlation, and an uncorrelated matrix changes nothing") {
    const Sweep none = correlated("").read();
    const Sweep zero = correlated(correlation("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]")).read();
    const Sweep some = correlated(correlation("[[1, 0.1, 0], [0.1, 1, 0], [0, 0, 1]]")).read();
    CHECK(identityOf(none) != identityOf(some));
    for (const std::uint64_t run : {0, 17}) {
        const SweepRun a = runOf(none, run), b = runOf(zero, run);
        for (std::size_t c = 0; c < a.values.size(); ++c)
            CHECK(std::get<double>(b.values[c]) ==
                  doctest::Approx(std::get<double>(a.values[c])).epsilon(1e-12));
    }
}

TEST_CASE("what is no correlation matrix is refused with its place") {
    const auto fault = [](const std::string& more) { return correlated(more).fault(); };
    const auto has = [&](const std::string& matrix, const std::string& text) {
        const std::string found = fault(correlation(matrix));
        CAPTURE(found);
        CHECK(found.find(text) != std::string::npos);
    };
    // The variables take 26 lines after the head's three; the matrix stands in the third of its table.
    has("[[1, 0.9, -0.9], [0.9, 1, 0.9], [-0.9, 0.9, 1]]",
        "correlation.matrix[2]: found a matrix that is not positive definite");
    has("[[1, 1, 0], [1, 1, 0], [0, 0, 1]]",
        "correlation.matrix[1]: found a matrix that is not positive definite");
    has("[[1, 0.5, 0], [0.4, 1, 0], [0, 0, 1]]",
        "correlation.matrix[1]: found 0.4 in column 1, but 0.5 in row 1");
    has("[[1, 0.5, 0], [0.5, 2, 0], [0, 0, 1]]", "correlation.matrix[1][1]: found 2, allowed:");
    has("[[1, 0.5, 0], [0.5, 0.9, 0], [0, 0, 1]]", "correlation.matrix[1]: found 0.9 on the diagonal");
    has("[[1, 0.5], [0.5, 1]]", "correlation.matrix[0]: found a matrix that is not 3 x 3");
    has("[[1, 0.5, 0], [0.5, 1, 0]]", "correlation.matrix: found 2 rows");
    CHECK(fault("[correlation]\nfields = [\"gravity.tilt\", \"joint.default.cohesion\"]\nmatrix = [[1, 0], "
                "[0, 1]]\n")
              .find("correlation.fields: found \"gravity.tilt\", allowed: the field of a [[random]]") !=
          std::string::npos);
    CHECK(fault("[correlation]\nfields = [\"joint.default.cohesion\"]\nmatrix = [[1]]\n")
              .find("correlation.fields: found fewer than two fields") != std::string::npos);
}

}  // namespace talus::formats
