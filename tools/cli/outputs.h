#pragma once
// What may be written where. Whatever a command writes goes through here: no output replaces a file that the
// command reads, --force or not, and a name says by its ending what is in the file.

#include <initializer_list>
#include <string>
#include <string_view>

#include "cli/common.h"
#include "talus/formats/output_file.h"

namespace talus::tools {

/// Throws BadInput when this path leads to a file that was read as input, under whatever name. `option` is
/// what brought the path ("--output"); it may be empty.
void refuseInput(const std::string& option, const std::string& path);

/// Throws BadInput unless the name ends in one of these (".csv", ...); devices and pipes may be called
/// anything.
void requireEnding(const std::string& option, const std::string& path,
                   std::initializer_list<std::string_view> endings);

/// Opens and locks a file that is written while a computation goes on; throws FileRefused, also when another
/// process is writing it. Says on stderr where locks do not reach.
formats::OutputFile takeOutput(const Common& common, const std::string& path);

}  // namespace talus::tools
