#include "mesh/mend_notes.h"

#include <algorithm>
#include <charconv>

namespace talus::formats::mesh {

namespace {

constexpr std::size_t kMostPlaces = 5;  // that are listed; of more, the number

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + (count == 1 ? one : many);
}

/// "at A, B and 3 more"
std::string listed(const std::vector<std::string>& places) {
    const std::size_t told = std::min(places.size(), kMostPlaces);
    std::string list = "at ";
    for (std::size_t k = 0; k < told; ++k)
        list += (k == 0 ? "" : k + 1 == places.size() ? " and " : ", ") + places[k];
    return places.size() > told ? list + " and " + std::to_string(places.size() - told) + " more" : list;
}

std::string placesOf(const std::vector<Vec3>& places) {
    std::vector<std::string> texts;
    for (const Vec3& place : places) texts.push_back(placeText(place));
    return listed(texts);
}

std::string placesOf(const std::vector<SurfaceHole>& holes) {
    std::vector<std::string> texts;
    for (const SurfaceHole& hole : holes) {
        texts.push_back(placeText(hole.middle) + " (" + std::to_string(hole.edges) + " edges, " +
                        shortText(hole.width) + " m wide)");
    }
    return listed(texts);
}

}  // namespace

std::string shortText(double value, int digits) {
    char buffer[40];
    return {buffer,
            std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

std::string placeText(const Vec3& p) {
    return "(" + shortText(p.x(), 10) + ", " + shortText(p.y(), 10) + ", " + shortText(p.z(), 10) + ")";
}

std::vector<std::string> mendNotes(const MendedSurface& mended, double largest_hole) {
    std::vector<std::string> deeds, notes;
    if (!mended.doubled.empty()) {
        deeds.push_back(counted(mended.doubled.size(), " doubled triangle", " doubled triangles") +
                        " left out, " + placesOf(mended.doubled));
    }
    if (!mended.turned.empty()) {
        deeds.push_back(counted(mended.turned.size(), " triangle", " triangles") + " turned over, " +
                        placesOf(mended.turned));
    }
    if (!mended.closed.empty()) {
        deeds.push_back(counted(mended.closed.size(), " hole", " holes") + " closed, " +
                        placesOf(mended.closed));
    }
    std::string note;
    for (const std::string& deed : deeds) note += (note.empty() ? "was mended: " : "; ") + deed;
    if (!note.empty()) notes.push_back(note);
    if (!mended.too_wide.empty()) {
        notes.push_back("has " + counted(mended.too_wide.size(), " hole", " holes") + " wider than " +
                        shortText(largest_hole) + " m (largest_hole) that stay open, " +
                        placesOf(mended.too_wide));
    }
    if (!mended.unclear.empty()) {
        notes.push_back("has " + counted(mended.unclear.size(), " hole", " holes") +
                        " with an outline that crosses itself, which stay open, " + placesOf(mended.unclear));
    }
    return notes;
}

}  // namespace talus::formats::mesh
