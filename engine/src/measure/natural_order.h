#pragma once
// Names in natural order: c2 before c10.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

namespace natural {

inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Takes the digits at the beginning of `text`, without leading zeros.
inline std::string_view takeNumber(std::string_view& text) {
    std::size_t zeros = 0;
    while (zeros < text.size() && text[zeros] == '0') ++zeros;
    std::size_t end = zeros;
    while (end < text.size() && isDigit(text[end])) ++end;
    const std::string_view number = text.substr(zeros, end - zeros);
    text.remove_prefix(end);
    return number;
}

/// Below 0: a comes first; 0: they differ in leading zeros at most.
inline int compare(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        if (isDigit(a[0]) && isDigit(b[0])) {
            const std::string_view x = takeNumber(a), y = takeNumber(b);
            if (x.size() != y.size()) return x.size() < y.size() ? -1 : 1;
            if (const int order = x.compare(y); order != 0) return order;
        } else if (a[0] != b[0]) {
            return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]) ? -1 : 1;
        } else {
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    return static_cast<int>(!a.empty()) - static_cast<int>(!b.empty());
}

}  // namespace natural

/// Digits in a row count as one number; a total order, so that every list has one order only.
inline bool isNaturallyBefore(std::string_view a, std::string_view b) {
    const int order = natural::compare(a, b);
    return order != 0 ? order < 0 : a < b;
}

inline void sortNaturally(std::vector<std::string>& names) {
    std::sort(names.begin(), names.end(), isNaturallyBefore);
}

}  // namespace talus
