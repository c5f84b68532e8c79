#pragma once
// Numbers in words, for messages.

#include <cstdio>
#include <string>

namespace talus {

/// A number by printf's format.
inline std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

}  // namespace talus
