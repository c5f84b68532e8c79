#pragma once
// Finds out what a reader asks, by giving it documents until it asks nothing new: every key of every table
// alone, in pairs and all together, with values of the kinds that it has asked for.

#include <functional>
#include <string>

#include "toml/questions.h"

namespace talus::formats::schema {

/// Reads a text and writes down its questions.
using Reading = std::function<void(const std::string& text, toml::Questions& questions)>;

toml::Questions explore(const Reading& read);

}  // namespace talus::formats::schema
