#pragma once
// The files this process has read as input: scenarios, meshes, sweeps and their tables, snapshot files and
// their scenarios. Every reader of this library records them here, so that writers can refuse to replace one
// under any name or link. (One list for the process: an input that a new reader forgot to pass up through
// four layers would be overwritten.)

#include <string>

namespace talus::formats {

void rememberInput(const std::string& path);

/// Whether the file at this path is one of them.
bool isInput(const std::string& path);

}  // namespace talus::formats
