// Exits with 0 when the installed library links, runs and is the version that was asked for.
#include <talus/build_info.h>

#include <cstdio>

int main() {
    const std::string& version = talus::buildInfo().version;
    std::printf("found talus %s, expected %s\n", version.c_str(), EXPECTED_VERSION);
    return version == EXPECTED_VERSION ? 0 : 1;
}
