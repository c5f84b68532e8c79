#pragma once
// Numbers and places as text for messages.

#include <charconv>
#include <string>

#include "talus/polyhedron.h"

namespace talus::rock_mass {

/// \param digits  significant ones at most
inline std::string numberText(double value, int digits = 10) {
    char buffer[40];
    return {buffer,
            std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

inline std::string placeText(const Vec3& p, int digits = 10) {
    return "(" + numberText(p.x(), digits) + ", " + numberText(p.y(), digits) + ", " +
           numberText(p.z(), digits) + ")";
}

}  // namespace talus::rock_mass
