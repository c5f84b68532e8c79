#include "mesh/plane_notation.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "files/csv_line.h"
#include "files/number.h"
#include "talus/angles.h"

namespace talus::formats {

namespace {

constexpr double kTellsNothing = 0.2;  ///< cos: within some 11 degrees of the strike no side is meant
constexpr std::array<std::pair<std::string_view, double>, 8> kCompass{
    {{"N", 0}, {"NE", 45}, {"E", 90}, {"SE", 135}, {"S", 180}, {"SW", 225}, {"W", 270}, {"NW", 315}}};
constexpr std::array<std::string_view, 8> kUnits{"deg",   "degree", "degrees", "m",
                                                 "metre", "metres", "meter",   "meters"};

bool isLetterOrDigit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Capitals without blanks and degree signs.
std::string plain(std::string_view text) {
    std::string word;
    for (const char c : withoutDegreeSigns(text))
        if (c != ' ' && c != '\t') word += capital(c);
    return word;
}

std::optional<double> compass(std::string_view letters) {
    for (const auto& [name, azimuth] : kCompass)
        if (name == letters) return azimuth;
    return std::nullopt;
}

double turned(double azimuth) {
    const double rest = std::fmod(azimuth, 360);
    return rest < 0 ? rest + 360 : rest;
}

}  // namespace

std::string withoutDegreeSigns(std::string_view text) {
    std::string rest(text);
    for (const std::string_view sign :
         {"\xc2\xb0", "\xc2\xba"}) {  // the degree sign, and the ordinal taken for it
        for (auto at = rest.find(sign); at != std::string::npos; at = rest.find(sign))
            rest.erase(at, sign.size());
    }
    return std::string(withoutBlanks(rest));
}

std::string titleWord(std::string_view title) {
    std::vector<std::string> words(1);
    for (const char c : title) {
        if (isLetterOrDigit(c)) {
            words.back() += small(c);
        } else if (!words.back().empty()) {
            words.emplace_back();
        }
    }
    if (words.back().empty()) words.pop_back();
    if (words.size() > 1) {
        for (const std::string_view unit : kUnits) {
            if (words.back() == unit) {
                words.pop_back();
                break;
            }
        }
    }
    std::string whole;
    for (const std::string& word : words) whole += word;
    return whole;
}

std::optional<double> quadrantAzimuth(std::string_view text) {
    const std::string word = plain(text);
    if (word.size() < 3) return std::nullopt;
    const char from = word.front(), towards = word.back();
    const auto angle = numberOf(std::string_view(word).substr(1, word.size() - 2));
    if ((from != 'N' && from != 'S') || (towards != 'E' && towards != 'W') || !angle ||
        !(*angle >= 0 && *angle <= 90))
        return std::nullopt;
    const double east = towards == 'E' ? *angle : -*angle;
    return turned(from == 'N' ? east : 180 - east);
}

std::optional<QuadrantDip> quadrantDip(std::string_view text) {
    const std::string word = plain(text);
    const auto last_digit = word.find_last_of("0123456789");
    if (last_digit == std::string::npos) return std::nullopt;
    const auto towards = compass(std::string_view(word).substr(last_digit + 1));
    if (!towards) return std::nullopt;
    return QuadrantDip{word.substr(0, last_digit + 1), *towards};
}

std::optional<double> dipDirectionTowards(double strike, double towards) {
    const double side = std::cos((strike + 90 - towards) * kDegree);
    if (std::abs(side) < kTellsNothing) return std::nullopt;
    return turned(strike + (side > 0 ? 90 : -90));
}

}  // namespace talus::formats
