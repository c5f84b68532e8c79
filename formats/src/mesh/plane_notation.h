#pragma once
// Names of columns and directions as field books have them.

#include <optional>
#include <string>
#include <string_view>

namespace talus::formats {

/// A column's title as one word of small letters and digits, without its unit: "Dip Direction (deg)" ->
/// "dipdirection". What else stands in brackets stays: "strike (left)" -> "strikeleft".
std::string titleWord(std::string_view title);

/// "N45E" -> 45, "S 30 W" -> 210 [degrees from north]; nothing for other texts.
std::optional<double> quadrantAzimuth(std::string_view text);

/// "45NE": the number and its direction, 45 degrees from north.
struct QuadrantDip {
    std::string number;
    double towards = 0;  ///< [degrees from north]
};
std::optional<QuadrantDip> quadrantDip(std::string_view text);

/// The dip direction, normal to the strike, that is nearer to `towards`. Nothing where `towards` is within
/// some 11 degrees of the strike and so decides nothing. [degrees from north]
std::optional<double> dipDirectionTowards(double strike, double towards);

/// Without degree signs.
std::string withoutDegreeSigns(std::string_view text);

}  // namespace talus::formats
