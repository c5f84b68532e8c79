#pragma once
// Numbers as text, and text on stdout.

#include <cstdint>
#include <string>

#include "talus/angles.h"  // degrees(), radians()

namespace talus::tools {

void printText(const std::string& text);         ///< on stdout; throws FileRefused
void printResult(const std::string& text);       ///< the same, with lines that fit a terminal
std::string hashText(std::uint64_t state_hash);  ///< 16 hex digits
std::string text(double value, int decimals);    ///< fixed notation, locale-free

}  // namespace talus::tools
