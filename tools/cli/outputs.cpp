#include "cli/outputs.h"

#include <algorithm>
#include <filesystem>

#include "cli/failures.h"
#include "talus/formats/inputs.h"

namespace talus::tools {

namespace {

bool isDeviceOrPipe(const std::string& path) {
    std::error_code absent;
    const auto status = std::filesystem::status(path, absent);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
}

}  // namespace

void refuseInput(const std::string& option, const std::string& path) {
    if (formats::isInput(path))
        throw BadInput(Error{option, "is a file that this command reads; choose another file", path});
}

void requireEnding(const std::string& option, const std::string& path,
                   std::initializer_list<std::string_view> endings) {
    const bool known = std::any_of(endings.begin(), endings.end(),
                                   [&](std::string_view ending) { return path.ends_with(ending); });
    if (known || isDeviceOrPipe(path)) return;
    std::string list;
    for (const std::string_view ending : endings)
        list += (list.empty() ? "" : ending == *(endings.end() - 1) ? " or " : ", ") + std::string(ending);
    throw BadInput(Error{option, "found \"" + path + "\", allowed: a name that ends in " + list});
}

formats::OutputFile takeOutput(const Common& common, const std::string& path) {
    auto file = formats::OutputFile::open(path);
    if (!file) throw FileRefused(file.errors().front().field + ": " + file.errors().front().message);
    if (const std::string warning = formats::lockWarning(file->lockReach()); !warning.empty())
        note(common, "warning: " + path + ": " + warning);
    return std::move(*file);
}

}  // namespace talus::tools
