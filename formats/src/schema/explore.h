#pragma once
// Finds a reader's queries by giving it documents until it makes no new ones. The documents have every key of
// every table alone, in pairs and all together, with values of the queried kinds.

#include <functional>
#include <string>

#include "toml/questions.h"

namespace talus::formats::schema {

/// Reads a text and writes down its questions.
using Reading = std::function<void(const std::string& text, toml::Questions& questions)>;

toml::Questions explore(const Reading& read);

}  // namespace talus::formats::schema
