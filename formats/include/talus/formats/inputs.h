#pragma once
// The files this process has read as input: scenarios, meshes, sweeps and their tables, snapshot files and
// the scenarios they were made from. Every reader of this library tells them here, so that whoever writes a
// file can refuse to replace one, whatever it is called and whatever links lead to it. (It is one list for
// the process: an input that some new reader forgot to hand up through four layers would be one that is
// overwritten.)

#include <string>

namespace talus::formats {

void rememberInput(const std::string& path);

/// Whether what stands at this path is one of them.
bool isInput(const std::string& path);

}  // namespace talus::formats
