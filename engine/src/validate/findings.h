#pragma once
// The list filled by the parts of validate.h.

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "state/arrays.h"

namespace talus {

class Findings {
 public:
    static constexpr std::size_t kMost = 20;

    /// Notes a rule that does not hold. \return whether it holds
    bool expect(bool holds, const char* rule) {
        if (!holds && list_.size() < kMost) list_.emplace_back(rule);
        return holds;
    }
    /// The same for one of many: "what index: rule".
    bool expect(bool holds, const char* what, std::size_t index, const char* rule) {
        if (!holds && list_.size() < kMost)
            list_.push_back(std::string(what) + ' ' + std::to_string(index) + ": " + rule);
        return holds;
    }

    bool none() const { return list_.empty(); }
    std::vector<std::string> take() { return std::move(list_); }

 private:
    std::vector<std::string> list_;
};

/// Unit and at right angles, to the rounding of many turns.
inline bool areOrthonormal(const Vec3& e1, const Vec3& e2) {
    constexpr double kFrameRounding = 1e-9;
    return std::abs(e1.squaredNorm() - 1.0) < kFrameRounding &&
           std::abs(e2.squaredNorm() - 1.0) < kFrameRounding && std::abs(e1.dot(e2)) < kFrameRounding;
}

// Parts of validate. Each is safe once those before it have found nothing.
void checkBlocks(const State& state, Findings& findings);
void checkLayout(const State& state, Findings& findings);  ///< sizes, groups, slots and indices of interfaces
void checkFrames(const State& state, Findings& findings);
void checkPlaces(const State& state, Findings& findings);  ///< for vertices and edges
void checkPoints(const State& state, Findings& findings);
void checkIncidence(const State& state, Findings& findings);
void checkWalls(const State& state, Findings& findings);

}  // namespace talus
