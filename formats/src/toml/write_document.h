#pragma once
// A document as TOML text that reads back with the same values to the last bit and tables in the same order
// (which decides ties between joints). Comments are lost.

#include <string>

#include "toml/document.h"

namespace talus::formats::toml {

std::string writeDocument(const Document& document);

}  // namespace talus::formats::toml
