#pragma once
// Files are written whole or not at all.

#include <atomic>
#include <string>
#include <string_view>

namespace talus::tools {

/// Writes a whole file: into a temporary one beside it, then renamed, so that no half-written file is ever
/// left. A device or a pipe is written in place. Throws FileRefused.
/// \param stop  ends the writing of a large file early: then there is none, and the result is false
bool writeFile(const std::string& path, std::string_view content, const std::atomic<bool>* stop = nullptr);

/// Throws FileRefused where writeFile could not begin: before a long computation.
void refuseUnwritable(const std::string& path);

/// Before a long computation whose file this is, by the option that names it: throws BadInput for another
/// ending and for a file that was read as input, FileRefused as above. Nothing for no name.
void refuseOutput(const std::string& option, const std::string& path, std::string_view ending);

/// Makes a folder and its parents if needed; throws FileRefused.
void makeFolder(const std::string& path);

}  // namespace talus::tools
