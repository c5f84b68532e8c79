#include "law/strength_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "law/laws.h"

namespace talus {
namespace contact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Piece = std::array<double, 4>;  // constant, linear and quadratic term, and up to where

/// Through three points, the middle one half way.
Piece parabola(double begin, double end, double first, double middle, double last) {
    const double half = 0.5 * (end - begin), centre = begin + half;
    const double quadratic = 0.5 * (last - 2 * middle + first) / (half * half);
    const double slope = 0.5 * (last - first) / half;  // at the centre
    return {middle - centre * (slope - quadratic * centre), slope - 2 * quadratic * centre, quadratic,
            kInfinity};
}

Piece line(double begin, double end, double first, double last) {
    const double slope = (last - first) / (end - begin);
    return {first - slope * begin, slope, 0, kInfinity};
}

class CurveMaker {
 public:
    CurveMaker(const StrengthFormula& formula, const Joint& joint, double factor)
        : formula_(formula), joint_(joint), factor_(factor), kinks_(formula.kinks(joint)) {
        // Below 1 Pa a curve is one straight piece.
        if (!formula.is_straight) std::erase_if(kinks_, [](double kink) { return kink < 1; });
    }

    std::vector<double> make() {
        addPieces(0, 1);
        for (int octave = 0; octave < simd::kOctaves; ++octave)
            for (int k = 0; k < simd::kPiecesPerOctave; ++k) {
                const double step = std::ldexp(1.0 / simd::kPiecesPerOctave, octave);
                addPieces(std::ldexp(1.0, octave) + k * step, std::ldexp(1.0, octave) + (k + 1) * step);
            }
        addPieces(simd::kGreatest, kInfinity);
        curve_.insert(curve_.end(), beyond_.begin(), beyond_.end());
        const std::vector<double> last(curve_.end() - 4, curve_.end() - 1);
        curve_.insert(curve_.end(), last.begin(), last.end());
        curve_.push_back(kInfinity);
        return std::move(curve_);
    }

 private:
    double at(double stress) const { return factor_ * formula_.strength(joint_, stress); }

    /// The pieces between two stresses: the first in its place, those behind kinks behind all others.
    void addPieces(double begin, double end) {
        std::vector<double>* into = &curve_;
        for (double from = begin; from < end;) {
            const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), from);
            const double to = kink == kinks_.end() ? end : std::min(*kink, end);
            Piece piece = pieceOf(from, to);
            if (into == &beyond_ || to < end) piece[3] = to;
            into->insert(into->end(), piece.begin(), piece.end());
            into = &beyond_;
            from = to;
        }
    }

    Piece pieceOf(double begin, double end) const {
        if (formula_.is_straight) return straightPiece(begin);
        if (end == kInfinity) return line(begin, 2 * begin, at(begin), at(2 * begin));
        if (end <= 1) return line(begin, end, at(begin), at(end));
        return parabola(begin, end, at(begin), at(0.5 * (begin + end)), at(end));
    }

    /// Between the kinks around it, so that it is the same line in all pieces of a segment, to the bit.
    Piece straightPiece(double begin) const {
        const auto next = std::upper_bound(kinks_.begin(), kinks_.end(), begin);
        const double from = next == kinks_.begin() ? 0 : *std::prev(next);
        const double to = next == kinks_.end() ? 2 * from + 1 : *next;
        return line(from, to, at(from), at(to));
    }

    const StrengthFormula& formula_;
    const Joint& joint_;
    double factor_;
    std::vector<double> kinks_, curve_, beyond_;
};

}  // namespace

std::shared_ptr<const std::vector<double>> strengthCurve(const Joint& joint, double factor) {
    const StrengthFormula* formula = strengthFormula(joint.law);
    if (formula == nullptr) return nullptr;
    return std::make_shared<const std::vector<double>>(CurveMaker(*formula, joint, factor).make());
}

}  // namespace contact

double shearStrength(const Joint& joint, double normal_stress) {
    if (const contact::StrengthFormula* formula = contact::strengthFormula(joint.law))
        return joint.strength_factor * formula->strength(joint, std::max(normal_stress, 0.0));
    return std::max(joint.cohesion + normal_stress * std::tan(joint.friction), 0.0);
}

double frictionAngle(const Joint& joint) {
    constexpr double kStress = 1e5;  // [Pa]
    if (joint.law == StrengthLaw::coulomb) return joint.friction;
    return std::atan2(shearStrength(joint, kStress), kStress);
}

}  // namespace talus
