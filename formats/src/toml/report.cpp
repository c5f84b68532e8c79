#include "toml/report.h"

#include <algorithm>
#include <tuple>

namespace talus::formats::toml {

namespace {

constexpr std::size_t kMaxKept = 1000;
constexpr std::size_t kMaxShown = 50;
constexpr std::size_t kMaxWarnings = 20;

bool standsBefore(const Error& a, const Error& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
}

}  // namespace

bool Report::full() const { return errors_.size() >= kMaxKept; }

void Report::add(Place place, std::string field, std::string message) {
    ++count_;
    if (!full()) errors_.push_back({std::move(field), std::move(message), path_, place.line, place.column});
}

void Report::warn(std::string message) {
    if (warnings_.size() < kMaxWarnings) warnings_.push_back(std::move(message));
}

std::vector<Error> Report::errors() const {
    std::vector<Error> sorted = errors_;
    std::stable_sort(sorted.begin(), sorted.end(), standsBefore);
    if (sorted.size() > kMaxShown) sorted.resize(kMaxShown);
    if (count_ > sorted.size())
        sorted.push_back({"", "and " + std::to_string(count_ - sorted.size()) + " further errors", path_});
    return sorted;
}

std::optional<Place> Report::placeOf(std::string field) const {
    for (; !field.empty(); field.resize(std::min(field.find_last_of(".["), field.size() - 1))) {
        const auto found = places_.find(field);
        if (found != places_.end()) return Place{found->second.first, found->second.second};
        if (field.find_last_of(".[") == std::string::npos) break;
    }
    return std::nullopt;
}

}  // namespace talus::formats::toml
