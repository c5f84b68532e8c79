#pragma once
// The result of a search as lines of text, for the command's table and the report's page.

#include <string>
#include <vector>

#include "answers/search_answer.h"

namespace talus::tools {

/// A label and its text; a line without a label continues the one before.
struct ResultLine {
    std::string label, content;
};
using ResultLines = std::vector<ResultLine>;

ResultLines answerLines(const SearchReport& report);  ///< the headline, with its interval and bracket
ResultLines besideLines(const SearchReport& report);  ///< theory, upper bound, the answer with cohesion kept
ResultLines intervalLines(const SearchReport& report);  ///< how its ends were found, other displacements
ResultLines failureLines(const SearchReport& report);   ///< what fails and how, volume and mass
ResultLines groupLines(const SearchReport& report);     ///< what fell or failed before, what fails after
ResultLines supportLines(const SearchReport& report);

bool wasInterrupted(const SearchResult& result);
/// A load, or a difference of loads, without its unit.
std::string figureOf(const SearchReport& report, double load);
std::string unitOf(const SearchReport& report);  ///< " deg" or ""
std::string percentText(double share);
std::string scientific(double value);
std::string amountText(double volume, double mass);  ///< of m^3 and kg: "12.4 m3, 32.24 t"

}  // namespace talus::tools
