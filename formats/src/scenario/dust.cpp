// Very small blocks: fragments that joints cut off a rugged ground where it rises just above them.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scenario/rock_mass.h"

namespace talus::formats::scenario {

namespace {

constexpr double kDust = 1e-3;  // of the median block's volume
constexpr std::size_t kMostNamed = 6;

std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

bool hasGround(const CutBlock& block) {
    for (std::size_t f = 0; f < block.origin.size(); ++f)
        if (block.origin[f].joint < 0 && !block.shape.isInner(f)) return true;
    return false;
}

/// Rounded up to two digits.
double roundedUp(double value) {
    const double digit = std::pow(10, std::floor(std::log10(value)) - 1);
    return digit * std::ceil(value / digit);
}

}  // namespace

std::optional<std::string> dustWarning(const RockMassBlocks& blocks) {
    const auto& all = blocks.cut.blocks;
    std::vector<double> volumes;
    for (const CutBlock& block : all) volumes.push_back(block.volume);
    const auto middle = volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() / 2);
    std::nth_element(volumes.begin(), middle, volumes.end());
    std::vector<std::size_t> dust;
    for (std::size_t b = 0; b < all.size(); ++b)
        if (all[b].volume < kDust * *middle && hasGround(all[b])) dust.push_back(b);
    if (dust.empty()) return std::nullopt;
    std::stable_sort(dust.begin(), dust.end(),
                     [&](std::size_t a, std::size_t b) { return all[a].volume < all[b].volume; });
    std::string named;
    double thickest = 0;
    for (std::size_t k = 0; k < dust.size(); ++k) {
        const CutBlock& block = all[dust[k]];
        thickest = std::max(thickest, smallestExtent(block.shape));
        if (k >= kMostNamed) continue;
        const Vec3 at = massProperties(block.shape).centroid;
        char place[96];
        std::snprintf(place, sizeof place, " (%.2g m3 at %.6g, %.6g, %.6g)", block.volume, at.x(), at.y(),
                      at.z());
        named += (k > 0 ? ", " : "") + blocks.names[dust[k]] + place;
    }
    if (dust.size() > kMostNamed) named += ", and " + std::to_string(dust.size() - kMostNamed) + " more";
    const std::string much = shortText(roundedUp(thickest));
    return "rock_mass.region: " + std::to_string(dust.size()) + " of " + std::to_string(all.size()) +
           " blocks at the surface are smaller than a thousandth of the median block (" +
           shortText(kDust * *middle) + " m3): " + named + "; simplify = " + much +
           " smooths such rough ground, min_thickness = " + much +
           " merges such pieces with their neighbours";
}

}  // namespace talus::formats::scenario
