// Writes the JSON Schemas into a folder at build time. Reading thousands of documents takes seconds, too long
// for a command or a model in Python.

#include <fstream>

#include "talus/formats/schema.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const std::string folder = argv[1];
    std::ofstream(folder + "/scenario.json") << talus::formats::scenarioSchema();
    std::ofstream(folder + "/sweep.json") << talus::formats::sweepSchema();
    return 0;
}
