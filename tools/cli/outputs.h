#pragma once
// Rules for output files. All writing of commands goes through here. No output replaces a file that the
// command reads, even with --force. The ending of a name gives the format.

#include <initializer_list>
#include <string>
#include <string_view>

#include "cli/common.h"
#include "talus/formats/output_file.h"

namespace talus::tools {

/// Throws BadInput when this path leads to a file that was read as input, under any name. `option` is the
/// option with the path ("--output"); it may be empty.
void refuseInput(const std::string& option, const std::string& path);

/// Throws BadInput unless the name ends in one of these (".csv", ...); devices and pipes may be called
/// anything.
void requireEnding(const std::string& option, const std::string& path,
                   std::initializer_list<std::string_view> endings);

/// Opens and locks a file that is written during a computation; throws FileRefused, also when another process
/// is writing it. Warns on stderr where locks do not work.
formats::OutputFile takeOutput(const Common& common, const std::string& path);

}  // namespace talus::tools
