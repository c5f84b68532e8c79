#include "frame/vertex_edge_fields.h"

#include <algorithm>

#include "state/incidence.h"

namespace talus {
namespace {

constexpr std::size_t kPlaces = kPlacesOfPair;

/// Which of its pair's places an interface is.
std::size_t placeOf(const Interfaces& f, std::size_t i) {
    return (i - static_cast<std::size_t>(f.groupOf(i).begin)) % kPlaces;
}

bool hasOneCorner(const FrameInterfaces& f, std::size_t i) {
    return f.patch_begin[i + 1] - f.patch_begin[i] == 1;
}

}  // namespace

Vec3 storedReferenceGap(const Interfaces& f, std::size_t i) {
    Vec3 gap = f.frame(i).reference_gap;
    if (f.kind[i] == InterfaceKind::faces) return gap;
    const std::size_t place = placeOf(f, i);
    if (place == 0) gap.y() = f.travel_left[i];
    if (place == 1) gap.y() = f.faces_are_apart[i - 1] != 0 ? 1.0 : 0.0;
    return gap;
}

void restorePlaces(Interfaces& f) {
    const std::size_t n = f.size();
    f.kind.assign(n, InterfaceKind::faces);
    f.idle.assign(n, 0);
    f.travel_left.assign(n, 0.0);
    f.faces_are_apart.assign(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        if (f.cornerCount(i) != 1) continue;
        f.kind[i] = InterfaceKind::vertex_edge;
        const Vec3 stored = f.frame(i).reference_gap;
        f.idle[i] = stored.x() < FrameInterfaces::kIdleGap ? 1 : 0;
        const std::size_t place = placeOf(f, i);
        if (place == 0) f.travel_left[i] = stored.y();
        if (place == 1) f.faces_are_apart[i - 1] = stored.y() > 0 ? 1 : 0;
        f.setReferenceGap(i, {stored.x(), 0, 0});
    }
    for (std::size_t g = 0; g < f.groups.size(); ++g) markIdle(f, g);
}

bool placesFit(const FrameInterfaces& f) {
    const auto pairOf = [&](std::size_t i) { return std::minmax(f.block_a[i], f.block_b[i]); };
    for (std::size_t i = 0; i < f.size();) {
        if (!hasOneCorner(f, i)) {
            ++i;
            continue;
        }
        for (const std::size_t end = i + kPlaces; i < end; ++i)
            if (i == f.size() || !hasOneCorner(f, i) || pairOf(i) != pairOf(end - kPlaces)) return false;
    }
    return true;
}

}  // namespace talus
